#pragma once
#include "gi/sweep.h"

namespace daylit {

/// The gather's settings for a report: rays per receiver and texels, each by factors of two around the base, and the
/// target error, which sets both.
std::vector<SweepPoint> day_gather_sweep(const BakeSettings& base);

}  // namespace daylit
