#pragma once
// The irradiance volume in a file: sections 'VOLU', 'VOTR', 'VORE'.
#include "engine/baked/irradiance_volume.h"
#include "engine/baked/section_file.h"

namespace daylit {

std::vector<CodedSection> code_volume(const IrradianceVolume& volume);
bool has_volume(const SectionFile& file);
IrradianceVolume read_volume(const SectionFile& file);

}  // namespace daylit
