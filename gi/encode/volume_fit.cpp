#include "gi/encode/volume_fit.h"

#include <tbb/parallel_for.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "engine/base/error.h"

namespace daylit {
namespace {

constexpr double kHeld = 1e-9;          // weight of the start, against all that is said of an unknown
constexpr std::size_t kColumns = SampleLight::kRun;  // solved together
constexpr float kMostOfChange = 0.25f;  // weight of a change that rays told, against a value: silhouettes are not in it
constexpr double kSteepest = 1.0;       // most of a change over the cell's side, against the light itself
constexpr double kDarkest = 1e-5;       // of the mean brightness: the darkest that errors are relative to
constexpr float kEven = 0.05f;          // of that weight, that nothing changes there
constexpr float kWeakly = 0.1f;         // weight of guesses, against what was measured

/// Sparse rows: number i of a row counts weight times.
struct Entry {
    std::uint32_t unknown;
    float weight;
};
using Row = std::vector<Entry>;

void add_scaled(float factor, const Row& from, Row& to) {
    for (const Entry& e : from) to.push_back({e.unknown, factor * e.weight});
}

/// Entries of one unknown become one.
void tidy(Row& row) {
    std::sort(row.begin(), row.end(), [](const Entry& a, const Entry& b) { return a.unknown < b.unknown; });
    std::size_t kept = 0;
    for (const Entry& e : row) {
        if (kept > 0 && row[kept - 1].unknown == e.unknown)
            row[kept - 1].weight += e.weight;
        else
            row[kept++] = e;
    }
    row.resize(kept);
}

struct Equation {
    Row row;
    float weight = 1.0f;
    const SampleLight* light = nullptr;  // of which a part is what the row is to come to; null: zero
    std::size_t part = 0;
    float scale = 1.0f;  // of that part
};

class Fitter {
  public:
    Fitter(const OctreeCells& cells, const RefinedVolume& refined, std::size_t numbers, VolumeBlend blend)
        : cells_(cells), refined_(refined), numbers_(numbers), blend_(blend) {}

    VolumeFit fit() {
        find_sides();
        find_darkest();
        expand_hanging();
        state_corners();
        state_insides();
        state_before_walls();
        guess_unmeasured();
        factor();
        VolumeFit result;
        for (const VolumeSample* sample : measured_) result.measured.push_back(sample != nullptr);
        result.records.assign(4 * cells_.samples.size() * numbers_, 0.0f);
        const std::size_t blocks = (numbers_ + kColumns - 1) / kColumns;
        tbb::parallel_for(std::size_t(0), blocks, [&](std::size_t b) {
            solve(b * kColumns, std::min(numbers_, (b + 1) * kColumns), result.records);
        });
        return result;
    }

  private:
    const RefinedLeaf& leaf(const LeafSide& side) const { return refined_.leaves.at(side.leaf); }
    const VolumeSample* sample(const LeafSide& side, int place) const {
        const RefinedLeaf& l = leaf(side);
        if (l.side[std::size_t(place)] != side.side) return nullptr;
        const int s = refined_.places.places[l.place[std::size_t(place)]].sample;
        return s < 0 || refined_.places.samples[std::size_t(s)].inside ? nullptr
                                                                       : &refined_.places.samples[std::size_t(s)];
    }

    /// Unknowns are values and changes over the side of the largest cell that has the record.
    void find_sides() {
        for (const SampledCorner& corner : cells_.samples)
            side_.push_back(refined_.octree.side_of(refined_.octree.nodes[corner.seen_by[0].leaf]));
    }

    void find_darkest() {
        double sum = 0.0;
        for (const VolumeSample& s : refined_.places.samples) sum += brightness(s);
        darkest_ = kDarkest * sum / double(std::max<std::size_t>(refined_.places.samples.size(), 1));
    }

    /// Errors count relative to the light where they are: else what is left of a bright room's, when steps end, would
    /// be as much as all the light of the dark room beside it.
    float importance(const VolumeSample& sample) const {
        const double light = std::max({brightness(sample), darkest_, 1e-15});
        return float(1.0 / (light * light));
    }

