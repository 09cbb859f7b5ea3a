#include "demo/points_csv.h"

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/point_rows.h"

namespace daylit {

std::vector<SurfaceSample> read_points(const std::filesystem::path& path) {
    std::vector<SurfaceSample> points;
    for (const PointRow& row : read_point_rows(path).rows) {
        if (!(glm::length(row.normal) > 0.0f)) {
            throw Error(path.string(), "point " + std::to_string(points.size() + 1) + " has a normal of no length");
        }
        points.push_back({row.position, glm::normalize(row.normal)});
    }
    return points;
}

void write_points(const std::filesystem::path& path, std::span<const SurfaceSample> points,
                  std::span<const Rgb> irradiance) {
    PointRows out;
    out.measured = !irradiance.empty();
    for (std::size_t i = 0; i < points.size(); ++i) {
        out.rows.push_back({points[i].position, points[i].normal, out.measured ? irradiance[i] : Rgb(0.0f)});
    }
    write_file(path, point_rows_text(out));
}

}  // namespace daylit
