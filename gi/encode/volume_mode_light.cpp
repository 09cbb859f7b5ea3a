#include "gi/encode/volume_mode_light.h"

#include <algorithm>
#include <cmath>

#include "engine/baked/record_coding.h"
#include "engine/baked/volume_sections.h"
#include "engine/base/error.h"
#include "shaders/shared/sh.h"

namespace daylit {
namespace {

bool uses_changes(VolumeBlend blend) {
    return blend != VolumeBlend::Trilinear;
}

/// That look-ups of irradiance read.
int coefficients_of(VolumeBands bands) {
    return bands == VolumeBands::Two || bands == VolumeBands::Zh3 ? 4 : 9;
}

/// Numbers of a record's parts that are kept, all components, without what a blend does not use.
Bytes code_kept(const IrradianceVolume& volume, const VolumeScheme& mode) {
    ByteWriter w;
    const std::size_t count = volume.tree.samples, components = std::size_t(volume.basis.components);
    const auto put_kept = [&]<class Integer>(const std::vector<Integer>& numbers, std::size_t planes) {
        std::vector<Integer> kept;
        for (std::size_t p = 0; p < planes; ++p) {
            const auto first = numbers.begin() + std::ptrdiff_t(p * kRecordNumbers * count);
            kept.insert(kept.end(), first,
                        first + std::ptrdiff_t(3 * std::size_t(coefficients_of(mode.bands)) * count));
        }
        put_planes<Integer>(w, kept, count);
    };
    w.put_all(volume.value_step);
    if (uses_changes(mode.blend)) w.put_all(volume.change_step), put_kept(volume.changes, 3 * components);
    put_kept(volume.values, components);
    return w.take();
}

/// As engine/baked's fill_hanging(), by any blend.
void fill_hanging(const VolumeTree& tree, VolumeBlend blend, std::span<Vec4> records) {
    for (std::size_t h = 0; h < tree.hanging.size(); ++h)
        for (std::size_t part = 0; part < 4; ++part) {
            const HangingCorner& at = tree.hanging[h];
            const glsl::VolumeCell& cell = tree.cells[at.cell[part]];
            const std::array<Vec4, 8> weights =
                part == 0 ? blend_weights(blend, at.t[part], cell.box.w)
                          : blend_weights_change(blend, at.t[part], cell.box.w, int(part) - 1);
            for (std::size_t i = 0; i < kRecordNumbers; ++i) {
                float sum = 0.0f;
                for (int corner = 0; corner < 8; ++corner)
                    sum +=
                        glm::dot(weights[std::size_t(corner)], records[kRecordNumbers * record_of(cell, corner) + i]);
                records[kRecordNumbers * (tree.samples + h) + i][glm::length_t(part)] = sum;
            }
        }
}

Rgb two_bands(const glsl::VolumeSh& sh, const Vec3& normal) {
    const glsl::Sh9 lobe = glsl::sh_irradiance_weights(normal);
    Rgb sum(0.0f);
    for (int i = 0; i < 4; ++i) sum += lobe.c[i] * sh.c[i];
    return sum;
}

}  // namespace

Rgb zh3_irradiance(const glsl::VolumeSh& sh, const Vec3& normal) {
    const Rgb linear = two_bands(sh, normal);
    const auto along = [&](const Vec3& axis) {  // of each channel's second band, whose order is y, z, x
        return axis.y * sh.c[1] + axis.z * sh.c[2] + axis.x * sh.c[3];
    };
    const Vec3 steepest(luminance(sh.c[3]), luminance(sh.c[1]), luminance(sh.c[2]));
    const float length = glm::length(steepest);
    if (!(length > 0.0f)) return glm::max(linear, Rgb(0.0f));
    const Vec3 axis = steepest / length;
    const Rgb mean = glm::max(sh.c[0], Rgb(1e-20f)), ratio = glm::abs(along(axis)) / mean;
    const Rgb zonal = sh.c[0] * (0.08f * ratio + 0.6f * ratio * ratio);
    const float cosine = glm::dot(axis, normal);
    constexpr float kZonal = 0.315391565f, kThirdBand = 0.785398163f;  // sqrt(5 / (16 pi)); pi / 4
    return glm::max(linear + kThirdBand * kZonal * (3.0f * cosine * cosine - 1.0f) * zonal, Rgb(0.0f));
}

double stored_bytes(const IrradianceVolume& volume, const VolumeScheme& mode) {
    double bytes = double(code_section(kRecordSection, code_kept(volume, mode)).stored.size());
    // What the fourth band would hold is not known here; that it takes as much as the others do is.
    if (mode.bands == VolumeBands::Four) bytes = std::round(bytes * 16.0 / 9.0);
    if (mode.grid) return bytes;
    for (const CodedSection& section : code_volume(volume))
        if (std::string_view(section.entry.name.data(), 4) != kRecordSection) bytes += double(section.stored.size());
    return bytes;
}

VolumeModeLight::VolumeModeLight(const IrradianceVolume& volume, const VolumeScheme& mode, std::span<const Rgb> weights)
    : volume_(volume), mode_(mode), numbers_(3 * coefficients_of(mode.bands)) {
    std::vector<Vec4> all = volume.records(weights);
    fill_hanging(volume.tree, mode.blend, all);
    for (std::size_t r = 0; r < volume.tree.records(); ++r)
        for (std::size_t i = 0; i < std::size_t(numbers_); ++i) {
            const Vec4& number = all[kRecordNumbers * r + i];
            if (uses_changes(mode.blend))
                records_.push_back(number);
            else
                values_.push_back(number.x);
        }
    arrays_ = {volume.tree.grid(), volume.tree.nodes.data(), volume.tree.cells.data(), volume.tree.cuts.data(),
               nullptr};
    if (mode.grid) lay_table();
}

void VolumeModeLight::lay_table() {
    const VolumeTree& tree = volume_.tree;
    const float side = tree.cells.front().box.w;
    for (const glsl::VolumeCell& cell : tree.cells)
        if (cell.box.w != side) throw Error("the volume", "has cells of several sizes and is no grid");
    const int across = int(std::lround(tree.side / side));  // cells along a root
    for (std::size_t a = 0; a < 3; ++a) size_[a] = tree.size[a] * across;
    per_metre_ = 1.0f / side;
    for (int z = 0; z < size_[2]; ++z)
        for (int y = 0; y < size_[1]; ++y)
            for (int x = 0; x < size_[0]; ++x) {
                Vec3 t = (Vec3(x, y, z) + 0.5f) / float(across);
                std::uint32_t node =
                    tree.nodes[std::size_t(((z / across) * tree.size[1] + y / across) * tree.size[0] + x / across)];
                t -= glm::floor(t);
                while ((node & glsl::kVolumeKind) == glsl::kVolumeInner) {
                    const Vec3 twice = 2.0f * t, upper = glm::step(Vec3(1.0f), twice);
                    t = twice - upper;
                    node = tree.nodes[node + std::uint32_t(upper.x + 2.0f * upper.y + 4.0f * upper.z)];
                }
                table_.push_back(node);
            }
}

glsl::VolumePlace VolumeModeLight::find(const Vec3& place) const {
    if (!mode_.grid) return glsl::volume_place(arrays_, place);
    const VolumeTree& tree = volume_.tree;
    const Vec3 size(size_[0], size_[1], size_[2]);
    const Vec3 inside = glm::clamp((place - tree.origin) * per_metre_, Vec3(0.0f), size);
    const Vec3 first = glm::min(glm::floor(inside), size - Vec3(1.0f));
    std::uint32_t node = table_[std::size_t((int(first.z) * size_[1] + int(first.y)) * size_[0] + int(first.x))];
    if ((node & glsl::kVolumeKind) == glsl::kVolumeCut) {
        const glsl::VolumeCut& wall = tree.cuts[node & ~glsl::kVolumeKind];
        node = glm::dot(Vec3(wall.plane), place) + wall.plane.w >= 0.0f ? wall.nodes.x : wall.nodes.y;
    }
    const std::uint32_t cell = node & ~glsl::kVolumeKind;
    if ((node & glsl::kVolumeKind) != glsl::kVolumeNearest) return {cell, inside - first};
    const Vec4& box = tree.cells[cell].box;
    return {cell, glm::clamp((place - Vec3(box)) / box.w, Vec3(0.0f), Vec3(1.0f))};
}

Rgb VolumeModeLight::irradiance(const Vec3& place, const Vec3& normal) const {
    const glsl::VolumePlace at = find(place);
    const glsl::VolumeCell& cell = volume_.tree.cells[at.cell];
    const std::array<Vec4, 8> weights = blend_weights(mode_.blend, at.t, cell.box.w);
    glsl::VolumeSh sh{};
    if (records_.empty()) {
        float sum[kRecordNumbers] = {};
        for (int corner = 0; corner < 8; ++corner) {
            const float* record = values_.data() + std::size_t(numbers_) * record_of(cell, corner);
            const float weight = weights[std::size_t(corner)].x;
            for (int i = 0; i < numbers_; ++i) sum[i] += weight * record[i];
        }
        for (int i = 0; i < numbers_; ++i) sh.c[i / 3][i % 3] = sum[i];
    } else {
        Vec4 sum[kRecordNumbers] = {};
        for (int corner = 0; corner < 8; ++corner) {
            const Vec4* record = records_.data() + std::size_t(numbers_) * record_of(cell, corner);
            const Vec4& weight = weights[std::size_t(corner)];
            for (int i = 0; i < numbers_; ++i) sum[i] += weight * record[i];
        }
        for (int i = 0; i < numbers_; ++i) sh.c[i / 3][i % 3] = (sum[i].x + sum[i].y) + (sum[i].z + sum[i].w);
    }
    if (mode_.bands == VolumeBands::Two) return glm::max(two_bands(sh, normal), Rgb(0.0f));
    if (mode_.bands == VolumeBands::Zh3) return zh3_irradiance(sh, normal);
    return glsl::volume_irradiance(sh, normal, 1.0f);
}

}  // namespace daylit
