#include "content/blocks.h"

#include <algorithm>

namespace daylit::content {

int Blocks::add_solid(const Finish& finish) {
    solids_.push_back(finish);
    return int(solids_.size()) - 1;
}

int Blocks::add_room(const Finish& finish) {
    rooms_.push_back(finish);
    return int(rooms_.size()) - 1;
}

void Blocks::fill(const Vec3& low, const Vec3& high, int solid) {
    operations_.push_back({low, high, solid, 0, false});
    built_ = false;
}

void Blocks::carve(const Vec3& low, const Vec3& high, int room) {
    operations_.push_back({low, high, -1, room, false});
    built_ = false;
}

void Blocks::cover(const Vec3& low, const Vec3& high, int room) {
    operations_.push_back({low, high, -1, room, true});
    built_ = false;
}

const Blocks::Cell& Blocks::cell(int x, int y, int z) const {
    static const Cell outside;
    const int nx = int(lines_[0].size()) - 1, ny = int(lines_[1].size()) - 1, nz = int(lines_[2].size()) - 1;
    if (x < 0 || y < 0 || z < 0 || x >= nx || y >= ny || z >= nz) return outside;
    return cells_[(std::size_t(y) * std::size_t(nz) + std::size_t(z)) * std::size_t(nx) + std::size_t(x)];
}

Vec3 Blocks::point(const std::array<int, 3>& i) const {
    return {lines_[0][std::size_t(i[0])], lines_[1][std::size_t(i[1])], lines_[2][std::size_t(i[2])]};
}

std::size_t Blocks::corner_key(const std::array<int, 3>& i) const {
    return (std::size_t(i[1]) * lines_[2].size() + std::size_t(i[2])) * lines_[0].size() + std::size_t(i[0]);
}

void Blocks::build() {
    if (built_) return;
    built_ = true;
    for (int k = 0; k < 3; ++k) {
        std::vector<float>& lines = lines_[std::size_t(k)];
        lines.clear();
        for (const Operation& o : operations_) lines.insert(lines.end(), {o.low[k], o.high[k]});
        std::sort(lines.begin(), lines.end());
        // Coordinates that differ by rounding alone are one line.
        lines.erase(std::unique(lines.begin(), lines.end(), [](float a, float b) { return b - a < 1e-4f; }),
                    lines.end());
    }
    const std::size_t nx = lines_[0].size() - 1, ny = lines_[1].size() - 1, nz = lines_[2].size() - 1;
    cells_.assign(nx * ny * nz, Cell{});
    const auto line = [&](int k, float v) {
        const auto& lines = lines_[std::size_t(k)];
        return std::size_t(std::lower_bound(lines.begin(), lines.end(), v - 2e-4f) - lines.begin());
    };
    for (const Operation& o : operations_)
        for (std::size_t y = line(1, o.low.y); y < line(1, o.high.y); ++y)
            for (std::size_t z = line(2, o.low.z); z < line(2, o.high.z); ++z)
                for (std::size_t x = line(0, o.low.x); x < line(0, o.high.x); ++x)
                    cells_[(y * nz + z) * nx + x] = {std::int16_t(o.solid), std::int16_t(o.room), o.covered};

    rectangles_.assign(rooms_.size(), {});
    corner_.assign(lines_[0].size() * lines_[1].size() * lines_[2].size(), false);
    for (int axis = 0; axis < 3; ++axis)
        for (int plane = 0; plane < int(lines_[std::size_t(axis)].size()); ++plane)
            for (bool positive : {false, true}) merge_plane(axis, plane, positive);
    for (const auto& room : rectangles_)
        for (const Rectangle& r : room)
            for (int a : {r.a0, r.a1})
                for (int b : {r.b0, r.b1}) {
                    std::array<int, 3> i{};
                    i[std::size_t(r.axis)] = r.plane;
                    i[std::size_t((r.axis + 1) % 3)] = a;
                    i[std::size_t((r.axis + 2) % 3)] = b;
                    corner_[corner_key(i)] = true;
                }
}

int Blocks::seen_material(const Cell& solid, const Cell& air, int axis, bool positive) const {
    const Finish& room = rooms_[std::size_t(air.room)];
    const Finish& own = solids_[std::size_t(solid.solid)];
    if (axis != 1) return room.wall >= 0 ? room.wall : own.wall;
    if (positive) return room.floor >= 0 ? room.floor : own.floor;
    return room.ceiling >= 0 ? room.ceiling : own.ceiling;
}

// Faces on one grid plane that look along +axis (positive) or -axis, merged greedily into rectangles of one material
// and room.
void Blocks::merge_plane(int axis, int plane, bool positive) {
    const int a_axis = (axis + 1) % 3, b_axis = (axis + 2) % 3;
    const int na = int(lines_[std::size_t(a_axis)].size()) - 1, nb = int(lines_[std::size_t(b_axis)].size()) - 1;
    struct Face {
        int material = -1, room = -1;
        bool operator==(const Face&) const = default;
    };
    std::vector<Face> faces(std::size_t(na) * std::size_t(nb));
    const auto face = [&](int a, int b) -> Face& { return faces[std::size_t(b) * std::size_t(na) + std::size_t(a)]; };
    for (int b = 0; b < nb; ++b)
        for (int a = 0; a < na; ++a) {
            std::array<int, 3> i{};
            i[std::size_t(a_axis)] = a;
            i[std::size_t(b_axis)] = b;
            i[std::size_t(axis)] = plane - 1;
            const Cell& below = cell(i[0], i[1], i[2]);
            i[std::size_t(axis)] = plane;
            const Cell& above = cell(i[0], i[1], i[2]);
            const Cell &solid = positive ? below : above, &air = positive ? above : below;
            if (solid.solid < 0 || air.solid >= 0 || air.covered) continue;
            face(a, b) = {seen_material(solid, air, axis, positive), air.room};
        }
    for (int b = 0; b < nb; ++b)
        for (int a = 0; a < na; ++a) {
            const Face first = face(a, b);
            if (first.material < 0) continue;
            int a1 = a + 1, b1 = b + 1;
            while (a1 < na && face(a1, b) == first) ++a1;
            const auto row_same = [&](int row) {
                for (int k = a; k < a1; ++k)
                    if (!(face(k, row) == first)) return false;
                return true;
            };
            while (b1 < nb && row_same(b1)) ++b1;
            for (int y = b; y < b1; ++y)
                for (int x = a; x < a1; ++x) face(x, y) = {};
            rectangles_[std::size_t(first.room)].push_back({axis, plane, a, a1, b, b1, first.material, positive});
        }
}

void Blocks::emit(MeshBuilder& builder, const Rectangle& r) const {
    std::vector<Vec3> border;
    std::array<int, 3> i{};
    i[std::size_t(r.axis)] = r.plane;
    const std::size_t a_axis = std::size_t((r.axis + 1) % 3), b_axis = std::size_t((r.axis + 2) % 3);
    const auto walk = [&](int a0, int b0, int a1, int b1) {  // from one corner up to, not including, the next
        const int da = (a1 > a0) - (a1 < a0), db = (b1 > b0) - (b1 < b0);
        for (int a = a0, b = b0; a != a1 || b != b1; a += da, b += db) {
            i[a_axis] = a;
            i[b_axis] = b;
            if ((a == a0 && b == b0) || corner_[corner_key(i)]) border.push_back(point(i));
        }
    };
    walk(r.a0, r.b0, r.a1, r.b0);
    walk(r.a1, r.b0, r.a1, r.b1);
    walk(r.a1, r.b1, r.a0, r.b1);
    walk(r.a0, r.b1, r.a0, r.b0);
    Vec3 normal(0.0f);
    normal[r.axis] = r.positive ? 1.0f : -1.0f;
    if (!r.positive) std::reverse(border.begin(), border.end());
    builder.material(r.material);
    std::vector<std::uint32_t> v;
    for (const Vec3& p : border) v.push_back(builder.vertex(p, normal, world_uv(p, normal)));
    if (v.size() == 4) {
        builder.triangle(v[0], v[1], v[2]);
        builder.triangle(v[0], v[2], v[3]);
        return;
    }
    // Points in the middle of edges make slivers in a fan from a corner; the middle of the rectangle sees every edge.
    std::array<int, 3> low = i, high = i;
    low[a_axis] = r.a0, low[b_axis] = r.b0, high[a_axis] = r.a1, high[b_axis] = r.b1;
    const Vec3 centre = 0.5f * (point(low) + point(high));
    const std::uint32_t c = builder.vertex(centre, normal, world_uv(centre, normal));
    for (std::size_t k = 0; k < v.size(); ++k) builder.triangle(c, v[k], v[(k + 1) % v.size()]);
}

LevelMesh Blocks::faces(const std::string& name, int room) {
    build();
    MeshBuilder builder;
    for (const Rectangle& r : rectangles_[std::size_t(room)]) emit(builder, r);
    return builder.take(name);
}

bool Blocks::solid_at(const Vec3& p) {
    build();
    std::array<int, 3> i{};
    for (int k = 0; k < 3; ++k) {
        const auto& lines = lines_[std::size_t(k)];
        i[std::size_t(k)] = int(std::upper_bound(lines.begin(), lines.end(), p[k]) - lines.begin()) - 1;
    }
    return cell(i[0], i[1], i[2]).solid >= 0;
}

}  // namespace daylit::content
