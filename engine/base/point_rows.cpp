#include "engine/base/point_rows.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "engine/base/error.h"
#include "engine/base/file.h"

namespace daylit {
namespace {

constexpr std::size_t kPlaceColumns = 6, kMeasuredColumns = 9;

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::optional<float> number(std::string_view cell) {
    cell = trimmed(cell);
    if (!cell.empty() && cell.front() == '+') cell.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
    return float(value);
}

/// The numbers of a line; empty when a cell is no number or there are too many.
std::vector<float> numbers(std::string_view line) {
    std::vector<float> values;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find(',', begin), line.size());
        const auto value = number(line.substr(begin, end - begin));
        if (!value || values.size() == kMeasuredColumns) return {};
        values.push_back(*value);
        begin = end + 1;
    }
    return values;
}

bool finite(const std::vector<float>& values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        if (!std::isfinite(values[i])) return false;
    }
    return true;
}

}  // namespace

PointRows read_point_rows(const std::filesystem::path& path) {
    const std::vector<std::uint8_t> bytes = read_file(path);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    PointRows points;
    bool head_allowed = true;
    int line_number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view line = trimmed(text.substr(begin, end - begin));
        begin = end + 1;
        ++line_number;
        if (line.empty() || line.front() == '#') continue;
        const std::vector<float> values = numbers(line);
        if (values.empty() && head_allowed && line.find_first_of("xX") != std::string_view::npos) {
            head_allowed = false;
            continue;
        }
        head_allowed = false;
        const std::string place = "line " + std::to_string(line_number);
        if ((values.size() != kPlaceColumns && values.size() != kMeasuredColumns) || !finite(values, kPlaceColumns)) {
            throw Error(path.string(), place + " is not x,y,z,nx,ny,nz with or without r,g,b");
        }
        const bool measured = values.size() == kMeasuredColumns;
        if (!points.rows.empty() && measured != points.measured) {
            throw Error(path.string(), place + " has " + std::to_string(values.size()) + " columns, those before it not");
        }
        points.measured = measured;
        points.rows.push_back({Vec3(values[0], values[1], values[2]), Vec3(values[3], values[4], values[5]),
                               measured ? Rgb(values[6], values[7], values[8]) : Rgb(0.0f)});
    }
    if (points.rows.empty()) throw Error(path.string(), "holds no points (x,y,z,nx,ny,nz); make some with daylit points --sample");
    return points;
}

std::string point_rows_text(const PointRows& points) {
    std::string text = points.measured ? "x,y,z,nx,ny,nz,r,g,b\n" : "x,y,z,nx,ny,nz\n";
    const auto append = [&text](float value, char after) {
        std::array<char, 32> buffer;
        const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);  // shortest exact form
        text.append(buffer.data(), result.ptr);
        text += after;
    };
    for (const PointRow& row : points.rows) {
        for (int i = 0; i < 3; ++i) append(row.position[i], ',');
        for (int i = 0; i < 3; ++i) append(row.normal[i], i == 2 && !points.measured ? '\n' : ',');
        if (!points.measured) continue;
        for (int i = 0; i < 3; ++i) append(row.value[i], i == 2 ? '\n' : ',');
    }
    return text;
}

}  // namespace daylit
