#include "gi/encode/time_basis.h"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace daylit {
namespace {

constexpr std::size_t kTile = 2048;  // rows whose sums belong together, whatever the threads
// A row darker than this share of what the eye is adapted to is judged as if it had that much.
constexpr double kDarkest = 1e-3;

/// One row as judged: light over exposure, and the row's weight.
struct Judged {
    Eigen::MatrixXd light;  // 3 x keyframes
    double weight = 1.0;
};

Judged judge(const DayRows& rows, std::size_t row, std::vector<Rgb>& buffer) {
    buffer.resize(rows.hours.size());
    rows.read(row, buffer.data());
    Judged judged{Eigen::MatrixXd(3, Eigen::Index(buffer.size())), 1.0};
    double mean = 0.0;
    for (std::size_t k = 0; k < buffer.size(); ++k) {
        for (int c = 0; c < 3; ++c) judged.light(c, Eigen::Index(k)) = double(buffer[k][c]) / rows.exposure[k];
        mean += double(luminance(buffer[k])) / rows.exposure[k] / double(buffer.size());
    }
    judged.weight = 1.0 / (mean + kDarkest);
    return judged;
}

/// sum over tiles in order of work(first row, last row), tiles computed in parallel.
template <class T, class Work>
T sum_tiles(std::size_t count, T zero, const Work& work) {
    const std::size_t tiles = (count + kTile - 1) / kTile;
    std::vector<T> partial(tiles, zero);
    tbb::parallel_for(std::size_t(0), tiles,
                      [&](std::size_t i) { partial[i] = work(i * kTile, std::min(count, (i + 1) * kTile)); });
    T sum = zero;
    for (const T& p : partial) sum += p;
    return sum;
}

Eigen::MatrixXd gram(const DayRows& rows) {
    const Eigen::Index keyframes = Eigen::Index(rows.hours.size());
    return sum_tiles(rows.count, Eigen::MatrixXd(Eigen::MatrixXd::Zero(keyframes, keyframes)),
                     [&](std::size_t first, std::size_t last) {
                         Eigen::MatrixXd tile(3 * Eigen::Index(last - first), keyframes);
                         std::vector<Rgb> buffer;
                         for (std::size_t row = first; row < last; ++row) {
                             const Judged judged = judge(rows, row, buffer);
                             tile.middleRows(3 * Eigen::Index(row - first), 3) = judged.weight * judged.light;
                         }
                         return Eigen::MatrixXd(tile.transpose() * tile);
                     });
}

/// Worst column's root of left-over over total.
double worst_keyframe(const Eigen::VectorXd& left, const Eigen::VectorXd& total) {
    const double floor = 1e-12 * std::max(total.maxCoeff(), 1e-300);
    double worst = 0.0;
    for (Eigen::Index k = 0; k < total.size(); ++k)
        if (total[k] > floor) worst = std::max(worst, std::sqrt(std::max(left[k], 0.0) / total[k]));
    return worst;
}

}  // namespace

TimeBasis fit_time_basis(const DayRows& rows, const TimeBasisSettings& settings) {
    const Eigen::Index keyframes = Eigen::Index(rows.hours.size());
    const Eigen::MatrixXd g = gram(rows);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(g);
    const Eigen::VectorXd values = solver.eigenvalues().reverse();
    const Eigen::MatrixXd vectors = solver.eigenvectors().rowwise().reverse();

    TimeBasis basis{rows.hours, rows.exposure, 0, {}, 0.0};
    Eigen::VectorXd left = g.diagonal();
    basis.error = worst_keyframe(left, g.diagonal());
    while (basis.components < std::min<Eigen::Index>(settings.max_components, keyframes) &&
           basis.error > settings.error && values[basis.components] > 1e-14 * values[0]) {
        Eigen::VectorXd v = vectors.col(basis.components);
        if (v.sum() < 0.0) v = -v;  // the solver's sign is chance
        left -= values[basis.components] * v.cwiseAbs2();
        basis.vectors.insert(basis.vectors.end(), v.data(), v.data() + keyframes);
        ++basis.components;
        basis.error = worst_keyframe(left, g.diagonal());
    }
    return basis;
}

void project(const TimeBasis& basis, const Rgb* keyframes, Rgb* components) {
    const std::size_t count = basis.hours.size();
    for (int r = 0; r < basis.components; ++r) {
        glm::dvec3 sum(0.0);
        for (std::size_t k = 0; k < count; ++k)
            sum += basis.vectors[std::size_t(r) * count + k] / basis.exposure[k] * glm::dvec3(keyframes[k]);
        components[r] = Rgb(sum);
    }
}

DayBasis day_basis(const TimeBasis& basis, std::span<const float> scale) {
    const std::size_t count = basis.hours.size();
    DayBasis result{basis.hours, basis.components, std::vector<float>(basis.vectors.size())};
    for (std::size_t i = 0; i < basis.vectors.size(); ++i)
        result.curves[i] = float(basis.vectors[i] * basis.exposure[i % count] * double(scale[i / count]));
    return result;
}

double measure_error(const DayRows& rows, const DayBasis& basis,
                     const std::function<Rgb(std::size_t, std::span<const float>)>& look_up) {
    const Eigen::Index keyframes = Eigen::Index(rows.hours.size());
    std::vector<std::vector<float>> weights;
    for (double hour : rows.hours) weights.push_back(basis.weights(hour));
    // An hour of 24 wraps to 0 in a look-up; its own weights are the last of each curve.
    for (int r = 0; r < basis.components; ++r)
        weights.back()[std::size_t(r)] = basis.curves[(std::size_t(r) + 1) * rows.hours.size() - 1];
    const Eigen::MatrixXd sums = sum_tiles(
        rows.count, Eigen::MatrixXd(Eigen::MatrixXd::Zero(keyframes, 2)), [&](std::size_t first, std::size_t last) {
            Eigen::MatrixXd tile = Eigen::MatrixXd::Zero(keyframes, 2);
            std::vector<Rgb> buffer;
            for (std::size_t row = first; row < last; ++row) {
                const Judged judged = judge(rows, row, buffer);
                for (Eigen::Index k = 0; k < keyframes; ++k) {
                    const Rgb found = look_up(row, weights[std::size_t(k)]);
                    for (int c = 0; c < 3; ++c) {
                        const double truth = judged.weight * judged.light(c, k);
                        const double error = judged.weight * double(found[c]) / rows.exposure[std::size_t(k)] - truth;
                        tile(k, 0) += error * error;
                        tile(k, 1) += truth * truth;
                    }
                }
            }
            return tile;
        });
    return worst_keyframe(sums.col(0), sums.col(1));
}

}  // namespace daylit
