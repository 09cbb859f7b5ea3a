#include "engine/baked/volume_batch.h"

#include <algorithm>
#include <array>

namespace daylit {
namespace {

constexpr std::size_t kRow = 32;  // kVolumeNumbers, padded to whole registers of any width
constexpr std::size_t kRecord = 4 * kRow;
constexpr std::size_t kPlacesAtOnce = 32;  // places found, and their records asked for, before any is summed up
constexpr std::size_t kCacheLine = 16;  // floats

void ask_for(const float* record) {
    for (std::size_t i = 0; i < kRecord; i += kCacheLine) __builtin_prefetch(record + i);
}

/// Eight numbers in one register, or in two where registers are shorter.
using PlaceLanes = float __attribute__((vector_size(32), aligned(4), may_alias));
constexpr std::size_t kPlaceLanes = 8;
static_assert(kRow % kPlaceLanes == 0);

/// The eight corners of a cell: where their records lie, and how much each part counts.
struct Corners {
    std::array<const float*, 8> record;
    std::array<Vec4, 8> weights;
};

// Sums stay in registers. Contraction is off, so that both forms below round alike.
__attribute__((always_inline)) inline void sum_up(const Corners& corners, float* to) {
    for (std::size_t block = 0; block < kRow; block += kPlaceLanes) {
        PlaceLanes sum{};
        for (std::size_t corner = 0; corner < 8; ++corner)
            for (std::size_t part = 0; part < 4; ++part)
                sum += corners.weights[corner][glm::length_t(part)] *
                       *reinterpret_cast<const PlaceLanes*>(corners.record[corner] + part * kRow + block);
        *reinterpret_cast<PlaceLanes*>(to + block) = sum;
    }
}

using SumUp = void (*)(const Corners&, float*);
void sum_up_anywhere(const Corners& corners, float* to) {
    sum_up(corners, to);
}
#ifdef __x86_64__
__attribute__((target("avx2"))) void sum_up_avx2(const Corners& corners, float* to) {
    sum_up(corners, to);
}
SumUp best_sum_up() {
    return __builtin_cpu_supports("avx2") ? sum_up_avx2 : sum_up_anywhere;
}
#else
SumUp best_sum_up() {
    return sum_up_anywhere;
}
#endif

using Row = std::array<float, kRow>;

Rgb coefficient(const Row& sh, std::size_t i) {
    return {sh[3 * i], sh[3 * i + 1], sh[3 * i + 2]};
}

Rgb shaded(const Row& sh, const Vec3& normal) {
    const glsl::Sh9 lobe = glsl::sh_irradiance_weights(normal);
    Rgb sum(0.0f);
    for (std::size_t i = 0; i < 9; ++i) sum += lobe.c[i] * coefficient(sh, i);
    return glsl::volume_held(sum, lobe.c[0] * coefficient(sh, 0));
}

/// The first band alone changes its sign from side to side.
TwoSided shaded_on_both(const Row& sh, const Vec3& normal) {
    const glsl::Sh9 lobe = glsl::sh_irradiance_weights(normal);
    const Rgb mean = lobe.c[0] * coefficient(sh, 0);
    Rgb even = mean, odd(0.0f);
    for (std::size_t i = 1; i < 4; ++i) odd += lobe.c[i] * coefficient(sh, i);
    for (std::size_t i = 4; i < 9; ++i) even += lobe.c[i] * coefficient(sh, i);
    return {glsl::volume_held(even + odd, mean), glsl::volume_held(even - odd, mean)};
}

}  // namespace

VolumeBatch::VolumeBatch(const VolumeLight& light) : tree_(light.tree()), rows_(kRecord * tree_.records(), 0.0f) {
    const std::span<const Vec4> records = light.records();
    for (std::size_t i = 0; i < records.size(); ++i)
        for (std::size_t part = 0; part < 4; ++part)
            rows_[i / glsl::kVolumeNumbers * kRecord + part * kRow + i % glsl::kVolumeNumbers] =
                records[i][glm::length_t(part)];
}

template <class Use>
void VolumeBatch::look_up(std::span<const Vec3> places, const Use& use) const {
    const glsl::VolumeArrays arrays{tree_.grid(), tree_.nodes.data(), tree_.cells.data(), tree_.cuts.data(), nullptr};
    const SumUp sum_up_here = best_sum_up();
    std::array<glsl::VolumePlace, kPlacesAtOnce> found;
    for (std::size_t first = 0; first < places.size(); first += kPlacesAtOnce) {
        const std::size_t count = std::min(kPlacesAtOnce, places.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            found[i] = glsl::volume_place(arrays, places[first + i]);
            const glsl::VolumeCell& cell = tree_.cells[found[i].cell];
            for (int corner = 0; corner < 8; ++corner) ask_for(rows_.data() + kRecord * record_of(cell, corner));
        }
        for (std::size_t i = 0; i < count; ++i) {
            const glsl::VolumeCell& cell = tree_.cells[found[i].cell];
            Corners corners;
            for (int corner = 0; corner < 8; ++corner) {
                corners.record[std::size_t(corner)] = rows_.data() + kRecord * record_of(cell, corner);
                corners.weights[std::size_t(corner)] = glsl::volume_corner_weights(corner, found[i].t, cell.box.w);
            }
            Row sum;
            sum_up_here(corners, sum.data());
            use(first + i, sum);
        }
    }
}

void VolumeBatch::irradiance(std::span<const Vec3> places, std::span<const Vec3> normals, std::span<Rgb> out) const {
    look_up(places, [&](std::size_t i, const Row& sh) { out[i] = shaded(sh, normals[i]); });
}

void VolumeBatch::two_sided(std::span<const Vec3> places, std::span<const Vec3> normals,
                            std::span<TwoSided> out) const {
    look_up(places, [&](std::size_t i, const Row& sh) { out[i] = shaded_on_both(sh, normals[i]); });
}

}  // namespace daylit
