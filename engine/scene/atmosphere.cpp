#include "engine/scene/atmosphere.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace daylit {
namespace {

// ---- Spectra: 16 bands of 20 nm from 380 to 700 nm. ----

constexpr int kSpectralBands = 16;
constexpr double kFirstBand = 380.0, kBandWidth = 20.0;  // nm

// Four bands side by side, by the vector types of GCC and Clang: the loops over a spectrum are all the time there is.
using Lanes [[gnu::vector_size(16)]] = float;
using IntLanes [[gnu::vector_size(16)]] = std::int32_t;
constexpr int kLanes = kSpectralBands / 4;

struct Spectrum {
    Lanes v[kLanes] = {};
    float at(int band) const { return v[band / 4][band % 4]; }
    void set(int band, double value) { v[band / 4][band % 4] = float(value); }
    static Spectrum filled(float value) {
        Spectrum spectrum;
        for (Lanes& lanes : spectrum.v) lanes += value;
        return spectrum;
    }
};

double band_centre(int band) {
    return kFirstBand + (band + 0.5) * kBandWidth;
}

// Solar irradiance at 1 au in W/m^2/nm, means over 10 nm from 380 nm on: ASTM G173-03, extraterrestrial column.
constexpr double kSolar[32] = {1.01249, 1.14716, 1.72765, 1.73054, 1.6887,  1.61253, 1.91198, 2.03474,
                               2.02042, 2.02212, 1.93377, 1.95809, 1.91686, 1.8298,  1.8685,  1.8931,
                               1.85149, 1.8504,  1.8341,  1.8345,  1.8147,  1.78158, 1.7533,  1.6965,
                               1.68194, 1.64654, 1.6048,  1.52143, 1.55622, 1.5113,  1.474,   1.4482};

// Ozone's absorption cross-section at 233 K in m^2, means over the same bins: Serdyuchenko et al. 2014 (IUP Bremen).
constexpr double kOzoneCrossSection[32] = {
    2.818e-28, 6.636e-28, 1.527e-27, 2.763e-27, 5.52e-27,  8.451e-27, 1.582e-26, 2.316e-26,
    3.669e-26, 4.924e-26, 7.752e-26, 9.016e-26, 1.48e-25,  1.602e-25, 2.139e-25, 2.755e-25,
    3.091e-25, 3.5e-25,   4.266e-25, 4.672e-25, 4.398e-25, 4.701e-25, 5.019e-25, 4.305e-25,
    3.74e-25,  3.215e-25, 2.662e-25, 2.238e-25, 1.852e-25, 1.473e-25, 1.209e-25, 9.423e-26};

/// CIE 1931 colour matching functions by the multi-lobe fit of Wyman, Sloan and Shirley 2013, equation 4.
std::array<double, 3> color_matching(double nm) {
    const auto lobe = [nm](double height, double mean, double below, double above) {
        const double t = (nm - mean) / (nm < mean ? below : above);
        return height * std::exp(-0.5 * t * t);
    };
    return {lobe(1.056, 599.8, 37.9, 31.0) + lobe(0.362, 442.0, 16.0, 26.7) + lobe(-0.065, 501.1, 20.4, 26.2),
            lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1),
            lobe(1.217, 437.0, 11.8, 36.0) + lobe(0.681, 459.0, 26.0, 13.8)};
}

/// Linear Rec. 709 in lux that the unattenuated sun has in each band; 683 lm/W.
std::array<Rgb, kSpectralBands> solar_bands() {
    std::array<Rgb, kSpectralBands> bands{};
    for (int band = 0; band < kSpectralBands; ++band) {
        double xyz[3] = {0, 0, 0};
        for (int i = 0; i < int(kBandWidth); ++i) {
            const double nm = kFirstBand + band * kBandWidth + i + 0.5;
            const double irradiance = kSolar[int((nm - kFirstBand) / 10.0)];
            const auto matching = color_matching(nm);
            for (int c = 0; c < 3; ++c) xyz[c] += 683.0 * irradiance * matching[std::size_t(c)];
        }
        bands[std::size_t(band)] = Rgb(3.2404542 * xyz[0] - 1.5371385 * xyz[1] - 0.4985314 * xyz[2],
                                       -0.9692660 * xyz[0] + 1.8760108 * xyz[1] + 0.0415560 * xyz[2],
                                       0.0556434 * xyz[0] - 0.2040259 * xyz[1] + 1.0572252 * xyz[2]);
    }
    return bands;
}

