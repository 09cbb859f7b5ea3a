#include "demo/report/truth.h"

#include <cmath>

#include "demo/report/result.h"
#include "engine/base/error.h"
#include "engine/base/exposure.h"

namespace daylit {
namespace {

constexpr int kEstimates = 4;
constexpr std::uint64_t kTruthSeed = 0x7275746874;  // unlike those of bakes and of traced runs

std::array<float, 3> numbers(const Rgb& v) {
    return {v.r, v.g, v.b};
}

Rgb rgb(const nlohmann::json& json) {
    return {json.at(0).get<float>(), json.at(1).get<float>(), json.at(2).get<float>()};
}

/// The estimates' mean into truth.light; the squared error of each mean, summed over the hour's points and channels.
double settle(const std::vector<std::vector<Rgb>>& estimates, std::vector<Rgb>& mean) {
    const std::size_t count = estimates.front().size();
    double squares = 0.0;
    mean.assign(count, Rgb(0.0f));
    for (std::size_t i = 0; i < count; ++i) {
        glm::dvec3 sum(0.0), square(0.0);
        for (const auto& estimate : estimates) sum += glm::dvec3(estimate[i]) / double(kEstimates);
        for (const auto& estimate : estimates)
            square += (glm::dvec3(estimate[i]) - sum) * (glm::dvec3(estimate[i]) - sum);
        mean[i] = Rgb(sum);
        squares += (square.x + square.y + square.z) / double(kEstimates * (kEstimates - 1));
    }
    return squares;
}

double mean_of(std::span<const Rgb> values) {
    glm::dvec3 sum(0.0);
    for (const Rgb& v : values) sum += glm::dvec3(v);
    return (sum.x + sum.y + sum.z) / (3.0 * double(std::max<std::size_t>(values.size(), 1)));
}

}  // namespace

LevelAtRest::LevelAtRest(const SceneOptions& options)
    : loaded(load(options)),
      pose(pose_scene(loaded.scene)),
      mesh(world_mesh(loaded.scene, pose, Part::All)),
      rays(loaded.scene, mesh),
      lamps(placed_lights(loaded.scene, pose)),
      light(loaded.light, lamps) {}

std::vector<Lighting> LevelAtRest::at(const std::vector<double>& hours) const {
    std::vector<Lighting> lighting;
    for (const double hour : hours) lighting.push_back(light.at(hour));
    return lighting;
}

LightAtPoints trace_once(const LevelAtRest& level, const PointTruth& at, const std::vector<Lighting>& lighting, int spp,
                         std::uint64_t seed, const Progress& progress) {
    LightAtPoints light;
    for (std::size_t h = 0; h < lighting.size(); ++h) {
        const Progress part = [&](double done) {
            return !progress || progress((double(h) + done) / double(lighting.size()));
        };
        light.push_back(path_trace_irradiance(level.rays, lighting[h], level.lamps, at.points,
                                              {.spp = spp, .seed = seed, .layer = Layer::Indirect}, part));
    }
    return light;
}

PointTruth trace_points(const LevelAtRest& level, std::vector<SurfaceSample> points, const std::vector<double>& hours,
                        int spp, const Progress& progress) {
    PointTruth truth{std::move(points), hours, {}, 0.0};
    const std::vector<Lighting> lighting = level.at(hours);
    std::vector<LightAtPoints> estimates;
    for (int i = 0; i < kEstimates; ++i) {
        const Progress part = [&](double done) { return !progress || progress((i + done) / kEstimates); };
        estimates.push_back(
            trace_once(level, truth, lighting, std::max(1, spp / kEstimates), kTruthSeed + std::uint64_t(i), part));
    }
    truth.light.resize(hours.size());
    int lit = 0;
    for (std::size_t h = 0; h < hours.size(); ++h) {
        std::vector<std::vector<Rgb>> hour;
        for (LightAtPoints& estimate : estimates) hour.push_back(std::move(estimate[h]));
        const double squares = settle(hour, truth.light[h]), mean = mean_of(truth.light[h]);
        if (!(mean > 0.0)) continue;
        truth.standard_error += std::sqrt(squares / (3.0 * double(truth.points.size()))) / mean;
        ++lit;
    }
    if (lit > 0) truth.standard_error /= lit;
    return truth;
}

std::map<std::string, double> judge(const LightAtPoints& found, const PointTruth& truth) {
    std::map<std::string, double> values;
    double nrmse = 0.0, worst = 0.0, bias = 0.0;
    int lit = 0;
    for (std::size_t h = 0; h < truth.hours.size(); ++h) {
        const Differences d = differences(found[h], truth.light[h]);
        if (d.nan_count > 0) throw Error("the method", "answers with numbers that are none");
        if (!std::isfinite(d.nrmse) || !(mean_of(truth.light[h]) > 0.0)) continue;  // no light at that hour
        nrmse += d.nrmse, bias += d.bias, worst = std::max(worst, d.nrmse);
        ++lit;
    }
    if (lit == 0)
        throw Error("the scene", "has no indirect light at any of these points and hours, so nothing can be judged");
    return {{"nrmse", nrmse / lit}, {"nrmse_worst", worst}, {"bias", bias / lit}};
}

PictureTruth trace_picture(const LevelAtRest& level, const ViewAt& at, Size size, int spp, const Progress& progress) {
    PathTraceImage picture =
        path_trace(level.rays, level.light.at(at.hour), level.lamps, at.camera, size.width, size.height,
                   {.spp = std::max(2, spp), .seed = kTruthSeed, .layer = Layer::Final}, progress);
    const double ev = auto_ev(picture.radiance);
    return {at, std::move(picture.radiance), ev, picture.relative_error};
}

JudgedPicture judge(const Image& radiance, const PictureTruth& truth) {
    JudgedPicture judged;
    judged.shown = tonemap(radiance, truth.ev);
    const Differences linear = differences(radiance.pixels, truth.radiance.pixels);
    if (linear.nan_count > 0) throw Error("the picture", "has pixels that are no numbers");
    DisplayedDifferences seen = displayed_differences(judged.shown, tonemap(truth.radiance, truth.ev));
    judged.flip = std::move(seen.flip);
    judged.result.view = truth.at.view;
    judged.result.hour = truth.at.hour;
    judged.result.values = {{"flip_mean", seen.flip_mean},
                            {"flip_p95", seen.flip_p95},
                            {"yee_share", double(seen.yee_failed) / double(radiance.pixels.size())}};
    if (std::isfinite(linear.nrmse)) judged.result.values["nrmse"] = linear.nrmse;
    if (std::isfinite(linear.bias)) judged.result.values["bias"] = linear.bias;
    return judged;
}

void to_json(nlohmann::json& json, const PointTruth& truth) {
    json = {{"hours", truth.hours},
            {"standard_error", truth.standard_error},
            {"points", nlohmann::json::array()},
            {"light", nlohmann::json::array()}};
    for (const SurfaceSample& p : truth.points) json["points"].push_back({numbers(p.position), numbers(p.normal)});
    for (const std::vector<Rgb>& hour : truth.light) {
        nlohmann::json values = nlohmann::json::array();
        for (const Rgb& e : hour) values.push_back(numbers(e));
        json["light"].push_back(std::move(values));
    }
}

void from_json(const nlohmann::json& json, PointTruth& truth) {
    json.at("hours").get_to(truth.hours), json.at("standard_error").get_to(truth.standard_error);
    for (const nlohmann::json& p : json.at("points")) truth.points.push_back({rgb(p.at(0)), rgb(p.at(1))});
    for (const nlohmann::json& hour : json.at("light")) {
        std::vector<Rgb>& light = truth.light.emplace_back();
        for (const nlohmann::json& e : hour) light.push_back(rgb(e));
    }
}

}  // namespace daylit
