#pragma once
// The irradiance volume in a file: sections 'VOLU', 'VOTR', 'VOLR'.
#include "engine/baked/irradiance_volume.h"
#include "engine/baked/section_file.h"

namespace daylit {

/// Its name tells how records are coded: those of files that were baked before were 'VORE'.
inline constexpr char kRecordSection[5] = "VOLR";

std::vector<CodedSection> code_volume(const IrradianceVolume& volume);
bool has_volume(const SectionFile& file);
IrradianceVolume read_volume(const SectionFile& file);

}  // namespace daylit
