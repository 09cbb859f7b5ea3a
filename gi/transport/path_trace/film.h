#pragma once
// Sums of samples per pixel (box filter), their means and standard errors. Samples come in groups, within which they
// may depend on each other: what groups differ by tells the error.
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/base/image.h"

namespace daylit {

class Film {
  public:
    Film(int width, int height);
    int width() const { return width_; }
    int height() const { return height_; }

    struct Group {
        glm::dvec3 sum = glm::dvec3(0.0);
        int count = 0;
        std::uint64_t rays = 0;
        /// A sample that is not finite counts as black.
        void add(const Rgb& value, std::uint32_t cast) {
            ++count;
            rays += cast;
            if (std::isfinite(value.r + value.g + value.b)) sum += glm::dvec3(value);
        }
    };
    /// Different pixels may be added to at the same time.
    void add(int x, int y, const Group& group);

    Image mean(int samples) const;
    /// Of each pixel's mean, per channel; zero after a single group, which says nothing about its error.
    Image standard_error(int samples, int groups) const;
    /// RMS over the pixels of the standard error of luminance, over the mean luminance; < 0 after a single group,
    /// 0 for a black picture.
    double relative_error(int samples, int groups) const;
    std::uint64_t rays() const;

  private:
    struct Pixel {
        glm::dvec3 sum = glm::dvec3(0.0), squares = glm::dvec3(0.0);  // squares: of groups' sums, over their counts
        double luminance = 0.0, luminance_squares = 0.0;
        std::uint64_t rays = 0;
    };
    int width_, height_;
    std::vector<Pixel> pixels_;
};

}  // namespace daylit
