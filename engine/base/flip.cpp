#include "engine/base/flip.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace daylit {
namespace {

// Section 4: exponents, and how the colour difference is spread over [0,1].
constexpr double kColorExponent = 0.7, kFeatureExponent = 0.5;
constexpr double kCut = 0.4, kCutValue = 0.95;
constexpr double kFeatureWidth = 0.082;  // degrees, of the edge and point detectors

// D65 as the sum of the columns of the matrix below, so that white is exactly neutral.
const glm::dmat3 kXyzFromRgb(0.4124564, 0.2126729, 0.0193339, 0.3575761, 0.7151522, 0.1191920, 0.1804375, 0.0721750,
                             0.9503041);
const glm::dmat3 kRgbFromXyz = glm::inverse(kXyzFromRgb);
const glm::dvec3 kWhite = kXyzFromRgb * glm::dvec3(1.0);

using Plane = std::vector<float>;

float unit_or_zero(float value) {
    return value >= 0.0f ? std::min(value, 1.0f) : 0.0f;  // NaN too
}

// ---- Colour spaces ----

/// Opponent space of the contrast sensitivity functions: luminance, red-green, blue-yellow.
Vec3 opponent_from_rgb(const Rgb& rgb) {
    const glm::dvec3 c = kXyzFromRgb * glm::dvec3(rgb) / kWhite;
    return Vec3(116.0 * c.y - 16.0, 500.0 * (c.x - c.y), 200.0 * (c.y - c.z));
}

Rgb rgb_from_opponent(const Vec3& opponent) {
    const double y = (double(opponent.x) + 16.0) / 116.0;
    const glm::dvec3 c(y + double(opponent.y) / 500.0, y, y - double(opponent.z) / 200.0);
    return Rgb(kRgbFromXyz * (c * kWhite));
}

/// CIELAB with its chroma scaled by lightness, for the Hunt effect (section 4.1.2).
glm::dvec3 hunt_lab_from_rgb(const Rgb& rgb) {
    const glm::dvec3 c = kXyzFromRgb * glm::dvec3(rgb) / kWhite;
    const auto f = [](double t) {
        constexpr double kDelta = 6.0 / 29.0;
        return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
    };
    const double lightness = 116.0 * f(c.y) - 16.0;
    return {lightness, 0.01 * lightness * 500.0 * (f(c.x) - f(c.y)), 0.01 * lightness * 200.0 * (f(c.y) - f(c.z))};
}

/// City-block in lightness, Euclidean in chroma (Abasi et al. 2020).
double hyab(const glm::dvec3& a, const glm::dvec3& b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

// ---- Separable filters, borders repeated ----

struct Kernel {
    std::vector<float> taps;  // odd count, centred
    int radius() const { return int(taps.size() / 2); }
};

/// Scales positive and negative weights to sum to 1 and -1.
void normalise_halves(std::vector<double>& taps) {
    double positive = 0, negative = 0;
    for (const double tap : taps) (tap > 0 ? positive : negative) += std::abs(tap);
    for (double& tap : taps) {
        if (tap != 0.0) tap /= tap > 0 ? positive : negative;
    }
}

template <class Weight>
Kernel make_kernel(int radius, Weight weight) {
    std::vector<double> taps;
    for (int i = -radius; i <= radius; ++i) taps.push_back(weight(double(i)));
    normalise_halves(taps);
    return {std::vector<float>(taps.begin(), taps.end())};
}

Kernel gaussian(int radius, double deviation) {
    return make_kernel(radius, [&](double x) { return std::exp(-0.5 * x * x / (deviation * deviation)); });
}

Plane convolve(const Plane& in, int width, int height, const Kernel& along_x, const Kernel& along_y) {
    Plane rows(in.size()), out(in.size());
    tbb::parallel_for(0, height, [&](int y) {
        const float* source = &in[std::size_t(y) * std::size_t(width)];
        float* target = &rows[std::size_t(y) * std::size_t(width)];
        const int r = along_x.radius();
        for (int x = 0; x < width; ++x) {
            float sum = 0;
            for (int i = -r; i <= r; ++i) {
                sum += along_x.taps[std::size_t(i + r)] * source[std::clamp(x + i, 0, width - 1)];
            }
            target[x] = sum;
        }
    });
    tbb::parallel_for(0, height, [&](int y) {
        float* target = &out[std::size_t(y) * std::size_t(width)];
        const int r = along_y.radius();
        for (int i = -r; i <= r; ++i) {
            const float weight = along_y.taps[std::size_t(i + r)];
            const float* source = &rows[std::size_t(std::clamp(y + i, 0, height - 1)) * std::size_t(width)];
            for (int x = 0; x < width; ++x) target[x] += weight * source[x];
        }
    });
    return out;
}

// ---- The colour pipeline ----

/// Contrast sensitivity as a sum of two Gaussians in degrees (table 1 of the paper): a sqrt(pi/b) exp(-pi^2 x^2 / b).
struct Sensitivity {
    double a1, b1, a2, b2;
};
constexpr Sensitivity kLuminanceSensitivity{1.0, 0.0047, 0.0, 1e-5};
constexpr Sensitivity kRedGreenSensitivity{1.0, 0.0053, 0.0, 1e-5};
constexpr Sensitivity kBlueYellowSensitivity{34.1, 0.04, 13.5, 0.025};
constexpr double kWidestScale = 0.04;

/// Filters with the two-dimensional kernel, normalised to sum 1: each Gaussian is separable, their sum is not.
Plane blur(const Plane& in, int width, int height, const Sensitivity& s, double ppd) {
    const int radius = int(std::ceil(3.0 * std::sqrt(kWidestScale / (2.0 * kPi * kPi)) * ppd));
    const auto deviation = [ppd](double b) { return std::sqrt(b / (2.0 * kPi * kPi)) * ppd; };
    const auto mass = [&](double a, double b) {  // of one Gaussian over the grid, before normalising
        double line = 0;
        for (int i = -radius; i <= radius; ++i) line += std::exp(-0.5 * i * i / (deviation(b) * deviation(b)));
        return a * std::sqrt(kPi / b) * line * line;
    };
    const double mass1 = mass(s.a1, s.b1), mass2 = mass(s.a2, s.b2);
    const Kernel first = gaussian(radius, deviation(s.b1));
    Plane out = convolve(in, width, height, first, first);
    if (mass2 <= 0.0) return out;
    const Kernel second = gaussian(radius, deviation(s.b2));
    const Plane other = convolve(in, width, height, second, second);
    const float share1 = float(mass1 / (mass1 + mass2)), share2 = float(mass2 / (mass1 + mass2));
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = share1 * out[i] + share2 * other[i];
    return out;
}

struct Opponent {
    Plane luminance, red_green, blue_yellow;
};

Opponent opponent_planes(const Image& image) {
    const std::size_t count = image.pixels.size();
    Opponent planes{Plane(count), Plane(count), Plane(count)};
    for (std::size_t i = 0; i < count; ++i) {
        const Rgb& p = image.pixels[i];
        const Vec3 c = opponent_from_rgb(Rgb(unit_or_zero(p.r), unit_or_zero(p.g), unit_or_zero(p.b)));
        planes.luminance[i] = c.x;
        planes.red_green[i] = c.y;
        planes.blue_yellow[i] = c.z;
    }
    return planes;
}

std::vector<glm::dvec3> perceived(const Opponent& planes, int width, int height, double ppd) {
    const Plane y = blur(planes.luminance, width, height, kLuminanceSensitivity, ppd);
    const Plane rg = blur(planes.red_green, width, height, kRedGreenSensitivity, ppd);
    const Plane by = blur(planes.blue_yellow, width, height, kBlueYellowSensitivity, ppd);
    std::vector<glm::dvec3> lab(y.size());
    tbb::parallel_for(std::size_t(0), y.size(), [&](std::size_t i) {
        const Rgb rgb = rgb_from_opponent(Vec3(y[i], rg[i], by[i]));
        lab[i] = hunt_lab_from_rgb(glm::clamp(rgb, Rgb(0.0f), Rgb(1.0f)));
    });
    return lab;
}

/// The largest difference there is, between green and blue.
double largest_color_difference() {
    return std::pow(hyab(hunt_lab_from_rgb(Rgb(0, 1, 0)), hunt_lab_from_rgb(Rgb(0, 0, 1))), kColorExponent);
}

double color_difference(const glm::dvec3& a, const glm::dvec3& b, double largest) {
    const double difference = std::pow(hyab(a, b), kColorExponent);
    const double cut = kCut * largest;
    if (difference < cut) return kCutValue / cut * difference;
    return kCutValue + (difference - cut) / (largest - cut) * (1.0 - kCutValue);
}

// ---- The feature pipeline ----

struct Features {
    Plane edges, points;
};

Plane gradient_length(const Plane& in, int width, int height, const Kernel& derivative, const Kernel& across) {
    const Plane x = convolve(in, width, height, derivative, across);
    const Plane y = convolve(in, width, height, across, derivative);
    Plane length(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) length[i] = std::hypot(x[i], y[i]);
    return length;
}

Features features(const Plane& luminance, int width, int height, double ppd) {
    const double deviation = 0.5 * kFeatureWidth * ppd;
    const int radius = int(std::ceil(3.0 * deviation));
    const double variance = deviation * deviation;
    const auto bell = [&](double x) { return std::exp(-0.5 * x * x / variance); };
    const Kernel across = gaussian(radius, deviation);
    const Kernel first = make_kernel(radius, [&](double x) { return -x * bell(x); });
    const Kernel second = make_kernel(radius, [&](double x) { return (x * x / variance - 1.0) * bell(x); });
    Plane grey(luminance.size());
    for (std::size_t i = 0; i < grey.size(); ++i) grey[i] = (luminance[i] + 16.0f) / 116.0f;
    return {gradient_length(grey, width, height, first, across), gradient_length(grey, width, height, second, across)};
}

}  // namespace

std::vector<float> flip(const Image& a, const Image& b, double pixels_per_degree) {
    assert(a.width == b.width && a.height == b.height && "flip() compares pictures of one size");
    const int width = a.width, height = a.height;
    if (a.empty()) return {};
    const Opponent planes_a = opponent_planes(a), planes_b = opponent_planes(b);
    const std::vector<glm::dvec3> lab_a = perceived(planes_a, width, height, pixels_per_degree);
    const std::vector<glm::dvec3> lab_b = perceived(planes_b, width, height, pixels_per_degree);
    const Features features_a = features(planes_a.luminance, width, height, pixels_per_degree);
    const Features features_b = features(planes_b.luminance, width, height, pixels_per_degree);
    const double largest = largest_color_difference();

    std::vector<float> result(a.pixels.size());
    tbb::parallel_for(std::size_t(0), result.size(), [&](std::size_t i) {
        const double color = color_difference(lab_a[i], lab_b[i], largest);
        const double feature = std::max(std::abs(features_a.edges[i] - features_b.edges[i]),
                                        std::abs(features_a.points[i] - features_b.points[i]));
        const double strength = std::pow(std::min(feature / std::sqrt(2.0), 1.0), kFeatureExponent);
        result[i] = float(std::pow(color, 1.0 - strength));
    });
    return result;
}

}  // namespace daylit