Rgb color_of(const Spectrum& share_of_sunlight, const std::array<Rgb, kSpectralBands>& bands) {
    Rgb sum(0.0f);
    for (int i = 0; i < kSpectralBands; ++i) sum += bands[std::size_t(i)] * share_of_sunlight.at(i);
    return sum;
}

/// e^x for x <= 0 within 3e-7, by 2^i 2^f with |f| <= 1/2 and the series of 2^f.
inline Lanes exp_of_negative(Lanes x) {
    const Lanes y = (x > -87.0f ? x : Lanes{} - 87.0f) * 1.44269504f;
    const IntLanes i = __builtin_convertvector(y - 0.5f, IntLanes);  // truncation rounds negatives to the nearest
    const Lanes f = y - __builtin_convertvector(i, Lanes);
    const Lanes power = 1.0f + f * (0.69314718f + f * (0.24022651f + f * (0.05550411f +
                        f * (0.00961813f + f * (0.00133336f + f * 0.00015404f)))));
    return power * std::bit_cast<Lanes>((i + 127) << 23);
}

/// Integral of the transmittance along a step: (1 - e^-x) / extinction, and its limit where that would cancel.
inline Lanes mean_length(Lanes x, Lanes left, Lanes extinction, float length) {
    return x > 1e-3f ? (1.0f - left) / extinction : length * (1.0f - 0.5f * x);
}

// ---- The medium: densities by height. ----

constexpr double kGround = 6371e3, kTop = kGround + 100e3;           // m from the Earth's centre
constexpr double kRayleighHeight = 8000.0, kAerosolHeight = 1200.0;  // scale heights, m
constexpr double kOzoneCentre = 25e3, kOzoneHalfWidth = 15e3;        // a tent, m
constexpr double kOzonePeak = 300.0 * 2.687e20 / kOzoneHalfWidth;    // molecules/m^3 for 300 Dobson units
constexpr double kAngstromExponent = 1.3;
constexpr double kAerosolAlbedo = 0.93;    // share of extinction that scatters; continental haze
constexpr double kAerosolAsymmetry = 0.65;  // g of the phase function below; its mean cosine is then 0.71

/// Densities relative to sea level (ozone: to its peak), or columns of them in metres.
struct Densities {
    float rayleigh = 0, aerosol = 0, ozone = 0;
};

Densities densities_at(double height) {
    return {float(std::exp(-height / kRayleighHeight)), float(std::exp(-height / kAerosolHeight)),
            float(std::max(0.0, 1.0 - std::abs(height - kOzoneCentre) / kOzoneHalfWidth))};
}

/// Coefficients per metre where the density is 1.
struct Medium {
    Spectrum rayleigh, aerosol_scattering, aerosol_extinction, ozone;
};

Medium medium_of(double turbidity) {
    // Preetham et al. 1999, appendix A.1: Angstrom's turbidity from the turbidity.
    const double beta = std::max(0.0, 0.04608 * turbidity - 0.04586);
    Medium medium;
    for (int i = 0; i < kSpectralBands; ++i) {
        const double um = band_centre(i) * 1e-3;
        const double u2 = 1.0 / (um * um);
        // Hansen and Travis 1974, equation 2.29: Rayleigh optical thickness of the whole air at 1013 mbar.
        const double rayleigh = 0.008569 * u2 * u2 * (1.0 + 0.0113 * u2 + 0.00013 * u2 * u2);
        const double aerosol = beta * std::pow(um, -kAngstromExponent);
        medium.rayleigh.set(i, rayleigh / kRayleighHeight);
        medium.aerosol_extinction.set(i, aerosol / kAerosolHeight);
        medium.aerosol_scattering.set(i, kAerosolAlbedo * aerosol / kAerosolHeight);
        medium.ozone.set(i, 0.5 * (kOzoneCrossSection[2 * i] + kOzoneCrossSection[2 * i + 1]) * kOzonePeak);
    }
    return medium;
}

double phase_rayleigh(double cosine) {
    return 3.0 / (16.0 * kPi) * (1.0 + cosine * cosine);
}

/// Cornette and Shanks 1992: Henyey-Greenstein with Rayleigh's factor.
double phase_aerosol(double cosine) {
    constexpr double g = kAerosolAsymmetry;
    const double base = 1.0 + g * g - 2.0 * g * cosine;
    return 3.0 / (8.0 * kPi) * (1.0 - g * g) * (1.0 + cosine * cosine) / ((2.0 + g * g) * base * std::sqrt(base));
}

