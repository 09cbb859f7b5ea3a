#pragma once
// A Level as one binary glTF 2.0 file, through tinygltf.
#include <filesystem>

#include "content/level.h"

namespace daylit::content {

/// Whole file or nothing; same level, same bytes. Tangents are written for materials with a normal picture.
/// throws Error when the place is not writable.
void write_glb(const Level& level, const std::filesystem::path& path);

}  // namespace daylit::content
