// Sun and sky: closed forms, published magnitudes, and what may not happen (energy from nothing, order of threads).
#include "engine/scene/sky.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

#include "engine/scene/atmosphere.h"
#include "engine/scene/environment.h"

namespace daylit {
namespace {

const Atmosphere& clear_air() {
    static const Atmosphere air(2.5);
    return air;
}

/// Horizontal illuminance of a clear sky by midpoint quadrature.
double illuminance(const ClearSky& sky) {
    constexpr int kElevations = 45, kAzimuths = 60;
    double sum = 0.0;
    for (int i = 0; i < kElevations; ++i) {
        const double elevation = (i + 0.5) / kElevations * kPi / 2;
        for (int j = 0; j < kAzimuths; ++j) {
            sum += luminance(sky.radiance(elevation, (j + 0.5) / kAzimuths * 2 * kPi)) * std::sin(elevation) *
                   std::cos(elevation);
        }
    }
    return sum * (kPi / 2 / kElevations) * (2 * kPi / kAzimuths);
}

/// A place where the sun culminates in the zenith at 12:00: sun elevations are then easy to name by the hour.
LightSettings equator() {
    LightSettings settings;
    settings.day = {0.0, 0.0, {2026, 3, 20}, 0.0, 0.0};
    return settings;
}

/// The evening hour at which the sun stands at this apparent elevation (degrees).
double hour_at(const Day& day, double elevation) {
    double early = 13.0, late = 23.0;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (early + late);
        (sun_position(day, middle).apparent_elevation > elevation * kDegree ? early : late) = middle;
    }
    return early;
}

TEST(Atmosphere, SunAboveTheAirGives133Kilolux) {
    // ASTM E490 and G173 give 133.1 klx at 1 au.
    EXPECT_NEAR(luminance(Atmosphere::solar_illuminance()), 133.1e3, 1.3e3);
}

TEST(Atmosphere, ZenithSunObeysBeerAndLambert) {
    // Turbidity 1 has no haze: at 555 nm, Hansen and Travis' 0.0938 and 300 Dobson units of ozone at 3.4e-25 m^2.
    const double thickness = 0.0938 + 300 * 2.687e20 * 3.4e-25;
    const Atmosphere pure(1.0);
    EXPECT_NEAR(luminance(pure.sun_illuminance(kPi / 2)) / luminance(Atmosphere::solar_illuminance()),
                std::exp(-thickness), 0.01);
    // Haze of turbidity 3 adds Angstrom's 0.04608 * 3 - 0.04586 at 1 um, exponent -1.3.
    const Atmosphere haze(3.0);
    const double added = (0.04608 * 3 - 0.04586) * std::pow(0.555, -1.3);
    EXPECT_NEAR(luminance(haze.sun_illuminance(kPi / 2)) / luminance(pure.sun_illuminance(kPi / 2)), std::exp(-added),
                0.01);
}

TEST(Atmosphere, SettingSunReddensAndDims) {
    double redness = 0.0, brightness = 1e9;
    for (double elevation = 90; elevation >= 1; elevation -= 1) {
        const Rgb sun = clear_air().sun_illuminance(elevation * kDegree);
        EXPECT_LT(luminance(sun), brightness) << elevation;
        EXPECT_GT(sun.r / sun.g, redness) << elevation;
        brightness = luminance(sun);
        redness = sun.r / sun.g;
    }
    EXPECT_GT(redness, 5.0);
    EXPECT_EQ(clear_air().sun_illuminance(-0.27 * kDegree), Rgb(0.0f));
}

TEST(Atmosphere, LightIsNotMadeFromNothing) {
    for (const double turbidity : {1.0, 4.0, 10.0}) {
        const Atmosphere air(turbidity);
        for (const double elevation : {90.0, 30.0, 10.0}) {
            const double sine = std::sin(elevation * kDegree);
            const double arriving = luminance(Atmosphere::solar_illuminance()) * sine;
            const double ground = luminance(air.sun_illuminance(elevation * kDegree)) * sine +
                                  illuminance(air.clear_sky(elevation * kDegree));
            // Of what arrives the ground (albedo 0.2) keeps four fifths; the rest may come back down from the air once
            // more.
            EXPECT_LT(ground * 0.8, arriving) << turbidity << " " << elevation;
            EXPECT_GT(ground, 0.2 * arriving) << turbidity << " " << elevation;
        }
    }
}

TEST(Atmosphere, SkyMirrorsAcrossTheSun) {
    const ClearSky sky = clear_air().clear_sky(0.4);
    for (const double azimuth : {0.1, 0.7, 2.0, 3.1}) {
        EXPECT_EQ(sky.radiance(0.5, azimuth), sky.radiance(0.5, -azimuth));
        EXPECT_EQ(sky.radiance(0.5, azimuth), sky.radiance(0.5, 2 * kPi - azimuth));
    }
}

TEST(Atmosphere, NoonSkyIsBlueAndDuskIsRedAtTheSunsFoot) {
    const Rgb zenith = clear_air().clear_sky(58 * kDegree).radiance(45 * kDegree, kPi);
    EXPECT_GT(zenith.b, 1.4f * zenith.r);
    EXPECT_NEAR(luminance(zenith), 3500, 1500);  // cd/m^2, a clear sky away from the sun
    const Rgb dusk = clear_air().clear_sky(0.5 * kDegree).radiance(1 * kDegree, 0.0);
    EXPECT_GT(dusk.r, 3.0f * dusk.b);
}

TEST(Atmosphere, PreethamsSkyAgreesInMagnitude) {
    std::ifstream file(DAYLIT_SHARED_DIR "/reference/sky/preetham-1999-samples.csv");
    if (!file) GTEST_SKIP() << DAYLIT_SHARED_DIR "/reference/sky is missing";
    double log_sum = 0.0;
    int count = 0;
    for (const double turbidity : {2.0, 3.0, 6.0}) {
        const Atmosphere air(turbidity);
        std::map<double, ClearSky> skies;
        file.clear();
        file.seekg(0);
        for (std::string line; std::getline(file, line);) {
            std::replace(line.begin(), line.end(), ',', ' ');
            std::istringstream row(line);
            double t, sun_zenith, zenith, azimuth, kilo;
            if (!(row >> t >> sun_zenith >> zenith >> azimuth >> kilo) || t != turbidity) continue;
            auto [sky, added] = skies.try_emplace(sun_zenith);
            if (added) sky->second = air.clear_sky((90 - sun_zenith) * kDegree);
            const double ours = luminance(sky->second.radiance((90 - zenith) * kDegree, azimuth * kDegree));
            const double ratio = ours / (1000 * kilo);
            EXPECT_GT(ratio, 0.2) << line;
            EXPECT_LT(ratio, 3.0) << line;
            log_sum += std::log(ratio);
            ++count;
        }
    }
    ASSERT_GE(count, 50);
    EXPECT_NEAR(std::exp(log_sum / count), 1.0, 0.4);
}

TEST(Sun, DiscFractionIsTheAreaAboveAChord) {
    EXPECT_DOUBLE_EQ(disc_fraction(0.0), 0.5);
    EXPECT_DOUBLE_EQ(disc_fraction(kSunRadius), 1.0);
    EXPECT_DOUBLE_EQ(disc_fraction(-2 * kSunRadius), 0.0);
    constexpr int kSlices = 100000;  // of the disc, from its upper limb down to half a radius below the centre
    double area = 0.0;
    for (int i = 0; i < kSlices; ++i) {
        const double y = -0.5 + 1.5 * (i + 0.5) / kSlices;
        area += 2.0 * std::sqrt(1.0 - y * y) * 1.5 / kSlices;
    }
    EXPECT_NEAR(disc_fraction(0.5 * kSunRadius), area / kPi, 1e-5);
}

TEST(Sun, DiscRadianceGivesItsIrradianceBack) {
    const Sun sun{Vec3(0, 1, 0), Rgb(9e4f, 8e4f, 7e4f)};
    const double projected = kPi * std::sin(kSunRadius) * std::sin(kSunRadius);  // of a cone of half angle kSunRadius
    EXPECT_NEAR(disc_radiance(sun).r * projected, 9e4, 1.0);
    EXPECT_NEAR(disc_radiance(sun).b * projected, 7e4, 1.0);
}

TEST(Environment, ConstantSkyGivesPiL) {
    const Rgb L(100, 200, 300);
    const Environment one{Image(1, 1, L)}, full{Image(256, 128, L)};
    EXPECT_TRUE(one.constant());
    EXPECT_FALSE(full.constant());
    for (const Environment* sky : {&one, &full}) {
        EXPECT_EQ(sky->radiance(glm::normalize(Vec3(1, -2, 3))), L);
        EXPECT_NEAR(horizontal_irradiance(*sky).g, 200 * kPi, 200 * kPi * 1e-6);
    }
}

TEST(Environment, DirectionsAndColumns) {
    EXPECT_NEAR(latlong_from_direction(Vec3(0, 0, -1)).x, 0.5f, 1e-6f);
    EXPECT_NEAR(latlong_from_direction(Vec3(1, 0, 0)).x, 0.75f, 1e-6f);
    EXPECT_NEAR(latlong_from_direction(Vec3(0, 1, 0)).y, 0.0f, 1e-6f);
    for (const Vec3 d : {Vec3(0.3f, 0.2f, -0.8f), Vec3(-0.5f, -0.7f, 0.1f), Vec3(0.9f, 0.0f, 0.2f)}) {
        const Vec3 unit = glm::normalize(d);
        EXPECT_LT(glm::length(direction_from_latlong(latlong_from_direction(unit)) - unit), 1e-5f);
    }
}

TEST(Environment, TexelCentresAndTheSeam) {
    Environment sky{Image(8, 4)};
    for (int i = 0; i < 32; ++i) sky.map.pixels[std::size_t(i)] = Rgb(float(i));
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 8; ++x) {
            const Vec3 centre = direction_from_latlong(Vec2((float(x) + 0.5f) / 8, (float(y) + 0.5f) / 4));
            EXPECT_NEAR(sky.radiance(centre).r, float(y * 8 + x), 1e-4f);
        }
    }
    // Half way between the last and the first column.
    EXPECT_NEAR(sky.radiance(direction_from_latlong(Vec2(0.0f, 0.375f))).r, 0.5f * (8 + 15), 1e-3f);
}

