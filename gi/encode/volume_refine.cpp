#include "gi/encode/volume_refine.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "engine/base/random.h"

namespace daylit {
namespace {

constexpr float kOutlier = 4.0f;     // errors above this many times the target count no more: a wall inside of the cell
constexpr std::size_t kBatch = 256;  // leaves split before errors are compared again
constexpr float kRootsAlong = 8.0f;  // the longest side
constexpr float kSmallest = 0.25f;   // metres, of cells of the level that ends refinement unless one is given
constexpr int kFinest = 4, kCoarsest = 12;
constexpr float kBeforeWall =
    0.05f;                       // sides between a wall and the sample that is taken in place of a corner behind it
constexpr double kUnseen = 1.0;  // error of a cell in which nothing could be measured, over the light; the most that
                                 // any place counts with, lest a lamp's surroundings at night take all cells
constexpr double kMoving = 63.0;  // what errors count where things move, on top of what they count everywhere
// What errors count where surfaces stand around within the size of a room, on top: what is indoors is seen from near.
constexpr double kEnclosed = 5.0;
constexpr float kRoom = 5.0f;
constexpr float kFloor = 0.1f;    // of the volume's mean light that errors are compared with, beside the light there

struct LatticeHash {
    std::size_t operator()(const Lattice& p) const {
        return std::size_t(mix64(mix64(mix64(std::uint64_t(p.x)) ^ std::uint64_t(p.y)) ^ std::uint64_t(p.z)));
    }
};

bool is_corner(int place) {
    return place % 3 != 1 && place / 3 % 3 != 1 && place / 9 != 1;
}

/// Centre of the cell or of a face: what is measured beside the corners.
bool is_test(int place) {
    return (place % 3 == 1) + (place / 3 % 3 == 1) + (place / 9 == 1) >= 2;
}

/// A leaf as it was tested.
struct Tested {
    RefinedLeaf leaf;
    int groups = 0;       // of places that see each other
    bool parted = false;  // by a plane between exactly two groups
    std::optional<Vec4> plane;
    double error = 0.0;   // worst, over the target; 1 and less: well enough
    double square = 0.0;  // mean square error, over the light, times the free space of the cell and what it counts
};

class Refiner {
  public:
    Refiner(const RayScene& rays, const FreeSpace& space, const std::vector<Bounds>& regions,
            const SampleVolume& sample, const VolumeSettings& settings)
        : rays_(rays), space_(space), regions_(regions), sample_(sample), settings_(settings) {}

    RefinedVolume refine(const StageProgress& progress) {
        lay_roots();
        std::vector<std::uint32_t> fresh(out_.octree.nodes.size());
        std::iota(fresh.begin(), fresh.end(), 0u);
        double done = 0.0;
        while (!fresh.empty()) {
            test(fresh, {progress.report, progress.begin + done * (progress.end - progress.begin),
                         progress.begin + (0.8 * done + 0.2) * (progress.end - progress.begin)});
            done = 0.8 * done + 0.2;
            fresh = split_worst();
        }
        finish({progress.report, progress.begin + done * (progress.end - progress.begin), progress.end});
        return std::move(out_);
    }

  private:
    void lay_roots() {
        out_.octree = lay_octree(space_, regions_);
        max_level_ = settings_.max_level >= 0
                         ? settings_.max_level
                         : std::clamp(int(std::ceil(std::log2(out_.octree.side / kSmallest))), kFinest, kCoarsest);
        max_level_ = std::max(max_level_, settings_.min_level);
    }

    bool wanted(const Vec3& place) const {
        if (space_.reachable(place)) return true;
        const Bounds& box = space_.box();
        const bool outside =
            box.empty() || glm::any(glm::lessThan(place, box.min)) || glm::any(glm::greaterThan(place, box.max));
        return outside && std::any_of(regions_.begin(), regions_.end(), [&](const Bounds& b) {
                   const float reach = out_.octree.side;
                   return glm::all(glm::greaterThan(place, b.min - reach)) &&
                          glm::all(glm::lessThan(place, b.max + reach)) && space_.open(0.5f * (b.min + b.max), place);
               });
    }

    /// Errors count where something is likely to be: not in the air around the scene that cells at its border reach.
    bool counts(const Vec3& place) const {
        const auto in = [&](const Bounds& b) {
            return !b.empty() && glm::all(glm::greaterThanEqual(place, b.min)) &&
                   glm::all(glm::lessThanEqual(place, b.max));
        };
        return in(space_.box()) || std::any_of(regions_.begin(), regions_.end(), in);
    }

