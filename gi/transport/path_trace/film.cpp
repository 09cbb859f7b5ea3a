#include "gi/transport/path_trace/film.h"

#include <algorithm>
#include <cmath>

namespace daylit {
namespace {

/// Variance of the mean of `samples`, from the sum S of all and the sum over groups of s^2 / n: one-way analysis of
/// variance, since a group's mean varies as 1 / n.
double variance_of_mean(double sum, double squares, double samples, double groups) {
    return std::max(squares - sum * sum / samples, 0.0) / (samples * (groups - 1.0));
}

}  // namespace

Film::Film(int width, int height)
    : width_(width), height_(height), pixels_(std::size_t(width) * std::size_t(height)) {}

void Film::add(int x, int y, const Group& group) {
    Pixel& pixel = pixels_[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
    const double l = luminance(group.sum), one_over_count = 1.0 / group.count;
    pixel.rays += group.rays;
    pixel.sum += group.sum;
    pixel.squares += group.sum * group.sum * one_over_count;
    pixel.luminance += l;
    pixel.luminance_squares += l * l * one_over_count;
}

Image Film::mean(int samples) const {
    Image image(width_, height_);
    for (std::size_t i = 0; i < pixels_.size(); ++i) image.pixels[i] = Rgb(pixels_[i].sum / double(samples));
    return image;
}

Image Film::standard_error(int samples, int groups) const {
    Image image(width_, height_);
    if (groups < 2) return image;
    for (std::size_t i = 0; i < pixels_.size(); ++i)
        for (int c = 0; c < 3; ++c)
            image.pixels[i][c] =
                float(std::sqrt(variance_of_mean(pixels_[i].sum[c], pixels_[i].squares[c], samples, groups)));
    return image;
}

double Film::relative_error(int samples, int groups) const {
    if (groups < 2) return -1.0;
    double sum = 0.0, variance = 0.0;
    for (const Pixel& pixel : pixels_) {
        sum += pixel.luminance / samples;
        variance += variance_of_mean(pixel.luminance, pixel.luminance_squares, samples, groups);
    }
    const double count = double(pixels_.size());
    return sum > 0.0 ? std::sqrt(variance / count) / (sum / count) : 0.0;
}

std::uint64_t Film::rays() const {
    std::uint64_t sum = 0;
    for (const Pixel& pixel : pixels_) sum += pixel.rays;
    return sum;
}

}  // namespace daylit
