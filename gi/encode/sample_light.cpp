#include "gi/encode/sample_light.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace daylit {
namespace {

constexpr float kMost = 32767.0f;

std::size_t runs_of(std::size_t numbers) {
    return (numbers + SampleLight::kRun - 1) / SampleLight::kRun;
}

float largest(std::span<const float> numbers) {
    float most = 0.0f;
    for (const float number : numbers) most = std::max(most, std::abs(number));
    return most;
}

}  // namespace

SampleLight::SampleLight(std::span<const float> light, std::size_t parts)
    : numbers_(light.size() / parts), values_(light.size(), 0) {
    steps_.reserve(parts * runs_of(numbers_));
    for (std::size_t part = 0; part < parts; ++part)
        for (std::size_t first = 0; first < numbers_; first += kRun) {
            const std::size_t at = part * numbers_ + first, count = std::min(kRun, numbers_ - first);
            const float step = largest(light.subspan(at, count)) / kMost;
            steps_.push_back(step);
            if (!(step > 0.0f)) continue;
            for (std::size_t i = at; i < at + count; ++i)
                values_[i] = std::int16_t(std::lrint(std::clamp(light[i] / step, -kMost, kMost)));
        }
}

void SampleLight::read(std::size_t part, std::size_t first, std::span<double> to) const {
    assert(first % kRun == 0 && first + to.size() <= numbers_);
    for (std::size_t i = 0; i < to.size(); i += kRun) {
        const double step = double(steps_[part * runs_of(numbers_) + (first + i) / kRun]);
        const std::int16_t* from = values_.data() + part * numbers_ + first + i;
        for (std::size_t j = i; j < std::min(i + kRun, to.size()); ++j) to[j] = step * double(*from++);
    }
}

}  // namespace daylit