    /// How much of it is likely to be free though none of its places is; 0: nothing can be in it.
    double free_share(const Octree::Node& n) const {
        const Bounds box{out_.octree.place(n.at), out_.octree.place(n.at + n.units())}, &all = space_.box();
        const bool within = !all.empty() && glm::all(glm::greaterThanEqual(box.min, all.min)) &&
                            glm::all(glm::lessThanEqual(box.max, all.max));
        const bool beside = !within && std::any_of(regions_.begin(), regions_.end(), [&](const Bounds& b) {
            return !b.empty() && glm::all(glm::lessThan(box.min, b.max)) && glm::all(glm::greaterThan(box.max, b.min));
        });
        return std::max(space_.reached_share(box), beside ? 1.0 : 0.0) / kLeafPlaces;
    }

    void test(const std::vector<std::uint32_t>& leaves, const StageProgress& progress) {
        tested_.resize(out_.octree.nodes.size());
        find_places(leaves);
        const StageProgress silent{Progress{}};
        for_each_parallel(leaves.size(), silent, [&](std::size_t i) { group(leaves[i]); });
        std::vector<std::uint32_t> places;
        for (const std::uint32_t n : leaves)
            for (int p = 0; p < kLeafPlaces; ++p)
                if (tested_[n].leaf.side[std::size_t(p)] >= 0 &&
                    (is_corner(p) || is_test(p) || !whole(tested_[n].leaf)))
                    places.push_back(tested_[n].leaf.place[std::size_t(p)]);
        sample(std::move(places), progress);
        sample_before_walls(leaves);
        for_each_parallel(leaves.size(), silent, [&](std::size_t i) { judge(leaves[i]); });
        waiting_.insert(waiting_.end(), leaves.begin(), leaves.end());
    }

    /// Where something stands in a cell, as beside an opening, the middles of its edges tell what the others cannot;
    /// they are sampled sooner or later.
    static bool whole(const RefinedLeaf& leaf) {
        return std::all_of(leaf.side.begin(), leaf.side.end(), [](int side) { return side == 0; });
    }

    void find_places(const std::vector<std::uint32_t>& leaves) {
        std::vector<VolumePlaces::Place>& places = out_.places.places;
        const std::size_t first = places.size();
        for (const std::uint32_t n : leaves) {
            const Octree::Node& node = out_.octree.nodes[n];
            for (int p = 0; p < kLeafPlaces; ++p) {
                const Lattice at = node.at + node.units() / 2 * Lattice(p % 3, p / 3 % 3, p / 9);
                const auto [known, is_new] = index_.try_emplace(at, std::uint32_t(places.size()));
                if (is_new) places.push_back({.at = at});
                tested_[n].leaf.place[std::size_t(p)] = known->second;
            }
        }
        std::vector<std::uint8_t> free(places.size() - first);  // bytes, since threads write neighbours
        const StageProgress silent{Progress{}};
        for_each_parallel(free.size(), silent,
                          [&](std::size_t i) { free[i] = wanted(out_.octree.place(places[first + i].at)); });
        for (std::size_t i = 0; i < free.size(); ++i) places[first + i].free = free[i] != 0;
    }

    Vec3 place_of(const RefinedLeaf& leaf, int p) const {
        return out_.octree.place(out_.places.places[leaf.place[std::size_t(p)]].at);
    }
    bool free(const RefinedLeaf& leaf, int p) const { return out_.places.places[leaf.place[std::size_t(p)]].free; }