// ---- Rays round the Earth. ----

double distance_to_sphere_top(double r, double mu) {
    return -r * mu + std::sqrt(std::max(0.0, r * r * (mu * mu - 1.0) + kTop * kTop));
}

/// Distance to the ground, or a negative number when the ray misses it.
double distance_to_ground(double r, double mu) {
    const double discriminant = r * r * (mu * mu - 1.0) + kGround * kGround;
    return mu < 0.0 && discriminant >= 0.0 ? -r * mu - std::sqrt(discriminant) : -1.0;
}

/// The depression of the horizon seen from r: its elevation, zero or below.
double horizon_elevation(double r) {
    return -std::acos(std::min(1.0, kGround / r));
}

// Columns up to the top, parametrised as Bruneton and Neyret 2008, section 4: dense near ground and horizon.
constexpr int kColumnHeights = 64, kColumnAngles = 192;
const double kHorizonSpan = std::sqrt(kTop * kTop - kGround * kGround);

class Columns {
  public:
    Columns() : table_(std::size_t(kColumnHeights * kColumnAngles)) {
        tbb::parallel_for(0, kColumnHeights, [this](int y) {
            for (int x = 0; x < kColumnAngles; ++x) table_[std::size_t(y * kColumnAngles + x)] = integrate(y, x);
        });
    }

    /// From r in the direction with cosine mu to the zenith; rays below the horizon get the horizon's column.
    Densities at(double r, double mu) const {
        const double rho = std::sqrt(std::max(0.0, r * r - kGround * kGround));
        const double nearest = kTop - r, farthest = rho + kHorizonSpan;
        const double distance = std::clamp(distance_to_sphere_top(r, std::max(mu, -rho / r)), nearest, farthest);
        const double y = std::min(rho / kHorizonSpan, 1.0) * (kColumnHeights - 1);
        const double x = (distance - nearest) / (farthest - nearest) * (kColumnAngles - 1);
        const int y0 = std::min(int(y), kColumnHeights - 2), x0 = std::min(int(x), kColumnAngles - 2);
        const float fy = float(y - y0), fx = float(x - x0);
        const Densities* row = &table_[std::size_t(y0 * kColumnAngles + x0)];
        const auto mix = [&](float Densities::*m) {
            const float low = row[0].*m * (1 - fx) + row[1].*m * fx;
            const float high = row[kColumnAngles].*m * (1 - fx) + row[kColumnAngles + 1].*m * fx;
            return low * (1 - fy) + high * fy;
        };
        return {mix(&Densities::rayleigh), mix(&Densities::aerosol), mix(&Densities::ozone)};
    }

  private:
    static Densities integrate(int y, int x) {
        const double rho = kHorizonSpan * y / (kColumnHeights - 1);
        const double r = std::sqrt(rho * rho + kGround * kGround);
        const double nearest = kTop - r, farthest = rho + kHorizonSpan;
        const double length = nearest + (farthest - nearest) * x / (kColumnAngles - 1);
        const double mu =
            length <= 0.0 ? 1.0
                          : std::clamp((kHorizonSpan * kHorizonSpan - rho * rho - length * length) / (2 * r * length),
                                       -1.0, 1.0);
        constexpr int kSteps = 200;
        double sum[3] = {0, 0, 0};
        for (int i = 0; i < kSteps; ++i) {
            // Near the ground upward rays need short steps, and rays that dip first need them in their middle.
            const double u = (i + 0.5) / kSteps;
            const double t = mu >= 0.0 ? length * u * u : length * u;
            const double step = mu >= 0.0 ? length * 2 * u / kSteps : length / kSteps;
            const double height = std::sqrt(r * r + t * t + 2 * r * mu * t) - kGround;
            const Densities d = densities_at(std::max(height, 0.0));
            sum[0] += d.rayleigh * step;
            sum[1] += d.aerosol * step;
            sum[2] += d.ozone * step;
        }
        return {float(sum[0]), float(sum[1]), float(sum[2])};
    }

    std::vector<Densities> table_;
};

/// Share of light left after columns of the medium, scaled.
void transmit(const Medium& medium, const Densities& columns, float scale, Spectrum& out) {
    for (int i = 0; i < kLanes; ++i) {
        out.v[i] = scale * exp_of_negative(-(medium.rayleigh.v[i] * columns.rayleigh +
                                             medium.aerosol_extinction.v[i] * columns.aerosol +
                                             medium.ozone.v[i] * columns.ozone));
    }
}

