#include "gi/encode/paper_pca.h"

#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "gi/eigen_decomposition.h"

namespace daylit {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr std::size_t kPixelsAtOnce = 2048;  // pixels whose sums belong together, whatever the threads
constexpr float kMostHalf = 65504.0f;
constexpr double kLargestHalf = 16384.0;  // of scores: far from the end of halves
constexpr double kNothing = 1e-13;        // of the largest variance: what rounding leaves

/// A channel's weights: component x frame.
Matrix weights_of(const FilmRows& film, int channel) {
    Matrix result(Eigen::Index(film.components), Eigen::Index(film.frames()));
    for (Eigen::Index r = 0; r < result.rows(); ++r)
        for (Eigen::Index k = 0; k < result.cols(); ++k)
            result(r, k) = film.weight(std::size_t(r), channel, std::size_t(k));
    return result;
}

/// Pixels [first, last) of a channel: pixel x component.
Matrix components_of(const FilmRows& film, std::size_t first, std::size_t last, int channel) {
    Matrix result(Eigen::Index(last - first), Eigen::Index(film.components));
    for (std::size_t i = first; i < last; ++i)
        for (std::size_t r = 0; r < film.components; ++r)
            result(Eigen::Index(i - first), Eigen::Index(r)) =
                double(film.rows[std::size_t(film.at[i]) * film.components + r][channel]);
    return result;
}

/// Sums over pixels of a channel's components, and of their products.
struct Moments {
    Vector sum;
    Matrix products;
};

Moments moments_of(const FilmRows& film, int channel) {
    const std::size_t chunks = (film.at.size() + kPixelsAtOnce - 1) / kPixelsAtOnce;
    std::vector<Moments> partial(chunks);
    tbb::parallel_for(std::size_t(0), chunks, [&](std::size_t i) {
        const Matrix part =
            components_of(film, i * kPixelsAtOnce, std::min(film.at.size(), (i + 1) * kPixelsAtOnce), channel);
        partial[i] = {part.colwise().sum().transpose(), part.transpose() * part};
    });
    const Eigen::Index n = Eigen::Index(film.components);
    Moments all{Vector::Zero(n), Matrix::Zero(n, n)};
    for (const Moments& p : partial) all.sum += p.sum, all.products += p.products;
    return all;
}

/// The two frames around an hour, and the second's share.
struct Between {
    std::size_t before = 0, after = 0;
    double share = 0.0;
};

Between between(const std::vector<double>& hours, double hour) {
    const std::size_t after = std::size_t(std::upper_bound(hours.begin(), hours.end(), hour) - hours.begin());
    if (after == 0) return {0, 0, 0.0};
    if (after == hours.size()) return {after - 1, after - 1, 0.0};
    return {after - 1, after, (hour - hours[after - 1]) / (hours[after] - hours[after - 1])};
}

std::vector<Rgb> halved(std::vector<Rgb> light) {
    for (Rgb& e : light)
        for (int c = 0; c < 3; ++c) e[c] = glm::unpackHalf1x16(glm::packHalf1x16(std::clamp(e[c], 0.0f, kMostHalf)));
    return light;
}

}  // namespace

FilmRows FilmRows::only(std::span<const std::size_t> kept) const {
    FilmRows result{{}, components, rows, at, {}};
    for (const std::size_t k : kept) result.hours.push_back(hours[k]);
    for (std::size_t r = 0; r < components; ++r)
        for (int c = 0; c < 3; ++c)
            for (const std::size_t k : kept) result.weights.push_back(weight(r, c, k));
    return result;
}

std::vector<Rgb> FilmRows::frame(std::size_t frame) const {
    std::vector<Rgb> scale(components), result(at.size(), Rgb(0.0f));
    for (std::size_t r = 0; r < components; ++r)
        for (int c = 0; c < 3; ++c) scale[r][c] = float(weight(r, c, frame));
    tbb::parallel_for(std::size_t(0), at.size(), [&](std::size_t i) {
        const Rgb* row = rows.data() + std::size_t(at[i]) * components;
        for (std::size_t r = 0; r < components; ++r) result[i] += row[r] * scale[r];
    });
    return result;
}

std::vector<Rgb> FilmRows::played(double hour) const {
    const Between around = between(hours, hour);
    std::vector<Rgb> light = halved(frame(around.before));
    if (around.share == 0.0) return light;
    const std::vector<Rgb> next = halved(frame(around.after));
    for (std::size_t i = 0; i < light.size(); ++i) light[i] = glm::mix(light[i], next[i], float(around.share));
    return light;
}

