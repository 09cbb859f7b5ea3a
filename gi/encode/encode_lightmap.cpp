#include "gi/encode/encode_lightmap.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/baked/integer_coding.h"
#include "engine/baked/light_basis_bytes.h"
#include "gi/eigen_decomposition.h"
#include "gi/encode/judged_basis.h"

namespace daylit {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

// A moment at which a tile is darker than this share of its brightest is judged as if it had that much.
constexpr double kDarkestMoment = 0.03;
// Texels beside an evening lamp are judged by their day: of the evening, only this share counts.
constexpr double kEveningShare = 1.0 / 64.0;
constexpr Eigen::Index kCheckedEvery = 3;  // texels of a tile on which its error is measured

/// What all tiles share.
struct TileJudge {
    const LightRows& rows;
    const TiltRows& tilts;
    const JudgedBasis& basis;
    Matrix truth;  // moment_weights of the dense curves
    Matrix shown;  // of the stored ones
    Matrix parts;  // part_weights of the dense curves
    Eigen::Index components() const { return truth.rows(); }
    Eigen::Index moments() const { return truth.cols() / 3; }
};

/// Texels of a tile that show something.
struct TileRows {
    std::vector<std::uint32_t> pixels;  // of the atlas
    std::vector<std::uint8_t> exponents;
    bool tilted = false;
    /// Rows of (channel, component), over their texels' brightness' step: texels, and in tilted tiles their tilts along
    /// u, then along v, over kTiltScale.
    Matrix light;
    double brightness = 0.0;  // of exponent 0
    Eigen::Index count() const { return Eigen::Index(pixels.size()); }
    auto texels() const { return light.topRows(count()); }
};

struct CodedTile {
    std::size_t patterns = 0;
    std::vector<float> scales;
    std::vector<std::int16_t> light;   // [pattern][channel][component]
    std::vector<std::int16_t> values;  // [pattern][row of TileRows::light]
    std::size_t rows = 0;
    Vector wrong, all;  // per moment: sums of squares over the texels that were checked
};

TileRows tile_rows(const TileJudge& judge, const DayLightmap& map, std::span<const std::uint32_t> row_of_pixel,
                   int tile) {
    TileRows result;
    const int x0 = tile % map.tiles_across() * map.kTileSide, y0 = tile / map.tiles_across() * map.kTileSide;
    for (int y = y0; y < std::min(y0 + map.kTileSide, map.height); ++y)
        for (int x = x0; x < std::min(x0 + map.kTileSide, map.width); ++x) {
            const auto pixel = std::uint32_t(y * map.width + x);
            if (row_of_pixel[pixel] != ~0u) result.pixels.push_back(pixel);
        }
    const Eigen::Index n = result.count(), q = judge.components(), given = judge.basis.turn.rows();
    std::vector<std::uint32_t> rows;
    for (const std::uint32_t pixel : result.pixels) rows.push_back(row_of_pixel[pixel]);
    const auto tilt_row = [&](std::uint32_t row) { return judge.tilts.of_row.empty() ? ~0u : judge.tilts.of_row[row]; };
    result.tilted = std::any_of(rows.begin(), rows.end(), [&](std::uint32_t row) { return tilt_row(row) != ~0u; });
    Eigen::MatrixXf light = Eigen::MatrixXf::Zero(result.tilted ? 3 * n : n, given);
    result.light.resize(light.rows(), 3 * q);
    const Eigen::Index evening = given - Eigen::Index(kStillParts) + Eigen::Index(StillPart::Evening);
    Vector squares = Vector::Zero(n), by_day = squares;
    for (int c = 0; c < 3; ++c) {
        for (Eigen::Index i = 0; i < n; ++i) {
            const std::uint32_t row = rows[std::size_t(i)], tilts = tilt_row(row);
            for (Eigen::Index r = 0; r < given; ++r) light(i, r) = judge.rows.row(row)[r][c];
            if (tilts == ~0u) continue;
            const Rgb* tilt = judge.tilts.rows.data() + std::size_t(tilts) * std::size_t(2 * given);
            for (Eigen::Index axis = 0; axis < 2; ++axis)
                for (Eigen::Index r = 0; r < given; ++r)
                    light((1 + axis) * n + i, r) = tilt[axis * given + r][c] / DayLightmap::kTiltScale;
        }
        const Eigen::MatrixXf turned = light * judge.basis.turn;
        const auto lamps = light.col(evening).head(n) * judge.basis.turn.row(evening);
        by_day += (turned.topRows(n) - lamps).rowwise().squaredNorm().cast<double>();
        squares += turned.topRows(n).rowwise().squaredNorm().cast<double>();
        result.light.middleCols(c * q, q) = turned.cast<double>();
    }
    const Vector brightness =
        (by_day.cwiseMax(kEveningShare * kEveningShare * squares) / 3.0).cwiseSqrt().cwiseMax(double(kDarkestRow));
    result.brightness = n ? brightness.maxCoeff() : 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
        const int exponent =
            std::clamp(int(std::log2(result.brightness / brightness[i]) / 2.0), 0, map.kLargestExponent);
        result.exponents.push_back(std::uint8_t(exponent));
        for (Eigen::Index row = i; row < result.light.rows(); row += n)
            result.light.row(row) *= std::ldexp(1.0, 2 * exponent) / result.brightness;
    }
    return result;
}

