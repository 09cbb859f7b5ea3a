#pragma once
// The study of whether compressed lightmaps can be told from uncompressed ones in the level's pictures.
#include "demo/report/study.h"

namespace daylit {

/// One solution at the base's settings, its lightmap as bakes keep it, drawn at the report's views and hours; beside it
/// the same frames by the uncompressed lightmap of each hour. Both are displayed at the uncompressed frame's automatic
/// exposure and told apart by Yee's metric.
StudyResult compare_seen_frames(const BakeSettings& base, const Judges& judges, const Progress& progress);

}  // namespace daylit
