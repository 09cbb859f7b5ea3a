#pragma once
// The day lightmap in a file: sections 'LMAP', 'LMUV', 'LMPT', 'LMTX', 'LMTI'.
#include "engine/baked/day_lightmap.h"
#include "engine/baked/section_file.h"

namespace daylit {

std::vector<CodedSection> code_lightmap(const DayLightmap& map);
bool has_lightmap(const SectionFile& file);
DayLightmap read_lightmap(const SectionFile& file);

/// Shape, basis and error alone: no texels, patterns or coordinates are read.
DayLightmap read_lightmap_shape(const SectionFile& file);

}  // namespace daylit