template <class Rows>
Matrix gram_of(const Rows& rows) {
    Matrix gram = Matrix::Zero(rows.cols(), rows.cols());
    gram.selfadjointView<Eigen::Lower>().rankUpdate(rows.transpose());
    gram.triangularView<Eigen::StrictlyUpper>() = gram.transpose();
    return gram;
}

/// Of numbers per channel and moment, the sums over channels.
template <class Row>
Vector sum_channels(const Row& row) {
    const Eigen::Index moments = row.cols() / 3;
    return (row.leftCols(moments) + row.middleCols(moments, moments) + row.rightCols(moments)).transpose();
}

/// Squares of light at every moment, summed over rows and channels. gram: of the rows
Vector moment_squares(const Matrix& gram, const Matrix& weights) {
    const Eigen::Index q = weights.rows(), moments = weights.cols() / 3;
    Vector result = Vector::Zero(moments);
    for (Eigen::Index c = 0; c < 3; ++c) {
        const auto w = weights.middleCols(c * moments, moments);
        result += (gram.block(c * q, c * q, q, q) * w).cwiseProduct(w).colwise().sum().transpose();
    }
    return result;
}

/// Light of rows ([channel][component]) at every moment: [row][channel][moment].
Matrix moments_of(const Matrix& rows, const Matrix& weights) {
    const Eigen::Index q = weights.rows(), moments = weights.cols() / 3;
    Matrix result(rows.rows(), weights.cols());
    for (Eigen::Index c = 0; c < 3; ++c)
        result.middleCols(c * moments, moments).noalias() =
            rows.middleCols(c * q, q) * weights.middleCols(c * moments, moments);
    return result;
}

struct Patterns {
    Matrix values;  // row of TileRows::light x pattern, orthogonal columns
    Matrix light;   // pattern x (channel, component)
};

/// The first patterns of the tile, as many as keep its worst moment's error below what is asked.
/// gram   of all rows
/// seen   what the tile's light is judged against at each moment
Patterns principal_patterns(const TileJudge& judge, const TileRows& tile, const Matrix& gram, const Vector& seen,
                            const LightmapSettings& settings) {
    const Eigen::Index q = judge.components(), n = tile.light.rows();
    Matrix judged = judge.parts;
    for (Eigen::Index m = 0; m < seen.size(); ++m) judged.middleCols(7 * m, 7) /= seen[m];
    const Matrix metric = gram_of(judged.transpose()) / double(seen.size());
    // A root by eigenvectors, since few moments leave the metric singular, where Cholesky's breaks down.
    const EigenDecomposition of_metric = eigen_decomposition(metric);
    const Matrix root = of_metric.vectors * of_metric.values.cwiseMax(1e-10 * metric.trace()).cwiseSqrt().asDiagonal();
    Matrix turned(3 * q, 3 * q);
    for (Eigen::Index a = 0; a < 3; ++a)
        for (Eigen::Index b = 0; b < 3; ++b)
            turned.block(a * q, b * q, q, q) = root.transpose() * gram.block(a * q, b * q, q, q) * root;
    const EigenDecomposition principal = first_eigenvectors(turned, settings.most_patterns);

    Patterns result{Matrix(n, settings.most_patterns), Matrix(settings.most_patterns, 3 * q)};
    Vector left = moment_squares(gram, judge.truth);
    const auto allowed = [&](Eigen::Index patterns) -> Vector {
        const double error = patterns < settings.usual_patterns ? settings.error : settings.bad_error;
        return (error * seen).cwiseAbs2() * double(3 * tile.count());
    };
    Eigen::Index count = 0;
    const Eigen::Index most = std::min<Eigen::Index>(settings.most_patterns, std::min(n, 3 * q));
    while (count < most && (left.array() > allowed(count).array()).any()) {
        const double energy = principal.values[count];
        if (!(energy > 1e-12 * principal.values[0])) break;
        Vector direction(3 * q);
        for (Eigen::Index c = 0; c < 3; ++c)
            direction.segment(c * q, q) = root * principal.vectors.col(count).segment(c * q, q);
        result.values.col(count) = tile.light * direction;
        result.light.row(count) = (gram * direction / energy).transpose();
        const Matrix shines = moments_of(result.light.row(count), judge.truth);
        left -= energy * sum_channels(shines.cwiseAbs2());
        ++count;
    }
    result.values.conservativeResize(Eigen::NoChange, count);
    result.light.conservativeResize(count, Eigen::NoChange);
    return result;
}

