#pragma once
// Pictures and frame times of baked light by the renderer; nothing of it where there is no OpenGL.
#include <memory>
#include <string>
#include <vector>

#include "demo/report/truth.h"

namespace daylit {

struct Frames {
    std::vector<Image> radiance;           // one a view
    std::map<std::string, double> values;  // relight_seconds, frame_seconds, frame_processor_seconds; medians
};

class FrameMaker {
  public:
    /// Null where no context can be had; `why` says why.
    static std::unique_ptr<FrameMaker> open(std::string& why);
    virtual ~FrameMaker() = default;
    virtual std::string driver() const = 0;
    /// timed   the first view is drawn over and over for its times; else there are none
    virtual Frames draw(const LevelAtRest& level, const Baked& baked, const std::vector<ViewAt>& views, Size size,
                        bool timed) = 0;
};

}  // namespace daylit
