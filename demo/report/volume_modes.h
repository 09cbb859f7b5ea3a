#pragma once
// The study of how an irradiance volume is kept and looked up.
#include "demo/report/study.h"

namespace daylit {

/// One solution at the base's settings, sampled once. Each way has an octree of several sizes that is refined by its
/// own errors and records that are fitted to the same samples by its own interpolant; only then are they compared, at
/// points in free space: with the reference, and with the gather itself at these points (many rays, three bands), which
/// leaves what storing and interpolating adds.
StudyResult compare_volume_modes(const BakeSettings& base, const Judges& judges, const Progress& progress);

}  // namespace daylit
