#include "engine/render/volume_view.h"

#include <algorithm>

#include "engine/gl/target.h"

namespace daylit {
namespace {

constexpr float kRadius = 0.04f;  // of a sphere, in sides of the smallest cell that has the sample
constexpr int kLineVertices = 24, kSquareVertices = 4;

}  // namespace

std::vector<Vec4> sample_spheres(const VolumeTree& tree) {
    std::vector<Vec4> spheres(tree.samples, Vec4(0.0f));
    std::vector<Vec4> aside(tree.samples, Vec4(0.0f));  // sums over cells; w: how many
    for (const glsl::VolumeCell& cell : tree.cells)
        for (int corner = 0; corner < 8; ++corner) {
            const std::uint32_t record = record_of(cell, corner);
            if (record >= tree.samples) continue;
            const Vec3 at(corner & 1, corner >> 1 & 1, corner >> 2);
            Vec4& sphere = spheres[record];
            const float radius = kRadius * cell.box.w;
            sphere = Vec4(Vec3(cell.box) + cell.box.w * at, sphere.w > 0.0f ? std::min(sphere.w, radius) : radius);
            aside[record] += Vec4(Vec3(1.0f) - 2.0f * at, 1.0f);
        }
    for (std::size_t s = 0; s < spheres.size(); ++s)
        if (aside[s].w > 0.0f) spheres[s] += Vec4(spheres[s].w / aside[s].w * Vec3(aside[s]), 0.0f);
    return spheres;
}

VolumeView::VolumeView(const VolumeTree& tree)
    : cells_(int(tree.cells.size())), samples_(int(tree.samples)), spheres_(make_buffer(sample_spheres(tree))) {}

DrawCount VolumeView::draw(Programs& programs, bool radiance) const {
    const std::vector<std::string> shown = {radiance ? "LIGHT_SHOWN (1.0 / 3.14159265)" : "LIGHT_SHOWN 1.0"};
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 8, spheres_.get());
    programs.get("volume_samples.vert", "volume_samples.frag", shown).use();
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, kSquareVertices, samples_);
    programs.get("volume_cells.vert", "volume_cells.frag", shown).use();
    glDrawArraysInstanced(GL_LINES, 0, kLineVertices, cells_);
    return {2, 2L * samples_, 0, 0};
}

}  // namespace daylit
