#include "demo/report/methods.h"

#include <cmath>

#include "demo/lightmap_points.h"
#include "demo/report/spent.h"
#include "gi/encode/sweep.h"
#include "gi/transport/day_gather/sweep.h"

namespace daylit {
namespace {

constexpr int kLookUps = 200000;

/// Seconds of one of many calls look_up(i), whose results are summed so that none can be left out.
template <class LookUp>
double seconds_of_one(const LookUp& look_up) {
    Rgb sum(0.0f);
    const double start = thread_seconds();
    for (int i = 0; i < kLookUps; ++i) sum += look_up(std::size_t(i));
    const double seconds = thread_seconds() - start;
    return std::isfinite(sum.x) ? seconds / kLookUps : 0.0;
}

/// The texels that triangles cover.
double covered_texels(const DayLightmap& map) {
    double area = 0.0;
    for (std::size_t i = 0; i + 2 < map.corner_uvs.size(); i += 3) {
        const glm::dvec2 e = map.corner_uvs[i + 1] - map.corner_uvs[i], f = map.corner_uvs[i + 2] - map.corner_uvs[i];
        area += 0.5 * std::abs(e.x * f.y - e.y * f.x);
    }
    return area * map.width * map.height;
}

ReportMethod lightmap(const BakeSettings& base) {
    ReportMethod m;
    m.name = m.part = "lightmap";
    m.about =
        "Day lightmaps (Bahnsen et al.): indirect irradiance in texels over static surfaces, all hours of the day in "
        "one bake, stored tile by tile as a few images times curves of the hour.";
    m.in_pictures = true;
    m.sweep = day_gather_sweep(base);
    m.present = [](const Baked& baked) { return baked.lightmap.has_value(); };
    m.irradiance = [](const Baked& baked, const Scene& scene, const Instant& instant,
                      const std::vector<SurfaceSample>& points) {
        return lightmap_irradiance(*baked.lightmap, scene, instant.scales, instant.hour, points);
    };
    m.look_up = [](const Baked& baked, const Instant& instant, const std::vector<SurfaceSample>&) {
        const DayLightmap& map = *baked.lightmap;
        const std::vector<Rgb> light = map.tile_light(map.basis.weights(instant.scales, instant.hour));
        constexpr std::size_t kStride = 7919;  // a prime: neighbours in time are not neighbours in the atlas
        return seconds_of_one([&](std::size_t i) {
            return map.irradiance(map.corner_uvs[(i * kStride) % map.corner_uvs.size()], light);
        });
    };
    m.answers = [](const Baked& baked) {
        return covered_texels(*baked.lightmap) * double(baked.lightmap->basis.hours.size());
    };
    return m;
}

VolumeLight volume_at(const Baked& baked, const Instant& instant) {
    return {*baked.volume, baked.volume->basis.weights(instant.scales, instant.hour)};
}

ReportMethod volume(const BakeSettings& base) {
    ReportMethod m;
    m.name = m.part = "volume";
    m.about = "Irradiance volume (Oat): radiance in spherical harmonics at points in free space, for what moves.";
    m.in_space = true;
    m.present = [](const Baked& baked) { return baked.volume.has_value(); };
    m.irradiance = [](const Baked& baked, const Scene&, const Instant& instant,
                      const std::vector<SurfaceSample>& points) {
        const VolumeLight volume = volume_at(baked, instant);
        std::vector<Rgb> light;
        for (const SurfaceSample& p : points) light.push_back(volume.irradiance(p.position, p.normal));
        return light;
    };
    m.look_up = [](const Baked& baked, const Instant& instant, const std::vector<SurfaceSample>& points) {
        const VolumeLight volume = volume_at(baked, instant);
        return seconds_of_one([&](std::size_t i) {
            const SurfaceSample& p = points[i % points.size()];
            return volume.irradiance(p.position, p.normal);
        });
    };
    m.answers = [](const Baked& baked) {
        return double(baked.volume->tree.samples) * double(baked.volume->basis.hours.size());
    };
    m.sweep = volume_sweep(base);
    return m;
}

}  // namespace

std::vector<ReportMethod> report_methods(const BakeSettings& base) {
    std::vector<ReportMethod> methods = {lightmap(base), volume(base)};
    for (ReportMethod& method : methods) {
        method.sweep.insert(method.sweep.begin(), SweepPoint{"base", "base", base});
        for (SweepPoint& point : method.sweep) point.settings.parts = {method.part};
    }
    return methods;
}

}  // namespace daylit