    /// Groups the free places of a leaf by what neighbours see each other, and parts two groups by a plane.
    void group(std::uint32_t n) {
        Tested& tested = tested_[n];
        std::array<int, kLeafPlaces> of;
        std::iota(of.begin(), of.end(), 0);
        std::vector<std::pair<int, int>> blocked;
        for (int p = 0; p < kLeafPlaces; ++p)
            for (const auto& [stride, last] :
                 {std::pair(1, p % 3 == 2), std::pair(3, p / 3 % 3 == 2), std::pair(9, p / 9 == 2)}) {
                const int q = p + stride;
                if (last || !free(tested.leaf, p) || !free(tested.leaf, q)) continue;
                if (!space_.open(place_of(tested.leaf, p), place_of(tested.leaf, q)))
                    blocked.emplace_back(p, q);
                else if (of[std::size_t(p)] != of[std::size_t(q)])
                    std::replace(of.begin(), of.end(), std::max(of[std::size_t(p)], of[std::size_t(q)]),
                                 std::min(of[std::size_t(p)], of[std::size_t(q)]));
            }
        std::map<int, int> sizes;
        for (int p = 0; p < kLeafPlaces; ++p)
            if (free(tested.leaf, p)) ++sizes[of[std::size_t(p)]];
        tested.groups = int(sizes.size());
        if (tested.groups > 1) part(tested, of, blocked);
        for (int p = 0; p < kLeafPlaces; ++p)
            tested.leaf.side[std::size_t(p)] =
                std::int8_t(!free(tested.leaf, p) ? -1
                            : tested.plane        ? side_of(*tested.plane, place_of(tested.leaf, p))
                                                  : 0);
        if (tested.plane && !tested.parted) drop_minorities(tested, of);
    }

    static int side_of(const Vec4& plane, const Vec3& place) {
        return glm::dot(Vec3(plane), place) + plane.w >= 0.0f ? 0 : 1;
    }

    /// The plane of a wall between blocked neighbours that parts the groups best.
    void part(Tested& tested, const std::array<int, kLeafPlaces>& of,
              const std::vector<std::pair<int, int>>& blocked) const {
        int best = 0;
        for (const auto& [p, q] : blocked) {
            if (of[std::size_t(p)] == of[std::size_t(q)]) continue;
            const Vec3 a = place_of(tested.leaf, p), b = place_of(tested.leaf, q);
            const Vec3 along = glm::normalize(b - a);
            const float length = glm::distance(a, b);
            const auto from_a = rays_.closest({a, along, 0.0f, length}, 0),
                       from_b = rays_.closest({b, -along, 0.0f, length}, 0);
            if (!from_a || !from_b) continue;
            const Vec3 middle = 0.5f * (a + from_a->distance * along + b - from_b->distance * along);
            for (const Vec3& hit_normal : {from_a->normal, from_b->normal}) {
                const Vec3 normal = glm::dot(hit_normal, along) > 0.0f ? -hit_normal : hit_normal;
                const Vec4 plane(normal, -glm::dot(normal, middle));
                const auto [right, wrong] = parted(tested.leaf, of, plane);
                if (wrong == 0 && tested.groups == 2) {
                    tested.plane = plane, tested.parted = true;
                    return;
                }
                if (right - wrong > best) best = right - wrong, tested.plane = plane;
            }
        }
    }

    /// Places on the side where most of their group is, and those that are not.
    std::pair<int, int> parted(const RefinedLeaf& leaf, const std::array<int, kLeafPlaces>& of,
                               const Vec4& plane) const {
        std::map<int, std::array<int, 2>> counts;
        for (int p = 0; p < kLeafPlaces; ++p)
            if (free(leaf, p)) ++counts[of[std::size_t(p)]][std::size_t(side_of(plane, place_of(leaf, p)))];
        int right = 0, wrong = 0;
        std::array<bool, 2> any{};
        for (const auto& [g, count] : counts) {
            right += std::max(count[0], count[1]), wrong += std::min(count[0], count[1]);
            any[count[1] > count[0] ? 1 : 0] = true;
        }
        return any[0] && any[1] ? std::pair(right, wrong) : std::pair(0, kLeafPlaces);
    }

    /// Of either side only the largest group tells of its light.
    void drop_minorities(Tested& tested, const std::array<int, kLeafPlaces>& of) const {
        for (int side = 0; side < 2; ++side) {
            std::map<int, int> sizes;
            for (int p = 0; p < kLeafPlaces; ++p)
                if (tested.leaf.side[std::size_t(p)] == side) ++sizes[of[std::size_t(p)]];
            const auto largest = std::max_element(sizes.begin(), sizes.end(),
                                                  [](const auto& a, const auto& b) { return a.second < b.second; });
            for (int p = 0; p < kLeafPlaces; ++p)
                if (tested.leaf.side[std::size_t(p)] == side && of[std::size_t(p)] != largest->first)
                    tested.leaf.side[std::size_t(p)] = -1;
        }
    }

