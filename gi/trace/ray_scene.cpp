#include "gi/trace/ray_scene.h"

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <tuple>
#include <unordered_set>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/scene/texture.h"

namespace daylit {
namespace {

/// Unit normal by winding; zero for a triangle without area or with corners that are not finite.
/// In doubles, so that neither a scene in micrometres nor one in light years loses its small triangles.
Vec3 winding_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
    const glm::dvec3 n = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
    const double length = glm::length(n);
    if (!std::isfinite(length) || length <= 0.0) return Vec3(0.0f);
    return Vec3(n / length);
}

enum class Coverage : std::uint8_t { Full, None, Varying };

/// True when a texture may lower the alpha anywhere.
bool texture_has_alpha(const Scene& scene, const TextureRef& ref) {
    if (ref.texture < 0) return false;
    const auto& rgba = scene.images[std::size_t(scene.textures[std::size_t(ref.texture)].image)].rgba;
    for (std::size_t i = 3; i < rgba.size(); i += 4)
        if (rgba[i] != 255) return true;
    return false;
}

/// What is known of a triangle's coverage before any ray is traced, so that only leaves and lattices pay for filters.
class CoverageOfTriangles {
  public:
    CoverageOfTriangles(const Scene& scene, const WorldMesh& mesh) : scene_(scene), mesh_(mesh) {
        textured_.reserve(scene.materials.size());
        for (const Material& m : scene.materials)
            textured_.push_back(m.alpha_mode != AlphaMode::Opaque && texture_has_alpha(scene, m.base_color_texture));
    }

    Coverage operator()(std::size_t triangle) const {
        const std::size_t id = mesh_.materials[triangle];
        const Material& material = scene_.materials[id];
        if (material.alpha_mode == AlphaMode::Opaque) return Coverage::Full;
        if (textured_[id]) return Coverage::Varying;
        const std::uint32_t* corner = &mesh_.indices[3 * triangle];
        const float alpha = material.base_color.a * mesh_.colors[corner[0]].a;
        for (int k = 1; k < 3; ++k)
            if (mesh_.colors[corner[k]].a != mesh_.colors[corner[0]].a) return Coverage::Varying;
        if (material.alpha_mode == AlphaMode::Mask)
            return alpha >= material.alpha_cutoff ? Coverage::Full : Coverage::None;
        return alpha >= 1.0f ? Coverage::Full : alpha <= 0.0f ? Coverage::None : Coverage::Varying;
    }

  private:
    const Scene& scene_;
    const WorldMesh& mesh_;
    std::vector<bool> textured_;
};

template <class T>
inline T interpolate(const std::vector<T>& values, const std::uint32_t* corner, const Vec2& b) {
    return values[corner[0]] * (1.0f - b.x - b.y) + values[corner[1]] * b.x + values[corner[2]] * b.y;
}

std::array<Vec2, 2> interpolate_uvs(const WorldMesh& mesh, const std::uint32_t* corner, const Vec2& b) {
    std::array<Vec2, 2> uvs;
    for (std::size_t set = 0; set < 2; ++set)
        uvs[set] = mesh.uvs[corner[0]][set] * (1.0f - b.x - b.y) + mesh.uvs[corner[1]][set] * b.x +
                   mesh.uvs[corner[2]][set] * b.y;
    return uvs;
}

/// Of a triangle: what varies over it. Most walls are flat, plain and white, and need none of it fetched.
enum Detail : std::uint8_t { kCurved = 1, kTextured = 2, kColored = 4, kBumped = 8 };

std::uint8_t details_of(const Scene& scene, const WorldMesh& mesh, std::uint32_t triangle, const Vec3& normal) {
    const Material& m = scene.materials[mesh.materials[triangle]];
    std::uint8_t details = 0;
    if (m.normal_texture.texture >= 0) details |= kBumped;
    for (const TextureRef* ref : m.textures())
        if (ref->texture >= 0) details |= kTextured;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = mesh.indices[3 * std::size_t(triangle) + k];
        if (mesh.colors[vertex] != Rgba(1.0f)) details |= kColored;
        // Within the rounding of files that store normals as floats; either sign, as the winding decides.
        if (!(std::abs(glm::dot(mesh.normals[vertex], normal)) > 1.0f - 1e-6f)) details |= kCurved;
    }
    return details;
}

