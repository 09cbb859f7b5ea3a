#pragma once
// Which passes a frame needs, and why: each states the condition under which it runs.
#include <array>
#include <cstddef>
#include <string>

#include "engine/scene/layer.h"

namespace daylit {

/// In the order in which they run.
enum class PassKind {
    Relight,
    MovingLight,
    SunShadows,
    LampShadows,
    Depth,
    Surfaces,
    VolumeView,
    Sky,
    Blended,
    Resolve,
    Meter
};
inline constexpr std::size_t kPassCount = 11;
const char* name(PassKind pass);

/// What the plan depends on.
struct FrameFacts {
    Layer show = Layer::Final;
    bool baked = false, baked_stale = false;
    bool baked_unlit = false;                  // surfaces came into view that were not since the light changed
    bool volume = false, volume_view = false;  // baked; its samples and cells are asked for
    bool moving_unlit = false;                 // something in view has light from the volume to be looked up
    std::size_t suns = 0, lamps = 0;
    bool sun_maps_stale = false, lamp_maps_stale = false;
    bool any_surface = false, any_through = false;
    bool depth_first = false;  // overdraw is dear here
    bool sky_black = false;
    int samples_per_side = 1;
    bool meter = false;
};

struct PassPlan {
    bool runs = false;
    std::string why;
};
using FramePlan = std::array<PassPlan, kPassCount>;

FramePlan plan_frame(const FrameFacts& facts);

/// True when the layer contains light that arrives straight from suns and lamps; baked light; light seen by the camera
/// straight from the sky.
bool shows_straight_light(Layer layer);
bool shows_baked_light(Layer layer);
bool shows_sky(Layer layer);
/// Radiance, cd/m^2, rather than irradiance or something else.
bool shows_radiance(Layer layer);
/// Albedo and normals are displayed as they are; everything else is exposed and tone-mapped.
bool shown_as_is(Layer layer);

}  // namespace daylit