    /// Traces samples at places that have none.
    void sample(std::vector<std::uint32_t> places, const StageProgress& progress) {
        std::sort(places.begin(), places.end());
        places.erase(std::unique(places.begin(), places.end()), places.end());
        std::erase_if(places, [&](std::uint32_t p) { return out_.places.places[p].sample >= 0; });
        const std::size_t first = out_.places.samples.size();
        out_.places.samples.resize(first + places.size());
        for_each_parallel(places.size(), progress, [&](std::size_t i) {
            const Lattice& at = out_.places.places[places[i]].at;
            out_.places.samples[first + i] = sample_(out_.octree.place(at), LatticeHash{}(at));
        });
        for (std::size_t i = 0; i < places.size(); ++i) {
            out_.places.places[places[i]].sample = int(first + i);
            add_to_mean(out_.places.samples[first + i]);
        }
    }

    const VolumeSample* sample_at(const RefinedLeaf& leaf, int p) const {
        const int s = out_.places.places[leaf.place[std::size_t(p)]].sample;
        return leaf.side[std::size_t(p)] >= 0 && s >= 0 ? &out_.places.samples[std::size_t(s)] : nullptr;
    }

    void judge(std::uint32_t n) {
        Tested& tested = tested_[n];
        const Octree::Node& node = out_.octree.nodes[n];
        const int members =
            int(std::count_if(tested.leaf.side.begin(), tested.leaf.side.end(), [](int s) { return s >= 0; }));
        const double length = double(out_.octree.side_of(node)), volume = length * length * length;
        tested.error = tested.square = 0.0;
        if (members == 0) {
            const double share = free_share(node);
            if (share > 0.0) tested.error = kOutlier, tested.square = kUnseen * kUnseen * share * volume;
            return;
        }
        if (tested.groups > 1 && !tested.parted) tested.error = kOutlier;
        for (int side = 0; side < 2; ++side) {
            const SideError found = side_error(tested, node, side);
            int places = 0;
            for (int p = 0; p < kLeafPlaces; ++p)
                places += tested.leaf.side[std::size_t(p)] == side && counts(place_of(tested.leaf, p));
            tested.error = std::max(tested.error, found.worst);
            tested.square += found.square * volume * double(places) / kLeafPlaces;
        }
        tested.square *= 1.0 + kMoving * moving_share(node) + kEnclosed * enclosed(tested.leaf);
        if (node.level < settings_.geometry_level && members < kLeafPlaces) tested.error = kOutlier;
    }

    /// How closely surfaces stand around a leaf, 0 to 1.
    double enclosed(const RefinedLeaf& leaf) const {
        double sum = 0.0;
        int count = 0;
        for (int p = 0; p < kLeafPlaces; ++p)
            if (const VolumeSample* sample = is_corner(p) || is_test(p) ? sample_at(leaf, p) : nullptr) {
                const double share = std::min(1.0, double(kRoom / sample->nearness));
                sum += share * share, ++count;
            }
        return count > 0 ? sum / count : 0.0;
    }

    /// Of a cell, that the swept box takes which takes most of it; most of these overlap.
    double moving_share(const Octree::Node& n) const {
        const Bounds box{out_.octree.place(n.at), out_.octree.place(n.at + n.units())};
        const Vec3 size = box.max - box.min;
        double most = 0.0;
        for (const Bounds& b : regions_) {
            if (b.empty()) continue;
            const Vec3 both = glm::max(glm::min(b.max, box.max) - glm::max(b.min, box.min), Vec3(0.0f)) / size;
            most = std::max(most, double(both.x) * double(both.y) * double(both.z));
        }
        return most;
    }

    struct SideError {
        double worst = 0.0;   // over the target
        double square = 0.0;  // mean, over the light where it was measured
    };

    /// What is known about light at a corner: a sample, and where in [0,1]^3 it was taken.
    struct StandIn {
        const VolumeSample* sample = nullptr;
        Vec3 from = Vec3(0.0f);
    };