std::int16_t rounded(double value, int most) {
    return std::int16_t(std::clamp<long>(std::lround(value), -most, most));
}

/// Rounds texels and patterns so that each pattern's rounding counts as little as asked when it shines most.
CodedTile quantise(const TileJudge& judge, const TileRows& tile, const Patterns& patterns, const Vector& seen,
                   const LightmapSettings& settings) {
    CodedTile coded;
    coded.patterns = std::size_t(patterns.values.cols());
    coded.rows = std::size_t(tile.light.rows());
    const Vector per_channel = seen.cwiseInverse().replicate(3, 1);
    const Matrix shines = moments_of(patterns.light, judge.truth) * per_channel.asDiagonal();
    // A moment's weights, over what is seen then.
    const double longest = (judge.truth.colwise().norm() * per_channel.asDiagonal()).maxCoeff();
    for (Eigen::Index p = 0; p < patterns.values.cols(); ++p) {
        const double peak = std::max(shines.row(p).cwiseAbs().maxCoeff(), 1e-30);
        const double largest = patterns.values.col(p).cwiseAbs().maxCoeff();
        const double step = std::max(settings.step / peak, largest / DayLightmap::kLargestValue);
        for (Eigen::Index i = 0; i < tile.light.rows(); ++i)
            coded.values.push_back(rounded(patterns.values(i, p) / step, DayLightmap::kLargestValue));
        const double typical = std::sqrt(patterns.values.col(p).squaredNorm() / double(tile.light.rows()));
        const double fine =
            std::max(0.5 * settings.step / (typical * longest), patterns.light.row(p).cwiseAbs().maxCoeff() / 32767.0);
        for (Eigen::Index i = 0; i < patterns.light.cols(); ++i)
            coded.light.push_back(rounded(patterns.light(p, i) / fine, 32767));
        coded.scales.push_back(float(step * fine * tile.brightness));
    }
    return coded;
}

/// What the tile's bytes show against the truth.
void measure(const TileJudge& judge, const TileRows& tile, const Vector& seen, CodedTile& coded) {
    const Eigen::Index q = judge.components(), k = Eigen::Index(coded.patterns);
    Matrix light(k, 3 * q);
    for (Eigen::Index p = 0; p < k; ++p)
        for (Eigen::Index i = 0; i < 3 * q; ++i)
            light(p, i) = double(coded.light[std::size_t(p * 3 * q + i)]) * double(coded.scales[std::size_t(p)]) /
                          tile.brightness;
    const Eigen::Index n = (tile.count() + kCheckedEvery - 1) / kCheckedEvery;
    Matrix rows(n, 3 * q), values(n, k);
    for (Eigen::Index i = 0; i < n; ++i) {
        rows.row(i) = tile.light.row(i * kCheckedEvery);
        for (Eigen::Index p = 0; p < k; ++p)
            values(i, p) = double(coded.values[std::size_t(p) * coded.rows + std::size_t(i * kCheckedEvery)]);
    }
    const Matrix truth = moments_of(rows, judge.truth).cwiseMax(0.0);  // few components swing below zero at times
    const Matrix found = (values * moments_of(light, judge.shown)).cwiseMax(0.0);
    const Eigen::RowVectorXd squares = (found - truth).cwiseAbs2().colwise().sum();
    coded.wrong = sum_channels(squares).cwiseQuotient(seen.cwiseAbs2());
    coded.all = Vector::Constant(seen.size(), double(3 * n));
}

