#pragma once
// One basis over light for everything that is stored per receiver: a row of light, over the day and over the parts that
// light is made of (engine/scene/light_parts.h), is a sum of few components. Hour, cloud cover, the sun's tint and
// lamps that are switched are all known at run time alone, and all come down to one weight a component.
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/scene/light_parts.h"

namespace daylit {

/// Parts without hours, in this order after the columns of S and K.
enum class StillColumn { Overcast, Ground, Night, Evening, Lamps };
inline constexpr std::size_t kStillColumns = 5;

/// value(receiver) = sum over r of component(receiver, r) * weight_r.
struct LightBasis {
    std::vector<double> hours;     // keyframes, ascending, local clock hours in [0,24]
    std::size_t suns = 0;          // columns of S: none, one that holds all day, or one a keyframe
    std::size_t skies = 0;         // columns of K, likewise
    std::vector<float> sky_level;  // [skies] > 0: columns of K are divided by this, which spans decades at dusk
    int components = 0;
    std::vector<float> curves;  // [components][columns()]

    std::size_t columns() const { return suns + skies + kStillColumns; }
    std::size_t still(StillColumn part) const { return suns + skies + std::size_t(part); }

    /// At any hour (wrapped to [0,24)). Between keyframes cubic, outside them held.
    std::vector<Rgb> weights(const LightScales& scales, double hour) const;
};

/// A cubic through keyframes (Catmull and Rom 1974, with the tangents of parabolas through three keyframes, since these
/// are not evenly spaced): value(hour) = sum of share * value(keyframe). The sun moves along its circle at an even
/// pace, so that hours are arc length along its path.
struct CurveBlend {
    std::array<std::size_t, 4> keyframe{};
    std::array<double, 4> share{};
};
/// hours   ascending, not empty; outside them the nearest is held
CurveBlend curve_blend(std::span<const double> hours, double hour);

}  // namespace daylit
