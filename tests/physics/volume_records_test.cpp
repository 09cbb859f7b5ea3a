// What storing an irradiance volume's records in steps does to its light.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random.h"
#include "engine/base/units.h"
#include "gi/encode/volume_records.h"
#include "shaders/shared/sh.h"
#include "tests/support/volume_builder.h"

namespace daylit {
namespace {

constexpr std::size_t kComponents = 12;

struct Stored {
    IrradianceVolume volume;
    std::vector<float> records;  // as store_records() takes them

    float record(std::size_t s, std::size_t part, std::size_t i, std::size_t r) const {
        return records[((s * 4 + part) * kRecordNumbers + i) * kComponents + r];
    }
    float value(std::size_t s, std::size_t i, std::size_t r) const {
        return float(volume.values[(r * kRecordNumbers + i) * volume.tree.samples + s]) *
               volume.value_step[i % 3 * volume.tree.samples + s] * band_step(i);
    }
    float change(std::size_t s, std::size_t axis, std::size_t i, std::size_t r) const {
        return float(volume.changes[((r * 3 + axis) * kRecordNumbers + i) * volume.tree.samples + s]) *
               change_step(s, i);
    }
    float change_step(std::size_t s, std::size_t i) const {
        return volume.change_step[i % 3 * volume.tree.samples + s] * band_step(i);
    }
    /// Error of irradiance over irradiance, both RMS over normals, channels and components.
    double noise(std::size_t s) const {
        double wrong = 0.0, all = 0.0;
        Random random(3, s, 0);
        for (int n = 0; n < 200; ++n) {
            const float z = 1.0f - 2.0f * random.next(), angle = float(2.0 * kPi) * random.next(),
                        ring = std::sqrt(1.0f - z * z);
            const glsl::Sh9 lobe = glsl::sh_irradiance_weights(Vec3(ring * std::cos(angle), ring * std::sin(angle), z));
            for (std::size_t channel = 0; channel < 3; ++channel)
                for (std::size_t r = 0; r < kComponents; ++r) {
                    double e = 0.0, is = 0.0;
                    for (std::size_t c = 0; c < 9; ++c) {
                        const std::size_t i = 3 * c + channel;
                        e += double(lobe.c[c]) * double(value(s, i, r) - record(s, 0, i, r));
                        is += double(lobe.c[c]) * double(record(s, 0, i, r));
                    }
                    wrong += e * e, all += is * is;
                }
        }
        return std::sqrt(wrong / all);
    }
};

/// A row of cells, each corner ten times as bright as the one before, components that fade.
Stored stored(float noise) {
    Stored made;
    made.volume = volume_of(Vec3(0.0f), {3, 1, 1}, [](int, int, int) { return 1.0f; });
    made.volume.basis.components = int(kComponents);
    Random random(5, 0, 0);
    for (std::uint32_t s = 0; s < made.volume.tree.samples; ++s)
        for (std::size_t part = 0; part < 4; ++part)
            for (std::size_t i = 0; i < kRecordNumbers; ++i)
                for (std::size_t r = 0; r < kComponents; ++r)
                    made.records.push_back(std::pow(10.0f, float(s % 4)) * std::exp2(-float(r)) *
                                           ((part == 0 && i < 3 ? 3.0f : 0.0f) + random.next() - 0.5f));
    store_records(made.records, noise, made.volume);
    return made;
}

TEST(VolumeRecords, RoundingErrsByTheShareThatIsAskedFor) {
    for (const float noise : {0.02f, 0.002f}) {
        const Stored made = stored(noise);
        double square = 0.0;
        for (std::size_t s = 0; s < made.volume.tree.samples; ++s) square += std::pow(made.noise(s), 2);
        const double mean = std::sqrt(square / made.volume.tree.samples);
        EXPECT_LT(mean, 1.15 * double(noise));
        EXPECT_GT(mean, 0.6 * double(noise));  // small components are rounded to none, which errs by less
    }
}

TEST(VolumeRecords, DarkCornersBesideBrightOnesKeepTheirLight) {
    const Stored made = stored(0.002f);
    for (std::size_t s = 0; s < made.volume.tree.samples; ++s) EXPECT_LT(made.noise(s), 0.004) << "record " << s;
}

TEST(VolumeRecords, ChangesArriveWithinHalfAStep) {
    const Stored made = stored(0.002f);
    for (std::size_t s = 0; s < made.volume.tree.samples; ++s)
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t i = 0; i < kRecordNumbers; ++i)
                for (std::size_t r = 0; r < kComponents; ++r)
                    ASSERT_NEAR(made.change(s, axis, i, r), made.record(s, axis + 1, i, r),  // cells of a metre
                                0.501 * double(made.change_step(s, i)));
}

// Floats whose low bytes are zero, that is.
TEST(VolumeRecords, StepsAreOneOfEightAnOctave) {
    const Stored made = stored(0.002f);
    for (const std::vector<float>* steps : {&made.volume.value_step, &made.volume.change_step})
        for (const float step : *steps) {
            int exponent = 0;
            const float sixteenths = 16.0f * std::frexp(step, &exponent);
            EXPECT_EQ(sixteenths, std::floor(sixteenths)) << step;
        }
}

TEST(VolumeRecords, LightThatOneStepCannotSpanTakesALargerOneAndNoLightTakesNone) {
    Stored made = stored(0.002f);
    std::fill(made.records.begin(), made.records.end(), 0.0f);
    made.records[4 * kRecordNumbers * kComponents] = 1e30f;  // of record 1
    store_records(made.records, 1e-9f, made.volume);
    EXPECT_EQ(made.volume.value_step[0], 0.0f);
    EXPECT_NEAR(made.value(1, 0, 0) / 1e30f, 1.0, 2e-5);  // half of the smallest step that spans it
}

}  // namespace
}  // namespace daylit
