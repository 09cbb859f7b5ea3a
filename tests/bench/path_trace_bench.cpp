// What the reference costs over its bare rays. For each scene the rays of one picture are logged; then the picture is
// path-traced, and the logged rays are traced by plain rtcIntersect1, turn by turn on one thread of one run.
//   daylit_bench --benchmark_filter=path_trace
// `ratio` is path-traced rays a second over plain ones; the target is 0.5.
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "content/content.h"
#include "engine/scene/gltf.h"
#include "gi/transport/path_trace/path_trace.h"

namespace daylit {
namespace {

constexpr int kWidth = 192, kHeight = 108, kSpp = 8;

/// Embree with nothing of ours around it.
class PlainEmbree {
  public:
    explicit PlainEmbree(const WorldMesh& mesh) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3),
                                                 mesh.positions.size());
        std::copy(mesh.positions.begin(), mesh.positions.end(), static_cast<Vec3*>(vertices));
        void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                3 * sizeof(std::uint32_t), mesh.triangle_count());
        std::copy(mesh.indices.begin(), mesh.indices.end(), static_cast<std::uint32_t*>(indices));
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        rtcCommitScene(scene_);
    }
    ~PlainEmbree() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    PlainEmbree(const PlainEmbree&) = delete;
    PlainEmbree& operator=(const PlainEmbree&) = delete;

    /// Rays that hit something.
    std::size_t trace(const std::vector<Ray>& rays) const {
        std::size_t hits = 0;
        for (const Ray& ray : rays) {
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            RTCRayHit r{};
            r.ray.org_x = ray.origin.x, r.ray.org_y = ray.origin.y, r.ray.org_z = ray.origin.z;
            r.ray.dir_x = ray.direction.x, r.ray.dir_y = ray.direction.y, r.ray.dir_z = ray.direction.z;
            r.ray.tnear = ray.t_min, r.ray.tfar = ray.t_max, r.ray.mask = ~0u;
            r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(scene_, &context, &r);
            hits += r.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        }
        return hits;
    }

  private:
    RTCDevice device_;
    RTCScene scene_;
};

struct BenchScene {
    std::string name;
    std::filesystem::path path;
    Vec3 eye = Vec3(0.0f), at = Vec3(0.0f);  // equal: the scene's first camera
};

/// A scene at noon, and the rays of one small picture of it.
struct Traced {
    Scene scene;
    WorldMesh mesh;
    std::unique_ptr<RayScene> rays;
    Lighting lighting;
    std::vector<PlacedLight> lamps;
    View view;
    std::vector<Ray> log;

    explicit Traced(const BenchScene& which) : scene(load_scene(which.path)) {
        const Pose pose = pose_scene(scene);
        mesh = world_mesh(scene, pose, Part::All);
        rays = std::make_unique<RayScene>(scene, mesh);
        lamps = placed_lights(scene, pose);
        lighting = LightModel({}, lamps).at(12.0);
        view = which.eye == which.at ? camera_view(scene, pose, scene.cameras.at(0).name)
                                     : look_at(which.eye, which.at, 1.0f);
        const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
        rays->log_rays(&log);
        picture();
        rays->log_rays(nullptr);
    }
    PathTraceImage picture() const { return path_trace(*rays, lighting, lamps, view, kWidth, kHeight, {.spp = kSpp}); }
};

/// By the process's CPU clock, so that neighbours on the machine do not count.
double seconds_of(const auto& work) {
    const std::clock_t start = std::clock();
    work();
    return double(std::clock() - start) / CLOCKS_PER_SEC;
}

void path_trace_over_plain_rays(benchmark::State& state, const BenchScene& which) {
    static std::map<std::string, std::unique_ptr<Traced>> scenes;  // loaded once for all repetitions
    std::unique_ptr<Traced>& traced = scenes[which.name];
    if (!traced) traced = std::make_unique<Traced>(which);
    const PlainEmbree plain(traced->mesh);
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    double ours = 0.0, bare = 0.0, rays = 0.0;
    for (auto _ : state) {
        ours += seconds_of([&] { benchmark::DoNotOptimize(traced->picture()); });
        bare += seconds_of([&] { benchmark::DoNotOptimize(plain.trace(traced->log)); });
        rays += double(traced->log.size());
    }
    state.counters["path_traced_rays/s"] = rays / ours;
    state.counters["plain_rays/s"] = rays / bare;
    state.counters["ratio"] = bare / ours;
    state.counters["triangles"] = double(traced->mesh.triangle_count());
}

void add(const BenchScene& scene) {
    benchmark::RegisterBenchmark(("path_trace/" + scene.name).c_str(), path_trace_over_plain_rays, scene)
        ->Unit(benchmark::kMillisecond);
}

/// The demo level, and the shared scenes where they are: rooms from inside, a town from the street.
void add_scenes(const std::filesystem::path& work) {
    for (const ContentScene& made : content_scenes()) {
        if (made.name != "koldinghus" && made.name != "cornell_box") continue;
        const std::filesystem::path path = work / (made.name + ".glb");
        make_scene(made.name, path);
        add({made.name, path});
    }
    const std::filesystem::path shared = std::filesystem::path(DAYLIT_SHARED_DIR) / "scenes";
    const BenchScene scenes[] = {
        {"living-room", shared / "living-room/living_room.glb", {0, 0.5f, 11}, {0, 0, 0}},
        {"duplex-apartment", shared / "duplex-apartment/duplex-apartment.gltf", {3.2f, 1.5f, 13.2f}, {5.2f, 1, 19.8f}},
    };
    for (const BenchScene& scene : scenes)
        if (std::filesystem::exists(scene.path)) add(scene);
}

}  // namespace
}  // namespace daylit

int main(int argc, char** argv) try {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    const std::filesystem::path work = std::filesystem::temp_directory_path() / "daylit_bench";
    std::filesystem::create_directories(work);
    daylit::add_scenes(work);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
