#pragma once
// Sums of samples per pixel (box filter), their means and standard errors.
#include <cstdint>
#include <vector>

#include "engine/base/image.h"

namespace daylit {

class Film {
  public:
    Film(int width, int height);
    int width() const { return width_; }
    int height() const { return height_; }

    /// Different pixels may be added to at the same time. A sample that is not finite counts as black.
    void add(int x, int y, const Rgb& value, std::uint32_t rays);

    Image mean(int samples) const;
    /// Of each pixel's mean, per channel; zero after a single sample, which says nothing about its error.
    Image standard_error(int samples) const;
    /// RMS over the pixels of the standard error of luminance, over the mean luminance; < 0 after a single sample,
    /// 0 for a black picture.
    double relative_error(int samples) const;
    std::uint64_t rays() const;

  private:
    struct Pixel {
        glm::dvec3 sum = glm::dvec3(0.0), squares = glm::dvec3(0.0);
        double luminance = 0.0, luminance_squares = 0.0;
        std::uint64_t rays = 0;
    };
    int width_, height_;
    std::vector<Pixel> pixels_;
};

}  // namespace daylit