    void expand_hanging() {
        const VolumeTree& tree = cells_.tree;
        rows_.resize(4 * tree.records());
        for (std::uint32_t u = 0; u < 4 * tree.samples; ++u) rows_[u] = {{u, u % 4 == 0 ? 1.0f : 1.0f / side_[u / 4]}};
        for (std::size_t h = 0; h < tree.hanging.size(); ++h)
            for (std::size_t part = 0; part < 4; ++part) {
                const glsl::VolumeCell& from = tree.cells[tree.hanging[h].cell[part]];
                const Vec3& t = tree.hanging[h].t[part];
                Row& row = rows_[4 * (tree.samples + h) + part];
                blend(from, weights_of(t, from.box.w, part), row);
                tidy(row);
            }
    }

    /// Of the interpolant (part 0), or of its change along x, y, z.
    std::array<Vec4, 8> weights_of(const Vec3& t, float side, std::size_t part) const {
        return part == 0 ? blend_weights(blend_, t, side) : blend_weights_change(blend_, t, side, int(part) - 1);
    }

    void blend(const glsl::VolumeCell& cell, const std::array<Vec4, 8>& weights, Row& row) const {
        for (int corner = 0; corner < 8; ++corner)
            for (int part = 0; part < 4; ++part) {
                const float weight = weights[std::size_t(corner)][part];
                if (weight != 0.0f) add_scaled(weight, rows_[4 * record_of(cell, corner) + std::size_t(part)], row);
            }
    }

    /// Of what is seen from a sample, in halves of this many metres, at most 1.
    static float nearness(const VolumeSample& sample, float side) {
        return std::min(1.0f, 2.0f * sample.nearness / side);
    }

    /// Of a change over this many metres, against its value. Beside a wall it says nothing about a large cell.
    static float weight_of_change(const VolumeSample& sample, float side) {
        const float noise = sample.change_noise * side, near = nearness(sample, side);
        return near * near * (noise > 0.0f ? std::min(kMostOfChange, 1.0f / (noise * noise)) : kMostOfChange);
    }

    /// Share that is believed of a change over this many metres. Beside an opening light changes as steeply as it can
    /// over a hand's breadth only: over a large cell that would be many times the light itself, and swing below zero.
    /// The hour at which it is worst decides for all numbers, so that colours keep their proportion.
    static float believed(const VolumeSample& sample, float side) {
        const std::size_t functionals = sample.judged.size() / 4, hours = functionals / kJudgedSides;
        double share = 1.0;
        for (std::size_t hour = 0; hour < hours; ++hour) {
            double light = 0.0, change = 0.0;
            for (std::size_t i = hour; i < 4 * functionals; i += hours)
                (i < functionals ? light : change) += double(sample.judged[i]) * double(sample.judged[i]);
            if (change > 0.0) share = std::min(share, kSteepest * std::sqrt(light / change) / double(side));
        }
        return float(share);
    }

    void state_corners() {
        for (std::uint32_t s = 0; s < cells_.samples.size(); ++s) {
            const SampledCorner& corner = cells_.samples[s];
            const VolumeSample* found = nullptr;
            for (const LeafSide& side : corner.seen_by)
                for (int p = 0; p < kLeafPlaces && !found; ++p)
                    if (refined_.places.places[leaf(side).place[std::size_t(p)]].at == corner.at)
                        found = sample(side, p);
            measured_.push_back(found);
            if (!found) continue;
            const float importance_here = importance(*found);
            equations_.push_back({{{4 * s, 1.0f}}, importance_here, &found->light});
            const float weight = weight_of_change(*found, side_[s]);
            const float scale = believed(*found, side_[s]) * side_[s];
            for (std::uint32_t a = 1; a < 4; ++a)
                equations_.push_back({{{4 * s + a, 1.0f}}, importance_here * weight, &found->light, a, scale});
        }
    }

    void state_insides() {
        for (std::uint32_t c = 0; c < cells_.cells.size(); ++c)
            for (int p = 0; p < kLeafPlaces; ++p) {
                if (is_corner(p)) continue;  // stated already
                const VolumeSample* measured = sample(cells_.cells[c], p);
                if (!measured) continue;
                Equation equation{{}, importance(*measured), &measured->light};
                const glsl::VolumeCell& cell = cells_.tree.cells[c];
                blend(cell, weights_of(t_of(p), cell.box.w, 0), equation.row);
                tidy(equation.row);
                equations_.push_back(std::move(equation));
            }
    }

