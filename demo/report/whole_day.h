#pragma once
// The study of what a whole day costs beside one hour.
#include "demo/report/study.h"

namespace daylit {

/// Lightmaps baked at the base's settings, with the same rays: the whole day with all bounces, and the hour of the
/// reference nearest to noon with one bounce and with all. Those with all bounces are judged at points at that hour.
StudyResult compare_whole_day(const BakeSettings& base, const Judges& judges, const Progress& progress);

}  // namespace daylit
