#include "demo/points_csv.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "engine/base/error.h"
#include "engine/base/file.h"

namespace daylit {
namespace {

std::string_view trim(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// The first `count` numbers of a row; false when there are fewer, or something else stands there.
bool parse_row(std::string_view row, std::span<float> numbers) {
    for (float& number : numbers) {
        const std::size_t comma = row.find(',');
        const std::string_view cell = trim(row.substr(0, comma));
        const auto [end, problem] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
        if (problem != std::errc() || end != cell.data() + cell.size() || !std::isfinite(number)) return false;
        row = comma == std::string_view::npos ? std::string_view() : row.substr(comma + 1);
    }
    return true;
}

}  // namespace

std::vector<SurfaceSample> read_points(const std::filesystem::path& path) {
    const std::vector<std::uint8_t> bytes = read_file(path);
    std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    std::vector<SurfaceSample> points;
    for (int line = 1; !rest.empty(); ++line) {
        const std::size_t end = rest.find('\n');
        const std::string_view row = trim(rest.substr(0, end));
        rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
        if (row.empty() || row.front() == '#' || (points.empty() && row.starts_with("x,"))) continue;
        std::array<float, 6> v;
        if (!parse_row(row, v))
            throw Error(path.string(), "line " + std::to_string(line) + " is not x,y,z,nx,ny,nz in finite numbers");
        const Vec3 normal(v[3], v[4], v[5]);
        if (!(glm::length(normal) > 0.0f))
            throw Error(path.string(), "line " + std::to_string(line) + " has a normal of no length");
        points.push_back({Vec3(v[0], v[1], v[2]), glm::normalize(normal)});
    }
    if (points.empty()) throw Error(path.string(), "holds no points; make some with daylit points --sample");
    return points;
}

void write_points(const std::filesystem::path& path, std::span<const SurfaceSample> points,
                  std::span<const Rgb> irradiance) {
    std::string text = irradiance.empty() ? "x,y,z,nx,ny,nz\n" : "x,y,z,nx,ny,nz,r,g,b\n";
    char row[200];
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto& [p, n] = points[i];
        // Nine digits bring every float back exactly.
        std::snprintf(row, sizeof row, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g", p.x, p.y, p.z, n.x, n.y, n.z);
        text += row;
        if (!irradiance.empty()) {
            const Rgb& e = irradiance[i];
            std::snprintf(row, sizeof row, ",%.9g,%.9g,%.9g", e.r, e.g, e.b);
            text += row;
        }
        text += '\n';
    }
    write_file(path, text);
}

}  // namespace daylit
