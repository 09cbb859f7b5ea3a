#include "demo/sample_points.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/scene/texture.h"

namespace daylit {
namespace {

constexpr int kTriesPerPoint = 1000;

/// Areas summed up, in triangle order; triangles that cannot be sampled add nothing.
std::vector<double> summed_areas(const Scene& scene, const WorldMesh& mesh) {
    std::vector<double> sums(mesh.triangle_count());
    double sum = 0.0;
    for (std::size_t t = 0; t < sums.size(); ++t) {
        const std::uint32_t* corner = &mesh.indices[3 * t];
        const glm::dvec3 a = mesh.positions[corner[0]], b = mesh.positions[corner[1]], c = mesh.positions[corner[2]];
        const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
        if (std::isfinite(area) && scene.materials[mesh.materials[t]].transmission <= 0.0f) sum += area;
        sums[t] = sum;
    }
    return sums;
}

/// A grid of cells over the scene and which of them were reached.
class Flood {
  public:
    explicit Flood(const RayScene& rays) : rays_(rays), box_(rays.bounds()) {
        constexpr int kCellsAlongLongest = 64;
        const Vec3 size = box_.max - box_.min;
        cell_ = std::max({size.x, size.y, size.z}) / kCellsAlongLongest;
        for (int axis = 0; axis < 3; ++axis) counts_[axis] = std::max(1, int(std::ceil(size[axis] / cell_)));
        reached_.resize(std::size_t(counts_.x) * std::size_t(counts_.y) * std::size_t(counts_.z), false);
    }

    const Bounds& box() const { return box_; }

    void start_at(const Vec3& place) {
        const glm::ivec3 cell = cell_of(place);
        if (inside(cell) && open(place, centre(cell))) reach(cell);
    }
    void start_under_the_sky() {
        for (int z = 0; z < counts_.z; ++z)
            for (int y = 0; y < counts_.y; ++y)
                for (int x = 0; x < counts_.x; ++x)
                    if (rays_.transmittance({centre({x, y, z}), Vec3(0, 1, 0)}) == 1.0f) reach({x, y, z});
    }
    void spread() {
        while (!front_.empty()) {
            const glm::ivec3 cell = front_.back();
            front_.pop_back();
            for (int axis = 0; axis < 3; ++axis)
                for (const int step : {-1, 1}) {
                    glm::ivec3 next = cell;
                    next[axis] += step;
                    if (inside(next) && !reached_[index(next)] && open(centre(cell), centre(next))) reach(next);
                }
        }
    }
    bool reachable(const Vec3& place) const {
        const glm::ivec3 cell = cell_of(place);
        return inside(cell) && reached_[index(cell)] && open(centre(cell), place);
    }

  private:
    glm::ivec3 cell_of(const Vec3& place) const { return glm::ivec3(glm::floor((place - box_.min) / cell_)); }
    Vec3 centre(const glm::ivec3& cell) const { return box_.min + (Vec3(cell) + 0.5f) * cell_; }
    bool inside(const glm::ivec3& cell) const {
        return glm::all(glm::greaterThanEqual(cell, glm::ivec3(0))) && glm::all(glm::lessThan(cell, counts_));
    }
    std::size_t index(const glm::ivec3& cell) const {
        return (std::size_t(cell.z) * std::size_t(counts_.y) + std::size_t(cell.y)) * std::size_t(counts_.x) +
               std::size_t(cell.x);
    }
    void reach(const glm::ivec3& cell) {
        if (reached_[index(cell)]) return;
        reached_[index(cell)] = true;
        front_.push_back(cell);
    }
    bool open(const Vec3& from, const Vec3& to) const {
        const float distance = glm::distance(from, to);
        return distance == 0.0f || rays_.transmittance({from, (to - from) / distance, 0.0f, distance}) > 0.0f;
    }

    const RayScene& rays_;
    Bounds box_;
    float cell_ = 1.0f;
    glm::ivec3 counts_ = glm::ivec3(1);
    std::vector<bool> reached_;
    std::vector<glm::ivec3> front_;
};

Vec3 uniform_direction(Random& random) {
    const float y = 1.0f - 2.0f * random.next(), phi = 2.0f * float(kPi) * random.next();
    const float r = std::sqrt(std::max(1.0f - y * y, 0.0f));
    return Vec3(r * std::cos(phi), y, r * std::sin(phi));
}

}  // namespace

std::vector<SurfaceSample> sample_surface(const Scene& scene, const Pose& pose, int count, std::uint64_t seed) {
    WorldMesh mesh = world_mesh(scene, pose, Part::Static);
    if (mesh.triangle_count() == 0) mesh = world_mesh(scene, pose, Part::All);
    const std::vector<double> sums = summed_areas(scene, mesh);
    if (sums.empty() || !(sums.back() > 0.0)) throw Error(scene.path.string(), "has no opaque surface to sample");

    std::vector<SurfaceSample> points;
    Random random(seed, 0, 0);
    for (long tries = 0; points.size() < std::size_t(count); ++tries) {
        if (tries > long(count) * kTriesPerPoint)
            throw Error(scene.path.string(), "its surfaces are cut away nearly everywhere; found too few points");
        const auto place = std::upper_bound(sums.begin(), sums.end(), random.next_double() * sums.back());
        const auto t = std::size_t(std::min(place, sums.end() - 1) - sums.begin());
        const float root = std::sqrt(random.next()), v = random.next();
        const Vec3 weights(1.0f - root, root * (1.0f - v), root * v);
        const std::uint32_t* corner = &mesh.indices[3 * t];
        Vec3 position(0.0f);
        std::array<Vec2, 2> uvs{};
        Rgba color(0.0f);
        for (int k = 0; k < 3; ++k) {
            position += weights[k] * mesh.positions[corner[k]];
            color += weights[k] * mesh.colors[corner[k]];
            for (std::size_t set = 0; set < 2; ++set) uvs[set] += weights[k] * mesh.uvs[corner[k]][set];
        }
        if (base_color(scene, scene.materials[mesh.materials[t]], uvs, color).a <= 0.0f) continue;
        const glm::dvec3 a = mesh.positions[corner[0]], b = mesh.positions[corner[1]], c = mesh.positions[corner[2]];
        points.push_back({position, Vec3(glm::normalize(glm::cross(b - a, c - a)))});
    }
    return points;
}

std::vector<SurfaceSample> sample_space(const RayScene& rays, const Pose& pose, int count, std::uint64_t seed) {
    const Scene& scene = rays.scene();
    if (rays.bounds().empty()) throw Error(scene.path.string(), "has no surfaces, so there is no space between them");
    Flood flood(rays);
    for (const Camera& camera : scene.cameras)
        flood.start_at(Vec3(pose.world_from_node[std::size_t(camera.node)][3]));
    if (scene.cameras.empty()) flood.start_under_the_sky();
    flood.spread();

    std::vector<SurfaceSample> points;
    Random random(seed, 0, 0);
    for (long tries = 0; points.size() < std::size_t(count); ++tries) {
        if (tries > long(count) * kTriesPerPoint)
            throw Error(scene.path.string(), scene.cameras.empty()
                                                 ? "no free space found under the open sky; add a camera inside"
                                                 : "no free space found from its cameras; are they inside walls?");
        const Vec3 share(random.next(), random.next(), random.next());
        const Vec3 place = flood.box().min + share * (flood.box().max - flood.box().min);
        const Vec3 normal = uniform_direction(random);
        if (flood.reachable(place)) points.push_back({place, normal});
    }
    return points;
}

}  // namespace daylit
