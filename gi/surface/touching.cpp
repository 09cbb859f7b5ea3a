#include "gi/surface/touching.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace daylit {
namespace {

constexpr double kRounding = 5e-7;    // of coordinates: a few of a float's steps, that a corner may lie beside an edge
constexpr double kOnePlane = 0.9999;  // cosine between normals
constexpr std::size_t kCrowd = 256;   // sides at one place, beyond which they are not compared
constexpr double kMostCells = 4096;   // that a side runs through
const glm::dvec3 kPreferred(1, 1.1, 1.23);  // of axes: rounding does not choose between those of a diagonal

struct Segment {
    glm::dvec3 a, b;
    double slack;  // metres, that rounding may have moved it by
    glm::dvec3 along() const { return b - a; }
};

Segment segment(const WorldMesh& mesh, const TriangleSide& s) {
    const std::uint32_t* corner = &mesh.indices[3 * std::size_t(s.triangle)];
    const glm::dvec3 a = mesh.positions[corner[s.side]], b = mesh.positions[corner[(s.side + 1) % 3]];
    const glm::dvec3 far = glm::max(glm::abs(a), glm::abs(b));
    return {a, b, kRounding * std::max({far.x, far.y, far.z})};
}

/// Whether they lie on one line, run against each other, and overlap.
bool touch(const Segment& s, const Segment& t) {
    const bool s_is_longer = glm::dot(s.along(), s.along()) >= glm::dot(t.along(), t.along());
    const Segment &longer = s_is_longer ? s : t, &shorter = s_is_longer ? t : s;
    const double length = glm::length(longer.along()), slack = s.slack + t.slack;
    if (!(length > 0.0)) return false;
    const glm::dvec3 u = longer.along() / length;
    const auto place = [&](const glm::dvec3& p) { return glm::dot(p - longer.a, u); };
    const auto away = [&](const glm::dvec3& p) { return glm::distance(p, longer.a + place(p) * u); };
    if (!(std::max(away(shorter.a), away(shorter.b)) <= slack)) return false;
    const double from = std::max(place(shorter.b), 0.0), to = std::min(place(shorter.a), length);
    return to - from > 4.0 * slack;
}

/// A cell of the grid that sides are sorted into, and one of them.
struct Entry {
    int axis;
    std::array<std::int64_t, 3> cell;
    std::uint32_t side;
    auto place() const { return std::tie(axis, cell); }
    auto order() const { return std::tie(axis, cell, side); }
};

/// One entry for each slab across its main axis, and more where a cell's border is near: sides on one line share cells.
void sort_in(const Segment& s, std::uint32_t side, double size, std::vector<Entry>& entries) {
    const glm::dvec3 d = glm::abs(s.along()) * kPreferred;
    const int axis = d.x >= d.y && d.x >= d.z ? 0 : d.y >= d.z ? 1 : 2, v = (axis + 1) % 3, w = (axis + 2) % 3;
    const auto cell = [&](double x) { return std::int64_t(std::floor(x / size)); };
    const auto [low, high] = std::minmax(s.a[axis], s.b[axis]);
    for (std::int64_t slab = cell(low); slab <= cell(high); ++slab) {
        const double share =
            s.a[axis] == s.b[axis] ? 0.0 : ((double(slab) + 0.5) * size - s.a[axis]) / (s.b[axis] - s.a[axis]);
        const glm::dvec3 middle = s.a + share * s.along();
        for (std::int64_t y = cell(middle[v] - 2 * s.slack); y <= cell(middle[v] + 2 * s.slack); ++y)
            for (std::int64_t z = cell(middle[w] - 2 * s.slack); z <= cell(middle[w] + 2 * s.slack); ++z)
                entries.push_back({axis, {slab, y, z}, side});
    }
}

/// Of cells such that sides run through two of them on average.
double cell_size(std::span<const Segment> segments) {
    double sum = 0.0, longest = 0.0, slack = 0.0;
    for (const Segment& s : segments) {
        const double length = glm::length(s.along());
        sum += length, longest = std::max(longest, length), slack = std::max(slack, s.slack);
    }
    return std::max({sum / double(segments.size()), longest / kMostCells, 16.0 * slack});
}

std::vector<Entry> entries_of(std::span<const Segment> segments) {
    const double size = cell_size(segments);
    std::vector<Entry> entries;
    if (!(size > 0.0) || !std::isfinite(size)) return entries;
    for (std::uint32_t i = 0; i < segments.size(); ++i) sort_in(segments[i], i, size, entries);
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.order() < b.order(); });
    return entries;
}

}  // namespace

std::vector<std::array<std::uint32_t, 2>> touching(const WorldMesh& mesh, std::span<const Facet> facets,
                                                   std::span<const TriangleSide> sides) {
    std::vector<Segment> segments;
    for (const TriangleSide& s : sides) segments.push_back(segment(mesh, s));
    std::vector<std::array<std::uint32_t, 2>> pairs;
    const auto compare = [&](std::uint32_t a, std::uint32_t b) {
        const std::uint32_t s = sides[a].triangle, t = sides[b].triangle;
        if (s != t && double(glm::dot(facets[s].normal, facets[t].normal)) > kOnePlane &&
            touch(segments[a], segments[b]))
            pairs.push_back({std::min(s, t), std::max(s, t)});
    };
    const std::vector<Entry> entries = entries_of(segments);
    for (std::size_t i = 0, end = 0; i < entries.size(); i = end) {
        while (end < entries.size() && entries[end].place() == entries[i].place()) ++end;
        if (end - i > kCrowd) continue;
        for (std::size_t a = i; a < end; ++a)
            for (std::size_t b = a + 1; b < end; ++b) compare(entries[a].side, entries[b].side);
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

}  // namespace daylit
