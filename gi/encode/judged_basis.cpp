#include "gi/encode/judged_basis.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "gi/eigen_decomposition.h"

namespace daylit {
namespace {

constexpr std::size_t kChunk = 2048;     // rows whose sums belong together, whatever the threads
constexpr double kFirstStep = 2.0;       // hours between the keyframes to begin with
constexpr double kSmallestLevel = 1e-9;  // of a sky's brightest column

using Matrix = Eigen::MatrixXd;

/// The light of each part alone.
std::array<LightScales, 7> parts_of(const LightScales& all) {
    std::array<LightScales, 7> parts;
    for (LightScales& p : parts) p.evening = 0.0f;
    parts[0].sun = Rgb(luminance(all.sun));
    parts[1].clear = all.clear;
    parts[2].overcast = Rgb(luminance(all.overcast));
    parts[3].ground = Rgb(luminance(all.ground));
    parts[4].night = all.night;
    parts[5].evening = all.evening;
    return parts;
}

/// The curves as a matrix, components x columns, with the sky's level in them.
Matrix curves_of(const LightBasis& basis) {
    Matrix curves(basis.components, Eigen::Index(basis.columns()));
    for (Eigen::Index r = 0; r < curves.rows(); ++r)
        for (std::size_t c = 0; c < basis.columns(); ++c) {
            const bool sky = c >= basis.suns && c < basis.suns + basis.skies;
            curves(r, Eigen::Index(c)) = double(basis.curves[std::size_t(r) * basis.columns() + c]) *
                                         (sky ? double(basis.sky_level[c - basis.suns]) : 1.0);
        }
    return curves;
}

/// A basis of these curves, of which it keeps the keyframes `kept`.
LightBasis basis_of(const LightBasis& dense, const Matrix& curves, const std::vector<std::size_t>& kept) {
    LightBasis basis;
    basis.components = int(curves.rows());
    for (std::size_t k : kept) basis.hours.push_back(dense.hours[k]);
    std::vector<Eigen::Index> columns;
    const auto keep = [&](std::size_t first, std::size_t count) {
        if (count > 1)
            for (std::size_t k : kept) columns.push_back(Eigen::Index(first + k));
        else if (count == 1)
            columns.push_back(Eigen::Index(first));
        return count > 1 ? kept.size() : count;
    };
    basis.suns = keep(0, dense.suns);
    basis.skies = keep(dense.suns, dense.skies);
    for (std::size_t s = 0; s < kStillColumns; ++s) columns.push_back(Eigen::Index(dense.suns + dense.skies + s));

    Matrix chosen = curves(Eigen::all, columns);
    auto skies = chosen.middleCols(Eigen::Index(basis.suns), Eigen::Index(basis.skies));
    const double brightest = basis.skies ? skies.colwise().norm().maxCoeff() : 0.0;
    for (Eigen::Index k = 0; k < skies.cols(); ++k) {
        const float level = float(std::max(skies.col(k).norm(), kSmallestLevel * brightest));
        basis.sky_level.push_back(level > 0.0f ? level : 1.0f);
        skies.col(k) /= double(basis.sky_level.back());
    }
    basis.curves.resize(std::size_t(chosen.size()));
    Eigen::Map<Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
        basis.curves.data(), chosen.rows(), chosen.cols()) = chosen.cast<float>();
    return basis;
}

/// Root mean squares of the rows' components, which may differ by decades; 1 for those that are black everywhere.
Eigen::VectorXd component_sizes(const LightRows& rows) {
    const std::size_t components = std::size_t(rows.light.components);
    const std::size_t chunks = (rows.count() + kChunk - 1) / kChunk;
    std::vector<Eigen::VectorXd> partial(chunks, Eigen::VectorXd::Zero(Eigen::Index(components)));
    tbb::parallel_for(std::size_t(0), chunks, [&](std::size_t i) {
        for (std::size_t row = i * kChunk; row < std::min(rows.count(), (i + 1) * kChunk); ++row)
            for (std::size_t r = 0; r < components; ++r) {
                const glm::dvec3 value(rows.row(row)[r]);
                partial[i][Eigen::Index(r)] += glm::dot(value, value);
            }
    });
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(Eigen::Index(components));
    for (const Eigen::VectorXd& p : partial) sum += p;
    const Eigen::VectorXd sizes = (sum / std::max(1.0, 3.0 * double(rows.count()))).cwiseSqrt();
    return (sizes.array() > 0.0).select(sizes, Eigen::VectorXd::Ones(sizes.size()));
}

/// Adds up, over all rows and channels, turned rows at unit brightness times themselves.
Matrix gram_of_unit_rows(const LightRows& rows, const Matrix& turn) {
    const Eigen::Index components = turn.cols();
    const std::size_t chunks = (rows.count() + kChunk - 1) / kChunk;
    std::vector<Matrix> partial(chunks);
    tbb::parallel_for(std::size_t(0), chunks, [&](std::size_t i) {
        const std::size_t first = i * kChunk, last = std::min(rows.count(), first + kChunk);
        Matrix all(Eigen::Index(last - first) * 3, turn.rows());
        for (std::size_t row = first; row < last; ++row)
            for (Eigen::Index c = 0; c < 3; ++c)
                for (Eigen::Index r = 0; r < turn.rows(); ++r)
                    all(Eigen::Index(row - first) * 3 + c, r) = double(rows.row(row)[r][int(c)]);
        Matrix turned = all * turn;
        for (Eigen::Index row = 0; row < turned.rows(); row += 3) {
            auto one = turned.middleRows(row, 3);
            one /= std::max(one.norm() / std::sqrt(3.0), double(kDarkestRow));
        }
        partial[i] = turned.transpose() * turned;
    });
    Matrix sum = Matrix::Zero(components, components);
    for (const Matrix& p : partial) sum += p;
    return sum;
}

/// Relative error of every moment: what `basis` gives against `truth`, weighted by how much rows hold of each
/// component.
Eigen::VectorXd moment_errors(const LightBasis& basis, const Matrix& truth, const Eigen::VectorXd& held,
                              std::span<const Moment> moments) {
    const Matrix found = moment_weights(basis, moments);
    Eigen::VectorXd errors(Eigen::Index(moments.size()));
    for (Eigen::Index m = 0; m < errors.size(); ++m) {
        double wrong = 0.0, all = 0.0;
        for (Eigen::Index c = m; c < truth.cols(); c += errors.size()) {
            wrong += held.dot((found.col(c) - truth.col(c)).cwiseAbs2());
            all += held.dot(truth.col(c).cwiseAbs2());
        }
        errors[m] = all > 0.0 ? std::sqrt(wrong / all) : 0.0;
    }
    return errors;
}

/// Adds keyframes where moments between them are wrong, the worst of each stretch, until none is.
std::vector<std::size_t> choose_keyframes(const LightBasis& dense, const Matrix& curves, const Eigen::VectorXd& held,
                                          std::span<const Moment> moments, double error) {
    const Matrix truth = moment_weights(dense, moments);
    std::vector<bool> kept(dense.hours.size(), false);
    kept.front() = kept.back() = true;
    double next = dense.hours.front() + kFirstStep;
    for (std::size_t k = 0; k < kept.size(); ++k)
        if (dense.hours[k] >= next) kept[k] = true, next = dense.hours[k] + kFirstStep;
    for (;;) {
        std::vector<std::size_t> chosen;
        for (std::size_t k = 0; k < kept.size(); ++k)
            if (kept[k]) chosen.push_back(k);
        const Eigen::VectorXd errors = moment_errors(basis_of(dense, curves, chosen), truth, held, moments);
        bool added = false;
        for (std::size_t i = 0; i + 1 < chosen.size(); ++i) {
            std::size_t worst = dense.hours.size();
            double most = error;
            for (Eigen::Index m = 0; m < errors.size(); ++m) {
                const double hour = moments[std::size_t(m)].hour;
                if (errors[m] <= most || hour <= dense.hours[chosen[i]] || hour >= dense.hours[chosen[i + 1]]) continue;
                const std::size_t k = std::size_t(
                    std::lower_bound(dense.hours.begin(), dense.hours.end(), hour - 1e-9) - dense.hours.begin());
                if (k < kept.size() && !kept[k]) worst = k, most = errors[m];
            }
            if (worst < dense.hours.size()) kept[worst] = added = true;
        }
        if (!added) return chosen;
    }
}

}  // namespace

