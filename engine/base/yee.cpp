#include "engine/base/yee.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace daylit {
namespace {

constexpr double kWhiteLuminance = 100.0;  // cd/m^2
constexpr int kLevels = 8, kBands = kLevels - 2;
constexpr double kLowestElevation = 1.0, kHighestElevation = 10.0;  // of the threshold by masking

using Plane = std::vector<float>;

/// Burt and Adelson's Gaussian pyramid kept at full size: level n blurs level n - 1 with taps 2^(n-1) pixels apart.
Plane blurred(const Plane& in, int width, int height, int spacing) {
    constexpr std::array<float, 5> kTaps = {0.05f, 0.25f, 0.4f, 0.25f, 0.05f};
    Plane rows(in.size()), out(in.size());
    const auto at = [width](int x, int y) { return std::size_t(y) * std::size_t(width) + std::size_t(x); };
    tbb::parallel_for(0, height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            float sum = 0;
            for (int i = 0; i < 5; ++i) {
                sum += kTaps[std::size_t(i)] * in[at(std::clamp(x + (i - 2) * spacing, 0, width - 1), y)];
            }
            rows[at(x, y)] = sum;
        }
    });
    tbb::parallel_for(0, height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            float sum = 0;
            for (int i = 0; i < 5; ++i) {
                sum += kTaps[std::size_t(i)] * rows[at(x, std::clamp(y + (i - 2) * spacing, 0, height - 1))];
            }
            out[at(x, y)] = sum;
        }
    });
    return out;
}

std::array<Plane, kLevels> luminance_pyramid(const Image& image) {
    std::array<Plane, kLevels> levels;
    for (const Rgb& pixel : image.pixels) levels[0].push_back(float(kWhiteLuminance) * luminance(pixel));
    for (int i = 1; i < kLevels; ++i) {
        levels[std::size_t(i)] = blurred(levels[std::size_t(i - 1)], image.width, image.height, 1 << (i - 1));
    }
    return levels;
}

/// Barten 1989, at a frequency in cycles per degree and an adapting luminance in cd/m^2.
double contrast_sensitivity(double frequency, double adaptation) {
    const double a = 440.0 * std::pow(1.0 + 0.7 / adaptation, -0.2);
    const double b = 0.3 * std::pow(1.0 + 100.0 / adaptation, 0.15);
    return a * frequency * std::exp(-b * frequency) * std::sqrt(1.0 + 0.06 * std::exp(b * frequency));
}

/// Daly 1993: how much a contrast hides others of its frequency.
double masking(double contrast) {
    return std::pow(1.0 + std::pow(0.0153 * std::pow(392.498 * contrast, 0.7), 4.0), 0.25);
}

/// Ward Larson et al. 1997: the smallest visible difference in cd/m^2.
double threshold(double adaptation) {
    const double log_a = std::log10(adaptation);
    double log_t = log_a - 1.255;
    if (log_a < -3.94) {
        log_t = -2.86;
    } else if (log_a < -1.44) {
        log_t = std::pow(0.405 * log_a + 1.6, 2.18) - 2.86;
    } else if (log_a < -0.0184) {
        log_t = log_a - 0.395;
    } else if (log_a < 1.9) {
        log_t = std::pow(0.249 * log_a + 0.65, 2.7) - 0.72;
    }
    return std::pow(10.0, log_t);
}

/// CIELAB's a* and b*.
Vec2 chroma(const Rgb& rgb) {
    const double x = (0.4124564 * rgb.r + 0.3575761 * rgb.g + 0.1804375 * rgb.b) / 0.9504700;
    const double y = 0.2126729 * rgb.r + 0.7151522 * rgb.g + 0.0721750 * rgb.b;
    const double z = (0.0193339 * rgb.r + 0.1191920 * rgb.g + 0.9503041 * rgb.b) / 1.0888300;
    const auto f = [](double t) { return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0; };
    return Vec2(500.0 * (f(x) - f(y)), 200.0 * (f(y) - f(z)));
}

}  // namespace

std::vector<unsigned char> yee_visible(const Image& a, const Image& b, double pixels_per_degree) {
    assert(a.width == b.width && a.height == b.height && "yee_visible() compares pictures of one size");
    const std::array<Plane, kLevels> levels_a = luminance_pyramid(a), levels_b = luminance_pyramid(b);
    std::array<double, kBands> frequency, weight;
    for (int i = 0; i < kBands; ++i) {
        frequency[std::size_t(i)] = 0.5 * pixels_per_degree / (1 << i);
        weight[std::size_t(i)] =
            contrast_sensitivity(3.248, 100.0) / contrast_sensitivity(frequency[std::size_t(i)], 100.0);
    }
    // The eye adapts to about one degree.
    const int adapting = std::clamp(int(std::log2(std::max(pixels_per_degree, 1.0))), 0, kLevels - 1);

    std::vector<unsigned char> visible(a.pixels.size());
    tbb::parallel_for(std::size_t(0), visible.size(), [&](std::size_t p) {
        const double adaptation =
            std::max(0.5 * (levels_a[std::size_t(adapting)][p] + levels_b[std::size_t(adapting)][p]), 1e-5);
        const double lightness = std::abs(levels_a[0][p] - levels_b[0][p]) / threshold(adaptation);
        const double by_night = adaptation < 10.0 ? 0.01 : 1.0;  // hue is hardly seen in the dark
        const Vec2 hue = chroma(a.pixels[p]) - chroma(b.pixels[p]);
        const double difference = std::max(lightness, by_night * double(glm::dot(hue, hue)));
        if (difference <= kLowestElevation || difference > kHighestElevation) {
            visible[p] = difference > kHighestElevation;
            return;
        }
        // Contrasts nearby raise the threshold.
        double sum = 0, weighted = 0;
        for (std::size_t i = 0; i < std::size_t(kBands); ++i) {
            const double band = std::max(std::abs(levels_a[i][p] - levels_a[i + 1][p]),
                                         std::abs(levels_b[i][p] - levels_b[i + 1][p]));
            const double mean = std::max({levels_a[i + 2][p], levels_b[i + 2][p], 1e-5f});
            const double contrast = band / mean;
            sum += contrast;
            weighted += contrast * weight[i] * masking(contrast * contrast_sensitivity(frequency[i], adaptation));
        }
        const double elevation = std::clamp(weighted / std::max(sum, 1e-5), kLowestElevation, kHighestElevation);
        visible[p] = difference > elevation;
    });
    return visible;
}

}  // namespace daylit
