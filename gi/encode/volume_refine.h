#pragma once
// An octree over free space, refined where light measured inside a cell differs from what its corners say.
#include <functional>
#include <map>
#include <optional>

#include "engine/base/progress.h"
#include "gi/encode/leaf_walls.h"
#include "gi/encode/sample_light.h"
#include "gi/encode/volume_octree.h"
#include "gi/encode/volume_settings.h"
#include "gi/parallel.h"

namespace daylit {

/// Planes that irradiance is judged on: those of the six axes.
inline constexpr std::size_t kJudgedSides = 6;

/// A sample of light at a place. Several numbers of one kind follow one another, so that they are blended alike.
struct VolumeSample {
    SampleLight light;          // [part 4][numbers]: what is encoded; parts are the value and its change along x, y, z
    std::vector<float> judged;  // [part 4][functionals]: irradiance over exposure, [kJudgedSides][hour]
    std::vector<float> noise;   // [functionals]: standard error of the values
    float change_noise = 0.0f;  // standard error of the change per metre, over that of the value; metres^-1
    float nearness = 1e9f;      // harmonic mean distance of what is seen, metres
    bool inside = false;        // of something solid
};
/// Root mean square over sides and hours, over exposure.
double brightness(const VolumeSample& sample);
using SampleVolume = std::function<VolumeSample(const Vec3& place, std::uint64_t key)>;

/// Places of the finest lattice that cells were tested at.
struct VolumePlaces {
    struct Place {
        Lattice at;
        bool free = false;  // something can be there
        int sample = -1;
    };
    std::vector<Place> places;
    std::vector<VolumeSample> samples;
};

/// Centre of the cell or of a face: what is measured beside the corners.
inline bool is_test(int place) {
    return (place % 3 == 1) + (place / 3 % 3 == 1) + (place / 9 == 1) >= 2;
}

struct RefinedLeaf {
    std::array<std::uint32_t, kLeafPlaces> place{};  // index into places
    std::array<std::int8_t, kLeafPlaces> side{};     // as in LeafSides

    /// Taken in the open, just before the wall that one of the places lies behind.
    struct WallSample {
        Vec3 t;         // where in the leaf
        int place = 0;  // of the 27
        int side = 0, sample = 0;
    };
    std::vector<WallSample> before_walls;
};

struct RefinedVolume {
    Octree octree;
    VolumePlaces places;
    std::map<std::uint32_t, RefinedLeaf> leaves;  // those with cells
    bool budget_spent = false;

    Vec3 place(const RefinedLeaf& leaf, int p) const {
        return octree.place(places.places[leaf.place[std::size_t(p)]].at);
    }
    /// Of a place that is of a cell; null: none was taken.
    const VolumeSample* sample(const RefinedLeaf& leaf, int p) const {
        const int s = places.places[leaf.place[std::size_t(p)]].sample;
        return leaf.side[std::size_t(p)] >= 0 && s >= 0 ? &places.samples[std::size_t(s)] : nullptr;
    }
};

/// Roots alone, over the scene's box and the regions: cubes of an eighth of the longest side.
Octree lay_octree(const FreeSpace& space, const std::vector<Bounds>& regions);

/// Every corner of every cell that is free, and every other free place that told of the light, has a sample.
/// regions   boxes where something can be though they leave the scene's box
RefinedVolume refine_volume(const RayScene& rays, const FreeSpace& space, const std::vector<Bounds>& regions,
                            const SampleVolume& sample, const VolumeSettings& settings, const StageProgress& progress);

}  // namespace daylit
