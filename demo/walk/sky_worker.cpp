#include "demo/walk/sky_worker.h"

#include <utility>

#include "engine/base/error.h"

namespace daylit {

SkyWorker::SkyWorker(std::vector<PlacedLight> placed) : placed_(std::move(placed)), thread_([this] { work(); }) {}

SkyWorker::~SkyWorker() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void SkyWorker::request(const LightSettings& settings, double hour) {
    {
        const std::lock_guard lock(mutex_);
        request_ = Request{settings, hour};
    }
    changed_.notify_all();
}

std::optional<SkyWorker::Result> SkyWorker::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
}

SkyWorker::Result SkyWorker::wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return result_ && !request_ && !working_; });
    Result result = std::move(*result_);
    result_.reset();
    return result;
}

bool SkyWorker::busy() const {
    const std::lock_guard lock(mutex_);
    return request_ || working_ || result_;
}

void SkyWorker::work() {
    std::unique_lock lock(mutex_);
    for (;;) {
        changed_.wait(lock, [this] { return request_ || stop_; });
        if (stop_) return;
        const Request request = *std::exchange(request_, std::nullopt);
        working_ = true;
        lock.unlock();
        Result result = answer(request);
        lock.lock();
        result_ = std::move(result);
        working_ = false;
        changed_.notify_all();
    }
}

SkyWorker::Result SkyWorker::answer(const Request& request) {
    try {
        if (!model_ || !(model_->settings() == request.settings)) {
            model_ = std::make_shared<const LightModel>(request.settings, placed_);
        }
        return {model_, model_->at(request.hour), {}};
    } catch (const Error& error) {
        return {{}, {}, error.what()};
    }
}

}  // namespace daylit
