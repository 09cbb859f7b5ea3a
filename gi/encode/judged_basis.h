#pragma once
// The basis that a file stores: the gather's components turned so that errors count as the eye sees them, and curves
// through few keyframes.
#include <Eigen/Core>
#include <vector>

#include "gi/encode/light_rows.h"

namespace daylit {

/// Rows change from the gather's components to these by `turn`; in these, a row's length is its brightness: the root
/// mean square, over moments and parts of light, of its light over the exposure.
struct JudgedBasis {
    LightBasis dense;      // a keyframe at every hour that was solved for: the truth
    LightBasis stored;     // at few keyframes
    Eigen::MatrixXf turn;  // gather's components x components
    double error = 0.0;    // of the keyframes: worst moment, relative
};

/// Principal components over moments and parts (Bahnsen et al. 2012, with columns divided by exposure so that dusk
/// counts as much as noon, and rows by their own brightness so that a dark room counts as much as the courtyard):
/// exact, by the metric that moments make of the gather's components. Keyframes are added where the worst moment is,
/// judged at every hour that was solved for.
JudgedBasis judge_basis(const LightRows& rows, const BasisSettings& settings);

/// The weights of a basis at every moment over its exposure: [component][channel * moments + moment].
Eigen::MatrixXd moment_weights(const LightBasis& basis, std::span<const Moment> moments);

/// The same, part by part and in luminance: [component][7 * moment + part].
Eigen::MatrixXd part_weights(const LightBasis& basis, std::span<const Moment> moments);

// A row darker than this share of what the eye is adapted to is judged as if it had that much.
inline constexpr float kDarkestRow = 1e-3f;

}  // namespace daylit
