#pragma once
// The methods that the report compares: what it asks of each.
#include <functional>
#include <string>
#include <vector>

#include "engine/baked/baked_file.h"
#include "gi/sweep.h"
#include "gi/transport/path_trace/path_trace.h"

namespace daylit {

/// The moment that light is asked for.
struct Instant {
    double hour = 12.0;
    LightScales scales;  // of light's parts, then
};

struct ReportMethod {
    std::string name, about;
    std::string part;          // of a bake, by its name in --parts
    bool in_space = false;     // judged at points in free space instead of on surfaces
    bool in_pictures = false;  // static surfaces show it
    std::vector<SweepPoint> sweep;
    /// False when the bake left the part out; `why` is the plan's reason then.
    std::function<bool(const Baked& baked)> present;
    /// Indirect irradiance at points, lux.
    std::function<std::vector<Rgb>(const Baked& baked, const Scene& scene, const Instant& instant,
                                   const std::vector<SurfaceSample>& points)>
        irradiance;
    /// Seconds of one look-up on the CPU, by many; the place in the scene is known already.
    std::function<double(const Baked& baked, const Instant& instant, const std::vector<SurfaceSample>& points)> look_up;
    /// Places times keyframes that the bake holds light for.
    std::function<double(const Baked& baked)> answers;
};

/// In the order of the page. Each sweep starts with the base settings themselves, on the axis "base".
std::vector<ReportMethod> report_methods(const BakeSettings& base);

}  // namespace daylit
