// daylit points: places to measure indirect irradiance at, and the irradiance there by any method.
#include <CLI/App.hpp>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "demo/commands.h"
#include "demo/lightmap_points.h"
#include "demo/output.h"
#include "demo/points_csv.h"
#include "demo/progress.h"
#include "demo/sample_points.h"
#include "demo/traced_scene.h"
#include "engine/baked/volume_batch.h"
#include "engine/base/error.h"

namespace daylit {
namespace {

struct PointsOptions {
    SceneOptions scene;
    std::string sample, input, output, method, light, hour = "12";
    int count = 1000, spp = 256, bounces = 1000, threads = 0;
    std::uint64_t seed = 1;
    bool json = false;
};

std::vector<SurfaceSample> sample(const PointsOptions& options, const TracedScene& scene) {
    if (options.count < 1 || options.count > 10000000) throw Error("--count", "give 1 to 10000000");
    if (options.sample == "surface") return sample_surface(scene.rays, scene.pose, options.count, options.seed);
    if (options.sample == "space") return sample_space(scene.rays, scene.pose, options.count, options.seed);
    throw UsageError("--sample", "'" + options.sample + "' is not one of surface, space");
}

std::vector<Rgb> by_reference(const PointsOptions& options, const TracedScene& scene,
                              const std::vector<SurfaceSample>& points) {
    if (options.spp < 1 || options.spp > 1 << 20) throw Error("--spp", "give 1 to 1048576 paths a point");
    if (options.bounces < 0 || options.bounces > 100000) throw Error("--bounces", "give 0 to 100000");
    return path_trace_irradiance(
        scene.rays, scene.lighting, scene.lamps, points,
        {.spp = options.spp, .max_bounces = options.bounces, .seed = options.seed, .layer = Layer::Indirect},
        make_progress("reference at points"));
}

std::vector<Rgb> by_lightmap(const PointsOptions& options, const TracedScene& scene,
                             const std::vector<SurfaceSample>& points) {
    if (!scene.loaded.baked->lightmap) throw Error(options.light, "has no lightmap; daylit info says why");
    return lightmap_irradiance(*scene.loaded.baked->lightmap, scene.loaded.scene, scene.lighting.scales, scene.hour,
                               points);
}

std::vector<Rgb> by_volume(const PointsOptions& options, const TracedScene& scene,
                           const std::vector<SurfaceSample>& points) {
    if (!scene.loaded.baked->volume) throw Error(options.light, "has no volume; daylit info says why");
    const IrradianceVolume& volume = *scene.loaded.baked->volume;
    const VolumeLight light(volume, volume.basis.weights(scene.lighting.scales, scene.hour));
    std::vector<Vec3> places, normals;
    for (const SurfaceSample& p : points) places.push_back(p.position), normals.push_back(p.normal);
    std::vector<Rgb> result(points.size());
    VolumeBatch(light).irradiance(places, normals, result);
    return result;
}

/// Every method that answers "indirect irradiance at these points, at this hour" has its line here.
std::vector<Rgb> evaluate(const PointsOptions& options, const TracedScene& scene,
                          const std::vector<SurfaceSample>& points) {
    if (options.method == "reference") return by_reference(options, scene, points);
    for (const char* part : {"lightmap", "volume", "dirmap", "antiradiance"})
        if (options.method == part && !scene.loaded.baked)
            throw UsageError("--method", options.method + " reads a baked file; name it with --light");
    if (options.method == "lightmap") return by_lightmap(options, scene, points);
    if (options.method == "volume") return by_volume(options, scene, points);
    for (const char* part : {"dirmap", "antiradiance"})
        if (options.method == part)
            throw Error(options.light, "has no " + options.method + "; daylit info lists what it has");
    if (options.method == "photons") throw Error("--method", "this build of daylit has no photon map");
    throw UsageError("--method", "'" + options.method +
                                     "' is not one of lightmap, volume, dirmap, antiradiance, photons, reference");
}

void print_report(const std::vector<SurfaceSample>& points, const std::vector<Rgb>& irradiance, double seconds) {
    nlohmann::json json = {{"points", points.size()}, {"seconds", seconds}};
    if (!irradiance.empty()) {
        glm::dvec3 sum(0.0);
        for (const Rgb& e : irradiance) sum += glm::dvec3(e);
        sum /= double(irradiance.size());
        json["mean"] = {sum.r, sum.g, sum.b};
    }
    std::printf("%s\n", json.dump(2).c_str());
}

void run(const PointsOptions& options) {
    if (options.sample.empty() == options.input.empty())
        throw UsageError("points", "give either --sample surface|space, or --in FILE with --method");
    if (options.input.empty() != options.method.empty())
        throw UsageError("--method", "goes with --in FILE, the points to evaluate");
    check_output(options.output, {".csv"});
    const ThreadLimit threads(options.threads);
    std::vector<SurfaceSample> points;
    if (!options.input.empty()) points = read_points(options.input);
    const TracedScene scene(options.scene, options.light, options.hour);

    const auto start = std::chrono::steady_clock::now();
    std::vector<Rgb> irradiance;
    if (options.input.empty())
        points = sample(options, scene);
    else
        irradiance = evaluate(options, scene, points);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

    write_points(options.output, points, irradiance);
    if (options.json) print_report(points, irradiance, seconds);
}

}  // namespace

void add_points(CLI::App& app) {
    CLI::App* command = app.add_subcommand("points", "indirect irradiance at points, by any method; as CSV");
    const auto options = std::make_shared<PointsOptions>();
    add_scene_options(*command, options->scene);
    command->add_option("-o", options->output, "CSV to write: x,y,z,nx,ny,nz, with --method also r,g,b in lux")
        ->required();
    command->add_option("--sample", options->sample,
                        "surface (by area, static surfaces, not where solids cover one another) | space (free space "
                        "reachable from the cameras, or from "
                        "the open sky in a scene without any)");
    command->add_option("--count", options->count, "points to draw")->capture_default_str();
    add_seed(*command, options->seed, "of the random numbers");
    command->add_option("--in", options->input, "CSV of points to evaluate");
    command->add_option("--hour", options->hour, "H or HH:MM, local clock")->capture_default_str();
    command->add_option("--method", options->method, "lightmap | volume | dirmap | antiradiance | photons | reference");
    command->add_option("--light", options->light, "baked file");
    command->add_option("--spp", options->spp, "paths a point (reference)")->capture_default_str();
    command->add_option("--bounces", options->bounces, "segments past the point (reference)")->capture_default_str();
    command->add_option("--threads", options->threads, "0: all cores")->capture_default_str();
    command->add_flag("--json", options->json, "count, mean and seconds on stdout");
    command->callback([options] { run(*options); });
}

}  // namespace daylit
