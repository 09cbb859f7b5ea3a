#include "demo/points_csv.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/point_rows.h"
#include "engine/base/vec.h"
#include "engine/scene/gltf.h"

namespace daylit {

std::vector<SurfaceSample> read_points(const std::filesystem::path& path) {
    std::vector<SurfaceSample> points;
    for (const PointRow& row : read_point_rows(path).rows) {
        const std::string place = "point " + std::to_string(points.size() + 1);
        const Vec3 normal = unit_or(row.normal, Vec3(0.0f)), distance = glm::abs(row.position);
        if (normal == Vec3(0.0f)) throw Error(path.string(), place + " has a normal of no length");
        if (std::max({distance.x, distance.y, distance.z}) > kMaxCoordinate)
            throw Error(path.string(), place + " lies more than 1e8 m from the origin");
        points.push_back({row.position, normal});
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