Matrix moment_weights(const LightBasis& basis, std::span<const Moment> moments) {
    Matrix result(basis.components, Eigen::Index(3 * moments.size()));
    for (std::size_t m = 0; m < moments.size(); ++m) {
        const std::vector<Rgb> weights = basis.weights(moments[m].scales, moments[m].hour);
        for (std::size_t r = 0; r < weights.size(); ++r)
            for (int c = 0; c < 3; ++c)
                result(Eigen::Index(r), Eigen::Index(std::size_t(c) * moments.size() + m)) =
                    double(weights[r][c]) / moments[m].exposure;
    }
    return result;
}

Matrix part_weights(const LightBasis& basis, std::span<const Moment> moments) {
    constexpr std::size_t kParts = 7;
    Matrix result(basis.components, Eigen::Index(kParts * moments.size()));
    LightScales none;
    none.evening = 0.0f;
    for (std::size_t m = 0; m < moments.size(); ++m) {
        const std::array<LightScales, kParts> parts = parts_of(moments[m].scales);
        // The lamps shine in all of them, so they are what is there without any other.
        const std::vector<Rgb> lamps = basis.weights(none, moments[m].hour);
        for (std::size_t p = 0; p < kParts; ++p) {
            const std::vector<Rgb> weights = p + 1 < kParts ? basis.weights(parts[p], moments[m].hour) : lamps;
            for (std::size_t r = 0; r < weights.size(); ++r)
                result(Eigen::Index(r), Eigen::Index(kParts * m + p)) =
                    (double(weights[r].x) - (p + 1 < kParts ? double(lamps[r].x) : 0.0)) / moments[m].exposure;
        }
    }
    return result;
}

