// The sun's place in the sky against NREL's published numbers, and the events of a day.
#include "engine/scene/day.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace daylit {
namespace {

double degrees_between(double a, double b) {
    return std::abs(std::remainder(a - b, 360.0));
}

double clock_hours(int h, int m, double s) {
    return h + m / 60.0 + s / 3600.0;
}

/// Rows of a shared table, without its comments and head; empty when the file is absent.
std::vector<std::vector<std::string>> shared_rows(const std::string& name) {
    std::ifstream file(std::string(DAYLIT_SHARED_DIR) + "/reference/solar/" + name);
    std::vector<std::vector<std::string>> rows;
    for (std::string line; std::getline(file, line);) {
        if (!line.empty() && line.back() == '\r') line.pop_back();
        if (line.empty() || line[0] == '#' || !std::isdigit(line[0])) continue;
        std::vector<std::string> cells;
        std::stringstream stream(line);
        for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
        if (line.back() == ',') cells.push_back("");
        rows.push_back(cells);
    }
    return rows;
}

Date date_of(const std::string& text) {
    Date date;
    std::sscanf(text.c_str(), "%d-%d-%d", &date.year, &date.month, &date.day);
    return date;
}

double hour_of(const std::string& text) {
    int h = 0, m = 0;
    double s = 0;
    std::sscanf(text.c_str(), "%d:%d:%lf", &h, &m, &s);
    return clock_hours(h, m, s);
}

// Reda and Andreas, NREL/TP-560-34302, appendix A.5: 2003-10-17 12:30:30 at UTC-7, 39.742476 N 105.1786 W.
const Day kExample{39.742476, -105.1786, {2003, 10, 17}, -7.0, 0.0};

TEST(Day, WorkedExampleOfTheReport) {
    const SunPosition sun = sun_position(kExample, clock_hours(12, 30, 30));
    EXPECT_NEAR(sun.azimuth / kDegree, 194.340241, 1e-3);
    EXPECT_NEAR(sun.elevation / kDegree, 39.872046, 1e-3);
    EXPECT_NEAR(sun.distance, 0.9965422974, 1e-7);
    // The report's air is 820 mbar at 11 C (0.016332 degrees); refraction is proportional to pressure.
    const double expected = 0.016332 * (1010.0 / 820.0) * (284.0 / 283.0);
    EXPECT_NEAR((sun.apparent_elevation - sun.elevation) / kDegree, expected, 2e-4);
}

TEST(Day, WorkedExampleRisesAndSets) {
    const SunTimes times = sun_times(kExample);
    ASSERT_TRUE(times.sunrise && times.sunset && times.transit);
    EXPECT_EQ(times.kind, DayKind::Normal);
    EXPECT_NEAR(*times.sunrise, clock_hours(6, 12, 43), 5.0 / 3600);
    EXPECT_NEAR(*times.transit, clock_hours(11, 46, 4), 2.0 / 3600);
    EXPECT_NEAR(*times.sunset, clock_hours(17, 18, 51), 5.0 / 3600);
}

TEST(Day, PositionsOfNrelsProgram) {
    const auto rows = shared_rows("spa-reference-rows.csv");
    if (rows.empty()) GTEST_SKIP() << DAYLIT_SHARED_DIR "/reference/solar is missing";
    double worst = 0.0;
    for (const auto& row : rows) {
        const Day day{std::stod(row[1]), std::stod(row[2]), date_of(row[0]), 0.0, 0.0};
        const SunPosition sun = sun_position(day, hour_of(row[0].substr(11)));
        worst = std::max(worst, degrees_between(sun.azimuth / kDegree, std::stod(row[3])) *
                                    std::sin(std::stod(row[4]) * kDegree));
        worst = std::max(worst, std::abs(90.0 - sun.apparent_elevation / kDegree - std::stod(row[4])));
    }
    RecordProperty("worst_degrees", std::to_string(worst));
    EXPECT_LT(worst, 0.02);
}

TEST(Day, KoldinghusThroughFourDays) {
    const auto rows = shared_rows("koldinghus-sun.csv");
    if (rows.empty()) GTEST_SKIP() << DAYLIT_SHARED_DIR "/reference/solar is missing";
    for (const auto& row : rows) {
        const Day day{55.49, 9.47, date_of(row[0]), 0.0, 0.0};
        const SunPosition sun = sun_position(day, hour_of(row[0].substr(11)));
        EXPECT_LT(degrees_between(sun.azimuth / kDegree, std::stod(row[1])), 0.02) << row[0];
        EXPECT_NEAR(sun.elevation / kDegree, std::stod(row[2]), 0.02) << row[0];
        const Vec3 unrefracted = compass_direction(day, sun.azimuth, sun.elevation);
        const Vec3 expected(std::stof(row[3]), std::stof(row[4]), std::stof(row[5]));
        EXPECT_LT(glm::length(unrefracted - expected), 0.02 * kDegree) << row[0];
    }
}

TEST(Day, SunriseAndSunsetOfPublishedCases) {
    const auto rows = shared_rows("spa-sunrise-transit-sunset.csv");
    if (rows.empty()) GTEST_SKIP() << DAYLIT_SHARED_DIR "/reference/solar is missing";
    for (const auto& row : rows) {
        const Day day{std::stod(row[1]), std::stod(row[2]), date_of(row[0]), std::stod(row[4]), 0.0};
        const SunTimes times = sun_times(day);
        const DayKind kind = row[5] == "normal"      ? DayKind::Normal
                             : row[5] == "polar-day" ? DayKind::PolarDay
                                                     : DayKind::PolarNight;
        EXPECT_EQ(times.kind, kind) << row[0];
        const auto expect = [&](const std::optional<double>& time, const std::string& cell) {
            if (cell.empty()) return;
            ASSERT_TRUE(time) << row[0];
            EXPECT_NEAR(*time, hour_of(cell), 10.0 / 3600) << row[0];
        };
        expect(times.sunrise, row[6]);
        expect(times.transit, row[7]);
        expect(times.sunset, row[8]);
        EXPECT_EQ(times.sunrise.has_value(), kind == DayKind::Normal);
    }
}

TEST(Day, CompassOnTheDefaultAndTurnedNorth) {
    Day day;
    EXPECT_LT(glm::length(compass_direction(day, 0, 0) - Vec3(0, 0, -1)), 1e-6f);
    EXPECT_LT(glm::length(compass_direction(day, kPi / 2, 0) - Vec3(1, 0, 0)), 1e-6f);
    EXPECT_LT(glm::length(compass_direction(day, 1.0, kPi / 2) - Vec3(0, 1, 0)), 1e-6f);
    day.north = 90;
    EXPECT_LT(glm::length(compass_direction(day, 0, 0) - Vec3(1, 0, 0)), 1e-6f);
}

TEST(Day, ClockAndUtcOffsetMoveTogether) {
    Day summer, utc = summer;
    utc.utc_offset = 0.0;
    EXPECT_EQ(sun_position(summer, 14.0).elevation, sun_position(utc, 12.0).elevation);
    Day tomorrow = summer;
    tomorrow.date = {2026, 6, 22};
    EXPECT_NEAR(sun_position(summer, 25.0).azimuth, sun_position(tomorrow, 1.0).azimuth, 1e-9);
}

TEST(Day, LeapDaysAndYearEndsAreOneDayApart) {
    const auto azimuth = [](Date date, double hour) { return sun_position({50, 10, date, 0, 0}, hour).azimuth; };
    EXPECT_NEAR(azimuth({2024, 2, 29}, 33.0), azimuth({2024, 3, 1}, 9.0), 1e-6);  // delta T changes with the month
    EXPECT_NEAR(azimuth({2023, 2, 28}, 33.0), azimuth({2023, 3, 1}, 9.0), 1e-6);
    EXPECT_NEAR(azimuth({2025, 12, 31}, 33.0), azimuth({2026, 1, 1}, 9.0), 1e-6);
}

TEST(Day, ApparentElevationIsContinuousAndIncreasing) {
    // An evening at the equator's equinox, down to 30 degrees below the horizon.
    const Day day{0, 0, {2026, 3, 20}, 0, 0};
    double before = sun_position(day, 17.5).apparent_elevation;
    for (double hour = 17.5; hour < 20.2; hour += 0.001) {
        const double now = sun_position(day, hour).apparent_elevation;
        EXPECT_LE(now, before) << hour;
        EXPECT_LT(before - now, 0.05 * kDegree) << hour;
        before = now;
    }
}

TEST(Day, ShortestNightOfKoldinghus) {
    const SunTimes times = sun_times(Day{});
    ASSERT_TRUE(times.sunrise && times.sunset);
    // Day length at the solstice by the sunrise equation with the sun's centre at -0.8333 degrees.
    const double latitude = 55.4917 * kDegree, declination = 23.44 * kDegree;
    const double cos_half = (std::sin(-0.8333 * kDegree) - std::sin(latitude) * std::sin(declination)) /
                            (std::cos(latitude) * std::cos(declination));
    EXPECT_NEAR(*times.sunset - *times.sunrise, 2.0 * std::acos(cos_half) / kDegree / 15.0, 0.02);
    EXPECT_NEAR(0.5 * (*times.sunset + *times.sunrise), *times.transit, 0.01);
}

TEST(Day, PolesAndDateLineGiveFiniteNumbers) {
    for (const double latitude : {-90.0, 90.0}) {
        for (const double longitude : {-180.0, 0.0, 180.0}) {
            const Day day{latitude, longitude, {2026, 6, 21}, 0.0, 0.0};
            const SunPosition sun = sun_position(day, 12.0);
            EXPECT_NEAR(std::abs(sun.elevation) / kDegree, 23.44, 0.02);
            EXPECT_TRUE(std::isfinite(sun.azimuth));
            EXPECT_EQ(sun_times(day).kind, latitude > 0 ? DayKind::PolarDay : DayKind::PolarNight);
        }
    }
}

}  // namespace
}  // namespace daylit
