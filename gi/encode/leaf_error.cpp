#include "gi/encode/leaf_error.h"

#include <algorithm>
#include <cmath>

namespace daylit {
namespace {

constexpr double kUnseen = 1.0;   // error of a cell in which nothing could be measured, over the light; the most that
                                  // any place counts with, lest a lamp's surroundings at night take all cells
constexpr double kMoving = 63.0;  // what errors count where things move, on top of what they count everywhere
// What errors count where surfaces stand around within the size of a room, on top: what is indoors is seen from near.
constexpr double kEnclosed = 5.0;
constexpr float kRoom = 5.0f;
// Errors are compared with the light there, and beside it with this share of the volume's mean light where budget goes,
// or of all light of the place where it is asked whether a cell is well enough: in a dark room beside a bright one it
// is to be well enough as well.
constexpr double kFloor = 0.1;

}  // namespace

/// What is known about light at a corner: a sample, and where in [0,1]^3 it was taken.
struct LeafJudge::StandIn {
    const VolumeSample* sample = nullptr;
    Vec3 from = Vec3(0.0f);
};

/// Of one side, over its places.
struct LeafJudge::SideError {
    double worst = 0.0;    // over the target
    double squares = 0.0;  // sum, over the light where it was measured
    double tests = 0.0;
};

void LeafJudge::add_to_mean(const VolumeSample& sample) {
    mean_.resize(sample.judged.size() / 4, 0.0);
    for (std::size_t f = 0; f < mean_.size(); ++f) mean_[f] += double(sample.judged[f]);
}

/// Errors count where something is likely to be: not in the air around the scene that cells at its border reach.
bool LeafJudge::counts(const Vec3& place) const {
    const auto in = [&](const Bounds& b) {
        return !b.empty() && glm::all(glm::greaterThanEqual(place, b.min)) &&
               glm::all(glm::lessThanEqual(place, b.max));
    };
    return in(space_.box()) || std::any_of(regions_.begin(), regions_.end(), in);
}

/// How much of it is likely to be free though none of its places is; 0: nothing can be in it.
double LeafJudge::free_share(const Octree::Node& n) const {
    const Bounds box{volume_.octree.place(n.at), volume_.octree.place(n.at + n.units())}, &all = space_.box();
    const bool within = !all.empty() && glm::all(glm::greaterThanEqual(box.min, all.min)) &&
                        glm::all(glm::lessThanEqual(box.max, all.max));
    const bool beside = !within && std::any_of(regions_.begin(), regions_.end(), [&](const Bounds& b) {
        return !b.empty() && glm::all(glm::lessThan(box.min, b.max)) && glm::all(glm::greaterThan(box.max, b.min));
    });
    return std::max(space_.reached_share(box), beside ? 1.0 : 0.0) / kLeafPlaces;
}

LeafError LeafJudge::judge(const Octree::Node& node, const RefinedLeaf& leaf, bool mixed) const {
    const auto members = std::count_if(leaf.side.begin(), leaf.side.end(), [](int s) { return s >= 0; });
    if (members == 0) return unseen(node);
    const double length = double(volume_.octree.side_of(node)), volume = length * length * length;
    LeafError result;
    for (int side = 0; side < 2; ++side) {
        const SideError found = side_error(leaf, node, side);
        int places = 0;
        for (int p = 0; p < kLeafPlaces; ++p)
            places += leaf.side[std::size_t(p)] == side && counts(volume_.place(leaf, p));
        result.worst = std::max(result.worst, found.worst);
        if (found.tests > 0.0) result.square += found.squares / found.tests * volume * double(places) / kLeafPlaces;
    }
    result.square *= 1.0 + kMoving * moving_share(node) + kEnclosed * enclosed(leaf);
    if (mixed || (node.level < settings_.geometry_level && members < kLeafPlaces)) result.worst = kOutlier;
    return result;
}

LeafError LeafJudge::unseen(const Octree::Node& node) const {
    const double share = free_share(node), length = double(volume_.octree.side_of(node));
    return share > 0.0 ? LeafError{kOutlier, kUnseen * kUnseen * share * length * length * length} : LeafError{};
}

/// How closely surfaces stand around a leaf, 0 to 1.
double LeafJudge::enclosed(const RefinedLeaf& leaf) const {
    double sum = 0.0;
    int count = 0;
    for (int p = 0; p < kLeafPlaces; ++p)
        if (const VolumeSample* sample = is_corner(p) || is_test(p) ? volume_.sample(leaf, p) : nullptr) {
            const double share = std::min(1.0, double(kRoom / sample->nearness));
            sum += share * share, ++count;
        }
    return count > 0 ? sum / count : 0.0;
}

/// Of a cell, that the swept box takes which takes most of it; most of these overlap.
double LeafJudge::moving_share(const Octree::Node& n) const {
    const Bounds box{volume_.octree.place(n.at), volume_.octree.place(n.at + n.units())};
    const Vec3 size = box.max - box.min;
    double most = 0.0;
    for (const Bounds& b : regions_) {
        if (b.empty()) continue;
        const Vec3 both = glm::max(glm::min(b.max, box.max) - glm::max(b.min, box.min), Vec3(0.0f)) / size;
        most = std::max(most, double(both.x) * double(both.y) * double(both.z));
    }
    return most;
}

/// Between what was measured and what the corners say.
LeafJudge::SideError LeafJudge::side_error(const RefinedLeaf& leaf, const Octree::Node& node, int side) const {
    const float length = volume_.octree.side_of(node);
    std::array<StandIn, 8> corners;
    for (int c = 0; c < 8; ++c) corners[std::size_t(c)] = stand_in(leaf, c, side);
    SideError result;
    if (!corners[0].sample) return result;
    for (const StandIn& c : corners) result.worst = std::max(result.worst, by_controls(*c.sample, length));
    for (int p = 0; p < kLeafPlaces; ++p)
        if (!is_corner(p) && leaf.side[std::size_t(p)] == side && volume_.sample(leaf, p))
            compare(corners, length, *volume_.sample(leaf, p), t_of(p), result);
    for (const RefinedLeaf::WallSample& before : leaf.before_walls)
        if (is_test(before.place) && before.side == side)
            compare(corners, length, volume_.places.samples[std::size_t(before.sample)], before.t, result);
    result.worst = std::min(result.worst, kOutlier);
    return result;
}

void LeafJudge::compare(const std::array<StandIn, 8>& corners, float length, const VolumeSample& measured,
                        const Vec3& t, SideError& result) const {
    const double own = kFloor * brightness(measured);
    for (std::size_t f = 0; f < mean_.size(); ++f) {
        const double mean = mean_[f] / double(volume_.places.samples.size());
        const double truth = double(measured.judged[f]), light = std::abs(truth) + kFloor * mean;
        const double left = std::abs(interpolated(corners, f, t, length) - truth) - 2.0 * double(measured.noise[f]);
        result.tests += 1.0;
        if (left <= 0.0 || mean <= 0.0) continue;
        result.worst = std::max(result.worst, left / (std::abs(truth) + own) / double(settings_.error));
        const double share = std::min(left / light, kUnseen);
        result.squares += share * share;
    }
}

double LeafJudge::interpolated(const std::array<StandIn, 8>& corners, std::size_t f, const Vec3& t,
                               float length) const {
    const std::size_t functionals = mean_.size();
    const std::array<Vec4, 8> blend = blend_weights(settings_.blend, t, length);
    double sum = 0.0;
    for (int c = 0; c < 8; ++c) {
        const auto& [sample, from] = corners[std::size_t(c)];
        const std::vector<float>& judged = sample->judged;
        const Vec4& weights = blend[std::size_t(c)];
        const float noise = sample->change_noise * length;
        const Vec3 change = Vec3(judged[functionals + f], judged[2 * functionals + f], judged[3 * functionals + f]) /
                            std::max(1.0f, noise * noise);
        const Vec3 moved = length * (Vec3(c & 1, c >> 1 & 1, c >> 2) - from);
        const float most = 0.5f * std::abs(judged[f]);
        const float value = judged[f] + std::clamp(glm::dot(change, moved), -most, most);
        sum += double(weights.x) * double(value) + double(glm::dot(Vec3(weights.y, weights.z, weights.w), change));
    }
    return sum;
}

/// Oat's tests of a corner alone.
double LeafJudge::by_controls(const VolumeSample& s, float length) const {
    if (s.nearness < settings_.harmonic_mean * length) return 2.0;
    const std::size_t functionals = mean_.size();
    for (std::size_t f = 0; f < functionals; ++f) {
        const Vec3 change(s.judged[functionals + f], s.judged[2 * functionals + f], s.judged[3 * functionals + f]);
        if (glm::length(change) * length > settings_.change * std::abs(s.judged[f])) return 2.0;
    }
    return 0.0;
}

/// The sample at a corner, or the nearest of the same side.
LeafJudge::StandIn LeafJudge::stand_in(const RefinedLeaf& leaf, int corner, int side) const {
    const Vec3 at(corner & 1, corner >> 1 & 1, corner >> 2);
    StandIn best;
    float least = 1e9f;
    const auto consider = [&](const VolumeSample* sample, const Vec3& t) {
        if (sample && glm::distance(at, t) < least) least = glm::distance(at, t), best = {sample, t};
    };
    for (int p = 0; p < kLeafPlaces; ++p)
        if (leaf.side[std::size_t(p)] == side) consider(volume_.sample(leaf, p), t_of(p));
    for (const RefinedLeaf::WallSample& before : leaf.before_walls)
        if (before.side == side && is_corner(before.place))
            consider(&volume_.places.samples[std::size_t(before.sample)], before.t);
    return best;
}

}  // namespace daylit
