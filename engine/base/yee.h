#pragma once
// Which pixels of two displayed pictures a viewer can tell apart: H. Yee, "A Perceptual Metric for Production Testing",
// journal of graphics tools 9(4), 2004. Written from the paper.
//
// OpenImageIO has the same metric as compare_Yee(), but reads channel 1 of its one-channel luminance images (2.4.7 and
// later), so that it sees differences of hue only: black against white passes. compare.h reports both counts.
#include <vector>

#include "engine/base/image.h"

namespace daylit {

/// One flag a pixel: 1 where the difference is visible. a, b: display-linear in [0,1], finite, same size.
/// White has 100 cd/m^2.
std::vector<unsigned char> yee_visible(const Image& a, const Image& b, double pixels_per_degree);

}  // namespace daylit
