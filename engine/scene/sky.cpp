// Sun and sky of one hour. The clear sky is atmosphere.h's; this adds clouds, the ground below the horizon and the
// night, and draws the map.
//
// Clouds (share N of the sky covered)   Kasten and Czeplak 1980: global illuminance G = G0 (1 - 0.75 N^3.4), of which
//     the diffuse share is d0 + (1 - d0) N^2 (their 0.3 + 0.7 N^2, with this sky's own share d0 at N = 0). The clear
//     sky keeps 1 - N of its radiance; the rest of the diffuse light has the distribution of the overcast sky of Moon
//     and Spencer 1942, (1 + 2 sin e) / 3, and the colour of the clear global light, for clouds scatter neutrally.
// Below the horizon                     level ground of albedo 0.2, lit by sun and sky, seen from 20 m through the air
//     of the ground: at the horizon it is the sky's own colour, so the map has no edge there.
// Night                                 starlight and airglow, 2.5e-4 cd/m^2 everywhere (Leinert et al. 1998: a
//     moonless zenith is about 2e-4), 0.8 mlx on open ground. No moon.
#include "engine/scene/sky.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "engine/scene/atmosphere.h"
#include "engine/scene/environment.h"

namespace daylit {
namespace {

constexpr int kMapWidth = 256, kMapHeight = 128;        // the horizon lies between rows 63 and 64
constexpr float kEyeHeight = 20.0f;                     // m
constexpr float kNightRadiance = 2.5e-4f;               // cd/m^2
constexpr double kAstronomicalNight = -20.0 * kDegree;  // below it the sun adds nothing to the night's own light

struct CloudShares {
    float sun, clear_sky, global, diffuse;  // of their clear values; diffuse is a share of the clouded global light
};

CloudShares cloud_shares(double cover, float clear_diffuse_share) {
    const double global = 1.0 - 0.75 * std::pow(cover, 3.4);
    return {float(global * (1.0 - cover * cover)), float(1.0 - cover), float(global),
            float(clear_diffuse_share + (1.0 - clear_diffuse_share) * cover * cover)};
}

float row_elevation(int row) {
    return float((0.5 - (row + 0.5) / kMapHeight) * kPi);
}

float column_bearing(int column) {
    return float(((column + 0.5) / kMapWidth - 0.5) * 2.0 * kPi);
}

struct SunState {
    SunPosition position;
    float scale;  // 1 / distance^2
};

SunState sun_state(const Day& day, double hour) {
    const SunPosition position = sun_position(day, hour);
    return {position, float(1.0 / (position.distance * position.distance))};
}

/// The upper half of the map, clear and without the night's light.
Image clear_map(const Atmosphere& air, const SunState& sun) {
    Image map(kMapWidth, kMapHeight);
    if (sun.position.apparent_elevation < kAstronomicalNight) return map;
    const ClearSky sky = air.clear_sky(sun.position.apparent_elevation);
    const double sun_bearing = std::atan2(double(sun.position.direction.x), -double(sun.position.direction.z));
    tbb::parallel_for(0, kMapHeight / 2, [&](int y) {
        const double elevation = row_elevation(y), quarter = 0.25 * kPi / kMapHeight;
        for (int x = 0; x < kMapWidth; ++x) {
            const double azimuth = column_bearing(x) - sun_bearing;
            map.at(x, y) = 0.5f * sun.scale *
                           (sky.radiance(elevation - quarter, azimuth) + sky.radiance(elevation + quarter, azimuth));
        }
    });
    return map;
}

/// The lower half: ground under `irradiance` (lux) fading into the horizon's light.
void draw_ground(Image& map, const Rgb& irradiance, const Rgb& extinction) {
    const Rgb ground = irradiance * float(kGroundAlbedo / kPi);
    for (int y = kMapHeight / 2; y < kMapHeight; ++y) {
        const float distance = kEyeHeight / std::sin(-row_elevation(y));
        const Rgb through = glm::exp(-extinction * distance);
        for (int x = 0; x < kMapWidth; ++x) {
            const Rgb horizon = map.at(x, kMapHeight / 2 - 1);
            map.at(x, y) = ground * through + horizon * (Rgb(1.0f) - through);
        }
    }
}

/// A sky with the ground that it lights.
Environment over_ground(Image upper_half, const Rgb& extinction) {
    Environment sky{std::move(upper_half)};
    draw_ground(sky.map, horizontal_irradiance(sky), extinction);
    return sky;
}

SkyParts make_sky_parts(const Rgb& extinction) {
    SkyParts parts;
    Image overcast(kMapWidth, kMapHeight), night(kMapWidth, kMapHeight);
    for (int y = 0; y < kMapHeight / 2; ++y)
        for (int x = 0; x < kMapWidth; ++x) {
            overcast.at(x, y) = Rgb((1.0f + 2.0f * std::sin(row_elevation(y))) / 3.0f);
            night.at(x, y) = Rgb(kNightRadiance);
        }
    parts.overcast = over_ground(std::move(overcast), extinction);
    parts.night = over_ground(std::move(night), extinction);
    parts.ground.map = Image(kMapWidth, kMapHeight);
    draw_ground(parts.ground.map, Rgb(1.0f), extinction);
    return parts;
}

/// Zenith of the overcast sky: what clouds add to the diffuse light on level ground, from the clear sky's and sun's.
Rgb overcast_zenith(const Rgb& from_sky, const Rgb& from_sun, double clouds) {
    const Rgb global = from_sky + from_sun;
    const float total = luminance(global);
    if (!(total > 0.0f)) return Rgb(0.0f);
    const CloudShares shares = cloud_shares(clouds, luminance(from_sky) / total);
    const float from_clouds =
        std::max(0.0f, shares.global * shares.diffuse * total - shares.clear_sky * luminance(from_sky));
    // (1 + 2 sin e) / 3 gives 7 pi / 9 of the zenith's radiance as irradiance.
    return global * float(from_clouds / total * 9.0 / (7.0 * kPi));
}

/// into += scale * part, pixel by pixel.
void add_part(const Rgb& scale, const Environment& part, Image& into) {
    if (scale == Rgb(0.0f)) return;
    for (std::size_t i = 0; i < into.pixels.size(); ++i) into.pixels[i] += scale * part.map.pixels[i];
}

std::vector<Sun> scene_suns(const std::vector<PlacedLight>& placed) {
    std::vector<Sun> suns;
    for (const PlacedLight& light : placed) {
        if (light.kind != LightKind::Directional || light.intensity == Rgb(0.0f)) continue;
        suns.push_back({-light.direction, light.intensity});
    }
    return suns;
}

}  // namespace

float evening_share(double elevation) {
    constexpr double kLit = -1.0 * kDegree, kDark = 3.0 * kDegree;
    const double t = std::clamp((kDark - elevation) / (kDark - kLit), 0.0, 1.0);
    return float(t * t * (3.0 - 2.0 * t));
}

std::vector<PlacedLight> lit_lamps(std::vector<PlacedLight> lamps, const Lighting& lighting) {
    for (PlacedLight& lamp : lamps)
        if (lamp.kind != LightKind::Directional) lamp.intensity *= lighting.share(lamp.lit);
    return lamps;
}

struct LightModel::State {
    LightSettings settings;
    std::vector<Sun> fixed_suns;      // SunSource other than Day
    Environment fixed_sky;            // SkySource other than Day
    std::unique_ptr<Atmosphere> air;  // where sun or sky follow the day
    SkyParts parts;                   // where the sky does