JudgedBasis judge_basis(const LightRows& rows, const BasisSettings& settings) {
    JudgedBasis result;
    const Matrix curves = curves_of(rows.light);
    const Eigen::VectorXd sizes = component_sizes(rows);
    const Matrix judged = sizes.asDiagonal() * part_weights(rows.light, rows.moments);
    const Matrix metric = judged * judged.transpose() / double(std::max<std::size_t>(rows.moments.size(), 1));
    const EigenDecomposition of_metric = eigen_decomposition(metric);
    // Directions that no moment asks for are left out.
    const double floor = 1e-14 * std::max(of_metric.values.maxCoeff(), 1e-300);
    Eigen::Index used = 0;
    while (used < metric.rows() && of_metric.values[used] > floor) ++used;
    const Matrix axes = of_metric.vectors.leftCols(used);
    const Eigen::VectorXd lengths = of_metric.values.head(used).cwiseSqrt();
    const Matrix to_metric = sizes.cwiseInverse().asDiagonal() * axes * lengths.asDiagonal();

    const Matrix gram = gram_of_unit_rows(rows, to_metric);
    const EigenDecomposition of_rows = eigen_decomposition(gram);
    const Eigen::VectorXd held = of_rows.values.cwiseMax(0.0);
    Eigen::Index components = 0;
    double left = held.sum();
    const double enough = left * settings.dropped * settings.dropped;
    while (components < used && left > enough) left -= held[components++];
    const Matrix principal = of_rows.vectors.leftCols(components);

    result.turn = (to_metric * principal).cast<float>();
    const Matrix turned =
        principal.transpose() * lengths.cwiseInverse().asDiagonal() * axes.transpose() * sizes.asDiagonal() * curves;
    std::vector<std::size_t> all(rows.light.hours.size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
    result.dense = basis_of(rows.light, turned, all);
    const Eigen::VectorXd weight = held.head(components);
    result.stored =
        basis_of(rows.light, turned, choose_keyframes(result.dense, turned, weight, rows.moments, settings.keyframes));
    const Matrix truth = moment_weights(result.dense, rows.moments);
    if (components > 0 && !rows.moments.empty())
        result.error = moment_errors(result.stored, truth, weight, rows.moments).maxCoeff();
    return result;
}

}  // namespace daylit
