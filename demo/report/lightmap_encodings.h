#pragma once
// The study of how one day's lightmaps are stored: tiles as bakes keep them, the scheme of Bahnsen et al. 2012, frames.
#include "demo/report/study.h"

namespace daylit {

/// One solution at the base's settings without tilts; bytes are those of the light alone, since all share the layout.
/// Every way is judged at points by the reference, and at every hour that was solved for against the uncompressed
/// lightmap: texels of grey surfaces (albedo 0.5) as displayed at the hour's automatic exposure, RMS of sRGB values.
StudyResult compare_lightmap_encodings(const BakeSettings& base, const Judges& judges, const Progress& progress);

}  // namespace daylit
