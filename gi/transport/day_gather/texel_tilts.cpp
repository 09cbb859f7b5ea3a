#include "gi/transport/day_gather/texel_tilts.h"

#include <array>

#include "gi/transport/day_gather/bfloat.h"
#include "gi/transport/day_gather/receiver_rays.h"

namespace daylit {
namespace {

constexpr std::size_t kMostNumbers = 3 * 64;  // of a receiver's light
constexpr std::size_t kAhead = 6;             // rows fetched ahead of their use

/// All light that leaves receivers and sky bins, at half the bytes.
std::vector<std::uint16_t> halved(std::span<const Rgb> light) {
    std::vector<std::uint16_t> result(3 * light.size());
    const StageProgress silent{Progress{}};
    constexpr std::size_t kBlock = 1 << 16;
    for_each_parallel((light.size() + kBlock - 1) / kBlock, silent, [&](std::size_t block) {
        for (std::size_t i = block * kBlock; i < std::min(light.size(), (block + 1) * kBlock); ++i)
            for (int c = 0; c < 3; ++c) result[3 * i + std::size_t(c)] = to_bfloat(light[i][c]);
    });
    return result;
}

void gather_tilts(const GatherScene& scene, const GatherHits& hits, const DaySolution& day,
                  std::span<const std::uint16_t> light, const GatherSettings& settings, std::uint32_t texel, Rgb* out) {
    const std::size_t components = day.basis.components, width = 3 * components;
    const std::uint32_t* hit = hits.hit.data() + std::size_t(texel) * std::size_t(hits.rays);
    const ReceiverRays rays(scene, settings, hits.receivers[texel]);
    const TiltFrame frame = tilt_frame(scene, texel);
    std::array<float, kMostNumbers> u{}, v{};
    for (int j = 0; j < hits.rays; ++j) {
        if (j + int(kAhead) < hits.rays && hit[j + int(kAhead)] != kNoLight) {
            const std::uint16_t* ahead = light.data() + hits.source(hit[j + int(kAhead)]) * width;
            for (std::size_t line = 0; line < width; line += 32) __builtin_prefetch(ahead + line);
        }
        if (hit[j] == kNoLight) continue;
        const Vec2 weight = tilt_weights(frame, rays.normal_of(rays.point_of(j)), rays.direction(j));
        const std::uint16_t* row = light.data() + hits.source(hit[j]) * width;
        for (std::size_t i = 0; i < width; ++i) {
            const float value = from_bfloat(row[i]);
            u[i] += weight.x * value, v[i] += weight.y * value;
        }
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

/// A stretch of the components of both axes, mixed over the neighbours of a row's texel: [axis][component].
void smooth_row(const GatherScene& scene, const SmoothingWeights& weights, const TexelTilts& tilts, std::size_t stride,
                const Stretch& part, std::size_t row, Rgb* out) {
    const std::uint32_t texel = tilts.texel_of_row[row];
    const TiltFrame own = tilt_frame(scene, texel);
    std::fill_n(out, 2 * part.count, Rgb(0.0f));
    float all = 0.0f;
    for (std::uint32_t k = weights.first[texel]; k < weights.first[texel + 1]; ++k) {
        const std::uint32_t from = tilts.row_of_texel[weights.texel[k]];
        if (from == ~0u) continue;
        const float weight = weights.weight[k];
        const TiltFrame other = tilt_frame(scene, weights.texel[k]);
        const Rgb *u = tilts.rows.data() + from * stride + part.first, *v = u + stride / 2;
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const Vec3& to = axis == 0 ? own.u : own.v;
            const float of_u = weight * glm::dot(to, other.u), of_v = weight * glm::dot(to, other.v);
            for (std::size_t i = 0; i < part.count; ++i) out[axis * part.count + i] += of_u * u[i] + of_v * v[i];
        }
        all += weight;
    }
    for (std::size_t i = 0; all > 0.0f && i < 2 * part.count; ++i) out[i] /= all;
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
                       const std::vector<bool>& wanted, const GatherSettings& settings, const StageProgress& progress) {
    TexelTilts tilts;
    tilts.row_of_texel.assign(wanted.size(), ~0u);
    for (std::uint32_t t = 0; t < wanted.size(); ++t)
        if (wanted[t]) tilts.row_of_texel[t] = std::uint32_t(tilts.count()), tilts.texel_of_row.push_back(t);
    if (tilts.count() == 0) return tilts;
    const std::size_t stride = 2 * day.basis.components;
    tilts.rows.resize(tilts.count() * stride);
    const std::vector<std::uint16_t> light = halved(day.leaving);
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