CodedTile encode_tile(const TileJudge& judge, const TileRows& tile, const LightmapSettings& settings) {
    if (tile.count() == 0 || judge.components() == 0) return {};
    Matrix gram = gram_of(tile.texels());
    const Vector squares = moment_squares(gram, judge.truth);
    Vector seen = (squares / double(3 * tile.count())).cwiseMax(0.0).cwiseSqrt();
    const double brightest = seen.maxCoeff();
    if (!(brightest > 0.0)) return {};
    // Below the darkest row that counts, light is judged as if it had that much.
    seen = seen.cwiseMax(std::max(kDarkestMoment * brightest, double(kDarkestRow) / tile.brightness));
    if (tile.tilted) gram += gram_of(tile.light.bottomRows(2 * tile.count()));
    const Patterns patterns = principal_patterns(judge, tile, gram, seen, settings);
    CodedTile coded = quantise(judge, tile, patterns, seen, settings);
    measure(judge, tile, seen, coded);
    return coded;
}

/// Gaps between charts hold what the file's coder expects, which costs next to nothing.
void fill_gaps(std::span<const std::uint32_t> row_of_pixel, int tile, std::size_t patterns, DayLightmap& map) {
    const int x0 = tile % map.tiles_across() * map.kTileSide, y0 = tile / map.tiles_across() * map.kTileSide;
    for (int y = y0; y < std::min(y0 + map.kTileSide, map.height); ++y)
        for (int x = x0; x < std::min(x0 + map.kTileSide, map.width); ++x) {
            const std::size_t pixel = std::size_t(y) * std::size_t(map.width) + std::size_t(x);
            if (row_of_pixel[pixel] != ~0u) continue;
            if (x > x0) map.exponents[pixel] = map.exponents[pixel - 1];
            for (std::size_t p = 0; p < patterns; ++p) {
                const auto fill = [&](std::int16_t* plane) {
                    plane[pixel] = predicted_texel(plane, map.width, map.kTileSide, x, y);
                };
                fill(map.values.data() + p * map.texels());
                for (std::size_t axis = 0; !map.tilts.empty() && axis < 2; ++axis)
                    fill(map.tilts.data() + (2 * p + axis) * map.texels());
            }
        }
}

void place(const TileRows& tile, const CodedTile& coded, DayLightmap& map) {
    map.scales.insert(map.scales.end(), coded.scales.begin(), coded.scales.end());
    map.patterns.insert(map.patterns.end(), coded.light.begin(), coded.light.end());
    const std::size_t n = tile.pixels.size();
    for (std::size_t p = 0; p < coded.patterns; ++p)
        for (std::size_t i = 0; i < n; ++i) {
            map.values[p * map.texels() + tile.pixels[i]] = coded.values[p * coded.rows + i];
            for (std::size_t axis = 0; tile.tilted && axis < 2; ++axis)
                map.tilts[(2 * p + axis) * map.texels() + tile.pixels[i]] =
                    coded.values[p * coded.rows + (1 + axis) * n + i];
        }
    for (std::size_t i = 0; i < tile.pixels.size(); ++i) map.exponents[tile.pixels[i]] = tile.exponents[i];
}

}  // namespace