Vec3 normalized_or(const Vec3& v, const Vec3& fallback) {
    const float square = glm::dot(v, v);
    return square > 1e-20f && std::isfinite(square) ? v / std::sqrt(square) : fallback;
}

/// Triangles that were seen before with the same three corners, in whatever order: modellers leave many, and which of
/// two such Embree reports would be chance.
class SeenTriangles {
  public:
    explicit SeenTriangles(const WorldMesh& mesh) : mesh_(mesh) {}

    /// True when a triangle with these corners was added before.
    bool add(std::uint32_t triangle) {
        std::array<Vec3, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh_.positions[mesh_.indices[3 * std::size_t(triangle) + k]];
        std::sort(corners.begin(), corners.end(),
                  [](const Vec3& a, const Vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
        return !seen_.insert(corners).second;
    }

  private:
    struct Hash {
        std::size_t operator()(const std::array<Vec3, 3>& corners) const {
            std::uint64_t h = 0;
            for (const Vec3& c : corners)
                // + 0.0f: minus zero equals zero, so it must hash alike
                for (int axis = 0; axis < 3; ++axis) h = mix64(h ^ std::bit_cast<std::uint32_t>(c[axis] + 0.0f));
            return h;
        }
    };
    const WorldMesh& mesh_;
    std::unordered_set<std::array<Vec3, 3>, Hash> seen_;
};

/// Embree passes its context on to the filters; ours has the query's own data behind it, by the rays' ids.
struct QueryContext {
    explicit QueryContext(const std::uint64_t* keys_of_rays, float* shares_of_rays = nullptr)
        : keys(keys_of_rays), transmittances(shares_of_rays) {
        rtcInitIntersectContext(&embree);
    }
    RTCIntersectContext embree;
    const std::uint64_t* keys;  // of closest hits
    float* transmittances;      // of shadow rays: so far
};

struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    void operator()(RTCBuffer buffer) const { rtcReleaseBuffer(buffer); }
};
template <class Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

/// In place, as all records of a ray: copied right after being written in pieces, they would stall the processor.
void set_ray(RTCRay& r, const Ray& ray) {
    r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
    r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
    r.tnear = ray.t_min, r.tfar = ray.t_max;
    r.time = 0.0f;
    r.mask = ~0u;
    r.id = 0;
    r.flags = 0;
}
void set_ray(RTCRay8& r, std::size_t i, const Ray& ray) {
    r.org_x[i] = ray.origin.x, r.org_y[i] = ray.origin.y, r.org_z[i] = ray.origin.z;
    r.dir_x[i] = ray.direction.x, r.dir_y[i] = ray.direction.y, r.dir_z[i] = ray.direction.z;
    r.tnear[i] = ray.t_min, r.tfar[i] = ray.t_max;
    r.time[i] = 0.0f;
    r.mask[i] = ~0u;
    r.id[i] = unsigned(i);
    r.flags[i] = 0;
}

/// Which of a bundle's rays there are, as Embree asks for it.
struct ValidRays {
    alignas(32) int mask[RayScene::kBundle];
    explicit ValidRays(std::size_t count) {
        for (std::size_t i = 0; i < RayScene::kBundle; ++i) mask[i] = i < count ? -1 : 0;
    }
};

}  // namespace

