#pragma once
// Bakes and judges every setting of a method, keeping what is finished.
#include <functional>
#include <vector>

#include "demo/report/finished.h"
#include "demo/report/frames.h"
#include "demo/report/methods.h"
#include "demo/report/truth.h"

namespace daylit {

/// What runs are judged by; all of it outlives the runner.
struct Judges {
    const LevelAtRest& level;
    const PointTruth& surface;
    const PointTruth& space;
    const std::vector<PictureTruth>& pictures;  // empty: none
    FrameMaker* frames = nullptr;               // null: no pictures
    Size size;
};

/// One setting: bake, file, look-ups, pictures. Failures of the method become RunResult::failure.
/// keep_pictures   writes PNGs into `folder` and names them in the result
RunResult run_point(const ReportMethod& method, const SweepPoint& point, const Judges& judges,
                    const std::filesystem::path& folder, bool keep_pictures, const Progress& progress);

/// The path tracer with few paths: at points (axis "surface" or "space") and in pictures (axis "pictures").
RunResult run_traced_points(const std::string& axis, const PointTruth& truth, int spp, const LevelAtRest& level,
                            const Progress& progress);
RunResult run_traced_pictures(int spp, const Judges& judges, const Progress& progress);

/// Fills traced_alike_seconds of runs by the path tracer's runs at the same kind of points: error falls with the root
/// of the paths beyond the most that were measured.
void compare_with_traced(std::vector<RunResult>& runs, const std::vector<RunResult>& traced);

}  // namespace daylit
