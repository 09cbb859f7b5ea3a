// Solar position after I. Reda and A. Andreas, "Solar position algorithm for solar radiation applications", Solar
// Energy 76(5), 2004, and NREL/TP-560-34302; the step numbers below are those of the report's section 3.
#include "engine/scene/day.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "engine/scene/solar_terms.h"

namespace daylit {
namespace {

double wrap_degrees(double degrees) {
    return degrees - 360.0 * std::floor(degrees / 360.0);
}

/// c[0] + c[1] x + c[2] x^2 ...
double polynomial(std::initializer_list<double> coefficients, double x) {
    double sum = 0.0;
    for (auto c = std::rbegin(coefficients); c != std::rend(coefficients); ++c) sum = sum * x + *c;
    return sum;
}

/// Days since 1970-01-01 in the proleptic Gregorian calendar; years start in March, so that leap days come last.
long days_since_1970(const Date& date) {
    const long year = long(date.year) - (date.month <= 2);
    const long era = (year >= 0 ? year : year - 399) / 400;
    const long year_of_era = year - era * 400;
    const long day_of_year = (153L * (date.month + (date.month > 2 ? -3 : 9)) + 2) / 5 + date.day - 1;
    return era * 146097 + year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year - 719468;
}

double julian_day(const Day& day, double hour) {
    return double(days_since_1970(day.date)) + 2440587.5 + (hour - day.utc_offset) / 24.0;
}

/// Terrestrial minus universal time in seconds: F. Espenak and J. Meeus, "Five Millennium Canon of Solar Eclipses",
/// NASA/TP-2006-214141, section 2.7.
double delta_t(const Date& date) {
    const double y = date.year + (date.month - 0.5) / 12.0;
    const double century = (y - 1820.0) / 100.0;
    const double parabola = -20.0 + 32.0 * century * century;
    if (y < -500) return parabola;
    if (y < 500) {
        return polynomial({10583.6, -1014.41, 33.78311, -5.952053, -0.1798452, 0.022174192, 0.0090316521}, y / 100);
    }
    if (y < 1600) {
        return polynomial({1574.2, -556.01, 71.23472, 0.319781, -0.8503463, -0.005050998, 0.0083572073},
                          (y - 1000) / 100);
    }
    if (y < 1700) return polynomial({120, -0.9808, -0.01532, 1 / 7129.0}, y - 1600);
    if (y < 1800) return polynomial({8.83, 0.1603, -0.0059285, 0.00013336, -1 / 1174000.0}, y - 1700);
    if (y < 1860) {
        return polynomial({13.72, -0.332447, 0.0068612, 0.0041116, -0.00037436, 0.0000121272, -0.0000001699,
                           0.000000000875}, y - 1800);
    }
    if (y < 1900) return polynomial({7.62, 0.5737, -0.251754, 0.01680668, -0.0004473624, 1 / 233174.0}, y - 1860);
    if (y < 1920) return polynomial({-2.79, 1.494119, -0.0598939, 0.0061966, -0.000197}, y - 1900);
    if (y < 1941) return polynomial({21.20, 0.84493, -0.076100, 0.0020936}, y - 1920);
    if (y < 1961) return polynomial({29.07, 0.407, -1 / 233.0, 1 / 2547.0}, y - 1950);
    if (y < 1986) return polynomial({45.45, 1.067, -1 / 260.0, -1 / 718.0}, y - 1975);
    if (y < 2005) return polynomial({63.86, 0.3345, -0.060374, 0.0017275, 0.000651814, 0.00002373599}, y - 2000);
    if (y < 2050) return polynomial({62.92, 0.32217, 0.005589}, y - 2000);
    if (y < 2150) return parabola - 0.5628 * (2150 - y);
    return parabola;
}

/// Sum of one power's series times 1e-8 (step 3.2).
double series(std::span<const solar::Term> terms, double t) {
    double sum = 0.0;
    for (const solar::Term& term : terms) sum += term.a * std::cos(term.b + term.c * t);
    return sum * 1e-8;
}

struct Nutation {
    double longitude, obliquity;  // degrees
};

/// Step 3.4; T in Julian ephemeris centuries.
Nutation nutation(double T) {
    const double x[5] = {polynomial({297.85036, 445267.111480, -0.0019142, 1 / 189474.0}, T),
                         polynomial({357.52772, 35999.050340, -0.0001603, -1 / 300000.0}, T),
                         polynomial({134.96298, 477198.867398, 0.0086972, 1 / 56250.0}, T),
                         polynomial({93.27191, 483202.017538, -0.0036825, 1 / 327270.0}, T),
                         polynomial({125.04452, -1934.136261, 0.0020708, 1 / 450000.0}, T)};
    Nutation sum{0, 0};
    for (const solar::NutationTerm& term : solar::kNutation) {
        double argument = 0.0;
        for (int i = 0; i < 5; ++i) argument += x[i] * term.y[i];
        argument *= kDegree;
        sum.longitude += (term.a + term.b * T) * std::sin(argument);
        sum.obliquity += (term.c + term.d * T) * std::cos(argument);
    }
    return {sum.longitude / 36e6, sum.obliquity / 36e6};
}

struct Geocentric {
    double right_ascension, declination;  // radians
    double sidereal_time;                 // degrees, apparent, at Greenwich
    double distance;                      // au
};

/// Steps 3.1 to 3.10: where the sun's centre is, seen from the Earth's.
Geocentric geocentric_sun(double jd, double delta_t_seconds) {
    using namespace solar;
    const double T = (jd + delta_t_seconds / 86400.0 - 2451545.0) / 36525.0;
    const double t = T / 10.0;
    const double longitude = polynomial(
        {series(kL0, t), series(kL1, t), series(kL2, t), series(kL3, t), series(kL4, t), series(kL5, t)}, t);
    const double latitude = polynomial({series(kB0, t), series(kB1, t)}, t);
    const double distance =
        polynomial({series(kR0, t), series(kR1, t), series(kR2, t), series(kR3, t), series(kR4, t)}, t);

    const Nutation shift = nutation(T);
    const double mean_obliquity = polynomial({84381.448, -4680.93, -1.55, 1999.25, -51.38, -249.67, -39.05, 7.12,
                                              27.87, 5.79, 2.45}, t / 10.0) / 3600.0;
    const double obliquity = (mean_obliquity + shift.obliquity) * kDegree;
    const double aberration = -20.4898 / (3600.0 * distance);
    const double lambda = (longitude / kDegree + 180.0 + shift.longitude + aberration) * kDegree;
    const double beta = -latitude;

    const double century = (jd - 2451545.0) / 36525.0;
    const double mean_sidereal =
        280.46061837 + 360.98564736629 * (jd - 2451545.0) + century * century * (0.000387933 - century / 38710000.0);
    return {std::atan2(std::sin(lambda) * std::cos(obliquity) - std::tan(beta) * std::sin(obliquity),
                       std::cos(lambda)),
            std::asin(std::clamp(std::sin(beta) * std::cos(obliquity) +
                                     std::cos(beta) * std::sin(obliquity) * std::sin(lambda), -1.0, 1.0)),
            wrap_degrees(mean_sidereal + shift.longitude * std::cos(obliquity)), distance};
}

/// Local hour angle of the geocentric sun, radians in [-pi, pi): negative before the meridian passage.
double hour_angle(const Geocentric& sun, double longitude) {
    return (wrap_degrees(sun.sidereal_time + longitude - sun.right_ascension / kDegree + 180.0) - 180.0) * kDegree;
}

// Of the sun's centre when its upper limb touches the refracted horizon: 0.26667 degrees of radius, 0.5667 of refraction.
constexpr double kRiseElevation = -0.8333;

/// Degrees by which air of 1010 mbar and 10 C lifts the sun (step 3.14.3; Meeus 1998, equation 16.4).
double refraction(double elevation) {
    const auto meeus = [](double e) { return 1.02 / (60.0 * std::tan((e + 10.3 / (e + 5.11)) * kDegree)); };
    if (elevation >= kRiseElevation) return meeus(elevation);
    // The report drops to zero here, which would make twilight jump by 0.6 degrees; this fades out instead and is
    // below 0.02 degrees from -4.7 degrees down.
    const double fade = std::tan(kRiseElevation * kDegree) / std::tan(elevation * kDegree);
    return meeus(kRiseElevation) * fade * fade;
}

/// Extremum of f in [a, b] (the larger values when sign is +1), by golden section.
double golden_section(const std::function<double(double)>& f, double a, double b, double sign) {
    const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
    for (int i = 0; i < 30; ++i) {
        const double x1 = b - ratio * (b - a), x2 = a + ratio * (b - a);
        if (sign * f(x1) > sign * f(x2)) {
            b = x2;
        } else {
            a = x1;
        }
    }
    return 0.5 * (a + b);
}

/// Root of f between a and b, where it has different signs.
double bisect(const std::function<double(double)>& f, double a, double b) {
    const bool a_positive = f(a) > 0;
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (a + b);
        ((f(middle) > 0) == a_positive ? a : b) = middle;
    }
    return 0.5 * (a + b);
}

/// Hours between which the elevation is monotone: the day's ends, and its culminations to the second, so that a sun
/// that only just clears the horizon is not missed.
std::vector<double> monotone_pieces(const std::function<double(double)>& elevation) {
    constexpr int kSteps = 96;
    std::vector<double> sampled(kSteps + 1);
    for (int i = 0; i <= kSteps; ++i) sampled[std::size_t(i)] = elevation(i * 24.0 / kSteps);
    std::vector<double> hours = {0.0};
    for (int i = 1; i < kSteps; ++i) {
        const double before = sampled[std::size_t(i - 1)], here = sampled[std::size_t(i)];
        const double after = sampled[std::size_t(i + 1)];
        const double sign = here > before && here >= after ? 1.0 : here < before && here <= after ? -1.0 : 0.0;
        if (sign == 0.0) continue;
        hours.push_back(golden_section(elevation, (i - 1) * 24.0 / kSteps, (i + 1) * 24.0 / kSteps, sign));
    }
    hours.push_back(24.0);
    return hours;
}

/// The meridian passage of this date by Newton's iteration on the hour angle; the sun gains about 15 degrees an hour.
std::optional<double> meridian_passage(const Day& day) {
    const auto nearest_passage = [&](double hour) {
        for (int i = 0; i < 4; ++i) {
            const Geocentric sun = geocentric_sun(julian_day(day, hour), delta_t(day.date));
            hour -= hour_angle(sun, day.longitude) / kDegree / 15.0;
        }
        return hour;
    };
    const auto within = [](double hour) { return hour >= 0.0 && hour < 24.0; };
    double hour = nearest_passage(12.0);
    if (!within(hour)) hour = nearest_passage(hour < 0.0 ? hour + 24.0 : hour - 24.0);
    if (!within(hour)) return std::nullopt;
    return hour;
}

}  // namespace