struct RayScene::State {
    const Scene& scene;
    const WorldMesh& mesh;
    Bounds bounds;
    std::vector<Vec3> normals;                          // one per triangle of the mesh; zero: left out
    std::array<std::vector<std::uint32_t>, 2> members;  // triangles of the two geometries: opaque, varying coverage
    std::vector<bool> traced;
    std::vector<std::uint8_t> details;  // one per triangle: what surface_point must interpolate
    std::vector<Ray>* log = nullptr;
    Owned<RTCDevice> device;
    Owned<RTCScene> accelerator;

    State(const Scene& s, const WorldMesh& m) : scene(s), mesh(m) {
        sort_triangles();
        device.reset(rtcNewDevice(nullptr));
        if (!device) throw Error("Embree", "cannot start the ray tracer on this processor (it needs SSE2 or newer)");
        build();
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    void sort_triangles();
    void build();
    void attach(unsigned geometry_id, RTCBuffer vertices);
    float alpha(std::uint32_t triangle, const Vec2& barycentric) const;
    Vec3 bent_normal(const Hit& hit, const SurfacePoint& point) const;
    void set_hit(std::optional<Hit>& hit, unsigned geometry, unsigned primitive, float distance, float u,
                 float v) const;

    static void filter_closest(const RTCFilterFunctionNArguments* args);
    static void filter_occluded(const RTCFilterFunctionNArguments* args);
};

void RayScene::State::sort_triangles() {
    const CoverageOfTriangles coverage(scene, mesh);
    SeenTriangles seen(mesh);
    normals.resize(mesh.triangle_count(), Vec3(0.0f));
    traced.resize(mesh.triangle_count(), false);
    details.resize(mesh.triangle_count(), 0);
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        const std::uint32_t* corner = &mesh.indices[3 * std::size_t(t)];
        const Vec3 normal =
            winding_normal(mesh.positions[corner[0]], mesh.positions[corner[1]], mesh.positions[corner[2]]);
        normals[t] = normal;
        details[t] = details_of(scene, mesh, t, normal);
        const Coverage share = coverage(t);
        if (normal == Vec3(0.0f) || share == Coverage::None) continue;
        if (share == Coverage::Full && seen.add(t)) continue;
        traced[t] = true;
        members[share == Coverage::Varying].push_back(t);
        for (int k = 0; k < 3; ++k) bounds.add(mesh.positions[corner[k]]);
    }
}

void RayScene::State::build() {
    accelerator.reset(rtcNewScene(device.get()));
    rtcSetSceneFlags(accelerator.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(accelerator.get(), RTC_BUILD_QUALITY_MEDIUM);

    // Embree reads 16 bytes at each vertex: one more than there are keeps the last read inside.
    const Owned<RTCBuffer> vertices(rtcNewBuffer(device.get(), (mesh.positions.size() + 2) * sizeof(Vec3)));
    if (!vertices) throw Error("Embree", "not enough memory for the scene's vertices");
    std::memcpy(rtcGetBufferData(vertices.get()), mesh.positions.data(), mesh.positions.size() * sizeof(Vec3));
    for (unsigned id = 0; id < 2; ++id)
        if (!members[id].empty()) attach(id, vertices.get());

    // Built by one thread: the order of triangles in a leaf, which decides the remaining ties (rays through an edge,
    // overlapping coplanar triangles), would follow the number of threads.
    tbb::task_arena(1).execute([&] { rtcCommitScene(accelerator.get()); });
    if (rtcGetDeviceError(device.get()) != RTC_ERROR_NONE)
        throw Error("Embree", "cannot build the ray tracing hierarchy; is there enough memory?");
}

void RayScene::State::attach(unsigned geometry_id, RTCBuffer vertices) {
    const std::vector<std::uint32_t>& triangles = members[geometry_id];
    RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
    rtcSetGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices, 0, sizeof(Vec3),
                         mesh.positions.size());
    auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), triangles.size()));
    if (!indices) throw Error("Embree", "not enough memory for the scene's triangles");
    for (std::size_t i = 0; i < triangles.size(); ++i)
        std::memcpy(indices + 3 * i, &mesh.indices[3 * std::size_t(triangles[i])], 3 * sizeof(std::uint32_t));
    if (geometry_id == 1) {
        rtcSetGeometryUserData(geometry, this);
        rtcSetGeometryIntersectFilterFunction(geometry, filter_closest);
        rtcSetGeometryOccludedFilterFunction(geometry, filter_occluded);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(accelerator.get(), geometry, geometry_id);
    rtcReleaseGeometry(geometry);
}