TEST(Environment, BadNumbersBecomeUsableOnes) {
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    Image image(4, 2, Rgb(1.0f));
    image.pixels[0] = Rgb(nan, 2.0f, -3.0f);
    image.pixels[1] = Rgb(inf, -inf, 1e30f);
    image.pixels[2] = Rgb(7e6f, 0.0f, 1.0f);
    const Environment sky = usable_environment(image, "test");
    EXPECT_EQ(sky.map.pixels[0], Rgb(0.0f, 2.0f, 0.0f));
    EXPECT_EQ(sky.map.pixels[1],
              Rgb(kBrightestEnvironment, 0.0f, kBrightestEnvironment));  // 1e30 is the largest finite
    EXPECT_EQ(sky.map.pixels[2], Rgb(7e6f, 0.0f, 1.0f));
    image.pixels[1] = Rgb(inf, 1.0f, 1.0f);
    EXPECT_EQ(usable_environment(image, "test").map.pixels[1].r, 7e6f);
    image.pixels[2] = Rgb(1.0f);
    EXPECT_EQ(usable_environment(image, "test").map.pixels[1].r, 65504.0f);
}

TEST(Environment, ShapeMustBeTwoToOne) {
    EXPECT_TRUE(usable_environment(Image(1, 1, Rgb(5)), "dot").constant());
    EXPECT_NO_THROW(usable_environment(Image(2, 1), "two by one"));
    EXPECT_NO_THROW(usable_environment(Image(1023, 512), "nearly"));
    EXPECT_ANY_THROW(usable_environment(Image(64, 64), "square"));
    EXPECT_ANY_THROW(usable_environment(Image(6, 1), "cube strip"));
    EXPECT_ANY_THROW(usable_environment(Image(), "nothing"));
}

