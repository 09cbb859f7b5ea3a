#pragma once
// Place, date and the sun's path. Solar position after Reda and Andreas 2004 (NREL SPA).
#include <optional>

#include "engine/base/units.h"

namespace daylit {

struct Date {
    int year = 2026, month = 6, day = 21;
    bool operator==(const Date&) const = default;
};

/// Defaults: Koldinghus castle at midsummer.
struct Day {
    double latitude = 55.4917;  // degrees north
    double longitude = 9.4733;  // degrees east
    Date date;
    double utc_offset = 2.0;  // hours, local clock minus UTC
    double north = 0.0;       // degrees: north is -Z turned this far clockwise seen from above (90: north is +X)
    bool operator==(const Day&) const = default;
};

struct SunPosition {
    double azimuth = 0;    // radians, clockwise from north
    double elevation = 0;  // radians, topocentric, without refraction
    double apparent_elevation = 0;  // radians, with refraction at 1010 mbar and 10 degrees C; what the light uses.
                                    // Continuous and increasing in elevation, below the horizon too
    double distance = 1;   // astronomical units
    Vec3 direction = Vec3(0, 1, 0);  // towards the apparent sun, world axes, unit
};

/// The sun at a local clock hour; any real hour is accepted (25 is 1 o'clock of the next day).
SunPosition sun_position(const Day& day, double hour);

enum class DayKind { Normal, PolarDay, PolarNight };

/// Sunrise and sunset are when the upper limb is at the refracted horizon (centre at -0.8333 degrees), local clock
/// hours of this date; an event that does not happen on this date is empty. transit is the meridian passage.
/// Where the sun rises or sets twice on one date, the events nearest to the transit are given.
struct SunTimes {
    DayKind kind = DayKind::Normal;
    std::optional<double> sunrise, sunset;
    std::optional<double> transit;
};
SunTimes sun_times(const Day& day);

/// World direction for a compass azimuth (radians clockwise from north) and elevation on this day's north.
Vec3 compass_direction(const Day& day, double azimuth, double elevation);

}  // namespace daylit
