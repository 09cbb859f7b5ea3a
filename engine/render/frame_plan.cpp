#include "engine/render/frame_plan.h"

namespace daylit {
namespace {

PassPlan when(bool runs, const char* because, const char* because_not) { return {runs, runs ? because : because_not}; }

PassPlan shadow_plan(bool shown, std::size_t sources, bool stale, const char* what, bool any_surface) {
    if (!shown) return {false, "the layer shows no straight light"};
    if (sources == 0) return {false, std::string("no ") + what};
    if (!any_surface) return {false, "nothing casts a shadow"};
    return when(stale, "light, casters or view moved", "as it was: light and casters are still");
}

PassPlan relight_plan(const FrameFacts& f) {
    if (!f.baked) return {false, "no baked light"};
    if (!shows_baked_light(f.show)) return {false, "the layer shows no baked light"};
    if (f.baked_stale) return {true, "the hour moved"};
    return when(f.baked_unlit, "surfaces came into view", "the hour is still");
}

}  // namespace

const char* name(PassKind pass) {
    constexpr std::array<const char*, kPassCount> kNames = {"relight", "moving light", "sun shadows", "lamp shadows",
                                                            "depth",   "surfaces",     "volume view", "sky",
                                                            "blended", "resolve",      "meter"};
    return kNames[std::size_t(pass)];
}

bool shows_straight_light(Layer l) { return l == Layer::Final || l == Layer::Direct || l == Layer::Irradiance; }
bool shows_baked_light(Layer l) {
    return l == Layer::Final || l == Layer::Indirect || l == Layer::Irradiance || l == Layer::Lightmap ||
           l == Layer::Volume;
}
bool shows_sky(Layer l) { return l == Layer::Final || l == Layer::Direct; }
bool shows_radiance(Layer l) { return l == Layer::Final || l == Layer::Direct || l == Layer::Indirect; }
bool shown_as_is(Layer l) { return l == Layer::Albedo || l == Layer::Normal; }

FramePlan plan_frame(const FrameFacts& f) {
    const bool straight = shows_straight_light(f.show);
    FramePlan plan;
    const auto set = [&](PassKind pass, PassPlan p) { plan[std::size_t(pass)] = std::move(p); };
    set(PassKind::Relight, relight_plan(f));
    set(PassKind::MovingLight, !f.volume ? PassPlan{false, "no irradiance volume"}
                               : !shows_baked_light(f.show)
                                   ? PassPlan{false, "the layer shows no baked light"}
                                   : when(f.moving_unlit, "the light or things in view moved",
                                          "light and things are still, or looked up at pixels"));
    set(PassKind::SunShadows, shadow_plan(straight, f.suns, f.sun_maps_stale, "sun above the horizon", f.any_surface));
    set(PassKind::LampShadows, shadow_plan(straight, f.lamps, f.lamp_maps_stale, "lamps", f.any_surface));
    set(PassKind::Depth, when(f.depth_first && f.any_surface, "hidden pixels would cost their light",
                              "surfaces are cheap to shade"));
    set(PassKind::Surfaces, when(f.any_surface, "the scene has surfaces", "the scene has no opaque surface"));
    set(PassKind::VolumeView, !f.volume                    ? PassPlan{false, "no irradiance volume"}
                              : !shows_baked_light(f.show) ? PassPlan{false, "the layer shows no baked light"}
                                                           : when(f.volume_view, "samples and cells are asked for",
                                                                  "samples and cells are not asked for"));
    set(PassKind::Sky, !shows_sky(f.show)                     ? PassPlan{false, "the layer shows no sky"}
                       : when(!f.sky_black || f.suns > 0, "sky or sun may be seen", "a black sky without sun"));
    set(PassKind::Blended, when(f.any_through, "BLEND or glass materials", "no BLEND or glass material"));
    set(PassKind::Resolve, when(f.samples_per_side > 1, "several samples a pixel", "one sample a pixel"));
    set(PassKind::Meter, when(f.meter, "auto exposure", "the exposure is given"));
    return plan;
}

}  // namespace daylit
