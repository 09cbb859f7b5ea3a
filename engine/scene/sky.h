#pragma once
// The light of sun and sky at one hour, from one clear-sky model or from an image; the same tables serve the baker, the
// reference and the renderer.
#include <filesystem>
#include <memory>
#include <vector>

#include "engine/base/image.h"
#include "engine/scene/day.h"
#include "engine/scene/light_parts.h"
#include "engine/scene/pose.h"

namespace daylit {

/// The sun (or a glTF directional light): a disc of kSunRadius. Its radiance is irradiance / (pi sin^2 radius).
struct Sun {
    Vec3 direction = Vec3(0, 1, 0);  // towards it, unit
    Rgb irradiance = Rgb(0.0f);      // lux on a plane facing it
};
Rgb disc_radiance(const Sun& sun);

/// Radiance from infinitely far away over all directions, without the sun's disc. Latitude-longitude, row 0 at +Y:
/// u = 0.5 + atan2(d.x, -d.z) / (2 pi), v = acos(d.y) / pi; so the middle column looks along -Z.
/// Bilinear between texel centres, wrapping in u, clamping in v. A 1x1 map is a constant.
struct Environment {
    Image map;  // cd/m^2, finite and non-negative
    bool black() const;
    bool constant() const { return map.width == 1 && map.height == 1; }
    Rgb radiance(const Vec3& direction) const;
};
Vec2 latlong_from_direction(const Vec3& direction);  // u, v in [0,1]
Vec3 direction_from_latlong(const Vec2& uv);

enum class SunSource { Day, Scene, None, Given };
enum class SkySource { Day, None, File, Constant };

/// Where light comes from; every hour of it. The scene's own lamps and emission are not part of this.
struct LightSettings {
    Day day;
    SunSource sun = SunSource::Day;
    Vec3 sun_direction = Vec3(0, 1, 0);   // Given: towards the sun
    Rgb sun_illuminance = Rgb(90000.0f);  // Given: lux on a plane facing it
    SkySource sky = SkySource::Day;
    std::filesystem::path sky_file;
    Rgb sky_radiance = Rgb(0.0f);  // Constant, cd/m^2
    double turbidity = 2.5;        // 1 (pure air) to 10 (haze)
    double clouds = 0.0;           // share of the sky covered, 0 to 1
    bool operator==(const LightSettings&) const = default;
};

struct Lighting {
    std::vector<Sun> suns;  // empty by night; SunSource::Scene may give several
    Environment sky;
    LightScales scales = {};  // what the parts of LightModel were multiplied by
    float share(Lit lit) const { return lit == Lit::Evening ? scales.evening : 1.0f; }
};

/// The parts of the day's sky that no hour changes (light_parts.h): O, G and N; empty maps where the sky is fixed.
struct SkyParts {
    Environment overcast, ground, night;
};

/// LightScales::evening for a sun at this elevation (radians): 0 from 3 degrees above the horizon on, 1 from 1 degree
/// below it, smooth between (3 t^2 - 2 t^3), as people light their lamps before it is dark.
float evening_share(double elevation);

/// The lamps with the intensity that they have in this light.
std::vector<PlacedLight> lit_lamps(std::vector<PlacedLight> lamps, const Lighting& lighting);

/// Computes the light of any hour; made once per scene and settings (holds the atmosphere's tables or the sky image).
/// Thread-safe to call. throws Error for an unreadable or unusable sky file.
class LightModel {
  public:
    /// placed   the scene's lights, of which the directional ones are used by SunSource::Scene
    LightModel(const LightSettings& settings, std::vector<PlacedLight> placed);
    ~LightModel();
    LightModel(LightModel&&) noexcept;
    LightModel& operator=(LightModel&&) noexcept;

    const LightSettings& settings() const;
    Lighting at(double hour) const;
    /// As at(), without the sky's map: only the suns. Cheap.
    std::vector<Sun> suns(double hour) const;
    /// As at().scales.evening: follows the day's sun where sun or sky follow the day, and is 1 in constant light. Cheap.
    float evening(double hour) const;
    /// True when the light is the same at all hours.
    bool constant() const;

    /// S: the suns of at(hour) where the sun's scale is taken out.
    std::vector<Sun> unit_suns(double hour) const;
    /// K, at any hour. At night its map is black.
    Environment clear_sky(double hour) const;
    const SkyParts& sky_parts() const;
    /// What the parts are multiplied by at this hour and cloud cover (0 to 1): at(hour) is their sum with the settings'
    /// own. Cheap without clouds; with them as dear as at(), for clouds spread the clear sky's light.
    LightScales scales(double hour, double clouds) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace daylit