    /// Between what was measured and what the corners say.
    SideError side_error(const Tested& tested, const Octree::Node& node, int side) const {
        const float length = out_.octree.side_of(node);
        std::array<StandIn, 8> corners;
        for (int c = 0; c < 8; ++c) corners[std::size_t(c)] = stand_in(tested.leaf, c, side);
        SideError result;
        if (!corners[0].sample) return result;
        for (const StandIn& c : corners) result.worst = std::max(result.worst, by_controls(*c.sample, length));
        double tests = 0.0;
        for (int p = 0; p < kLeafPlaces; ++p)
            if (!is_corner(p) && tested.leaf.side[std::size_t(p)] == side && sample_at(tested.leaf, p))
                compare(corners, length, *sample_at(tested.leaf, p), t_of(p), tests, result);
        for (const RefinedLeaf::WallSample& before : tested.leaf.before_walls)
            if (is_test(before.place) && before.side == side)
                compare(corners, length, out_.places.samples[std::size_t(before.sample)], before.t, tests, result);
        if (tests > 0.0) result.square /= tests;
        result.worst = std::min(result.worst, double(kOutlier));
        return result;
    }

    void compare(const std::array<StandIn, 8>& corners, float length, const VolumeSample& measured, const Vec3& t,
                 double& tests, SideError& result) const {
        for (std::size_t f = 0; f < mean_.size(); ++f) {
            const double mean = mean_[f] / double(out_.places.samples.size());
            const double truth = double(measured.judged[f]), light = std::abs(truth) + double(kFloor) * mean;
            const double left = std::abs(interpolated(corners, f, t, length) - truth) - 2.0 * double(measured.noise[f]);
            tests += 1.0;
            if (left <= 0.0 || mean <= 0.0) continue;
            result.worst = std::max(result.worst, left / light / double(settings_.error));
            const double share = std::min(left / light, kUnseen);
            result.square += share * share;
        }
    }

    double interpolated(const std::array<StandIn, 8>& corners, std::size_t f, const Vec3& t, float length) const {
        const std::size_t functionals = mean_.size();
        const std::array<Vec4, 8> blend = blend_weights(settings_.blend, t, length);
        double sum = 0.0;
        for (int c = 0; c < 8; ++c) {
            const auto& [sample, from] = corners[std::size_t(c)];
            const std::vector<float>& judged = sample->judged;
            const Vec4& weights = blend[std::size_t(c)];
            const float noise = sample->change_noise * length;
            const Vec3 change =
                Vec3(judged[functionals + f], judged[2 * functionals + f], judged[3 * functionals + f]) /
                std::max(1.0f, noise * noise);
            const Vec3 moved = length * (Vec3(c & 1, c >> 1 & 1, c >> 2) - from);
            const float most = 0.5f * std::abs(judged[f]);
            const float value = judged[f] + std::clamp(glm::dot(change, moved), -most, most);
            sum += double(weights.x) * double(value) + double(glm::dot(Vec3(weights.y, weights.z, weights.w), change));
        }
        return sum;
    }

    /// Oat's tests of a corner alone.
    double by_controls(const VolumeSample& s, float length) const {
        if (s.nearness < settings_.harmonic_mean * length) return 2.0;
        const std::size_t functionals = mean_.size();
        for (std::size_t f = 0; f < functionals; ++f) {
            const Vec3 change(s.judged[functionals + f], s.judged[2 * functionals + f], s.judged[3 * functionals + f]);
            if (glm::length(change) * length > settings_.change * std::abs(s.judged[f])) return 2.0;
        }
        return 0.0;
    }

    /// The sample at a corner, or the nearest of the same side.
    StandIn stand_in(const RefinedLeaf& leaf, int corner, int side) const {
        const Vec3 at(corner & 1, corner >> 1 & 1, corner >> 2);
        StandIn best;
        float least = 1e9f;
        const auto consider = [&](const VolumeSample* sample, const Vec3& t) {
            if (sample && glm::distance(at, t) < least) least = glm::distance(at, t), best = {sample, t};
        };
        for (int p = 0; p < kLeafPlaces; ++p)
            if (leaf.side[std::size_t(p)] == side) consider(sample_at(leaf, p), t_of(p));
        for (const RefinedLeaf::WallSample& before : leaf.before_walls)
            if (before.side == side && is_corner(before.place))
                consider(&out_.places.samples[std::size_t(before.sample)], before.t);
        return best;
    }