EncodedLightmap encode_lightmap(DayLightmap map, const LightRows& rows, const TiltRows& tilts,
                                std::span<const std::uint32_t> row_of_pixel, const LightmapSettings& settings) {
    JudgedBasis basis = judge_basis(rows, settings.basis);
    basis.stored = rounded(std::move(basis.stored));
    const TileJudge judge{rows,
                          tilts,
                          basis,
                          moment_weights(basis.dense, rows.moments),
                          moment_weights(basis.stored, rows.moments),
                          part_weights(basis.dense, rows.moments)};
    std::vector<TileRows> tiles(map.tiles());
    std::vector<CodedTile> coded(map.tiles());
    tbb::parallel_for(std::size_t(0), tiles.size(), [&](std::size_t t) {
        tiles[t] = tile_rows(judge, map, row_of_pixel, int(t));
        coded[t] = encode_tile(judge, tiles[t], settings);
        tiles[t].light.resize(0, 0);
    });

    EncodedLightmap result;
    result.keyframes_error = basis.error;
    map.basis = basis.stored;
    map.tile_patterns.clear();
    for (const CodedTile& c : coded) map.tile_patterns.push_back(std::uint8_t(c.patterns));
    map.tile_tilted.clear();
    for (std::size_t t = 0; t < tiles.size(); ++t)
        map.tile_tilted.push_back(tiles[t].tilted && coded[t].patterns > 0 ? 1 : 0);
    if (!map.tilted()) map.tile_tilted.clear();
    map.scales.clear(), map.patterns.clear();
    map.values.assign(std::size_t(map.slots()) * map.texels(), 0);
    map.tilts.assign(map.tilted() ? 2 * map.values.size() : 0, 0);
    map.exponents.assign(map.texels(), 0);
    Vector wrong = Vector::Zero(judge.moments()), all = Vector::Zero(judge.moments());
    double pixels = 0.0;
    for (std::size_t t = 0; t < tiles.size(); ++t) {
        place(tiles[t], coded[t], map);
        fill_gaps(row_of_pixel, int(t), coded[t].patterns, map);
        if (coded[t].wrong.size() == 0) continue;
        wrong += coded[t].wrong, all += coded[t].all;
        result.worst_tile =
            std::max(result.worst_tile, std::sqrt(coded[t].wrong.cwiseQuotient(coded[t].all).maxCoeff()));
        result.mean_patterns += double(coded[t].patterns * tiles[t].pixels.size());
        pixels += double(tiles[t].pixels.size());
    }
    if (pixels > 0.0) {
        result.error = std::sqrt(wrong.cwiseQuotient(all).maxCoeff());
        result.mean_patterns /= pixels;
    }
    map.error = result.error;
    result.map = std::move(map);
    return result;
}

std::vector<std::uint32_t> rows_of_pixels(const Atlas& atlas, const Texels& texels,
                                          std::span<const std::uint32_t> row_of_texel) {
    const auto row_of_cell = [&](std::size_t chart, std::size_t cell) {
        const std::uint32_t texel = texels.texel_of_cell[texels.first_cell[chart] + cell];
        return texel == kNoTexel ? ~0u : row_of_texel[texel];
    };
    std::vector<std::vector<std::uint32_t>> nearest(atlas.charts.size());
    tbb::parallel_for(std::size_t(0), atlas.charts.size(), [&](std::size_t id) {
        const PlacedChart& c = atlas.charts[id];
        std::vector<bool> lit(std::size_t(c.nx) * std::size_t(c.ny));
        for (std::size_t cell = 0; cell < lit.size(); ++cell) lit[cell] = row_of_cell(id, cell) != ~0u;
        nearest[id] = nearest_usable(c.nx, c.ny, lit);
    });
    std::vector<std::uint32_t> result(std::size_t(atlas.width) * std::size_t(atlas.height), ~0u);
    std::vector<int> distance(result.size(), std::numeric_limits<int>::max());  // from the texel that is shown
    for (std::size_t id = 0; id < atlas.charts.size(); ++id) {
        const PlacedChart& c = atlas.charts[id];
        for (int y = 0; y < c.atlas_height(); ++y)
            for (int x = 0; x < c.atlas_width(); ++x) {
                const std::uint32_t from = nearest[id][std::size_t(std::min(y, c.ny - 1)) * std::size_t(c.nx) +
                                                       std::size_t(std::min(x, c.nx - 1))];
                if (from == kNoTexel) continue;  // all of it inside solid geometry: black
                const std::size_t pixel = std::size_t(c.y + y) * std::size_t(atlas.width) + std::size_t(c.x + x);
                const int away = std::abs(x - int(from) % c.nx) + std::abs(y - int(from) / c.nx);
                if (away < distance[pixel]) distance[pixel] = away, result[pixel] = row_of_cell(id, from);
            }
    }
    return result;
}

}  // namespace daylit
