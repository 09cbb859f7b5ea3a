#pragma once
// How far two pictures, or two sets of measured points, are apart.
#include <cstddef>
#include <span>
#include <vector>

#include "engine/base/image.h"

namespace daylit {

/// Over all channels of all pixels (or points) in which both are finite; b is the reference.
struct Differences {
    double rmse = 0;
    double mse = 0;
    double nrmse = 0;    // rmse / mean of b
    double bias = 0;     // mean(a) / mean(b) - 1
    double p95 = 0;      // 95th percentile of |a - b| / mean(b)
    double max_abs = 0;  // of |a - b|
    double largest = 0;  // value of b
    std::size_t nan_count = 0;  // values that are not finite, in a and in b
};

/// Same count. A mean of zero makes the ratios NaN (0/0) or infinite; identical black pictures give 0 throughout.
Differences differences(std::span<const Rgb> a, std::span<const Rgb> b);

/// How two pictures look, displayed side by side.
struct DisplayedDifferences {
    std::vector<float> flip;  // one a pixel
    double flip_mean = 0, flip_p95 = 0;
    std::size_t yee_failed = 0;       // pixels whose difference is visible by Yee 2004 (yee.h)
    std::size_t yee_failed_oiio = 0;  // the same by OpenImageIO's compare_Yee, which misses differences of lightness
    int max_abs_8bit = 0;        // largest difference of 8-bit sRGB codes
};

/// a, b   display-linear in [0,1], same size
DisplayedDifferences displayed_differences(const Image& a, const Image& b);

/// Values between 0 and 1 as colours of rising lightness: black, violet, red, orange, pale yellow. sRGB-linear.
Rgb heat_color(float value);

/// A, B and the FLIP map in heat colours beside each other, display-linear; `gap` dark pixels between them.
Image difference_image(const Image& a, const Image& b, std::span<const float> flip, int gap = 4);

}  // namespace daylit
