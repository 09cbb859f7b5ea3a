#include "engine/base/exposure.h"

#include <algorithm>
#include <cmath>

#include "shaders/shared/tonemap.h"

namespace daylit {
namespace {

constexpr float kDarkest = 1e-4f;     // cd/m^2; a moonless night
constexpr double kLeastEv = -3.0;     // a landscape under a half moon
constexpr double kMeter = 12.5;       // reflected-light meter calibration constant K, ISO 2720
constexpr double kCutShare = 0.1;     // of the pixels, at either end
constexpr double kSaturation = 1.2;   // ISO 12232: 78 / (100 * 0.65)

/// Black pixels say nothing about how bright the picture should be: in one layer of light, or without baked light, they
/// can be most of it, and would open the exposure until all else is white.
std::vector<float> metered_luminances(const Image& radiance) {
    std::vector<float> values;
    values.reserve(radiance.pixels.size());
    for (const Rgb& pixel : radiance.pixels) {
        const float value = luminance(pixel);
        if (std::isfinite(value) && value > kDarkest) values.push_back(value);
    }
    return values;
}

double log_average_of_middle(std::vector<float> values) {
    if (values.empty()) return kDarkest;
    const auto cut = std::ptrdiff_t(kCutShare * double(values.size()));
    const auto first = values.begin() + cut, last = values.end() - cut;
    std::nth_element(values.begin(), first, values.end());
    if (cut > 0) std::nth_element(first, last, values.end());
    double sum = 0;
    for (auto value = first; value != last; ++value) sum += std::log(double(*value));
    return std::exp(sum / double(last - first));
}

}  // namespace

double auto_ev(const Image& radiance) {
    return std::max(kLeastEv, std::log2(log_average_of_middle(metered_luminances(radiance)) * 100.0 / kMeter));
}

double exposure_from_ev(double ev) {
    return 1.0 / (kSaturation * std::exp2(ev));
}

Image tonemap(const Image& radiance, double ev) {
    const float exposure = float(exposure_from_ev(ev));
    Image shown = radiance;
    for (Rgb& pixel : shown.pixels) pixel = glsl::filmic(pixel * exposure);
    return shown;
}

}  // namespace daylit