    State(const LightSettings& wanted, const std::vector<PlacedLight>& placed) : settings(wanted) {
        if (settings.sun == SunSource::Scene) fixed_suns = scene_suns(placed);
        if (settings.sun == SunSource::Given && settings.sun_illuminance != Rgb(0.0f)) {
            fixed_suns = {{glm::normalize(settings.sun_direction), settings.sun_illuminance}};
        }
        if (settings.sky == SkySource::File) {
            fixed_sky = usable_environment(read_image(settings.sky_file), settings.sky_file.string());
        } else {
            fixed_sky.map = Image(1, 1, settings.sky == SkySource::Constant ? settings.sky_radiance : Rgb(0.0f));
        }
        if (settings.sun == SunSource::Day || settings.sky == SkySource::Day) {
            air = std::make_unique<Atmosphere>(settings.turbidity);
        }
        if (settings.sky == SkySource::Day) parts = make_sky_parts(air->ground_extinction());
    }

    Rgb clear_sun(const SunState& sun) const {
        return air->sun_illuminance(sun.position.apparent_elevation) * sun.scale;
    }

    std::vector<Sun> unit_suns(const SunState& sun) const {
        if (settings.sun != SunSource::Day) return fixed_suns;
        if (luminance(clear_sun(sun)) <= 0.0f) return {};
        return {{sun.position.direction, Rgb(1.0f)}};
    }

