#include "engine/baked/light_basis_bytes.h"

#include <algorithm>
#include <array>

#include "engine/baked/integer_coding.h"

namespace daylit {
namespace {

constexpr std::uint32_t kMostComponents = 128, kMostKeyframes = 4096;

/// None, one for all day, or one a keyframe.
std::size_t get_columns(ByteReader& r, std::size_t keyframes, const char* what) {
    const std::size_t count = r.number<std::uint32_t>(0, kMostKeyframes, what);
    if (count > 1 && count != keyframes) r.fail(std::string(what) + " is not that of keyframes");
    return count;
}

/// Columns of S and of K: each has a step of its own.
struct Group {
    std::size_t first, count;
};
std::array<Group, 2> groups_of(const LightBasis& basis) {
    return {Group{0, basis.suns}, Group{basis.suns, basis.skies}};
}

/// A power of two, so that rounding again finds the same.
float step_of(const float* values, std::size_t count) {
    float largest = 0.0f;
    for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, std::abs(values[i]));
    // What is smaller than any light counts as none; its step would fall below the least float.
    return largest > 1e-30f ? std::exp2(std::ceil(std::log2(largest / 32767.0f))) : 1.0f;
}

}  // namespace

LightBasis rounded(LightBasis basis) {
    for (std::size_t r = 0; r < std::size_t(basis.components); ++r)
        for (const Group& group : groups_of(basis)) {
            float* curve = basis.curves.data() + r * basis.columns() + group.first;
            const float step = step_of(curve, group.count);
            for (std::size_t k = 0; k < group.count; ++k) curve[k] = std::round(curve[k] / step) * step;
        }
    return basis;
}

void put_basis(ByteWriter& w, const LightBasis& basis) {
    w.put(std::uint32_t(basis.components)), w.put(std::uint32_t(basis.hours.size()));
    w.put(std::uint32_t(basis.suns)), w.put(std::uint32_t(basis.skies));
    w.put_all(basis.hours), w.put_all(basis.sky_level);
    std::vector<float> steps, stills;
    std::vector<std::int16_t> curves;  // from keyframe to keyframe
    for (std::size_t r = 0; r < std::size_t(basis.components); ++r) {
        const float* row = basis.curves.data() + r * basis.columns();
        for (const Group& group : groups_of(basis)) {
            const float* curve = row + group.first;
            steps.push_back(step_of(curve, group.count));
            std::uint16_t before = 0;
            for (std::size_t k = 0; k < group.count; ++k) {
                const auto at = std::uint16_t(std::int16_t(std::lround(curve[k] / steps.back())));
                curves.push_back(std::int16_t(std::uint16_t(at - before)));
                before = at;
            }
        }
        stills.insert(stills.end(), row + basis.suns + basis.skies, row + basis.columns());
    }
    w.put_all(steps), w.put_all(stills);
    put_integers(w, curves);
}

LightBasis get_basis(ByteReader& r) {
    LightBasis basis;
    basis.components = int(r.number<std::uint32_t>(0, kMostComponents, "the number of components"));
    const std::size_t keyframes = r.number<std::uint32_t>(1, kMostKeyframes, "the number of keyframes");
    basis.suns = get_columns(r, keyframes, "the number of sun columns");
    basis.skies = get_columns(r, keyframes, "the number of sky columns");
    basis.hours = r.get_all<double>(keyframes);
    for (std::size_t i = 0; i < keyframes; ++i) {
        const double hour = basis.hours[i];
        if (!(hour >= 0.0 && hour <= 24.0) || (i > 0 && hour <= basis.hours[i - 1]))
            r.fail("has hours that do not ascend from 0 to 24");
    }
    basis.sky_level = r.get_all<float>(basis.skies);
    for (float level : basis.sky_level)
        if (!(level > 0.0f && std::isfinite(level))) r.fail("has a sky that is not brighter than black");
    const std::size_t components = std::size_t(basis.components);
    const std::vector<float> steps = r.get_all<float>(2 * components);
    const std::vector<float> stills = r.get_all<float>(kStillColumns * components);
    for (const std::vector<float>* numbers : {&steps, &stills})
        for (float number : *numbers)
            if (!std::isfinite(number)) r.fail("holds a curve that is not finite");
    const std::vector<std::int16_t> curves = get_integers(r, components * (basis.suns + basis.skies));
    const std::int16_t* next = curves.data();
    for (std::size_t k = 0; k < components; ++k) {
        for (std::size_t g = 0; g < 2; ++g) {
            std::uint16_t at = 0;
            for (std::size_t i = 0; i < groups_of(basis)[g].count; ++i) {
                at = std::uint16_t(at + std::uint16_t(*next++));
                basis.curves.push_back(float(std::int16_t(at)) * steps[2 * k + g]);
            }
        }
        basis.curves.insert(basis.curves.end(), stills.begin() + std::ptrdiff_t(k * kStillColumns),
                            stills.begin() + std::ptrdiff_t((k + 1) * kStillColumns));
    }
    return basis;
}

}  // namespace daylit