/// Irradiance facing up and down, as the shared stats.json gives them (negative samples as 0).
struct SharedMap {
    const char* file;
    Rgb up, down;
};

TEST(Environment, SharedMapsHaveTheirIrradiance) {
    if (!std::ifstream(DAYLIT_SHARED_DIR "/environments/stats.json")) {
        GTEST_SKIP() << DAYLIT_SHARED_DIR "/environments is missing";
    }
    const SharedMap maps[] = {
        {"blender_courtyard.exr", {1.88264f, 2.09914f, 3.12266f}, {0.985818f, 0.585478f, 0.353549f}},
        {"dresden_square_1k.hdr", {8.04978f, 8.55037f, 11.1803f}, {0.904304f, 0.739338f, 0.718638f}},
        {"pmndrs_sky.exr", {5.44172f, 5.67579f, 6.00963f}, {0.492674f, 0.576864f, 0.845395f}},
        {"spiaggia_di_mondello_1k.hdr", {2.78478f, 3.30258f, 3.80521f}, {1.81125f, 1.43435f, 1.1738f}}};
    for (const SharedMap& map : maps) {
        LightSettings settings;
        settings.sun = SunSource::None;
        settings.sky = SkySource::File;
        settings.sky_file = std::string(DAYLIT_SHARED_DIR "/environments/") + map.file;
        const LightModel model(settings, {});
        EXPECT_TRUE(model.constant());
        Environment sky = model.at(12.0).sky;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(horizontal_irradiance(sky)[c] / map.up[c], 1.0f, 0.01f) << map.file;
        std::reverse(sky.map.pixels.begin(), sky.map.pixels.end());
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(horizontal_irradiance(sky)[c] / map.down[c], 1.0f, 0.01f) << map.file;
    }
}