// ---- Higher orders: Hillaire 2020, section 5.5, by height and the sun's elevation there. ----

constexpr int kMultipleHeights = 24, kMultipleSuns = 81;  // odd: the middle column is the horizon

/// Sun elevation of a column; the square root puts most of them near the horizon.
double multiple_sun(int column) {
    const double s = 2.0 * column / (kMultipleSuns - 1) - 1.0;
    return 0.5 * kPi * s * std::abs(s);
}

double multiple_column(double elevation) {
    const double s = std::copysign(std::sqrt(std::abs(elevation) / (0.5 * kPi)), elevation);
    return 0.5 * (s + 1.0) * (kMultipleSuns - 1);
}

double multiple_height(int row) {
    const double s = double(row) / (kMultipleHeights - 1);
    return (kTop - kGround) * s * s;
}

double multiple_row(double height) {
    return std::sqrt(std::max(height, 0.0) / (kTop - kGround)) * (kMultipleHeights - 1);
}

/// Where a ray's samples lie: short steps at the end that is nearer to the ground.
struct Spacing {
    double length;
    bool dense_at_start, dense_at_end;
    double position(double u) const {
        if (dense_at_start) return length * u * u;
        if (dense_at_end) return length * (1.0 - (1.0 - u) * (1.0 - u));
        return length * u;
    }
};

}  // namespace

struct Atmosphere::Tables {
    Medium medium;
    Columns columns;
    std::array<Rgb, kSpectralBands> bands = solar_bands();
    std::vector<Spectrum> multiple;  // mean radiance of all higher orders, per unit of the sun's irradiance

    explicit Tables(double turbidity)
        : medium(medium_of(turbidity)), multiple(std::size_t(kMultipleHeights * kMultipleSuns)) {
        tbb::parallel_for(0, kMultipleHeights * kMultipleSuns,
                          [this](int i) { multiple[std::size_t(i)] = gather_multiple(i); });
    }

    /// The sun's light arriving at r where the sun stands at `elevation`: its disc as far as the Earth leaves it.
    void sunlight(double r, double elevation, Spectrum& out) const {
        const float visible = float(disc_fraction(elevation - horizon_elevation(r)));
        if (visible <= 0.0f) {
            out = {};
            return;
        }
        transmit(medium, columns.at(r, std::sin(elevation)), visible, out);
    }

    void multiple_at(double height, double sun_elevation, Spectrum& out) const {
        const double y = multiple_row(height), x = multiple_column(sun_elevation);
        const int y0 = std::min(int(y), kMultipleHeights - 2), x0 = std::clamp(int(x), 0, kMultipleSuns - 2);
        const float fy = float(std::min(y - y0, 1.0)), fx = float(std::min(x - x0, 1.0));
        const Spectrum* a = &multiple[std::size_t(y0 * kMultipleSuns + x0)];
        const Spectrum* b = a + kMultipleSuns;
        for (int i = 0; i < kLanes; ++i) {
            out.v[i] = (a[0].v[i] * (1 - fx) + a[1].v[i] * fx) * (1 - fy) +
                       (b[0].v[i] * (1 - fx) + b[1].v[i] * fx) * fy;
        }
    }

    Spectrum gather_multiple(int cell) const;
    ClearSky::Cell view_ray(double elevation, double azimuth, double sun_elevation) const;
};

