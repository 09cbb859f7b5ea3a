#include "demo/parse.h"

#include <gtest/gtest.h>

#include "engine/base/error.h"

namespace daylit {
namespace {

TEST(ParseHour, TakesDecimalsAndClockTimes) {
    EXPECT_DOUBLE_EQ(parse_hour("--hour", "7.5"), 7.5);
    EXPECT_DOUBLE_EQ(parse_hour("--hour", "07:30"), 7.5);
    EXPECT_DOUBLE_EQ(parse_hour("--hour", "0"), 0.0);
    EXPECT_DOUBLE_EQ(parse_hour("--hour", "23:59"), 23.0 + 59.0 / 60.0);
}

TEST(ParseHour, RefusesWhatIsNoHourOfTheDay) {
    for (const char* out_of_range : {"24", "-0.1", "24:00", "12:60", "1e300", "-0:30"}) {
        try {
            parse_hour("--hour", out_of_range);
            ADD_FAILURE() << out_of_range << " was taken";
        } catch (const UsageError&) {
            ADD_FAILURE() << out_of_range << " is wrong usage rather than out of range";
        } catch (const Error&) {
        }
    }
    for (const char* no_hour : {"noon", "", "7:30:00", "7h", "nan", " 7"}) {
        EXPECT_THROW(parse_hour("--hour", no_hour), Error) << no_hour;
    }
}

TEST(ParseDuration, UnitsAreHoursMinutesSeconds) {
    EXPECT_DOUBLE_EQ(parse_duration_hours("--every", "5m"), 5.0 / 60.0);
    EXPECT_DOUBLE_EQ(parse_duration_hours("--every", "1h"), 1.0);
    EXPECT_DOUBLE_EQ(parse_duration_hours("--every", "90s"), 0.025);
    EXPECT_DOUBLE_EQ(parse_duration_hours("--every", "0.5"), 0.5);
    EXPECT_THROW(parse_duration_hours("--every", "0m"), Error);
    EXPECT_THROW(parse_duration_hours("--every", "m"), UsageError);
}

TEST(ParseSize, WithinWhatCanBeAllocated) {
    EXPECT_EQ(parse_size("1280x720").width, 1280);
    EXPECT_EQ(parse_size("1280x720").height, 720);
    for (const char* wrong : {"0x0", "100000x100000", "16384x16384", "-1x5", "5", "x", "5x5x5", "5.5x5"}) {
        EXPECT_THROW(parse_size(wrong), Error) << wrong;
    }
}

TEST(ParseDate, KnowsTheCalendar) {
    EXPECT_EQ(parse_date("2024-02-29"), (Date{2024, 2, 29}));
    for (const char* wrong : {"2026-02-29", "2100-02-29", "2026-13-01", "2026-00-10", "2026-6", "midsummer"}) {
        EXPECT_THROW(parse_date(wrong), Error) << wrong;
    }
}

TEST(ParseVectors, NumbersOnly) {
    EXPECT_EQ(parse_vec3("--eye", "1,-2.5,3e2"), Vec3(1.0f, -2.5f, 300.0f));
    EXPECT_EQ(parse_rgb("--sun-lux", "5"), Rgb(5.0f));
    EXPECT_THROW(parse_vec3("--eye", "1,2"), UsageError);
    EXPECT_THROW(parse_vec3("--eye", "1,2,inf"), Error);
    EXPECT_THROW(parse_rgb("--sun-lux", "1,-1,1"), Error);
    EXPECT_THROW(parse_rgb("--sun-lux", "1,1e13,1"), Error);
}

TEST(ParsePlace, WhereASceneCanReach) {
    EXPECT_EQ(parse_place("--eye", "1e8,0,-1e8"), Vec3(1e8f, 0, -1e8f));
    for (const char* far : {"1.1e8,0,0", "0,-1e30,0", "0,0,nan"}) EXPECT_THROW(parse_place("--eye", far), Error) << far;
}

}  // namespace
}  // namespace daylit