TEST(LightModel, MidsummerNoonAtKoldinghus) {
    const LightModel model(LightSettings{}, {});
    const Lighting noon = model.at(13.4);
    ASSERT_EQ(noon.suns.size(), 1u);
    EXPECT_NEAR(luminance(noon.suns[0].irradiance), 97e3, 8e3);
    EXPECT_NEAR(luminance(horizontal_irradiance(noon.sky)), 18e3, 5e3);
    EXPECT_FALSE(model.constant());
    EXPECT_FALSE(noon.sky.black());
    EXPECT_LT(glm::length(noon.suns[0].direction - sun_position(Day{}, 13.4).direction), 1e-6f);
}

TEST(LightModel, TwilightFallsAsMeasured) {
    // Seidelmann (ed.), Explanatory Supplement to the Astronomical Almanac 1992, figure 9.1: horizontal illuminance of
    // a clear sky about 700 lx at sunset, 90 lx at -3 degrees, 3.5 lx at -6, 0.008 lx at -12; the night adds to the
    // last.
    const LightModel model(equator(), {});
    const auto sky_at = [&](double elevation) {
        return luminance(horizontal_irradiance(model.at(hour_at(equator().day, elevation)).sky));
    };
    EXPECT_NEAR(std::log10(sky_at(0.0)), std::log10(700.0), 0.3);
    EXPECT_NEAR(std::log10(sky_at(-3.0)), std::log10(90.0), 0.3);
    EXPECT_NEAR(std::log10(sky_at(-6.0)), std::log10(3.5), 0.3);
    EXPECT_NEAR(std::log10(sky_at(-12.0)), std::log10(0.008), 0.3);
    double before = 1e9;
    for (double elevation = 60; elevation > -25; elevation -= 2.5) {
        const double now = sky_at(elevation);
        EXPECT_LE(now, before * 1.0001) << elevation;
        before = now;
    }
    EXPECT_NEAR(before, 2.5e-4 * kPi, 1e-6);  // the night's own light
    EXPECT_TRUE(model.suns(0.0).empty());
}

TEST(LightModel, CloudsFollowKastenAndCzeplak) {
    LightSettings settings = equator();
    const double hour = 14.0;
    const auto global = [&](double cover) {
        settings.clouds = cover;
        const Lighting light = LightModel(settings, {}).at(hour);
        double sum = luminance(horizontal_irradiance(light.sky));
        for (const Sun& sun : light.suns) sum += luminance(sun.irradiance) * sun.direction.y;
        return sum;
    };
    const double clear = global(0.0);
    for (const double cover : {0.5, 1.0}) {
        EXPECT_NEAR(global(cover) / clear, 1.0 - 0.75 * std::pow(cover, 3.4), 0.003) << cover;
    }
    settings.clouds = 1.0;
    const Lighting overcast = LightModel(settings, {}).at(hour);
    EXPECT_TRUE(overcast.suns.empty());
    // Three times as bright overhead as at the horizon.
    const float overhead = luminance(overcast.sky.radiance(Vec3(0, 1, 0)));
    const float low = luminance(overcast.sky.radiance(glm::normalize(Vec3(1, 0.0123f, 0))));
    EXPECT_NEAR(overhead / low, 3.0 / (1.0 + 2.0 * std::sin(0.0123)), 0.03);
}

