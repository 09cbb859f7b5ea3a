#pragma once
// Points with normals, and light measured at them, as CSV: rows x,y,z,nx,ny,nz and, where measured, r,g,b in lux.
// Lines that are empty or start with # are skipped, and so is one head line of names.
#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/units.h"

namespace daylit {

struct PointRow {
    Vec3 position, normal;
    Rgb value = Rgb(0.0f);  // zero where the file has no r,g,b
};

struct PointRows {
    std::vector<PointRow> rows;
    bool measured = false;  // has r,g,b
};

/// throws Error naming the line that is not 6 or 9 numbers, mixes both, or when there are no rows at all.
/// Values may be NaN or infinite ("nan", "inf"); positions and normals may not.
PointRows read_point_rows(const std::filesystem::path& path);

/// The same as text, numbers written so that they read back exactly.
std::string point_rows_text(const PointRows& points);

}  // namespace daylit