float RayScene::State::alpha(std::uint32_t triangle, const Vec2& barycentric) const {
    const std::uint32_t* corner = &mesh.indices[3 * std::size_t(triangle)];
    const Material& material = scene.materials[mesh.materials[triangle]];
    return coverage(scene, material, interpolate_uvs(mesh, corner, barycentric),
                    interpolate(mesh.colors, corner, barycentric).a);
}

/// The shading normal on the side of the geometric one.
Vec3 RayScene::State::bent_normal(const Hit& hit, const SurfacePoint& point) const {
    const std::uint32_t* corner = &mesh.indices[3 * std::size_t(hit.triangle)];
    const Material& material = scene.materials[point.material];
    // Vertex normals may point against the winding in careless files; the winding decides.
    Vec3 normal = normalized_or(interpolate(mesh.normals, corner, hit.barycentric), hit.normal);
    if (glm::dot(normal, hit.normal) < 0.0f) normal = -normal;
    if (material.normal_texture.texture >= 0)
        normal =
            shading_normal(scene, material, point.uvs, normal, interpolate(mesh.tangents, corner, hit.barycentric));
    // A steep bump may lean under the surface; mirrored above it, it still sees the light it should.
    const float below = glm::dot(normal, hit.normal);
    if (below < 0.0f) normal = normalized_or(normal - 2.0f * below * hit.normal, hit.normal);
    return normal;
}

void RayScene::State::filter_closest(const RTCFilterFunctionNArguments* args) {
    const State& state = *static_cast<const State*>(args->geometryUserPtr);
    const auto* query = reinterpret_cast<const QueryContext*>(args->context);
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] == 0) continue;
        const std::uint32_t triangle = state.members[1][RTCHitN_primID(args->hit, args->N, i)];
        const float alpha =
            state.alpha(triangle, Vec2(RTCHitN_u(args->hit, args->N, i), RTCHitN_v(args->hit, args->N, i)));
        const std::uint64_t key = query->keys[RTCRayN_id(args->ray, args->N, i)];
        const float chance = float(mix64(key ^ mix64(triangle)) >> 40) * 0x1p-24f;
        if (chance >= alpha) args->valid[i] = 0;
    }
}

void RayScene::State::filter_occluded(const RTCFilterFunctionNArguments* args) {
    const State& state = *static_cast<const State*>(args->geometryUserPtr);
    auto* query = reinterpret_cast<QueryContext*>(args->context);
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] == 0) continue;
        const float alpha = state.alpha(state.members[1][RTCHitN_primID(args->hit, args->N, i)],
                                        Vec2(RTCHitN_u(args->hit, args->N, i), RTCHitN_v(args->hit, args->N, i)));
        float& transmittance = query->transmittances[RTCRayN_id(args->ray, args->N, i)];
        transmittance *= 1.0f - std::min(alpha, 1.0f);
        if (transmittance > 0.0f) args->valid[i] = 0;
    }
}

/// Writes in place: an optional copied right after being written in pieces would stall the processor.
void RayScene::State::set_hit(std::optional<Hit>& hit, unsigned geometry, unsigned primitive, float distance, float u,
                              float v) const {
    if (geometry == RTC_INVALID_GEOMETRY_ID) return hit.reset();
    Hit& met = hit.emplace();
    met.triangle = members[geometry][primitive];
    met.distance = distance;
    met.barycentric.x = u, met.barycentric.y = v;
    const Vec3& normal = normals[met.triangle];
    met.normal.x = normal.x, met.normal.y = normal.y, met.normal.z = normal.z;
}

