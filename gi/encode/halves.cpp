#include "gi/encode/halves.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

namespace daylit {
namespace {

// Far from the end of halves (65504), and far above their smallest normal number (6e-5).
constexpr float kLargestHalf = 16384.0f;

}  // namespace

std::vector<float> component_scales(std::span<const Rgb> values, int components) {
    std::vector<float> largest(std::size_t(components), 0.0f);
    for (std::size_t i = 0; i < values.size(); ++i)
        for (int c = 0; c < 3; ++c)
            largest[i % std::size_t(components)] =
                std::max(largest[i % std::size_t(components)], std::abs(values[i][c]));
    for (float& l : largest) l = l > 0.0f ? l / kLargestHalf : 1.0f;
    return largest;
}

std::vector<std::uint16_t> to_halves(std::span<const Rgb> values, std::span<const float> scales) {
    std::vector<std::uint16_t> halves(3 * values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        for (int c = 0; c < 3; ++c)
            halves[3 * i + std::size_t(c)] = glm::packHalf1x16(values[i][c] / scales[i % scales.size()]);
    return halves;
}

}  // namespace daylit
