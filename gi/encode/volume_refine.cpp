#include "gi/encode/volume_refine.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "engine/base/random.h"
#include "gi/encode/leaf_error.h"

namespace daylit {
namespace {

constexpr std::size_t kBatch = 256;  // leaves split before errors are compared again
constexpr float kRootsAlong = 8.0f;  // the longest side
constexpr float kSmallest = 0.25f;   // metres, of cells of the level that ends refinement unless one is given
constexpr int kFinest = 4, kCoarsest = 12;
// Sides between a wall and the sample that is taken in place of a corner behind it.
constexpr float kBeforeWall = 0.05f;

struct LatticeHash {
    std::size_t operator()(const Lattice& p) const {
        return std::size_t(mix64(mix64(mix64(std::uint64_t(p.x)) ^ std::uint64_t(p.y)) ^ std::uint64_t(p.z)));
    }
};

/// A leaf as it was tested.
struct Tested {
    RefinedLeaf leaf;
    std::optional<Vec4> plane;
    bool mixed = false;
    LeafError error;
};

class Refiner {
  public:
    Refiner(const RayScene& rays, const FreeSpace& space, const std::vector<Bounds>& regions,
            const SampleVolume& sample, const VolumeSettings& settings)
        : rays_(rays),
          space_(space),
          regions_(regions),
          sample_(sample),
          settings_(settings),
          judge_(out_, space, regions, settings) {}

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

    void test(const std::vector<std::uint32_t>& leaves, const StageProgress& progress) {
        tested_.resize(out_.octree.nodes.size());
        find_places(leaves);
        const StageProgress silent{Progress{}};
        for_each_parallel(leaves.size(), silent, [&](std::size_t i) { part(tested_[leaves[i]]); });
        std::vector<std::uint32_t> places;
        for (const std::uint32_t n : leaves)
            for (int p = 0; p < kLeafPlaces; ++p)
                if (tested_[n].leaf.side[std::size_t(p)] >= 0 &&
                    (is_corner(p) || is_test(p) || !whole(tested_[n].leaf)))
                    places.push_back(tested_[n].leaf.place[std::size_t(p)]);
        sample(std::move(places), progress);
        sample_before_walls(leaves);
        for_each_parallel(leaves.size(), silent, [&](std::size_t i) {
            Tested& tested = tested_[leaves[i]];
            tested.error = judge_.judge(out_.octree.nodes[leaves[i]], tested.leaf, tested.mixed);
        });
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

    void part(Tested& tested) const {
        std::array<Vec3, kLeafPlaces> places;
        std::array<bool, kLeafPlaces> free;
        for (std::size_t p = 0; p < kLeafPlaces; ++p) {
            places[p] = out_.place(tested.leaf, int(p));
            free[p] = out_.places.places[tested.leaf.place[p]].free;
        }
        const LeafSides found = find_sides(places, free, rays_, space_);
        tested.leaf.side = found.side, tested.plane = found.plane, tested.mixed = found.mixed;
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
            judge_.add_to_mean(out_.places.samples[first + i]);
        }
    }

    /// Splits the leaves whose error matters most, and returns their children; none when all are well or the budget is
    /// spent.
    std::vector<std::uint32_t> split_worst() {
        const auto asked_for = [&](std::uint32_t n) { return out_.octree.nodes[n].level < settings_.min_level; };
        std::erase_if(waiting_, [&](std::uint32_t n) {
            return (tested_[n].error.worst <= 1.0 && !asked_for(n)) || out_.octree.nodes[n].level >= max_level_;
        });
        std::stable_sort(waiting_.begin(), waiting_.end(), [&](std::uint32_t a, std::uint32_t b) {
            if (asked_for(a) != asked_for(b)) return asked_for(a);
            return tested_[a].error.square > tested_[b].error.square;
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
                    const std::optional<Vec3> place =
                        before_wall(rays_, space_.box(), out_.place(leaf, from), out_.place(leaf, p),
                                    kBeforeWall * out_.octree.side_of(node));
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
            judge_.add_to_mean(out_.places.samples[i]);
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
    LeafJudge judge_;
    std::unordered_map<Lattice, std::uint32_t, LatticeHash> index_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> before_wall_;  // by corner and place that it is seen from
    std::vector<Tested> tested_;                                          // by node
    std::vector<std::uint32_t> waiting_;                                  // leaves that may be split
    int max_level_ = 0;
};

}  // namespace

double brightness(const VolumeSample& sample) {
    double sum = 0.0;
    const std::size_t functionals = sample.judged.size() / 4;
    for (std::size_t f = 0; f < functionals; ++f) sum += double(sample.judged[f]) * double(sample.judged[f]);
    return functionals ? std::sqrt(sum / double(functionals)) : 0.0;
}

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