/// Radiance that scattered twice, averaged over the sphere, and the share of it that each further order keeps: a
/// geometric series. Scattering is taken as isotropic here, since two or more bounces forget the direction.
Spectrum Atmosphere::Tables::gather_multiple(int cell) const {
    const double r = kGround + multiple_height(cell / kMultipleSuns);
    const double sun_elevation = multiple_sun(cell % kMultipleSuns);
    const double sun_sin = std::sin(sun_elevation), sun_cos = std::cos(sun_elevation);
    constexpr int kPolar = 8, kAround = 6, kSteps = 20;
    Spectrum second, kept;
    for (int direction = 0; direction < kPolar * kAround; ++direction) {
        // Equal solid angles; azimuths from 0 to pi, the other half mirrors them.
        const double mu = 1.0 - 2.0 * (direction / kAround + 0.5) / kPolar;
        const double toward_sun = std::sqrt(1.0 - mu * mu) * std::cos(kPi * (direction % kAround + 0.5) / kAround);
        const double ground = distance_to_ground(r, mu);
        const Spacing spacing{ground >= 0.0 ? ground : distance_to_sphere_top(r, mu), mu >= 0.0, ground >= 0.0};
        const double sun_cosine = toward_sun * sun_cos + mu * sun_sin;

        Spectrum through = Spectrum::filled(1.0f);  // transmittance so far
        Spectrum lit;
        const auto sun_at = [&](double t, double& radius) {
            radius = std::sqrt(r * r + t * t + 2.0 * r * mu * t);
            return std::asin(std::clamp((r * sun_sin + t * sun_cosine) / radius, -1.0, 1.0));
        };
        for (int step = 0; step < kSteps; ++step) {
            const double t0 = spacing.position(double(step) / kSteps);
            const double t1 = spacing.position(double(step + 1) / kSteps);
            double radius;
            const double elevation = sun_at(0.5 * (t0 + t1), radius);
            const Densities d = densities_at(std::max(radius - kGround, 0.0));
            sunlight(radius, elevation, lit);
            const float length = float(t1 - t0);
            for (int i = 0; i < kLanes; ++i) {
                const Lanes scattering = medium.rayleigh.v[i] * d.rayleigh + medium.aerosol_scattering.v[i] * d.aerosol;
                const Lanes extinction = medium.rayleigh.v[i] * d.rayleigh +
                                         medium.aerosol_extinction.v[i] * d.aerosol + medium.ozone.v[i] * d.ozone;
                const Lanes x = extinction * length;
                const Lanes left = exp_of_negative(-x);
                const Lanes weight = through.v[i] * scattering *
                                     mean_length(x, left, extinction, length);
                second.v[i] += weight * lit.v[i] * float(1.0 / (4.0 * kPi));
                kept.v[i] += weight;
                through.v[i] *= left;
            }
        }
        if (ground >= 0.0) {
            double radius;
            const double elevation = sun_at(ground, radius);
            sunlight(kGround, elevation, lit);
            const float cosine = float(std::max(0.0, std::sin(elevation)) * kGroundAlbedo / kPi);
            for (int i = 0; i < kLanes; ++i) second.v[i] += through.v[i] * lit.v[i] * cosine;
        }
    }
    constexpr float kShare = 1.0f / (kPolar * kAround);
    Spectrum all;
    for (int i = 0; i < kLanes; ++i) {
        const Lanes ratio = kept.v[i] * kShare;
        all.v[i] = second.v[i] * kShare / (1.0f - (ratio < 0.999f ? ratio : Lanes{} + 0.999f));
    }
    return all;
}

/// One view ray from the ground: what each kind of scattering adds, phase functions left out, so that the result is
/// smooth in both angles and a coarse table serves.
ClearSky::Cell Atmosphere::Tables::view_ray(double elevation, double azimuth, double sun_elevation) const {
    const double mu = std::sin(elevation);
    const double sun_sin = std::sin(sun_elevation);
    const double sun_cosine = std::cos(elevation) * std::cos(sun_elevation) * std::cos(azimuth) + mu * sun_sin;
    const Spacing spacing{distance_to_sphere_top(kGround, mu), true, false};
    constexpr int kSteps = 64;
    Spectrum through = Spectrum::filled(1.0f);
    Spectrum lit, higher, rayleigh, aerosol, multiple_light;
    for (int step = 0; step < kSteps; ++step) {
        const double t0 = spacing.position(double(step) / kSteps);
        const double t1 = spacing.position(double(step + 1) / kSteps);
        const double t = 0.5 * (t0 + t1);
        const double radius = std::sqrt(kGround * kGround + t * t + 2.0 * kGround * mu * t);
        const double here = std::asin(std::clamp((kGround * sun_sin + t * sun_cosine) / radius, -1.0, 1.0));
        const Densities d = densities_at(std::max(radius - kGround, 0.0));
        sunlight(radius, here, lit);
        multiple_at(radius - kGround, here, higher);
        const float length = float(t1 - t0);
        for (int i = 0; i < kLanes; ++i) {
            const Lanes rayleigh_here = medium.rayleigh.v[i] * d.rayleigh;
            const Lanes aerosol_here = medium.aerosol_scattering.v[i] * d.aerosol;
            const Lanes extinction =
                rayleigh_here + medium.aerosol_extinction.v[i] * d.aerosol + medium.ozone.v[i] * d.ozone;
            const Lanes x = extinction * length;
            const Lanes left = exp_of_negative(-x);
            const Lanes weight = through.v[i] * mean_length(x, left, extinction, length);
            rayleigh.v[i] += weight * rayleigh_here * lit.v[i];
            aerosol.v[i] += weight * aerosol_here * lit.v[i];
            multiple_light.v[i] += weight * (rayleigh_here + aerosol_here) * higher.v[i];
            through.v[i] *= left;
        }
    }
    return {color_of(rayleigh, bands), color_of(aerosol, bands), color_of(multiple_light, bands)};
}

