#include "gi/transport/day_gather/reduce.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "gi/eigen_decomposition.h"

namespace daylit {
namespace {

using Matrix = Eigen::MatrixXd;

constexpr Eigen::Index kTile = 192;  // rows whose sums belong together, whatever the threads
// A row darker than this share of the mean is judged as if it had that much.
constexpr double kDarkest = 0.01;
constexpr std::size_t kStep = 8;  // components in all are a multiple of it, for vectors of floats

/// What a column gives on a clear day, over what the eye is adapted to.
std::vector<double> column_worth(const DayLight& light, const std::vector<double>& exposure) {
    std::vector<double> worth(light.columns.suns + light.columns.skies, 0.0);
    for (std::size_t k = 0; k < exposure.size(); ++k)
        light.columns.for_hour(k, light.scales[k], [&](std::size_t column, const Rgb& scale) {
            if (column < worth.size()) worth[column] = std::max(worth[column], double(luminance(scale)) / exposure[k]);
        });
    return worth;
}

/// Rows as judged: 3 a sample row, columns times their worth, rows over their mean.
Matrix judged(const DayLight& light, const SampleRows& rows, const std::vector<double>& worth,
              const std::vector<double>& exposure) {
    const Eigen::Index columns = Eigen::Index(rows.columns);
    std::vector<double> mean(rows.count(), 0.0);
    double all = 0.0;
    for (std::size_t i = 0; i < rows.count(); ++i) {
        const std::vector<double> hours = clear_day(light, rows.row(i));
        for (std::size_t k = 0; k < hours.size(); ++k) mean[i] += hours[k] / exposure[k] / double(hours.size());
        all += mean[i] / double(rows.count());
    }
    Matrix result(3 * Eigen::Index(rows.count()), columns);
    for (std::size_t i = 0; i < rows.count(); ++i) {
        const double weight = all > 0.0 ? 1.0 / (mean[i] + kDarkest * all) : 0.0;
        for (Eigen::Index channel = 0; channel < 3; ++channel)
            for (Eigen::Index c = 0; c < columns; ++c)
                result(3 * Eigen::Index(i) + channel, c) =
                    weight * worth[std::size_t(c)] * double(rows.row(i)[channel * columns + c]);
    }
    return result;
}

Matrix gram(const Matrix& rows) {
    const Eigen::Index tiles = (rows.rows() + kTile - 1) / kTile;
    std::vector<Matrix> partial(static_cast<std::size_t>(tiles));
    tbb::parallel_for(Eigen::Index(0), tiles, [&](Eigen::Index i) {
        const auto tile = rows.middleRows(i * kTile, std::min(kTile, rows.rows() - i * kTile));
        partial[std::size_t(i)].noalias() = tile.transpose() * tile;
    });
    Matrix sum = Matrix::Zero(rows.cols(), rows.cols());
    for (const Matrix& p : partial) sum += p;
    return sum;
}

/// Relative error of the check rows with 0, 1, 2 ... vectors.
std::vector<double> errors(const Matrix& check, const Matrix& vectors) {
    const Matrix parts = check * vectors;
    const double total = check.squaredNorm();
    double left = total;
    std::vector<double> result = {total > 0.0 ? 1.0 : 0.0};
    for (Eigen::Index r = 0; r < vectors.cols(); ++r) {
        left -= parts.col(r).squaredNorm();
        result.push_back(total > 0.0 ? std::sqrt(std::max(left, 0.0) / total) : 0.0);
    }
    return result;
}

Reduction every_column(std::size_t columns) {
    Reduction result{columns, std::vector<float>(columns * columns, 0.0f), {}, 0.0};
    for (std::size_t c = 0; c < columns; ++c) result.project[c * columns + c] = 1.0f;
    result.curves = result.project;
    return result;
}

}  // namespace

std::vector<double> clear_day(const DayLight& light, const float* row) {
    const std::size_t columns = light.columns.suns + light.columns.skies;
    std::vector<double> hours(light.columns.hours.size(), 0.0);
    for (std::size_t k = 0; k < hours.size(); ++k)
        light.columns.for_hour(k, light.scales[k], [&](std::size_t c, const Rgb& scale) {
            if (c < columns) hours[k] += double(luminance(scale * Rgb(row[c], row[columns + c], row[2 * columns + c])));
        });
    return hours;
}

Reduction reduce(const DayLight& light, const SampleRows& sample, const SampleRows& check,
                 const std::vector<double>& exposure, const ReductionSettings& settings) {
    const std::size_t columns = light.columns.suns + light.columns.skies;
    if (light.columns.hours.size() < 2 || columns < 2) return every_column(columns);
    const std::vector<double> worth = column_worth(light, exposure);
    const std::size_t allowed = (settings.most + kStillParts) / kStep * kStep - kStillParts;
    const Eigen::Index most = Eigen::Index(std::min(allowed, columns));
    const Matrix vectors = eigen_decomposition(gram(judged(light, sample, worth, exposure))).vectors.leftCols(most);
    const std::vector<double> error = errors(judged(light, check, worth, exposure), vectors);

    Reduction result;
    while (result.components < std::size_t(most) &&
           (error[result.components] > settings.error || (result.components + kStillParts) % kStep != 0))
        ++result.components;
    result.error = error[result.components];
    result.project.resize(columns * result.components);
    result.curves.resize(columns * result.components, 0.0f);
    for (std::size_t c = 0; c < columns; ++c)
        for (std::size_t r = 0; r < result.components; ++r) {
            const double v = vectors(Eigen::Index(c), Eigen::Index(r));
            result.project[c * result.components + r] = float(v * worth[c]);
            if (worth[c] > 0.0) result.curves[r * columns + c] = float(v / worth[c]);
        }
    return result;
}

}  // namespace daylit
