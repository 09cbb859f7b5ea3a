#pragma once
// The clear atmosphere: Rayleigh and aerosol scattering, ozone, all orders of scattering, 16 wavelengths. Sun and sky come
// from the same tables, so that what the sun loses by scattering is what the sky gains.
// Sources: Bruneton and Neyret 2008 (geometry, column table), Hillaire 2020 (isotropic higher orders), Preetham et al.
// 1999 (turbidity), Hansen and Travis 1974 (Rayleigh), Wyman, Sloan and Shirley 2013 (colour matching).
#include <memory>
#include <vector>

#include "engine/base/units.h"

namespace daylit {

inline constexpr double kGroundAlbedo = 0.2;  // of the Earth around, which lights the sky from below

/// Share of the sun's disc above a flat horizon when its centre stands `elevation` radians over it: 0 to 1.
double disc_fraction(double elevation);

/// The clear sky over level ground at one elevation of the sun, 1 au away: radiance in cd/m^2 without the disc.
class ClearSky {
  public:
    /// direction   elevation in [0, pi/2] and azimuth from the sun, radians
    Rgb radiance(double elevation, double azimuth) const;

  private:
    friend class Atmosphere;
    struct Cell {
        Rgb rayleigh, aerosol, multiple;  // in-scattered light before the phase functions, cd/m^2 (lux/sr)
    };
    double sun_elevation_ = 0.0;
    std::vector<Cell> cells_;
};

class Atmosphere {
  public:
    /// turbidity   1 (pure air) to 10 (haze), Preetham's: total over molecular optical thickness at 550 nm
    explicit Atmosphere(double turbidity);
    ~Atmosphere();
    Atmosphere(Atmosphere&&) noexcept;
    Atmosphere& operator=(Atmosphere&&) noexcept;

    /// Illuminance in lux on a plane facing the sun at sea level, 1 au away: its disc as far as it is above the
    /// horizon, through the air. Zero when it has set.
    Rgb sun_illuminance(double apparent_elevation) const;

    /// Computed in parallel; the same bytes for any number of threads.
    ClearSky clear_sky(double apparent_elevation) const;

    /// Extinction of the air at ground level, 1/m, at 610, 550 and 465 nm: how distant ground fades into haze.
    Rgb ground_extinction() const;

    /// What arrives above the air from the sun at 1 au, lux: about 133 klx.
    static Rgb solar_illuminance();

  private:
    struct Tables;
    std::unique_ptr<Tables> tables_;
};

/// The nearest colour with no negative component and the same luminance: mixes in grey. Spectral sunsets reach outside
/// Rec. 709.
Rgb into_gamut(const Rgb& color);

}  // namespace daylit
