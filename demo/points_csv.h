#pragma once
// Points as CSV: x,y,z,nx,ny,nz in metres, then r,g,b in lux where a method has filled them in. A line of names may
// stand first; lines that start with # are comments.
#include <filesystem>
#include <span>
#include <vector>

#include "gi/transport/path_trace/path_trace.h"

namespace daylit {

/// Places and normals, these made unit. throws Error that names the line.
std::vector<SurfaceSample> read_points(const std::filesystem::path& path);

/// `irradiance`: one per point, or empty.
void write_points(const std::filesystem::path& path, std::span<const SurfaceSample> points,
                  std::span<const Rgb> irradiance = {});

}  // namespace daylit
