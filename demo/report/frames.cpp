#include "demo/report/frames.h"

#include <algorithm>

#include "engine/gl/context.h"
#include "engine/render/renderer.h"

namespace daylit {
namespace {

constexpr int kTimedFrames = 5;
constexpr double kMinute = 1.0 / 60.0;

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
    return values[values.size() / 2];
}

/// Sums over the passes of a frame, seconds.
struct FrameCost {
    double relight = 0.0, wall = 0.0, processor = 0.0;
};

FrameCost cost(const FrameReport& report) {
    FrameCost sum;
    for (const PassReport& pass : report.passes) {
        sum.wall += 1e-3 * pass.milliseconds, sum.processor += 1e-3 * pass.processor_milliseconds;
        if (pass.name == "relight") sum.relight += 1e-3 * pass.milliseconds;
    }
    return sum;
}

class GlFrameMaker : public FrameMaker {
  public:
    GlFrameMaker() : context_(make_any_context()) {}
    std::string driver() const override { return context_->description(); }

    Frames draw(const LevelAtRest& level, const Baked& baked, const std::vector<ViewAt>& views, Size size,
                bool timed) override {
        Renderer renderer(level.loaded.scene, &baked);
        renderer.set_pose(level.pose);
        Frames frames;
        frames.radiance.resize(views.size());
        std::vector<std::size_t> order(views.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return views[a].hour < views[b].hour; });
        for (const std::size_t i : order) {
            light(renderer, level, views[i].hour);
            renderer.draw(frame_of(views[i], size));
            frames.radiance[i] = renderer.read_radiance();
        }
        if (timed && !views.empty()) frames.values = times(renderer, level, views.front(), size);
        return frames;
    }

  private:
    static void light(Renderer& renderer, const LevelAtRest& level, double hour) {
        renderer.set_lighting(level.light.at(hour));
    }

    static FrameSettings frame_of(const ViewAt& at, Size size) {
        FrameSettings frame;
        frame.view = at.camera;
        frame.width = size.width, frame.height = size.height;
        frame.hour = at.hour;
        frame.ev = 0.0;  // radiance is judged, not what is displayed
        frame.samples_per_side = 2;
        return frame;
    }

    static std::map<std::string, double> times(Renderer& renderer, const LevelAtRest& level, const ViewAt& at,
                                               Size size) {
        FrameSettings frame = frame_of(at, size);
        frame.timings = true;
        std::vector<double> relight, wall, processor;
        for (int i = 0; i < kTimedFrames; ++i) {
            frame.hour = at.hour - (i % 2 ? 0.0 : kMinute);
            light(renderer, level, frame.hour);
            relight.push_back(cost(renderer.draw(frame)).relight);
        }
        for (int i = 0; i < kTimedFrames; ++i) {
            const FrameCost still = cost(renderer.draw(frame));
            wall.push_back(still.wall), processor.push_back(still.processor);
        }
        return {{"relight_seconds", median(relight)},
                {"frame_seconds", median(wall)},
                {"frame_processor_seconds", median(processor)}};
    }

    std::unique_ptr<GlContext> context_;
};

}  // namespace

std::unique_ptr<FrameMaker> FrameMaker::open(std::string& why) {
    try {
        return std::make_unique<GlFrameMaker>();
    } catch (const std::exception& error) {
        why = error.what();
        return nullptr;
    }
}

}  // namespace daylit