    Rgb sun_scale(const SunState& sun, double clouds) const {
        if (settings.sun != SunSource::Day) return Rgb(fixed_suns.empty() ? 0.0f : 1.0f);
        return clear_sun(sun) * cloud_shares(clouds, 0.0f).sun;
    }

    /// clear_map   of this hour, without ground; looked at under clouds only
    LightScales scales(const SunState& sun, double clouds, const Image& clear_map) const {
        LightScales scales{.sun = sun_scale(sun, clouds)};
        if (air) scales.evening = evening_share(sun.position.apparent_elevation);
        if (settings.sky != SkySource::Day) {
            scales.clear = fixed_sky.black() ? 0.0f : 1.0f;
            return scales;
        }
        const float slope = float(std::max(0.0, std::sin(sun.position.apparent_elevation)));
        scales.clear = cloud_shares(clouds, 0.0f).clear_sky, scales.night = 1.0f;
        if (settings.sun == SunSource::Day) scales.ground = slope * scales.sun;
        if (clouds > 0.0)
            scales.overcast = overcast_zenith(horizontal_irradiance({clear_map}), slope * clear_sun(sun), clouds);
        return scales;
    }
};

LightModel::LightModel(const LightSettings& settings, std::vector<PlacedLight> placed)
    : state_(std::make_unique<State>(settings, placed)) {}
LightModel::~LightModel() = default;
LightModel::LightModel(LightModel&&) noexcept = default;
LightModel& LightModel::operator=(LightModel&&) noexcept = default;

const LightSettings& LightModel::settings() const {
    return state_->settings;
}

std::vector<Sun> LightModel::suns(double hour) const {
    std::vector<Sun> suns = unit_suns(hour);
    if (state_->settings.sun != SunSource::Day || suns.empty()) return suns;
    suns[0].irradiance = state_->sun_scale(sun_state(state_->settings.day, hour), state_->settings.clouds);
    if (luminance(suns[0].irradiance) <= 0.0f) suns.clear();
    return suns;
}

float LightModel::evening(double hour) const {
    return constant() ? 1.0f : evening_share(sun_position(state_->settings.day, hour).apparent_elevation);
}

Lighting LightModel::at(double hour) const {
    Lighting lighting{suns(hour), clear_sky(hour), {}};
    if (constant()) {
        lighting.scales = state_->scales({}, 0.0, {});
        return lighting;
    }
    const SunState sun = sun_state(state_->settings.day, hour);
    lighting.scales = state_->scales(sun, state_->settings.clouds, lighting.sky.map);
    if (state_->settings.sky != SkySource::Day) return lighting;
    Image& map = lighting.sky.map;
    for (Rgb& pixel : map.pixels) pixel *= lighting.scales.clear;
    add_part(lighting.scales.overcast, state_->parts.overcast, map);
    add_part(lighting.scales.ground, state_->parts.ground, map);
    add_part(Rgb(lighting.scales.night), state_->parts.night, map);
    return lighting;
}

std::vector<Sun> LightModel::unit_suns(double hour) const {
    if (state_->settings.sun != SunSource::Day) return state_->fixed_suns;
    return state_->unit_suns(sun_state(state_->settings.day, hour));
}

Environment LightModel::clear_sky(double hour) const {
    if (state_->settings.sky != SkySource::Day) return state_->fixed_sky;
    return over_ground(clear_map(*state_->air, sun_state(state_->settings.day, hour)),
                       state_->air->ground_extinction());
}

const SkyParts& LightModel::sky_parts() const {
    return state_->parts;
}

LightScales LightModel::scales(double hour, double clouds) const {
    if (constant()) return state_->scales({}, clouds, {});
    const SunState sun = sun_state(state_->settings.day, hour);
    const bool spread = clouds > 0.0 && state_->settings.sky == SkySource::Day;
    return state_->scales(sun, clouds, spread ? clear_map(*state_->air, sun) : Image());
}

bool LightModel::constant() const {
    return state_->settings.sun != SunSource::Day && state_->settings.sky != SkySource::Day;
}

}  // namespace daylit