    /// Splits the leaves whose error matters most, and returns their children; none when all are well or the budget is
    /// spent.
    std::vector<std::uint32_t> split_worst() {
        const auto asked_for = [&](std::uint32_t n) { return out_.octree.nodes[n].level < settings_.min_level; };
        std::erase_if(waiting_, [&](std::uint32_t n) {
            return (tested_[n].error <= 1.0 && !asked_for(n)) || out_.octree.nodes[n].level >= max_level_;
        });
        std::stable_sort(waiting_.begin(), waiting_.end(), [&](std::uint32_t a, std::uint32_t b) {
            if (asked_for(a) != asked_for(b)) return asked_for(a);
            return tested_[a].square > tested_[b].square;
        });
        const auto forced = std::size_t(std::count_if(waiting_.begin(), waiting_.end(), asked_for));
        std::vector<std::uint32_t> children;
        std::size_t count = std::min(waiting_.size(), std::max({kBatch, leaves() / 8, forced}));
        if (leaves() + 7 * count > settings_.most_cells) {
            count = leaves() < settings_.most_cells ? std::min(count, (settings_.most_cells - leaves()) / 7) : 0;
            out_.budget_spent = !waiting_.empty();
            count = std::max(count, forced);
        }
        for (std::size_t i = 0; i < count; ++i) {
            out_.octree.split(waiting_[i]);
            const std::uint32_t first = out_.octree.nodes[waiting_[i]].children;
            for (std::uint32_t c = 0; c < 8; ++c) children.push_back(first + c);
        }
        waiting_.erase(waiting_.begin(), waiting_.begin() + std::ptrdiff_t(count));
        return children;
    }
    std::size_t leaves() const { return out_.octree.nodes.size() * 7 / 8; }

    /// Marks what is empty or cut, and samples all free places of cells that lack corners.
    void finish(const StageProgress& progress) {
        std::vector<std::uint32_t> places;
        for (std::uint32_t n = 0; n < out_.octree.nodes.size(); ++n) {
            Octree::Node& node = out_.octree.nodes[n];
            if (!node.leaf()) continue;
            const Tested& tested = tested_[n];
            std::array<int, 2> members{};
            for (const int side : tested.leaf.side)
                if (side >= 0) ++members[std::size_t(side)];
            node.empty = members[0] + members[1] == 0;
            if (node.empty) continue;
            if (members[0] > 0 && members[1] > 0) node.cut = true, node.plane = *tested.plane;
            out_.leaves[n] = tested.leaf;
            if (!node.cut && members[1] > 0) {
                for (std::int8_t& side : out_.leaves[n].side)
                    if (side == 1) side = 0;
                for (RefinedLeaf::WallSample& at : out_.leaves[n].before_walls) at.side = 0;
            }
            const bool whole = members[0] == kLeafPlaces;
            for (int p = 0; !whole && p < kLeafPlaces; ++p)
                if (tested.leaf.side[std::size_t(p)] >= 0) places.push_back(tested.leaf.place[std::size_t(p)]);
        }
        sample(std::move(places), progress);
        merge_empty();
    }

    /// Light for corners inside of walls: without, it would be guessed from the middle of the cell.
    void sample_before_walls(const std::vector<std::uint32_t>& leaves) {
        std::vector<std::pair<Vec3, std::uint64_t>> asked;
        const auto first = int(out_.places.samples.size());
        for (const std::uint32_t n : leaves) {
            const Octree::Node& node = out_.octree.nodes[n];
            RefinedLeaf& leaf = tested_[n].leaf;
            for (int side = 0; side < (tested_[n].plane ? 2 : 1); ++side)
                for (int p = 0; p < kLeafPlaces; ++p) {
                    if (!(is_corner(p) || is_test(p)) || leaf.side[std::size_t(p)] == side) continue;
                    const int from = nearest_place(leaf, side, t_of(p));
                    if (from < 0) continue;
                    const std::optional<Vec3> place = before_wall(place_of(leaf, from), place_of(leaf, p), node);
                    if (!place) continue;
                    const auto [at, is_new] = before_wall_.try_emplace(
                        {leaf.place[std::size_t(p)], leaf.place[std::size_t(from)]}, first + int(asked.size()));
                    const Lattice& corner = out_.places.places[leaf.place[std::size_t(p)]].at;
                    if (is_new) asked.emplace_back(*place, mix64(LatticeHash{}(corner) + std::uint64_t(from)));
                    const Vec3 t = (*place - out_.octree.place(node.at)) / out_.octree.side_of(node);
                    leaf.before_walls.push_back({t, p, side, at->second});
                }
        }
        out_.places.samples.resize(std::size_t(first) + asked.size());
        for_each_parallel(asked.size(), StageProgress{Progress{}}, [&](std::size_t i) {
            out_.places.samples[std::size_t(first) + i] = sample_(asked[i].first, asked[i].second);
        });
        for (std::size_t i = std::size_t(first); i < out_.places.samples.size(); ++i)
            add_to_mean(out_.places.samples[i]);
    }