Vec3 compass_direction(const Day& day, double azimuth, double elevation) {
    const double bearing = azimuth + day.north * kDegree;  // clockwise from -Z
    return Vec3(std::sin(bearing) * std::cos(elevation), std::sin(elevation), -std::cos(bearing) * std::cos(elevation));
}

SunPosition sun_position(const Day& day, double hour) {
    const Geocentric sun = geocentric_sun(julian_day(day, hour), delta_t(day.date));
    const double H = hour_angle(sun, day.longitude);
    const double latitude = day.latitude * kDegree;

    // Steps 3.12 and 3.13: parallax of an observer at sea level on the ellipsoid.
    const double parallax = 8.794 / (3600.0 * sun.distance) * kDegree;
    const double reduced = std::atan(0.99664719 * std::tan(latitude));
    const double x = std::cos(reduced), y = 0.99664719 * std::sin(reduced);
    const double away = std::cos(sun.declination) - x * std::sin(parallax) * std::cos(H);
    const double shift = std::atan2(-x * std::sin(parallax) * std::sin(H), away);
    const double declination = std::atan2((std::sin(sun.declination) - y * std::sin(parallax)) * std::cos(shift), away);
    const double topocentric_H = H - shift;

    SunPosition position;
    position.distance = sun.distance;
    position.elevation = std::asin(
        std::clamp(std::sin(latitude) * std::sin(declination) +
                       std::cos(latitude) * std::cos(declination) * std::cos(topocentric_H), -1.0, 1.0));
    const double from_south = std::atan2(std::sin(topocentric_H) * std::cos(declination),
                                         std::cos(topocentric_H) * std::sin(latitude) * std::cos(declination) -
                                             std::sin(declination) * std::cos(latitude));
    position.azimuth = wrap_degrees(from_south / kDegree + 180.0) * kDegree;
    position.apparent_elevation = position.elevation + refraction(position.elevation / kDegree) * kDegree;
    position.direction = compass_direction(day, position.azimuth, position.apparent_elevation);
    return position;
}

SunTimes sun_times(const Day& day) {
    const std::function<double(double)> above = [&](double hour) {
        return sun_position(day, hour).elevation - kRiseElevation * kDegree;
    };
    std::vector<double> rises, sets;
    const std::vector<double> pieces = monotone_pieces(above);
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
        const bool up_before = above(pieces[i]) > 0, up_after = above(pieces[i + 1]) > 0;
        if (up_before != up_after) (up_after ? rises : sets).push_back(bisect(above, pieces[i], pieces[i + 1]));
    }

    SunTimes times;
    times.transit = meridian_passage(day);
    if (rises.empty() && sets.empty()) times.kind = above(12.0) > 0 ? DayKind::PolarDay : DayKind::PolarNight;
    // Far north the sun may set twice on one date, just after and just before midnight: the events round the transit
    // are the ones that bound its day.
    const double noon = times.transit.value_or(12.0);
    for (const double rise : rises) {
        if (!times.sunrise || rise < noon) times.sunrise = rise;
    }
    for (auto set = sets.rbegin(); set != sets.rend(); ++set) {
        if (!times.sunset || *set > noon) times.sunset = *set;
    }
    return times;
}

}  // namespace daylit