    void state_before_walls() {
        for (std::uint32_t c = 0; c < cells_.cells.size(); ++c)
            for (const RefinedLeaf::WallSample& at : leaf(cells_.cells[c]).before_walls) {
                if (at.side != cells_.cells[c].side) continue;
                const VolumeSample& measured = refined_.places.samples[std::size_t(at.sample)];
                const glsl::VolumeCell& cell = cells_.tree.cells[c];
                // It tells of a thin layer, the thinner the larger the cell.
                const float of_value = nearness(measured, cell.box.w) * importance(measured);
                const float of_change = of_value * weight_of_change(measured, cell.box.w);
                const float scale = believed(measured, cell.box.w) * cell.box.w;
                for (std::size_t part = 0; part < 4; ++part) {
                    Equation equation{{}, of_value, &measured.light, part};
                    blend(cell, weights_of(at.t, cell.box.w, part), equation.row);
                    tidy(equation.row);
                    if (part > 0) {  // over the cell's side, as at corners
                        equation.weight = of_change, equation.scale = scale;
                        for (Entry& e : equation.row) e.weight *= cell.box.w;
                    }
                    equations_.push_back(std::move(equation));
                }
            }
    }

    /// What nothing is measured about is even, and as bright as before the wall, or as the nearest measured place of
    /// its cell.
    void guess_unmeasured() {
        for (std::uint32_t s = 0; s < cells_.samples.size(); ++s) {
            if (measured_[s]) continue;
            const VolumeSample* before = sample_before(cells_.samples[s]);
            const VolumeSample* guess = before ? before : nearest_sample(cells_.samples[s]);
            guess_.emplace_back(s, guess);
            const float weak = kWeakly * (guess ? importance(*guess) : 1.0f);
            equations_.push_back({{{4 * s, 1.0f}}, weak, guess ? &guess->light : nullptr});
            for (std::uint32_t a = 1; a < 4; ++a) equations_.push_back({{{4 * s + a, 1.0f}}, kEven * weak});
        }
    }

    const VolumeSample* sample_before(const SampledCorner& corner) const {
        for (const LeafSide& side : corner.seen_by)
            for (const RefinedLeaf::WallSample& at : leaf(side).before_walls)
                if (at.side == side.side &&
                    refined_.places.places[leaf(side).place[std::size_t(at.place)]].at == corner.at)
                    return &refined_.places.samples[std::size_t(at.sample)];
        return nullptr;
    }

    const VolumeSample* nearest_sample(const SampledCorner& corner) const {
        const VolumeSample* nearest = nullptr;
        double least = 1e30;
        for (const LeafSide& side : corner.seen_by)
            for (int p = 0; p < kLeafPlaces; ++p) {
                const Lattice& at = refined_.places.places[leaf(side).place[std::size_t(p)]].at;
                const double distance = glm::length(glm::dvec3(at - corner.at));
                if (distance < least && sample(side, p)) least = distance, nearest = sample(side, p);
            }
        return nearest;
    }

    using Sparse = Eigen::SparseMatrix<double>;
    using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    /// The normal equations are those of every number: factored once, their unknowns scaled to a diagonal of one.
    void factor() {
        std::vector<Eigen::Triplet<double>> entries;
        unit_ = Eigen::VectorXd::Zero(Eigen::Index(4 * cells_.samples.size()));
        for (std::size_t q = 0; q < equations_.size(); ++q) {
            const double root = std::sqrt(double(equations_[q].weight));
            for (const Entry& e : equations_[q].row) {
                entries.emplace_back(int(q), int(e.unknown), root * double(e.weight));
                unit_[e.unknown] += entries.back().value() * entries.back().value();
            }
        }
        for (double& u : unit_) u = u > 0.0 ? 1.0 / std::sqrt(u) : 0.0;  // 0: nothing is said of it, it stays
        Sparse stated(Eigen::Index(equations_.size()), unit_.size());
        stated.setFromTriplets(entries.begin(), entries.end());
        stated = stated * unit_.asDiagonal();
        Sparse normal = stated.transpose() * stated;
        Sparse held(unit_.size(), unit_.size());
        held.setIdentity();
        factor_.compute(normal + kHeld * held);
        if (factor_.info() != Eigen::Success) throw Error("volume", "its samples do not determine its records");
    }

