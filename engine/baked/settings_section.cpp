#include "engine/baked/settings_section.h"

namespace daylit {
namespace {

constexpr std::uint32_t kMaxPlanItems = 256;

}  // namespace

Bytes code_settings(const Baked& baked) {
    ByteWriter w;
    const LightSettings& light = baked.light;
    w.put(light.day.latitude), w.put(light.day.longitude);
    w.put(std::int32_t(light.day.date.year)), w.put(std::int32_t(light.day.date.month));
    w.put(std::int32_t(light.day.date.day));
    w.put(light.day.utc_offset), w.put(light.day.north);
    w.put(std::uint8_t(light.sun)), w.put(std::uint8_t(light.sky));
    w.put(light.sun_direction), w.put(light.sun_illuminance);
    w.put_string(light.sky_file.string());
    w.put(light.sky_radiance);
    w.put(light.turbidity), w.put(light.clouds);
    w.put(baked.unit);
    w.put(std::uint8_t(baked.lambert));
    w.put(baked.geometry_hash);
    return w.take();
}

void decode_settings(ByteReader r, Baked& baked) {
    LightSettings& light = baked.light;
    light.day.latitude = r.finite(), light.day.longitude = r.finite();
    light.day.date.year = r.number<std::int32_t>(-10000, 10000, "the year");
    light.day.date.month = r.number<std::int32_t>(1, 12, "the month");
    light.day.date.day = r.number<std::int32_t>(1, 31, "the day");
    light.day.utc_offset = r.finite(), light.day.north = r.finite();
    light.sun = SunSource(r.number<std::uint8_t>(0, std::uint8_t(SunSource::Given), "the sun's source"));
    light.sky = SkySource(r.number<std::uint8_t>(0, std::uint8_t(SkySource::Constant), "the sky's source"));
    light.sun_direction = r.finite_vec3(), light.sun_illuminance = r.finite_vec3();
    light.sky_file = r.string();
    light.sky_radiance = r.finite_vec3();
    light.turbidity = r.finite(), light.clouds = r.finite();
    baked.unit = r.finite();
    baked.lambert = r.boolean();
    baked.geometry_hash = r.get<std::uint64_t>();
    r.expect_end();
}

Bytes code_plan(const std::vector<PlanItem>& plan) {
    ByteWriter w;
    w.put(std::uint32_t(plan.size()));
    for (const PlanItem& item : plan) {
        w.put_string(item.part);
        w.put(std::uint8_t(item.done));
        w.put_string(item.why);
        w.put(item.bytes);
        w.put(item.error);
    }
    return w.take();
}

std::vector<PlanItem> decode_plan(ByteReader r) {
    std::vector<PlanItem> plan(r.number<std::uint32_t>(0, kMaxPlanItems, "the number of parts"));
    for (PlanItem& item : plan) {
        item.part = r.string();
        item.done = r.boolean();
        item.why = r.string();
        item.bytes = r.get<std::uint64_t>();
        item.error = r.finite();
    }
    r.expect_end();
    return plan;
}

}  // namespace daylit
