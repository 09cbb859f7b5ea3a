#include "gi/encode/volume_records.h"

#include <algorithm>
#include <cmath>

#include "engine/base/units.h"
#include "shaders/shared/sh.h"

namespace daylit {
namespace {

constexpr float kMostValue = 32767.0f, kMostChange = 127.0f;
// What errors of one step of its band in every coefficient do to irradiance, RMS over normals: the root of the sum over
// the nine of (kShCosine * band_step)^2, over 4 pi.
constexpr float kLobeNorm = 2.983f;
// Inside a cell the changes of its corners weigh, RMS, 0.30 of what their values do (Hermite's h10 against h00, along
// one of three axes, three of them): steps larger by 3.4 would add as much noise. But changes are three times as many
// and most of them within a step or two, where a larger step saves most bits: three times that takes 27 % of the bytes
// for 1 to 5 % of error (two_rooms and the demo level), which values do not give.
constexpr float kChangeSteps = 10.0f;

/// No smaller, eight an octave: as floats of the file, steps of any mantissa were a tenth of a preview's bytes.
float few_bits(float step) {
    int exponent = 0;
    const float mantissa = std::frexp(step, &exponent);
    return std::ldexp(std::ceil(16.0f * mantissa) / 16.0f, exponent);
}

long rounded(float steps, float most) {
    return std::lround(std::clamp(steps, -most, most));
}

/// One record's numbers.
class Record {
  public:
    Record(std::span<const float> all, std::size_t record, std::size_t components)
        : first_(all.data() + record * 4 * kRecordNumbers * components), components_(components) {}

    float at(std::size_t part, std::size_t i, std::size_t component) const {
        return first_[(part * kRecordNumbers + i) * components_ + component];
    }
    /// In steps of its band.
    float largest(std::size_t first_part, std::size_t last_part, std::size_t channel) const {
        float found = 0.0f;
        for (std::size_t part = first_part; part <= last_part; ++part)
            for (std::size_t i = channel; i < kRecordNumbers; i += 3)
                for (std::size_t r = 0; r < components_; ++r)
                    found = std::max(found, std::abs(at(part, i, r)) / band_step(i));
        return found;
    }
    /// Of irradiance, RMS over normals and moments.
    float brightness(std::size_t channel) const {
        double square = 0.0;
        for (std::size_t i = channel; i < kRecordNumbers; i += 3) {
            const float lobe = i < 3 ? glsl::kShCosine0 : i < 12 ? glsl::kShCosine1 : glsl::kShCosine2;
            for (std::size_t r = 0; r < components_; ++r) square += std::pow(double(lobe * at(0, i, r)), 2);
        }
        return float(std::sqrt(square / (4.0 * kPi)));
    }

  private:
    const float* first_;
    std::size_t components_;
};

}  // namespace

void store_records(std::span<const float> records, float noise, IrradianceVolume& volume) {
    const std::size_t components = std::size_t(volume.basis.components), count = volume.tree.samples;
    const std::vector<float> sides = record_sides(volume.tree);
    volume.values.assign(components * kRecordNumbers * count, 0);
    volume.changes.assign(3 * components * kRecordNumbers * count, 0);
    volume.value_step.assign(3 * count, 0.0f);
    volume.change_step.assign(3 * count, 0.0f);
    // Rounding to steps errs by step / sqrt(12), in every component alike.
    const float share = noise * std::sqrt(12.0f / float(std::max<std::size_t>(components, 1))) / kLobeNorm;
    for (std::size_t s = 0; s < count; ++s)
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const Record record(records, s, components);
            const float step =
                few_bits(std::max(share * record.brightness(channel), record.largest(0, 0, channel) / kMostValue));
            const float change_step =
                few_bits(std::max(kChangeSteps * step, record.largest(1, 3, channel) * sides[s] / kMostChange));
            if (!(change_step > 0.0f)) continue;
            volume.value_step[channel * count + s] = step;
            volume.change_step[channel * count + s] = change_step;
            for (std::size_t r = 0; r < components; ++r)
                for (std::size_t i = channel; i < kRecordNumbers; i += 3) {
                    const float band = band_step(i);
                    if (step > 0.0f)
                        volume.values[(r * kRecordNumbers + i) * count + s] =
                            std::int16_t(rounded(record.at(0, i, r) / (step * band), kMostValue));
                    for (std::size_t a = 0; a < 3; ++a)
                        volume.changes[((r * 3 + a) * kRecordNumbers + i) * count + s] =
                            std::int8_t(rounded(record.at(a + 1, i, r) * sides[s] / (change_step * band), kMostChange));
                }
        }
}

}  // namespace daylit