PaperPca paper_pca(const FilmRows& film, std::size_t vectors) {
    const auto frames = Eigen::Index(film.frames());
    const double count = std::max(3.0 * double(film.at.size()), 1.0);
    Vector mean = Vector::Zero(frames);
    Matrix covariance = Matrix::Zero(frames, frames);
    for (int c = 0; c < 3; ++c) {
        const Matrix weights = weights_of(film, c);
        const Moments all = moments_of(film, c);
        mean += weights.transpose() * all.sum / count;
        covariance += weights.transpose() * all.products * weights / count;
    }
    covariance -= mean * mean.transpose();
    const EigenDecomposition principal = eigen_decomposition(covariance);
    const Vector variances = principal.values.cwiseMax(0.0);

    PaperPca result;
    result.hours = film.hours, result.pixels = film.at.size();
    result.mean.resize(film.frames());
    Eigen::Map<Eigen::VectorXf>(result.mean.data(), frames) = mean.cast<float>();
    result.variances.assign(variances.begin(), variances.end());
    Eigen::Index kept = 0;
    while (kept < std::min<Eigen::Index>(Eigen::Index(vectors), frames) && variances[kept] > kNothing * variances[0])
        ++kept;
    const Matrix basis = principal.vectors.leftCols(kept);

    // Scores, vector by vector: those of a channel are its components times weights times vectors.
    std::vector<float> scores(std::size_t(3 * kept) * result.pixels);
    for (int c = 0; c < 3; ++c) {
        const Matrix turn = weights_of(film, c) * basis;
        const Eigen::RowVectorXd of_mean = mean.transpose() * basis;
        const std::size_t chunks = (result.pixels + kPixelsAtOnce - 1) / kPixelsAtOnce;
        tbb::parallel_for(std::size_t(0), chunks, [&](std::size_t i) {
            const std::size_t first = i * kPixelsAtOnce, last = std::min(result.pixels, first + kPixelsAtOnce);
            const Matrix part = (components_of(film, first, last, c) * turn).rowwise() - of_mean;
            for (Eigen::Index v = 0; v < kept; ++v)
                for (std::size_t p = first; p < last; ++p)
                    scores[(std::size_t(3 * v + c)) * result.pixels + p] = float(part(Eigen::Index(p - first), v));
        });
    }
    for (Eigen::Index v = 0; v < kept; ++v) {
        const float* of_vector = scores.data() + std::size_t(3 * v) * result.pixels;
        float largest = 0.0f;
        for (std::size_t i = 0; i < 3 * result.pixels; ++i) largest = std::max(largest, std::abs(of_vector[i]));
        const double scale = largest > 0.0f ? double(largest) / kLargestHalf : 1.0;
        for (std::size_t i = 0; i < 3 * result.pixels; ++i)
            result.scores.push_back(glm::packHalf1x16(float(double(of_vector[i]) / scale)));
        for (Eigen::Index t = 0; t < frames; ++t) result.vectors.push_back(float(basis(t, v) * scale));
    }
    return result;
}

std::vector<Rgb> PaperPca::light(double hour) const {
    const Between at = between(hours, hour);
    const auto mix = [&](const float* curve) {
        return float((1.0 - at.share) * double(curve[at.before]) + at.share * double(curve[at.after]));
    };
    std::vector<float> weights(count());
    for (std::size_t v = 0; v < weights.size(); ++v) weights[v] = mix(vectors.data() + v * hours.size());
    std::vector<Rgb> result(pixels, Rgb(mix(mean.data())));
    tbb::parallel_for(std::size_t(0), (pixels + kPixelsAtOnce - 1) / kPixelsAtOnce, [&](std::size_t chunk) {
        const std::size_t first = chunk * kPixelsAtOnce, last = std::min(pixels, first + kPixelsAtOnce);
        for (std::size_t v = 0; v < weights.size(); ++v)
            for (int c = 0; c < 3; ++c) {
                const std::uint16_t* plane = scores.data() + (3 * v + std::size_t(c)) * pixels;
                for (std::size_t p = first; p < last; ++p) result[p][c] += weights[v] * glm::unpackHalf1x16(plane[p]);
            }
        for (std::size_t p = first; p < last; ++p) result[p] = glm::max(result[p], Rgb(0.0f));
    });
    return result;
}

PaperPca PaperPca::of(std::span<const std::uint32_t> which) const {
    PaperPca result{hours, mean, vectors, {}, which.size(), variances};
    for (std::size_t plane = 0; plane < 3 * count(); ++plane)
        for (const std::uint32_t pixel : which) result.scores.push_back(scores[plane * pixels + pixel]);
    return result;
}

Bytes PaperPca::bytes() const {
    ByteWriter w;
    w.put_all(hours), w.put_all(mean), w.put_all(vectors), w.put_all(scores);
    return w.take();
}

std::vector<std::size_t> paper_intervals(std::size_t frames, const FramesDiffer& differ) {
    if (frames < 3) return frames == 2 ? std::vector<std::size_t>{0, 1} : std::vector<std::size_t>(frames, 0);
    std::vector<bool> kept(frames, false);
    const std::size_t last = frames - 1;
    kept[0] = kept[last / 2] = kept[last] = true;
    std::vector<std::pair<std::size_t, std::size_t>> open = {{0, last / 2}, {last / 2, last}};
    while (!open.empty()) {
        const auto [a, b] = open.back();
        open.pop_back();
        if (b - a < 2) continue;
        const std::size_t middle = (a + b) / 2;
        if (!differ(a, b, middle)) continue;
        kept[middle] = true;
        open.emplace_back(a, middle), open.emplace_back(middle, b);
    }
    std::vector<std::size_t> result;
    for (std::size_t k = 0; k < frames; ++k)
        if (kept[k]) result.push_back(k);
    return result;
}

}  // namespace daylit
