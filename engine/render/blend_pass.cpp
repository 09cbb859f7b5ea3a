#include "engine/render/blend_pass.h"

#include <algorithm>

#include "engine/gl/target.h"

namespace daylit {
namespace {

struct Triangle {
    float distance;
    int part;
    std::uint32_t batch, first;  // of its three indices
};

Vec3 forward(const View& view) {
    const Mat4& m = view.view_from_world;
    return -Vec3(m[0][2], m[1][2], m[2][2]);
}

}  // namespace

BlendOrder sort_blended(const DrawScene& scene, const View& view) {
    std::vector<Triangle> triangles;
    for (int part = 0; part < 2; ++part) {
        if (!scene.parts[part]) continue;
        const DrawMesh& mesh = scene.parts[part]->mesh();
        for (std::uint32_t b = 0; b < mesh.batches.size(); ++b) {
            const Batch& batch = mesh.batches[b];
            if (coverage(scene.material(batch)) != Coverage::Through) continue;
            for (std::uint32_t c = 0; c < batch.cluster_count; ++c) {
                const Cluster& cluster = mesh.clusters[batch.first_cluster + c];
                for (std::uint32_t i = cluster.first; i < cluster.first + cluster.count; i += 3) {
                    const Vec3 center = (mesh.positions[mesh.indices[i]] + mesh.positions[mesh.indices[i + 1]] +
                                         mesh.positions[mesh.indices[i + 2]]) / 3.0f - view.eye;
                    const float distance = view.orthographic ? glm::dot(center, forward(view)) : glm::length(center);
                    triangles.push_back({distance, part, b, i});
                }
            }
        }
    }
    std::stable_sort(triangles.begin(), triangles.end(),
                     [](const Triangle& a, const Triangle& b) { return a.distance > b.distance; });
    BlendOrder order;
    for (const Triangle& t : triangles) {
        const auto at = std::uint32_t(order.indices.size());
        const DrawMesh& mesh = scene.parts[t.part]->mesh();
        order.indices.insert(order.indices.end(), mesh.indices.begin() + t.first, mesh.indices.begin() + t.first + 3);
        if (order.runs.empty() || order.runs.back().part != t.part || order.runs.back().batch != t.batch)
            order.runs.push_back({t.part, t.batch, at, 0});
        order.runs.back().count += 3;
    }
    return order;
}

DrawCount BlendPass::draw(DrawScene& scene, const View& view, const FrameDefines& frame_defines) {
    DrawCount count;
    const BlendOrder order = sort_blended(scene, view);
    if (order.indices.empty()) return count;
    indices_ = make_buffer(order.indices);
    for (const std::optional<Geometry>& part : scene.parts)
        if (part) part->use_indices(indices_.get());
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_SRC1_COLOR);  // light + share let through * what lies behind
    glDepthMask(GL_FALSE);
    const Lights lights{scene.every_lamp};
    for (const BlendRun& run : order.runs) {
        const Geometry& part = *scene.parts[run.part];
        const Batch& batch = part.mesh().batches[run.batch];
        part.bind();
        const Program& program =
            scene.programs.get("surface.vert", "surface.frag",
                               frame_defines.with(surface_defines(scene.material(batch), batch.vertex_colors),
                                                  std::size_t(run.part), lights));
        program.use();
        set_lamp_bits(program, lights.lamps);
        scene.materials->bind(batch.material);
        if (scene.material(batch).double_sided) glDisable(GL_CULL_FACE);
        else glEnable(GL_CULL_FACE);
        glDrawElements(GL_TRIANGLES, GLsizei(run.count), GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(std::uintptr_t(run.first) * 4));
        ++count.draws;
        count.triangles += run.count / 3;
    }
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
    for (const std::optional<Geometry>& part : scene.parts)
        if (part) part->use_indices(0);
    return count;
}

}  // namespace daylit
