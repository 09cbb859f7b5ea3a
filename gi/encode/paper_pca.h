#pragma once
// The scheme of Bahnsen, Dewilde, Pedersen, Tranchet and Madsen 2012 ("Realtime global illumination using compressed
// pre-computed indirect illumination textures"), kept to compare with: frames at even intervals, principal components
// of all texels at once, every texel and every hour worth the same (3.2), straight lines between frames (eq. 1 to 3),
// and their test of which frames are needed.
//
// The paper keeps skylight apart, as one image times a brightness. Here frames hold all indirect light, as everything
// that they are compared with does: a clear sky's light is not one image all day.
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/baked/bytes.h"
#include "engine/base/units.h"

namespace daylit {

/// A film of a level's texels, as sums of few components:
///     light(row, channel, frame) = sum over r of rows[row][r][channel] * weights[r][channel][frame], lux
struct FilmRows {
    std::vector<double> hours;  // of the frames, ascending
    std::size_t components = 0;
    std::span<const Rgb> rows;          // [row][component]
    std::span<const std::uint32_t> at;  // the film's pixels: which row each shows
    std::vector<double> weights;        // [component][channel][frame]

    std::size_t frames() const { return hours.size(); }
    double weight(std::size_t component, int channel, std::size_t frame) const {
        return weights[(component * 3 + std::size_t(channel)) * frames() + frame];
    }
    /// The same film with some of its frames alone.
    FilmRows only(std::span<const std::size_t> frames) const;
    /// One frame of all pixels, lux.
    std::vector<Rgb> frame(std::size_t frame) const;
    /// As the paper plays a film that is not compressed: frames in half floats, linear between the two around an hour,
    /// outside them held.
    std::vector<Rgb> played(double hour) const;
    /// Of the half floats.
    double bytes() const { return 6.0 * double(frames()) * double(at.size()); }
};

/// What such a film is stored as: light(pixel, channel, frame) = mean(frame) + sum over v of score * vector(frame).
struct PaperPca {
    std::vector<double> hours;
    std::vector<float> mean;            // [frame]: over all pixels and channels, lux
    std::vector<float> vectors;         // [vector][frame]
    std::vector<std::uint16_t> scores;  // halves: [vector][channel][pixel]
    std::size_t pixels = 0;
    std::vector<double> variances;  // of all vectors that there are, falling: lux^2 over pixels, channels

    std::size_t count() const { return hours.empty() ? 0 : vectors.size() / hours.size(); }
    /// Linear between the two frames around an hour, outside them held; never negative. Lux.
    std::vector<Rgb> light(double hour) const;
    /// Some of its pixels alone.
    PaperPca of(std::span<const std::uint32_t> which) const;
    /// As a file would hold it.
    Bytes bytes() const;
};

/// Exact: eigenvectors of the frames' covariance over all pixels and channels. Fewer than `vectors` where the film has
/// no more. What is left out of a pixel's square error is, on average, the sum of the variances that were left out;
/// halves add 2^-11 of each score at most.
PaperPca paper_pca(const FilmRows& film, std::size_t vectors);

/// Which frames their sampling keeps, ascending: the day begins as two equal intervals; the middle of an interval,
/// interpolated from its ends, is compared with both ends, and when it differs from either the interval is split.
/// That measures how much light changes over the interval, not how wrong the interpolation is.
/// differ(a, b, middle)   whether the mean of frames a and b, as it is at frame `middle`'s hour, looks different from a
///                        or from b
using FramesDiffer = std::function<bool(std::size_t a, std::size_t b, std::size_t middle)>;
std::vector<std::size_t> paper_intervals(std::size_t frames, const FramesDiffer& differ);

}  // namespace daylit
