#include "demo/report/seen_frames.h"

#include <algorithm>

#include "demo/parse.h"
#include "engine/base/error.h"
#include "engine/base/exposure.h"
#include "gi/encode/frame_lightmap.h"
#include "gi/lightmap_rows.h"
#include "gi/solved_day.h"

namespace daylit {
namespace {

TiltRows tilt_rows(const LightmapRows& rows) {
    return {rows.tilts.row_of_texel, rows.tilts.rows};
}

LightmapRows solve(const BakeInput& input, const Progress& progress) {
    SolvedDay solved(input, progress);
    return lightmap_rows(solved, {progress, SolvedDay::kShare, 1.0});
}

Baked with_map(const BakeInput& input, DayLightmap map) {
    Baked baked;
    baked.light = input.settings.light, baked.unit = input.settings.unit, baked.lambert = input.settings.lambert;
    baked.geometry_hash = geometry_hash(input.mesh);
    baked.lightmap = std::move(map);
    return baked;
}

PictureResult judge(const Image& compressed, const Image& whole, const ViewAt& at) {
    const double ev = auto_ev(whole);
    const DisplayedDifferences seen = displayed_differences(tonemap(compressed, ev), tonemap(whole, ev));
    const Differences linear = differences(compressed.pixels, whole.pixels);
    PictureResult result{at.view, at.hour, {}, {}, {}};
    result.values = {{"flip_mean", seen.flip_mean},
                     {"flip_p95", seen.flip_p95},
                     {"yee_share", double(seen.yee_failed) / double(whole.pixels.size())}};
    if (std::isfinite(linear.nrmse)) result.values["nrmse"] = linear.nrmse;
    if (std::isfinite(linear.bias)) result.values["bias"] = linear.bias;
    return result;
}

std::vector<Finding> findings(const std::vector<PictureResult>& pictures, const Size& size) {
    std::size_t seen = 0;
    const PictureResult* worst = &pictures.front();
    for (const PictureResult& picture : pictures) {
        const double share = picture.values.at("yee_share");
        seen += share > 0.0;
        if (share > worst->values.at("yee_share")) worst = &picture;
    }
    const double pixels = double(size.width) * double(size.height), most = worst->values.at("yee_share") * pixels;
    return {{"yee_frames", double(seen),
             "In " + std::to_string(seen) + " of " + std::to_string(pictures.size()) +
                 " frames a viewer could tell some pixel from the uncompressed lightmap's"},
            {"yee_most_pixels", most,
             "At most " + written(most, Unit::Number) + " of " + written(pixels, Unit::Number) +
                 " pixels of a frame can be told apart, in " + worst->view + " at " + clock_text(worst->hour)}};
}

}  // namespace

StudyResult compare_seen_frames(const BakeSettings& base, const Judges& judges, const Progress& progress) {
    if (!judges.frames || judges.pictures.empty()) throw Error("not compared", "no pictures can be drawn");
    BakeSettings settings = base;
    settings.parts = {"lightmap"};
    const BakeInput input(judges.level.loaded.scene, settings);
    if (!input.plan.lightmap) throw Error("not compared", "the scene has no static surfaces to hold a lightmap");
    const LightmapRows rows = solve(input, [&](double done) { return !progress || progress(0.6 * done); });
    EncodedLightmap encoded = encode_lightmap(rows.shape, rows.light(), tilt_rows(rows), rows.row_of_pixel, {});

    RunResult run{.method = "seen-frames", .axis = "tiles", .name = "as bakes do"};
    run.note = "encoding error " + written(encoded.error, Unit::Share) + ", tiles of " +
               std::to_string(encoded.map.slots()) + " components at most";
    const Baked compressed = with_map(input, std::move(encoded.map));
    std::vector<double> hours;
    for (const PictureTruth& picture : judges.pictures) hours.push_back(picture.at.hour);
    std::sort(hours.begin(), hours.end());
    hours.erase(std::unique(hours.begin(), hours.end()), hours.end());
    for (std::size_t h = 0; h < hours.size(); ++h) {
        std::vector<ViewAt> views;
        for (const PictureTruth& picture : judges.pictures)
            if (picture.at.hour == hours[h]) views.push_back(picture.at);
        const LightModel& light = judges.level.light;
        const std::vector<Rgb> weights = rows.basis.weights(light.scales(hours[h], light.settings().clouds), hours[h]);
        const Baked whole =
            with_map(input, frame_lightmap(rows.shape, rows.light(), tilt_rows(rows), rows.row_of_pixel, weights));
        const auto drawn = [&](const Baked& baked) {
            return judges.frames->draw(judges.level, baked, views, judges.size, false).radiance;
        };
        const std::vector<Image> ours = drawn(compressed), truth = drawn(whole);
        for (std::size_t i = 0; i < views.size(); ++i) run.pictures.push_back(judge(ours[i], truth[i], views[i]));
        if (progress && !progress(0.6 + 0.4 * double(h + 1) / double(hours.size()))) throw Interrupted();
    }
    for (const char* key : {"yee_share", "flip_mean"})
        for (const PictureResult& picture : run.pictures)
            run.values[key] += picture.values.at(key) / double(run.pictures.size());
    StudyResult result;
    result.findings = findings(run.pictures, judges.size);
    result.runs.push_back(std::move(run));
    return result;
}

}  // namespace daylit