    void add_to_mean(const VolumeSample& sample) {
        mean_.resize(sample.judged.size() / 4, 0.0);
        for (std::size_t f = 0; f < mean_.size(); ++f) mean_[f] += double(sample.judged[f]);
    }

    /// The place of this side that is nearest; -1: there is none.
    static int nearest_place(const RefinedLeaf& leaf, int side, const Vec3& t) {
        int best = -1;
        for (int p = 0; p < kLeafPlaces; ++p)
            if (leaf.side[std::size_t(p)] == side &&
                (best < 0 || glm::distance(t, t_of(p)) < glm::distance(t, t_of(best))))
                best = p;
        return best;
    }

    /// On the way from one place to another, just before what is met first: a surface, or the end of the scene's box.
    std::optional<Vec3> before_wall(const Vec3& from, const Vec3& to, const Octree::Node& node) const {
        const float length = glm::distance(from, to);
        const Vec3 along = (to - from) / length;
        const std::optional<Hit> met = rays_.closest({from, along, 0.0f, length}, 0);
        const float end = std::min(met ? met->distance : length, length * share_inside(space_.box(), from, to));
        if (!met && end >= length) return std::nullopt;
        return from + (end - std::min(kBeforeWall * out_.octree.side_of(node), 0.5f * end)) * along;
    }

    /// Of the way from a place in a box to another; 1 where it starts outside.
    static float share_inside(const Bounds& box, const Vec3& from, const Vec3& to) {
        float share = 1.0f;
        for (int a = 0; a < 3; ++a) {
            if (box.empty() || from[a] < box.min[a] || from[a] > box.max[a]) return 1.0f;
            if (to[a] < box.min[a]) share = std::min(share, (box.min[a] - from[a]) / (to[a] - from[a]));
            if (to[a] > box.max[a]) share = std::min(share, (box.max[a] - from[a]) / (to[a] - from[a]));
        }
        return share;
    }

    /// Eight empty leaves are one.
    void merge_empty() {
        for (std::uint32_t n = std::uint32_t(out_.octree.nodes.size()); n-- > 0;) {
            Octree::Node& node = out_.octree.nodes[n];
            if (node.leaf()) continue;
            bool all = true;
            for (std::uint32_t c = 0; c < 8; ++c) {
                const Octree::Node& child = out_.octree.nodes[node.children + c];
                all = all && child.leaf() && child.empty;
            }
            if (all) node.children = 0, node.empty = true;
        }
    }

    const RayScene& rays_;
    const FreeSpace& space_;
    const std::vector<Bounds>& regions_;
    const SampleVolume& sample_;
    const VolumeSettings& settings_;
    RefinedVolume out_;
    std::unordered_map<Lattice, std::uint32_t, LatticeHash> index_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> before_wall_;  // by corner and place that it is seen from
    std::vector<Tested> tested_;                                          // by node
    std::vector<std::uint32_t> waiting_;                                  // leaves that may be split
    std::vector<double> mean_;                                            // sums over samples
    int max_level_ = 0;
};

}  // namespace

Octree lay_octree(const FreeSpace& space, const std::vector<Bounds>& regions) {
    Bounds all = space.box();
    for (const Bounds& b : regions)
        if (!b.empty()) all.add(b.min), all.add(b.max);
    if (all.empty()) return {};
    const Vec3 extent = all.max - all.min;
    const float side = std::max({extent.x, extent.y, extent.z, 1e-4f}) / kRootsAlong;
    std::array<int, 3> size;
    Vec3 origin;
    for (int a = 0; a < 3; ++a) {
        size[std::size_t(a)] = std::max(1, int(std::ceil(extent[a] / side - 1e-3f)));
        origin[a] = 0.5f * (all.min[a] + all.max[a] - side * float(size[std::size_t(a)]));
    }
    return Octree(origin, side, size);
}

RefinedVolume refine_volume(const RayScene& rays, const FreeSpace& space, const std::vector<Bounds>& regions,
                            const SampleVolume& sample, const VolumeSettings& settings, const StageProgress& progress) {
    return Refiner(rays, space, regions, sample, settings).refine(progress);
}

}  // namespace daylit