TEST(LightModel, GroundBelowTheHorizonReflectsAFifth) {
    const LightModel model(equator(), {});
    const Lighting light = model.at(13.0);
    const double arriving =
        luminance(horizontal_irradiance(light.sky)) + luminance(light.suns[0].irradiance) * light.suns[0].direction.y;
    EXPECT_NEAR(luminance(light.sky.radiance(Vec3(0, -1, 0))) * kPi / arriving, 0.2, 0.004);
}

// What a bake of the parts gives is what at() shows, whatever the weather.
TEST(LightModel, IsTheSumOfItsParts) {
    const LightModel other_weather(LightSettings{}, {});
    for (const double clouds : {0.0, 0.4, 1.0}) {
        LightSettings settings;
        settings.clouds = clouds;
        const LightModel model(settings, {});
        for (const double hour : {3.7, 13.4, 21.0}) {
            const Lighting whole = model.at(hour);
            const LightScales scales = other_weather.scales(hour, clouds);
            EXPECT_EQ(whole.scales, scales);
            const std::vector<Sun> unit = other_weather.unit_suns(hour);
            ASSERT_LE(whole.suns.size(), unit.size());
            if (whole.suns.empty()) {
                EXPECT_EQ(scales.sun, Rgb(0.0f));
            } else {
                EXPECT_EQ(whole.suns[0].direction, unit[0].direction);
                EXPECT_EQ(whole.suns[0].irradiance, scales.sun * unit[0].irradiance);
            }
            const Environment clear = other_weather.clear_sky(hour);
            const SkyParts& parts = other_weather.sky_parts();
            ASSERT_EQ(whole.sky.map.pixels.size(), clear.map.pixels.size());
            for (std::size_t i = 0; i < clear.map.pixels.size(); ++i) {
                const Rgb sum = scales.clear * clear.map.pixels[i] + scales.overcast * parts.overcast.map.pixels[i] +
                                scales.ground * parts.ground.map.pixels[i] + scales.night * parts.night.map.pixels[i];
                for (int c = 0; c < 3; ++c) ASSERT_NEAR(sum[c] / whole.sky.map.pixels[i][c], 1.0f, 1e-5f);
            }
        }
    }
}

TEST(LightModel, FixedLightsArePartsAsTheyAre) {
    LightSettings settings;
    settings.sun = SunSource::Given;
    settings.sun_illuminance = Rgb(30, 20, 10);
    settings.sky = SkySource::Constant;
    settings.sky_radiance = Rgb(3, 2, 1);
    const LightModel model(settings, {});
    EXPECT_EQ(model.scales(12.0, 0.5), (LightScales{.sun = Rgb(1.0f), .clear = 1.0f}));
    EXPECT_EQ(model.at(12.0).scales, model.scales(0.0, 0.0));
    EXPECT_EQ(model.unit_suns(12.0).at(0).irradiance, Rgb(30, 20, 10));
    EXPECT_EQ(model.clear_sky(12.0).map.pixels, std::vector<Rgb>{Rgb(3, 2, 1)});
    // A fixed sun over the day's sky: the ground below the horizon is not lit by it.
    settings.sky = SkySource::Day;
    EXPECT_EQ(LightModel(settings, {}).scales(12.0, 0.0).ground, Rgb(0.0f));
    EXPECT_EQ(LightModel(settings, {}).scales(12.0, 0.0).sun, Rgb(1.0f));
}