RayScene::RayScene(const Scene& scene, const WorldMesh& mesh) : state_(std::make_unique<State>(scene, mesh)) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;

const Scene& RayScene::scene() const {
    return state_->scene;
}

const WorldMesh& RayScene::mesh() const {
    return state_->mesh;
}

Bounds RayScene::bounds() const {
    return state_->bounds;
}

bool RayScene::traced(std::uint32_t triangle) const {
    return state_->traced[triangle];
}

const Vec3& RayScene::normal(std::uint32_t triangle) const {
    return state_->normals[triangle];
}

void RayScene::log_rays(std::vector<Ray>* log) {
    state_->log = log;
}

void RayScene::log(const Ray& ray) const {
    if (state_->log) state_->log->push_back(ray);
}

std::optional<Hit> RayScene::closest(const Ray& ray, std::uint64_t key) const {
    log(ray);
    QueryContext query(&key);
    RTCRayHit r;
    set_ray(r.ray, ray);
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(state_->accelerator.get(), &query.embree, &r);
    std::optional<Hit> hit;
    state_->set_hit(hit, r.hit.geomID, r.hit.primID, r.ray.tfar, r.hit.u, r.hit.v);
    return hit;
}

float RayScene::transmittance(const Ray& ray) const {
    log(ray);
    float share = 1.0f;
    QueryContext query(nullptr, &share);
    RTCRay r;
    set_ray(r, ray);
    rtcOccluded1(state_->accelerator.get(), &query.embree, &r);
    return r.tfar < 0.0f ? 0.0f : share;
}

void RayScene::closest(std::span<const Ray> rays, std::span<const std::uint64_t> keys,
                       std::span<std::optional<Hit>> hits) const {
    QueryContext query(keys.data());
    query.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    const ValidRays valid(rays.size());
    RTCRayHit8 r;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        log(rays[i]);
        set_ray(r.ray, i, rays[i]);
        r.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        r.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect8(valid.mask, state_->accelerator.get(), &query.embree, &r);
    for (std::size_t i = 0; i < rays.size(); ++i)
        state_->set_hit(hits[i], r.hit.geomID[i], r.hit.primID[i], r.ray.tfar[i], r.hit.u[i], r.hit.v[i]);
}

void RayScene::transmittance(std::span<const Ray> rays, std::span<float> shares) const {
    QueryContext query(nullptr, shares.data());
    const ValidRays valid(rays.size());
    RTCRay8 r;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        log(rays[i]);
        set_ray(r, i, rays[i]);
        shares[i] = 1.0f;
    }
    rtcOccluded8(valid.mask, state_->accelerator.get(), &query.embree, &r);
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (r.tfar[i] < 0.0f) shares[i] = 0.0f;
}

SurfacePoint RayScene::surface_point(const Ray& ray, const Hit& hit) const {
    const WorldMesh& mesh = state_->mesh;
    const std::uint32_t* corner = &mesh.indices[3 * std::size_t(hit.triangle)];
    const std::uint8_t details = state_->details[hit.triangle];
    SurfacePoint point;
    point.position = interpolate(mesh.positions, corner, hit.barycentric);
    point.uvs = details & kTextured ? interpolate_uvs(mesh, corner, hit.barycentric) : std::array<Vec2, 2>{};
    point.color = details & kColored ? interpolate(mesh.colors, corner, hit.barycentric) : Rgba(1.0f);
    point.material = mesh.materials[hit.triangle];

    const bool from_behind = glm::dot(ray.direction, hit.normal) > 0.0f;
    const Vec3 normal = details & (kCurved | kBumped) ? state_->bent_normal(hit, point) : hit.normal;
    point.geometric_normal = from_behind ? -hit.normal : hit.normal;
    point.shading_normal = from_behind ? -normal : normal;
    return point;
}

}  // namespace daylit
