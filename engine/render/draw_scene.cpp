#include "engine/render/draw_scene.h"

#include <algorithm>

namespace daylit {
namespace {

const Frustum kEverything{{}, 0};
constexpr GLint kLampBitsLocation = 10;  // as in shaders/surface.frag

void cull_faces(bool on) {
    if (on) glEnable(GL_CULL_FACE);
    else glDisable(GL_CULL_FACE);
}

}  // namespace

std::vector<std::string> FrameDefines::with(std::vector<std::string> own, std::size_t part_number,
                                            const Lights& lights) const {
    const auto add = [&](const std::vector<std::string>& more) { own.insert(own.end(), more.begin(), more.end()); };
    add(part[part_number]);
    if (lights.suns) add(suns);
    if (lights.lamps != LampBits{}) add(lamps);
    if (volume && part_number == 1) {
        own.push_back("VOLUME");
        if (lights.volume_at_pixels) own.push_back("VOLUME_PIXEL");
    }
    return own;
}

void DrawCount::add(const DrawList& list) {
    draws += list.empty() ? 0 : 1;
    triangles += list.triangles;
    clusters_drawn += list.clusters_drawn;
    clusters_culled += list.clusters_culled;
}

void DrawCount::add(const DrawCount& other) {
    draws += other.draws;
    triangles += other.triangles;
    clusters_drawn += other.clusters_drawn;
    clusters_culled += other.clusters_culled;
}

void bind_texture(GLuint unit, GLuint texture) {
    glBindTextureUnit(unit, texture);
    glBindSampler(unit, 0);
}

void DrawScene::add_visible(const Geometry& geometry, const Batch& batch, const Frustum& frustum,
                            DrawList& list) const {
    geometry.add_visible(batch, cull ? frustum : kEverything, list);
}

void set_lamp_bits(const Program& program, const LampBits& bits) {
    if (program.has("lamp_bits")) glProgramUniform4uiv(program.get(), kLampBitsLocation, 1, bits.data());
}

std::vector<std::pair<Lights, DrawList>> DrawScene::lists_by_lights(const Geometry& geometry, const Batch& batch,
                                                                    const Frustum& frustum, DrawCount& count) const {
    std::vector<std::pair<Lights, DrawList>> lists;
    const auto add = [&](const Lights& lights, std::uint32_t first, std::uint32_t indices) {
        if (indices == 0) return;
        auto list = std::find_if(lists.begin(), lists.end(), [&](const auto& l) { return l.first == lights; });
        if (list == lists.end()) list = lists.insert(list, {lights, DrawList()});
        list->second.add(first, indices);
    };
    const bool standing = parts[0] && &geometry == &*parts[0], known = cull && standing;
    for (std::uint32_t c = batch.first_cluster; c < batch.first_cluster + batch.cluster_count; ++c) {
        const Cluster& cluster = geometry.mesh().clusters[c];
        const bool hidden = known && !seen_clusters.empty() && !seen_clusters[c % seen_clusters.size()];
        if (hidden || (cull && !may_see(frustum, cluster.bounds))) {
            ++count.clusters_culled;
            continue;
        }
        ++count.clusters_drawn;
        Lights lights;
        lights.lamps = known && !lamp_bits.empty() ? lamp_bits[c] : every_lamp;
        if (!standing) lights.volume_at_pixels = volume_objects.at_pixels(c);
        const std::uint32_t reached = known && !sun_split.reached.empty() ? sun_split.reached[c] : cluster.count;
        add(lights, cluster.first, reached);
        lights.suns = false;
        add(lights, cluster.first + reached, cluster.count - reached);
    }
    return lists;
}

bool DrawScene::moved_in(const Frustum& frustum, std::uint64_t since) const {
    if (since == version) return false;
    if (since + 1 != version) return true;
    return std::any_of(moved.begin(), moved.end(), [&](const Bounds& box) { return may_see(frustum, box); });
}

DrawCount DrawScene::draw_coverage(const Mat4& clip_from_world, const Frustum& frustum, CoverageFor purpose) {
    const bool for_eye = purpose == CoverageFor::Eye || purpose == CoverageFor::EyeAndClusters, for_light = !for_eye;
    DrawCount count;
    for (const std::optional<Geometry>& part : parts) {
        const bool numbered =
            (purpose == CoverageFor::Clusters || purpose == CoverageFor::EyeAndClusters) && &part == &parts[0];
        if (!part || (purpose == CoverageFor::Clusters && !numbered)) continue;
        part->bind();
        if (for_eye) glColorMask(numbered, numbered, numbered, numbered);
        // Whole faces first, in as few calls as there are culling states; then those with holes, one a material.
        DrawList whole[2];
        for (const Batch& batch : part->mesh().batches) {
            const Coverage kind = coverage(material(batch));
            if (kind == Coverage::Mask || (kind == Coverage::Through && (!for_light || veils(material(batch))))) continue;
            const bool culled = !for_light && !material(batch).double_sided;
            add_visible(*part, batch, frustum, whole[culled ? 1 : 0]);
        }
        for (int culled = 0; culled < 2; ++culled) {
            if (whole[culled].empty()) continue;
            std::vector<std::string> defines;
            if (numbered) defines.push_back("CLUSTERS");
            const Program& program = programs.get("depth.vert", "depth.frag", defines);
            program.use();
            program.set("clip_from_world", clip_from_world);
            cull_faces(culled == 1);
            Geometry::draw(whole[culled]);
        }
        count.add(whole[0]);
        count.add(whole[1]);
        for (const Batch& batch : part->mesh().batches) {
            if (coverage(material(batch)) != Coverage::Mask) continue;
            DrawList list;
            add_visible(*part, batch, frustum, list);
            count.add(list);
            if (list.empty()) continue;
            std::vector<std::string> defines = coverage_defines(material(batch), batch.vertex_colors);
            defines.push_back("MASK");
            if (numbered) defines.push_back("CLUSTERS");
            const Program& program = programs.get("depth.vert", "depth.frag", defines);
            program.use();
            program.set("clip_from_world", clip_from_world);
            materials->bind_coverage(batch.material);
            cull_faces(!for_light && !material(batch).double_sided);
            Geometry::draw(list);
        }
    }
    cull_faces(false);
    if (for_eye) glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    return count;
}

DrawCount DrawScene::draw_casters(const Mat4& clip_from_world, const Frustum& frustum) {
    return draw_coverage(clip_from_world, frustum, CoverageFor::Light);
}

void DrawScene::draw_clusters(const Mat4& clip_from_world, const Frustum& frustum) {
    draw_coverage(clip_from_world, frustum, CoverageFor::Clusters);
}

DrawCount DrawScene::draw_depth(const Mat4& clip_from_world, const Frustum& frustum, bool clusters) {
    return draw_coverage(clip_from_world, frustum, clusters ? CoverageFor::EyeAndClusters : CoverageFor::Eye);
}

DrawCount DrawScene::draw_veils(const Mat4& clip_from_world, const Frustum& frustum, int known_layer) {
    DrawCount count;
    for (const std::optional<Geometry>& part : parts) {
        if (!part) continue;
        part->bind();
        for (const Batch& batch : part->mesh().batches) {
            if (!veils(material(batch))) continue;
            DrawList list;
            add_visible(*part, batch, frustum, list);
            count.add(list);
            if (list.empty()) continue;
            std::vector<std::string> defines = coverage_defines(material(batch), batch.vertex_colors);
            defines.push_back("VEIL");
            const Program& program = programs.get("depth.vert", "depth.frag", defines);
            program.use();
            program.set("clip_from_world", clip_from_world);
            program.set("known_layer", known_layer);
            materials->bind_coverage(batch.material);
            Geometry::draw(list);
        }
    }
    return count;
}

DrawCount DrawScene::draw_surfaces(const FrameDefines& frame_defines, const Frustum& frustum) {
    DrawCount count;
    for (std::size_t p = 0; p < 2; ++p) {
        const std::optional<Geometry>& part = parts[p];
        if (!part) continue;
        part->bind();
        if (p == 0 && cull && !sun_split.reached.empty()) part->use_indices(sun_split.indices.get());
        for (const Batch& batch : part->mesh().batches) {
            if (coverage(material(batch)) == Coverage::Through) continue;
            const auto lists = lists_by_lights(*part, batch, frustum, count);
            if (lists.empty()) continue;
            const std::vector<std::string> own = surface_defines(material(batch), batch.vertex_colors);
            materials->bind(batch.material);
            cull_faces(!material(batch).double_sided);
            for (const auto& [lights, list] : lists) {
                count.add(list);
                const Program& program =
                    programs.get("surface.vert", "surface.frag", frame_defines.with(own, p, lights));
                program.use();
                set_lamp_bits(program, lights.lamps);
                Geometry::draw(list);
            }
        }
        part->use_indices(0);
    }
    cull_faces(false);
    return count;
}

}  // namespace daylit
