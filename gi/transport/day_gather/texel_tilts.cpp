#include "gi/transport/day_gather/texel_tilts.h"

#include <array>

#include "gi/transport/day_gather/receiver_rays.h"

namespace daylit {
namespace {

void gather_tilts(const GatherScene& scene, const GatherHits& hits, const DaySolution& day, const HalvedLight& light,
                  const GatherSettings& settings, std::uint32_t texel, Rgb* out) {
    constexpr int kAhead = int(HalvedLight::kAhead);
    const std::size_t components = day.basis.components;
    const std::uint32_t* hit = hits.hit.data() + std::size_t(texel) * std::size_t(hits.rays);
    const ReceiverRays rays(scene, settings, hits.receivers[texel]);
    const TiltFrame frame = tilt_frame(scene, texel);
    std::array<float, HalvedLight::kMostNumbers> u{}, v{};
    for (int j = 0; j < hits.rays; ++j) {
        if (j + kAhead < hits.rays && hit[j + kAhead] != kNoLight) light.prefetch(hits.source(hit[j + kAhead]));
        if (hit[j] == kNoLight) continue;
        const Vec2 weights = tilt_weights(frame, rays.normal_of(rays.point_of(j)), rays.direction(j));
        light.add(hits.source(hit[j]), weights, u.data(), v.data());
    }
    const float scale = hits.scale[texel];
    for (std::size_t i = 0; i < components; ++i) {
        out[i] = scale * Rgb(u[3 * i], u[3 * i + 1], u[3 * i + 2]);
        out[components + i] = scale * Rgb(v[3 * i], v[3 * i + 1], v[3 * i + 2]);
    }
    const std::size_t evening = day.basis.component_of(StillPart::Evening),
                      lamps = day.basis.component_of(StillPart::Lamps);
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const ByLit& emission = hits.emission_tilts[texel][axis];
        out[axis * components + evening] += emission.evening;
        out[axis * components + lamps] += emission.always;
    }
}

struct Stretch {
    std::size_t first, count;
};

/// A stretch of the components of both axes, mixed over the neighbours of a row's texel: [axis][component]. Those
/// without tilts count as if they had its own, since what is left of weights of either sign has no sum to divide by.
void smooth_row(const GatherScene& scene, const SmoothingWeights& weights, const TexelTilts& tilts, std::size_t stride,
                const Stretch& part, std::size_t row, Rgb* out) {
    const std::uint32_t texel = tilts.texel_of_row[row];
    const TiltFrame own = tilt_frame(scene, texel);
    std::fill_n(out, 2 * part.count, Rgb(0.0f));
    for (std::uint32_t k = weights.first[texel]; k < weights.first[texel + 1]; ++k) {
        const std::uint32_t neighbour = tilts.row_of_texel[weights.texel[k]] == ~0u ? texel : weights.texel[k];
        const std::uint32_t from = tilts.row_of_texel[neighbour];
        const float weight = weights.weight[k];
        const TiltFrame other = tilt_frame(scene, neighbour);
        const Rgb *u = tilts.rows.data() + from * stride + part.first, *v = u + stride / 2;
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const Vec3& to = axis == 0 ? own.u : own.v;
            const float of_u = weight * glm::dot(to, other.u), of_v = weight * glm::dot(to, other.v);
            for (std::size_t i = 0; i < part.count; ++i) out[axis * part.count + i] += of_u * u[i] + of_v * v[i];
        }
    }
}

}  // namespace

TiltFrame tilt_frame(const GatherScene& scene, std::size_t texel) {
    const Vec3& u = scene.texels.along_u[texel];
    return {u, glm::cross(scene.texels.normal[texel], u)};
}

std::vector<bool> normal_mapped(const GatherScene& scene) {
    std::vector<bool> result(scene.texels.count(), false);
    const WorldMesh& mesh = scene.rays.mesh();
    for (std::size_t t = 0; t < result.size(); ++t)
        for (const TexelPoint& p : scene.texels.points_of(t)) {
            const Material& material = scene.rays.scene().materials[mesh.materials[p.triangle]];
            if (material.normal_texture.texture >= 0 && material.normal_scale != 0.0f) result[t] = true;
        }
    return result;
}

TexelTilts texel_tilts(const GatherScene& scene, const GatherHits& hits, const DaySolution& day,
                       const HalvedLight& light, const std::vector<bool>& wanted, const GatherSettings& settings,
                       const StageProgress& progress) {
    TexelTilts tilts;
    tilts.row_of_texel.assign(wanted.size(), ~0u);
    for (std::uint32_t t = 0; t < wanted.size(); ++t)
        if (wanted[t]) tilts.row_of_texel[t] = std::uint32_t(tilts.count()), tilts.texel_of_row.push_back(t);
    if (tilts.count() == 0) return tilts;
    const std::size_t stride = 2 * day.basis.components;
    tilts.rows.resize(tilts.count() * stride);
    for_each_parallel(tilts.count(), progress, [&](std::size_t row) {
        gather_tilts(scene, hits, day, light, settings, tilts.texel_of_row[row], tilts.rows.data() + row * stride);
    });
    return tilts;
}

void smooth_tilts(const GatherScene& scene, const SmoothingWeights& weights, std::size_t components,
                  TexelTilts& tilts) {
    const StageProgress silent{Progress{}};
    const std::size_t stride = 2 * components;
    std::vector<Rgb> block(tilts.count() * 2 * kColumnsAtOnce);
    for (std::size_t first = 0; first < components; first += kColumnsAtOnce) {
        const std::size_t width = std::min(kColumnsAtOnce, components - first);
        for_each_parallel(tilts.count(), silent, [&](std::size_t row) {
            smooth_row(scene, weights, tilts, stride, {first, width}, row, block.data() + row * 2 * width);
        });
        for_each_parallel(tilts.count(), silent, [&](std::size_t row) {
            for (std::size_t axis = 0; axis < 2; ++axis)
                std::copy_n(block.data() + (2 * row + axis) * width, width,
                            tilts.rows.data() + row * stride + axis * components + first);
        });
    }
}

}  // namespace daylit