TEST(LightModel, EveningComesSmoothlyWithTheSun) {
    EXPECT_EQ(evening_share(3.01 * kDegree), 0.0f);
    EXPECT_EQ(evening_share(-1.01 * kDegree), 1.0f);
    EXPECT_NEAR(evening_share(1.0 * kDegree), 0.5f, 1e-6f);
    float before = 0.0f;
    for (double elevation = 4.0; elevation > -2.0; elevation -= 0.05) {
        const float now = evening_share(elevation * kDegree);
        EXPECT_GE(now, before) << elevation;
        EXPECT_LT(now - before, 0.02f) << elevation;  // its steepest slope is 1.5 over 4 degrees
        before = now;
    }
}

TEST(LightModel, EveningFollowsTheDay) {
    LightSettings settings = equator();
    const LightModel model(settings, {});
    for (const double elevation : {20.0, 2.0, 1.0, 0.0, -5.0}) {
        const double hour = hour_at(settings.day, elevation);
        EXPECT_EQ(model.at(hour).scales.evening, model.evening(hour));
        EXPECT_NEAR(model.evening(hour), evening_share(elevation * kDegree), 0.02f) << elevation;
    }
    settings.sun = SunSource::None, settings.sky = SkySource::None;
    EXPECT_EQ(LightModel(settings, {}).at(12.0).scales.evening, 1.0f);
    EXPECT_EQ(LightModel(settings, {}).evening(12.0), 1.0f);
}

TEST(LightModel, EveningDimsTheLampsThatAreMeant) {
    std::vector<PlacedLight> lamps(3);
    for (PlacedLight& lamp : lamps) lamp.intensity = Rgb(8.0f), lamp.lit = Lit::Evening;
    lamps[1].lit = Lit::Always;
    lamps[2].kind = LightKind::Directional;
    const std::vector<PlacedLight> lit = lit_lamps(lamps, {.suns = {}, .sky = {}, .scales = {.evening = 0.25f}});
    EXPECT_EQ(lit[0].intensity, Rgb(2.0f));
    EXPECT_EQ(lit[1].intensity, Rgb(8.0f));
    EXPECT_EQ(lit[2].intensity, Rgb(8.0f));
}

TEST(LightModel, SameBytesForAnyNumberOfThreads) {
    const auto make = [] { return LightModel(LightSettings{}, {}).at(19.0); };
    const Lighting many = make();
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const Lighting alone = make();
    ASSERT_EQ(many.sky.map.pixels.size(), alone.sky.map.pixels.size());
    EXPECT_EQ(
        std::memcmp(many.sky.map.pixels.data(), alone.sky.map.pixels.data(), many.sky.map.pixels.size() * sizeof(Rgb)),
        0);
    EXPECT_EQ(many.suns[0].irradiance, alone.suns[0].irradiance);
}

TEST(LightModel, GivenSceneAndNoSun) {
    LightSettings settings;
    settings.sky = SkySource::Constant;
    settings.sky_radiance = Rgb(4000.0f);
    settings.sun = SunSource::Given;
    settings.sun_direction = Vec3(0.2f, 0.6f, 0.77f);
    settings.sun_illuminance = Rgb(90000.0f);
    const LightModel given(settings, {});
    EXPECT_TRUE(given.constant());
    ASSERT_EQ(given.at(3.0).suns.size(), 1u);
    EXPECT_NEAR(glm::length(given.at(3.0).suns[0].direction), 1.0f, 1e-6f);
    EXPECT_EQ(given.at(3.0).sky.radiance(Vec3(0, 1, 0)), Rgb(4000.0f));

    PlacedLight key, lamp;
    key.kind = LightKind::Directional;
    key.direction = Vec3(0, -1, 0);
    key.intensity = Rgb(500, 400, 300);
    lamp.kind = LightKind::Point;
    lamp.intensity = Rgb(100);
    settings.sun = SunSource::Scene;
    const LightModel scene(settings, {lamp, key});
    ASSERT_EQ(scene.suns(0.0).size(), 1u);
    EXPECT_EQ(scene.suns(0.0)[0].direction, Vec3(0, 1, 0));
    EXPECT_EQ(scene.suns(0.0)[0].irradiance, Rgb(500, 400, 300));

    settings.sun = SunSource::None;
    settings.sky = SkySource::None;
    const LightModel dark(settings, {key});
    EXPECT_TRUE(dark.at(12.0).suns.empty());
    EXPECT_TRUE(dark.at(12.0).sky.black());
}

}  // namespace
}  // namespace daylit
