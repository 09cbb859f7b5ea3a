#pragma once
// LDR-FLIP: how different two pictures look when one flips between them.
// P. Andersson, J. Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astroem, M. D. Fairchild, "FLIP: A Difference Evaluator
// for Alternating Images", HPG 2020. Written from the paper's equations.
#include <vector>

#include "engine/base/image.h"

namespace daylit {

/// The paper's viewing condition: a 0.7 m wide display of 3840 pixels seen from 0.7 m.
inline constexpr double kFlipPixelsPerDegree = 67.0;

/// One value a pixel, 0 (alike) to 1, row by row.
///   a, b    display-linear Rec. 709 in [0,1] (what the sRGB code stands for), same size; clamped, NaN counts as 0.
///           The measure is symmetric.
std::vector<float> flip(const Image& a, const Image& b, double pixels_per_degree = kFlipPixelsPerDegree);

}  // namespace daylit
