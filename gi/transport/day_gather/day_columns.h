#pragma once
// What is solved for: the parts of the day's light (engine/scene/light_parts.h) as columns of one matrix.
#include <span>
#include <vector>

#include "engine/scene/sky.h"

namespace daylit {

/// Columns without hours, in this order after those of S and K.
enum class StillPart { Overcast, Ground, Night, Evening, Lamps };
inline constexpr std::size_t kStillParts = 5;
/// Components of a solution, the still parts among them: its error falls slowly with them, for sun comes to places for
/// minutes. A room that it enters through a door was black and blue about its patch with 64 of them.
inline constexpr std::size_t kMostComponents = 96;

/// S at every hour, K at every hour, then the still parts. S and K have one column alone where they are the same all
/// day, and none where there is no such light.
struct DayColumns {
    std::vector<double> hours;  // ascending, local clock
    std::size_t suns = 0, skies = 0;

    std::size_t count() const { return suns + skies + kStillParts; }
    std::size_t still(StillPart part) const { return suns + skies + std::size_t(part); }
    /// Calls use(column, scale) for the columns whose sum, each times its scale, is the light of hour `hours[k]`.
    template <class Use>
    void for_hour(std::size_t k, const LightScales& scales, const Use& use) const {
        if (suns > 0) use(suns == 1 ? 0 : k, scales.sun);
        if (skies > 0) use(suns + (skies == 1 ? 0 : k), Rgb(scales.clear));
        use(still(StillPart::Overcast), scales.overcast);
        use(still(StillPart::Ground), scales.ground);
        use(still(StillPart::Night), Rgb(scales.night));
        use(still(StillPart::Evening), Rgb(scales.evening));
        use(still(StillPart::Lamps), Rgb(1.0f));
    }
};

/// The light from afar of every column, and what each is worth.
struct DayLight {
    DayColumns columns;
    std::vector<std::vector<Sun>> suns;  // per column of S
    std::vector<std::vector<Rgb>>
        sky;  // per column of K, then Overcast, Ground, Night: mean radiance of the bins, cd/m^2
    std::vector<LightScales> scales;  // per hour, without clouds: by these columns are weighed against each other
};

/// hours   ascending; one alone where the light is constant
DayLight day_light(const LightModel& model, std::vector<double> hours);

/// The sky's directions in bins of 5.6 degrees: mean radiance, cd/m^2.
std::vector<Rgb> sky_bins(const Environment& sky);
std::uint32_t sky_bin(const Vec3& direction);
inline constexpr int kSkyRows = 32, kSkyColumns = 64;
inline constexpr std::size_t kSkyBins = std::size_t(kSkyRows) * kSkyColumns;

}  // namespace daylit