    /// Of numbers [first, last): least squares, as what is added to the start.
    void solve(std::size_t first, std::size_t last, std::vector<float>& records) const {
        const std::size_t columns = last - first;
        Columns x = Columns::Zero(unit_.size(), Eigen::Index(columns)), left = x;
        start(first, columns, x);
        Eigen::RowVectorXd line(columns);
        for (const Equation& e : equations_) {
            line.setZero();
            if (e.light) e.light->read(e.part, first, {line.data(), columns}), line *= double(e.scale);
            for (const Entry& entry : e.row) line -= double(entry.weight) * x.row(entry.unknown);
            for (const Entry& entry : e.row) left.row(entry.unknown) += double(e.weight) * double(entry.weight) * line;
        }
        left.array().colwise() *= unit_.array();
        Columns ordered = factor_.permutationP() * left;
        substitute(ordered);
        left = factor_.permutationPinv() * ordered;
        x += unit_.asDiagonal() * left;
        for (Eigen::Index u = 0; u < unit_.size(); ++u)
            for (std::size_t i = 0; i < columns; ++i)
                records[std::size_t(u) * numbers_ + first + i] =
                    float(x(u, Eigen::Index(i))) / (u % 4 == 0 ? 1.0f : side_[std::size_t(u / 4)]);
    }

    /// L D L^T y = y for all columns at once; Eigen's own goes through the factor once a column.
    void substitute(Columns& y) const {
        const Sparse& lower = factor_.matrixL().nestedExpression();
        const auto each_below = [&](Eigen::Index j, const auto& use) {
            for (Sparse::InnerIterator l(lower, j); l; ++l)
                if (l.row() > j) use(l.row(), l.value());
        };
        for (Eigen::Index j = 0; j < y.rows(); ++j)
            each_below(j, [&](Eigen::Index i, double l) { y.row(i) -= l * y.row(j); });
        for (Eigen::Index j = y.rows(); j-- > 0;) {
            y.row(j) /= factor_.vectorD()[j];
            each_below(j, [&](Eigen::Index i, double l) { y.row(j) -= l * y.row(i); });
        }
    }

    /// From what was measured at the corners, and the nearest elsewhere.
    void start(std::size_t first, std::size_t columns, Columns& x) const {
        for (std::size_t s = 0; s < measured_.size(); ++s) {
            if (!measured_[s]) continue;
            // A change that is all noise, as beside a wall, is no place to start at.
            const float certain = believed(*measured_[s], side_[s]) * side_[s] *
                                  weight_of_change(*measured_[s], side_[s]) / kMostOfChange;
            for (std::size_t part = 0; part < 4; ++part) {
                const auto row = Eigen::Index(4 * s + part);
                measured_[s]->light.read(part, first, {x.row(row).data(), columns});
                if (part > 0) x.row(row) *= double(certain);
            }
        }
        for (const auto& [s, nearest] : guess_)
            if (nearest) nearest->light.read(0, first, {x.row(Eigen::Index(4 * s)).data(), columns});
    }

    const OctreeCells& cells_;
    const RefinedVolume& refined_;
    std::size_t numbers_;
    VolumeBlend blend_;
    double darkest_ = 0.0;
    std::vector<float> side_;                    // per sampled record, metres
    std::vector<Row> rows_;                      // per record and part: by unknowns
    std::vector<const VolumeSample*> measured_;  // per sampled record; null: not measured
    std::vector<std::pair<std::uint32_t, const VolumeSample*>> guess_;
    std::vector<Equation> equations_;
    Eigen::VectorXd unit_;  // per unknown: what it is counted in
    Eigen::SimplicialLDLT<Sparse> factor_;
};

}  // namespace

VolumeFit fit_volume(const OctreeCells& cells, const RefinedVolume& refined, std::size_t numbers, VolumeBlend blend) {
    return Fitter(cells, refined, numbers, blend).fit();
}

SameLight same_light_by_rays(const RefinedVolume& refined, const FreeSpace& space) {
    return [&refined, &space](const Lattice& corner, const LeafSide& a, const LeafSide& b) {
        const auto nearest = [&](const LeafSide& side) {
            const RefinedLeaf& leaf = refined.leaves.at(side.leaf);
            const VolumePlaces::Place* best = nullptr;
            double least = 1e30;
            for (int p = 0; p < kLeafPlaces; ++p) {
                if (leaf.side[std::size_t(p)] != side.side) continue;
                const VolumePlaces::Place& place = refined.places.places[leaf.place[std::size_t(p)]];
                const double distance = glm::length(glm::dvec3(place.at - corner));
                if (distance < least) least = distance, best = &place;
            }
            return best;
        };
        const VolumePlaces::Place *at_a = nearest(a), *at_b = nearest(b);
        if (!at_a || !at_b) return false;
        return at_a->at == at_b->at || space.open(refined.octree.place(at_a->at), refined.octree.place(at_b->at));
    };
}

}  // namespace daylit
