#include "engine/base/compare.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "engine/base/flip.h"
#include "engine/base/yee.h"

namespace daylit {
namespace {

/// The value below which this share of the values lies; 0 when there are none.
double percentile(std::vector<float> values, double share) {
    if (values.empty()) return 0.0;
    const auto nth = values.begin() + std::ptrdiff_t(share * double(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

double ratio(double numerator, double denominator) {
    return numerator == 0.0 && denominator == 0.0 ? 0.0 : numerator / denominator;
}

std::size_t yee_failures_of_oiio(const Image& a, const Image& b) {
    const auto buffer = [](const Image& image) {
        return OIIO::ImageBuf(OIIO::ImageSpec(image.width, image.height, 3, OIIO::TypeDesc::FLOAT),
                              const_cast<Rgb*>(image.pixels.data()));  // wrapped, only read
    };
    OIIO::ImageBufAlgo::CompareResults results;
    constexpr float kDisplayLuminance = 100.0f;  // cd/m^2
    const float fov = std::min(float(a.width / kFlipPixelsPerDegree), 120.0f);
    return std::size_t(OIIO::ImageBufAlgo::compare_Yee(buffer(a), buffer(b), results, kDisplayLuminance, fov));
}

int code_difference(const Image& a, const Image& b) {
    int largest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const auto code = [c](const Rgb& p) { return int(std::lround(255.0f * encode_srgb(p[c]))); };
            largest = std::max(largest, std::abs(code(a.pixels[i]) - code(b.pixels[i])));
        }
    }
    return largest;
}

Image cleaned(Image image) {
    for (Rgb& p : image.pixels) {
        for (int c = 0; c < 3; ++c) p[c] = p[c] >= 0.0f ? std::min(p[c], 1.0f) : 0.0f;  // NaN becomes 0
    }
    return image;
}

}  // namespace

Differences differences(std::span<const Rgb> a, std::span<const Rgb> b) {
    assert(a.size() == b.size());
    Differences d;
    double sum_a = 0, sum_b = 0, squares = 0;
    std::vector<float> absolute;
    absolute.reserve(3 * a.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const double va = a[i][c], vb = b[i][c];
            d.nan_count += std::size_t(!std::isfinite(va)) + std::size_t(!std::isfinite(vb));
            if (!std::isfinite(va) || !std::isfinite(vb)) continue;
            sum_a += va;
            sum_b += vb;
            squares += (va - vb) * (va - vb);
            absolute.push_back(float(std::abs(va - vb)));
            d.max_abs = std::max(d.max_abs, std::abs(va - vb));
            d.largest = std::max(d.largest, vb);
        }
    }
    const double count = double(std::max<std::size_t>(absolute.size(), 1));
    d.mse = squares / count;
    d.rmse = std::sqrt(d.mse);
    d.nrmse = ratio(d.rmse, sum_b / count);
    d.bias = sum_a == sum_b ? 0.0 : sum_a / sum_b - 1.0;
    d.p95 = ratio(percentile(std::move(absolute), 0.95), sum_b / count);
    return d;
}

DisplayedDifferences displayed_differences(const Image& a, const Image& b) {
    assert(a.width == b.width && a.height == b.height);
    const Image shown_a = cleaned(a), shown_b = cleaned(b);
    DisplayedDifferences d;
    d.flip = flip(shown_a, shown_b);
    double sum = 0;
    for (const float value : d.flip) sum += value;
    d.flip_mean = sum / double(std::max<std::size_t>(d.flip.size(), 1));
    d.flip_p95 = percentile(d.flip, 0.95);
    const std::vector<unsigned char> visible = yee_visible(shown_a, shown_b, kFlipPixelsPerDegree);
    d.yee_failed = std::size_t(std::count(visible.begin(), visible.end(), 1));
    d.yee_failed_oiio = yee_failures_of_oiio(shown_a, shown_b);
    d.max_abs_8bit = code_difference(shown_a, shown_b);
    return d;
}

Rgb heat_color(float value) {
    // Linear Rec. 709 steps whose CIE lightness rises evenly (0, 20, 40, 60, 80, 97).
    constexpr std::array<std::array<float, 3>, 6> kSteps = {{{0.0f, 0.0f, 0.0f},
                                                             {0.065f, 0.010f, 0.160f},
                                                             {0.330f, 0.035f, 0.200f},
                                                             {0.800f, 0.150f, 0.110f},
                                                             {0.960f, 0.480f, 0.120f},
                                                             {0.970f, 0.950f, 0.550f}}};
    const float x = (value >= 0.0f ? std::min(value, 1.0f) : 0.0f) * float(kSteps.size() - 1);
    const std::size_t step = std::min(std::size_t(x), kSteps.size() - 2);
    const float share = x - float(step);
    Rgb color;
    for (int c = 0; c < 3; ++c) {
        color[c] = kSteps[step][std::size_t(c)] * (1 - share) + kSteps[step + 1][std::size_t(c)] * share;
    }
    return color;
}

Image difference_image(const Image& a, const Image& b, std::span<const float> flip, int gap) {
    Image sheet(3 * a.width + 2 * gap, a.height, Rgb(0.02f));
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            sheet.at(x, y) = a.at(x, y);
            sheet.at(x + a.width + gap, y) = b.at(x, y);
            sheet.at(x + 2 * (a.width + gap), y) =
                heat_color(flip[std::size_t(y) * std::size_t(a.width) + std::size_t(x)]);
        }
    }
    return cleaned(std::move(sheet));
}

}  // namespace daylit
