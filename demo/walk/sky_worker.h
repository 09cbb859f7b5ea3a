#pragma once
// Works out the sky beside the walk, so that dragging the sun never holds up a frame.
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "engine/scene/sky.h"

namespace daylit {

class SkyWorker {
  public:
    struct Result {
        std::shared_ptr<const LightModel> model;  // its suns(hour) is cheap enough for every frame
        Lighting lighting;
        std::string error;  // not empty: nothing else is filled
    };

    /// placed   the scene's lights, as for LightModel
    explicit SkyWorker(std::vector<PlacedLight> placed);
    ~SkyWorker();
    SkyWorker(const SkyWorker&) = delete;
    SkyWorker& operator=(const SkyWorker&) = delete;

    /// Asks for the light of an hour. Of several requests that wait, only the last one is worked out.
    void request(const LightSettings& settings, double hour);
    /// The newest result since the last call.
    std::optional<Result> take();
    /// Until the requests made so far are answered.
    Result wait();
    bool busy() const;

  private:
    struct Request {
        LightSettings settings;
        double hour = 0;
    };
    void work();
    Result answer(const Request& request);

    std::vector<PlacedLight> placed_;
    std::shared_ptr<const LightModel> model_;  // the worker's own, of the last settings
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<Request> request_;
    std::optional<Result> result_;
    bool working_ = false, stop_ = false;
    std::thread thread_;  // last: it uses all of the above
};

}  // namespace daylit