// ---- The sky's table: elevations dense near the horizon, azimuths from the sun to the point opposite. ----

namespace {
constexpr int kViewElevations = 64, kViewAzimuths = 33;
}

Rgb ClearSky::radiance(double elevation, double azimuth) const {
    const double from_sun = std::abs(std::remainder(azimuth, 2.0 * kPi));
    const double y = std::sqrt(std::clamp(elevation / (0.5 * kPi), 0.0, 1.0)) * (kViewElevations - 1);
    const double x = from_sun / kPi * (kViewAzimuths - 1);
    const int y0 = std::min(int(y), kViewElevations - 2), x0 = std::min(int(x), kViewAzimuths - 2);
    const float fy = float(y - y0), fx = float(x - x0);
    const Cell* a = &cells_[std::size_t(y0 * kViewAzimuths + x0)];
    const Cell* b = a + kViewAzimuths;
    const auto mix = [&](Rgb Cell::*m) {
        return (a[0].*m * (1 - fx) + a[1].*m * fx) * (1 - fy) + (b[0].*m * (1 - fx) + b[1].*m * fx) * fy;
    };
    const double cosine = std::cos(elevation) * std::cos(sun_elevation_) * std::cos(from_sun) +
                          std::sin(elevation) * std::sin(sun_elevation_);
    return into_gamut(mix(&Cell::rayleigh) * float(phase_rayleigh(cosine)) +
                      mix(&Cell::aerosol) * float(phase_aerosol(cosine)) + mix(&Cell::multiple));
}

double disc_fraction(double elevation) {
    const double x = std::clamp(elevation / kSunRadius, -1.0, 1.0);
    return 0.5 + (x * std::sqrt(1.0 - x * x) + std::asin(x)) / kPi;  // the circle's area above a chord
}

Rgb into_gamut(const Rgb& color) {
    const float smallest = std::min({color.r, color.g, color.b});
    if (smallest >= 0.0f) return color;
    const float grey = luminance(color);
    if (grey <= 0.0f) return Rgb(0.0f);
    return glm::max(Rgb(grey) + (color - Rgb(grey)) * (grey / (grey - smallest)), Rgb(0.0f));
}

Atmosphere::Atmosphere(double turbidity) : tables_(std::make_unique<Tables>(turbidity)) {}
Atmosphere::~Atmosphere() = default;
Atmosphere::Atmosphere(Atmosphere&&) noexcept = default;
Atmosphere& Atmosphere::operator=(Atmosphere&&) noexcept = default;

Rgb Atmosphere::sun_illuminance(double apparent_elevation) const {
    const double fraction = disc_fraction(apparent_elevation);
    if (fraction <= 0.0) return Rgb(0.0f);
    // A sun that is partly down shines from the middle of what is left of it.
    const double middle =
        apparent_elevation >= kSunRadius ? apparent_elevation : 0.5 * (apparent_elevation + kSunRadius);
    Spectrum left;
    transmit(tables_->medium, tables_->columns.at(kGround, std::sin(middle)), float(fraction), left);
    return into_gamut(color_of(left, tables_->bands));
}

ClearSky Atmosphere::clear_sky(double apparent_elevation) const {
    ClearSky sky;
    sky.sun_elevation_ = apparent_elevation;
    sky.cells_.resize(std::size_t(kViewElevations * kViewAzimuths));
    tbb::parallel_for(0, kViewElevations, [&](int y) {
        const double s = double(y) / (kViewElevations - 1);
        for (int x = 0; x < kViewAzimuths; ++x) {
            sky.cells_[std::size_t(y * kViewAzimuths + x)] =
                tables_->view_ray(0.5 * kPi * s * s, kPi * x / (kViewAzimuths - 1), apparent_elevation);
        }
    });
    return sky;
}

Rgb Atmosphere::ground_extinction() const {
    const auto at = [this](double nm) {
        const int band = int((nm - kFirstBand) / kBandWidth);
        return tables_->medium.rayleigh.at(band) + tables_->medium.aerosol_extinction.at(band);
    };
    return Rgb(at(610.0), at(550.0), at(465.0));
}

Rgb Atmosphere::solar_illuminance() {
    return color_of(Spectrum::filled(1.0f), solar_bands());
}

}  // namespace daylit
