#include "engine/render/renderer.h"

#include <algorithm>
#include <chrono>
#include <ctime>

#include "engine/gl/target.h"
#include "engine/render/baked_light.h"
#include "engine/render/baked_volume.h"
#include "engine/render/blend_pass.h"
#include "engine/render/display.h"
#include "engine/render/frame_plan.h"
#include "engine/render/lamp_shadow.h"
#include "engine/render/sky_pass.h"
#include "engine/render/sun_shadow.h"
#include "engine/render/volume_view.h"

namespace daylit {
namespace {

constexpr int kSunTexels = 2048;
constexpr int kFineSunTexels = 4096;  // pictures with several samples a pixel

/// GL state that passes rely on, set for the time of a draw: reversed depth in [0, 1], as projection() makes it.
class DrawState {
  public:
    DrawState() {
        glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_GREATER);
        glDepthMask(GL_TRUE);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        glFrontFace(GL_CCW);
        glCullFace(GL_BACK);
        glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
        for (const GLenum off : {GL_CULL_FACE, GL_BLEND, GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_FRAMEBUFFER_SRGB})
            glDisable(off);
        // The dual-source one that veils leave forbids several targets even where nothing blends.
        glBlendFunc(GL_ONE, GL_ZERO);
        glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    }
    ~DrawState() {
        glDisable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        glBlendFunc(GL_ONE, GL_ZERO);
        glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
        glBindVertexArray(0);
        glUseProgram(0);
        for (GLuint unit = 0; unit < 4; ++unit) glBindSampler(unit, 0);
    }
    DrawState(const DrawState&) = delete;
    DrawState& operator=(const DrawState&) = delete;
};

std::vector<bool> used_materials(const Scene& scene, const WorldMesh& a, const WorldMesh& b) {
    std::vector<bool> used(scene.materials.size());
    for (const WorldMesh* mesh : {&a, &b})
        for (const std::uint32_t material : mesh->materials) used[material] = true;
    return used;
}

const char* show_define(Layer layer) {
    switch (layer) {
        case Layer::Final:
            return "SHOW_FINAL";
        case Layer::Direct:
            return "SHOW_DIRECT";
        case Layer::Indirect:
            return "SHOW_INDIRECT";
        case Layer::Irradiance:
            return "SHOW_IRRADIANCE";
        case Layer::Albedo:
            return "SHOW_ALBEDO";
        case Layer::Normal:
            return "SHOW_NORMAL";
        case Layer::Depth:
            return "SHOW_DEPTH";
        case Layer::Lightmap:
            return "SHOW_LIGHTMAP";
        case Layer::Volume:
            return "SHOW_VOLUME";
        default:
            return "SHOW_OTHER";  // parts that are not baked yet are black
    }
}

}  // namespace

struct Renderer::State {
    State(const Scene& s, const Baked* b) : scene(s), baked(b), draw(s) {}

    const Scene& scene;
    const Baked* baked;
    Pose pose;
    std::vector<PlacedLight> lamps;
    Lighting lighting;

    DrawScene draw;
    std::optional<BakedLight> baked_light;    // of what stands
    std::optional<BakedVolume> baked_volume;  // of what moves
    std::optional<VolumeView> volume_view;    // made when first asked for
    SunShadow sun_shadow;
    LampShadow lamp_shadow;
    SkyPass sky;
    BlendPass blend;
    CameraTarget target;
    GlBuffer frame_buffer;
    GlVertexArray no_attributes;  // for full-screen triangles
    bool software = software_driver();
    Layer shown = Layer::Final;
    double ev = 0.0;

    // Poses.
    bool part_moved(const Pose& to, bool dynamic) const;
    void build_static(const WorldMesh& mesh);
    void build_moving(const WorldMesh& mesh);
    void find_bounds();

    // Frames.
    FrameFacts facts(const FrameSettings& frame, const Frustum& seen);
    glsl::FrameBlock frame_block(const FrameSettings& frame) const;
    FrameDefines frame_defines(Layer show) const;
};

namespace {

/// Runs a pass of the plan and writes what it did.
class PassRunner {
  public:
    PassRunner(const FramePlan& plan, FrameReport& report, bool timings)
        : plan_(plan), report_(report), timings_(timings) {}

    template <typename Work>
    void run(PassKind kind, Work&& work) {
        const PassPlan& plan = plan_[std::size_t(kind)];
        PassReport pass;
        pass.name = name(kind);
        pass.ran = plan.runs;
        pass.why = plan.why;
        if (plan.runs) {
            if (timings_) glFinish();
            const auto start = std::chrono::steady_clock::now();
            const std::clock_t processor_start = std::clock();
            const DrawCount count = work();
            if (timings_) {
                glFinish();
                const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
                pass.milliseconds = spent.count();
                pass.processor_milliseconds = 1000.0 * double(std::clock() - processor_start) / CLOCKS_PER_SEC;
            }
            pass.draws = count.draws;
            pass.triangles = count.triangles;
            if (kind == PassKind::Surfaces) {
                report_.objects_drawn = count.clusters_drawn;
                report_.objects_culled = count.clusters_culled;
            }
        }
        report_.passes.push_back(std::move(pass));
    }

  private:
    const FramePlan& plan_;
    FrameReport& report_;
    bool timings_;
};

}  // namespace

// --- poses -----------------------------------------------------------------------------------------------------------

bool Renderer::State::part_moved(const Pose& to, bool dynamic) const {
    if (pose.world_from_node.empty()) return true;
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        if (scene.nodes[n].dynamic != dynamic) continue;
        if (pose.world_from_node[n] != to.world_from_node[n] || pose.morph_weights[n] != to.morph_weights[n])
            return true;
    }
    return false;
}

void Renderer::State::build_static(const WorldMesh& mesh) {
    const DayLightmap* lightmap = baked && baked->lightmap ? &*baked->lightmap : nullptr;
    if (lightmap && lightmap->corner_uvs.size() != mesh.indices.size())
        throw Error("lightmap", "it has coordinates for " + std::to_string(lightmap->corner_uvs.size() / 3) +
                                    " triangles, but the scene has " + std::to_string(mesh.triangle_count()) +
                                    " that stand; bake this scene again");
    if (lightmap) baked_light->set_bounds(tile_bounds(*lightmap, mesh));
    draw.parts[0].reset();
    if (mesh.triangle_count() > 0) draw.parts[0].emplace(build_draw_mesh(mesh, lightmap, false), false);
}

void Renderer::State::build_moving(const WorldMesh& mesh) {
    const Geometry& part = draw.parts[1].emplace(build_draw_mesh(mesh, nullptr, true), true);
    if (!baked_volume) return;
    std::vector<BatchLook> looks;
    for (const Batch& batch : part.mesh().batches) {
        const Material& material = draw.material(batch);
        looks.push_back({coverage(material) == Coverage::Through, material.metallic > 0.5f});
    }
    draw.volume_objects.set_mesh(part.mesh(), looks);
    part.use_light(draw.volume_objects.buffer());
}

void Renderer::State::find_bounds() {
    draw.box = {};
    for (const std::optional<Geometry>& part : draw.parts) {
        if (!part) continue;
        for (const Cluster& cluster : part->mesh().clusters) {
            draw.box.add(cluster.bounds.min);
            draw.box.add(cluster.bounds.max);
        }
    }
}

Renderer::Renderer(const Scene& scene, const Baked* baked) : state_(std::make_unique<State>(scene, baked)) {
    State& s = *state_;
    s.frame_buffer = make_buffer(std::vector<glsl::FrameBlock>(1), GL_DYNAMIC_STORAGE_BIT);
    s.no_attributes = make_vertex_array();
    if (baked && baked->lightmap) s.baked_light.emplace(*baked->lightmap);
    if (baked && baked->volume) s.baked_volume.emplace(*baked->volume);
    s.sky.set_environment({});
    set_pose(pose_scene(scene));
}

Renderer::~Renderer() = default;

void Renderer::set_pose(const Pose& pose) {
    State& s = *state_;
    const bool first = s.pose.world_from_node.empty();
    const bool standing = s.part_moved(pose, false), moving = s.part_moved(pose, true);
    s.lamps = placed_lights(s.scene, pose);
    s.pose = pose;
    if (!standing && !moving) return;

    if (first) {
        const WorldMesh still = world_mesh(s.scene, pose, Part::Static),
                        dynamic = world_mesh(s.scene, pose, Part::Dynamic);
        s.draw.materials.emplace(s.scene, used_materials(s.scene, still, dynamic));
        s.build_static(still);
        if (dynamic.triangle_count() > 0) s.build_moving(dynamic);
        for (const std::optional<Geometry>& part : s.draw.parts)
            for (std::size_t i = 0; part && i < part->mesh().batches.size(); ++i) {
                const Material& material = s.draw.material(part->mesh().batches[i]);
                s.draw.any_veils |= veils(material);
                s.draw.any_through |= coverage(material) == Coverage::Through;
            }
        s.draw.moved.clear();
        s.draw.version += 2;  // everything is new
        s.draw.standing_version = s.draw.version;
    } else {
        s.draw.moved.clear();
        if (moving && s.draw.parts[1]) {
            s.draw.moved = s.draw.parts[1]->move(world_mesh(s.scene, pose, Part::Dynamic));
            s.draw.volume_objects.move(s.draw.parts[1]->mesh());
        }
        if (standing) s.build_static(world_mesh(s.scene, pose, Part::Static));
        s.draw.version += standing ? 2 : s.draw.moved.empty() ? 0 : 1;
        if (standing) s.draw.standing_version = s.draw.version;
    }
    s.find_bounds();
}

void Renderer::set_lighting(const Lighting& lighting) {
    state_->lighting.suns = lighting.suns;
    state_->lighting.scales = lighting.scales;
    if (state_->lighting.suns.size() > glsl::kMaxSuns) state_->lighting.suns.resize(glsl::kMaxSuns);
    state_->draw.materials->set_evening(lighting.scales.evening);
    state_->sky.set_environment(lighting.sky);
}

// --- frames ----------------------------------------------------------------------------------------------------------

FrameFacts Renderer::State::facts(const FrameSettings& frame, const Frustum& seen) {
    FrameFacts f;
    f.show = frame.show;
    f.baked = baked_light || baked_volume;
    f.baked_stale = (baked_light && baked_light->stale(lighting.scales, frame.hour)) ||
                    (baked_volume && baked_volume->stale(lighting.scales, frame.hour));
    f.baked_unlit = baked_light && baked_light->unlit(seen);
    f.volume = baked_volume.has_value();
    f.volume_view = frame.volume_view;
    if (baked_volume && draw.parts[1] && shows_baked_light(frame.show))
        f.moving_unlit = draw.volume_objects.plan(draw.parts[1]->mesh(), seen, baked_volume->tree(), frame.volume_mode,
                                                  baked_volume->stale(lighting.scales, frame.hour));
    f.suns = lighting.suns.size();
    f.any_surface = draw.parts[0] || draw.parts[1];
    if (shows_straight_light(frame.show)) {
        f.sun_maps_stale = sun_shadow.plan(lighting.suns, draw, frame.view.eye,
                                           frame.samples_per_side > 1 ? kFineSunTexels : kSunTexels);
        f.lamp_maps_stale = lamp_shadow.plan(lit_lamps(lamps, lighting), draw);
        f.lamps = lamp_shadow.lamp_count();
    }
    f.any_through = draw.any_through;
    f.depth_first = shows_straight_light(frame.show);
    f.sky_black = sky.black();
    f.samples_per_side = frame.samples_per_side;
    f.meter = !frame.ev || frame.meter;
    return f;
}

glsl::FrameBlock Renderer::State::frame_block(const FrameSettings& frame) const {
    glsl::FrameBlock block{};
    const View& view = frame.view;
    const int samples = frame.samples_per_side;
    block.clip_from_world = projection(view, frame.width, frame.height) * view.view_from_world;
    block.world_from_clip = glm::inverse(block.clip_from_world);
    const Mat4& m = view.view_from_world;
    const float span = view.orthographic ? 0.0f : 2.0f * std::tan(0.5f * view.vertical_fov);
    block.eye = Vec4(view.eye, view.orthographic ? 1.0f : 0.0f);
    block.forward = Vec4(-Vec3(m[0][2], m[1][2], m[2][2]), std::max(span / float(frame.height * samples), 1.0e-6f));
    block.target = Vec4(frame.width * samples, frame.height * samples, std::tan(kSunRadius), std::cos(kSunRadius));
    return block;
}

FrameDefines Renderer::State::frame_defines(Layer show) const {
    FrameDefines defines;
    for (std::vector<std::string>& part : defines.part) part.push_back(show_define(show));
    if (shows_straight_light(show) && !lighting.suns.empty()) {
        defines.suns = {"SUNS " + std::to_string(lighting.suns.size()), "SHADOW_TAPS 16"};
        if (draw.any_veils) defines.suns.push_back("BLEND_CASTERS " + std::to_string(kVeils));
    }
    if (shows_straight_light(show) && lamp_shadow.lamp_count() > 0) {
        defines.lamps = {"LAMPS " + std::to_string((lamp_shadow.lamp_count() + 31) / 32)};
        if (lamp_shadow.any_spots()) defines.lamps.push_back("SPOTS");
    }
    if (baked_light && shows_baked_light(show)) {
        defines.part[0].push_back("LIGHTMAP");
        if (baked_light->tilted()) defines.part[0].push_back("TILTED");
    }
    defines.volume = baked_volume && shows_baked_light(show);
    return defines;
}

FrameReport Renderer::draw(const FrameSettings& frame) {
    State& s = *state_;
    const DrawState draw_state;
    FrameReport report;
    s.shown = frame.show;
    s.target.resize(frame.width, frame.height, frame.samples_per_side);
    s.draw.cull = frame.cull;
    s.draw.materials->set_fine(frame.samples_per_side > 1);
    glsl::FrameBlock block = s.frame_block(frame);
    const Frustum seen = frame.cull ? frustum(block.clip_from_world, true) : Frustum{{}, 0};
    const FramePlan plan = plan_frame(s.facts(frame, seen));
    PassRunner passes(plan, report, frame.timings);

    glBindVertexArray(s.no_attributes.get());
    passes.run(PassKind::Relight, [&] {
        if (s.baked_volume) s.baked_volume->set_light(s.lighting.scales, frame.hour);
        if (!s.baked_light) return DrawCount{};
        const int tiles = s.baked_light->set_light(s.lighting.scales, frame.hour, seen, s.draw.programs);
        return DrawCount{1, 2 * tiles, 0, 0};
    });
    passes.run(PassKind::MovingLight, [&] {
        return DrawCount{0, s.draw.volume_objects.renew(s.draw.parts[1]->mesh(), *s.baked_volume), 0, 0};
    });
    passes.run(PassKind::SunShadows, [&] { return s.sun_shadow.draw(s.draw); });
    passes.run(PassKind::LampShadows, [&] { return s.lamp_shadow.draw(s.draw); });

    if (shows_straight_light(frame.show)) {
        s.sun_shadow.use(block);
        s.lamp_shadow.use(block);
    }
    if (s.baked_light) s.baked_light->bind();
    if (plan[std::size_t(PassKind::VolumeView)].runs || s.draw.volume_objects.any_at_pixels()) s.baked_volume->bind();
    glNamedBufferSubData(s.frame_buffer.get(), 0, sizeof block, &block);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, s.frame_buffer.get());

    s.target.bind_and_clear();
    s.draw.seen_clusters.clear();
    passes.run(PassKind::Depth, [&] {
        // Reading back costs nothing where the CPU draws: what is hidden is then neither drawn nor compiled for.
        const bool clusters = s.software && frame.cull && s.draw.parts[0];
        if (clusters) s.target.bind_clusters();
        const DrawCount count = s.draw.draw_depth(block.clip_from_world, seen, clusters);
        if (clusters) s.draw.seen_clusters = s.target.seen_clusters();
        s.target.bind();
        return count;
    });
    passes.run(PassKind::Surfaces, [&] {
        glDepthFunc(GL_GEQUAL);
        const DrawCount count = s.draw.draw_surfaces(s.frame_defines(frame.show), seen);
        glDepthFunc(GL_GREATER);
        return count;
    });
    glBindVertexArray(s.no_attributes.get());
    passes.run(PassKind::VolumeView, [&] {
        if (!s.volume_view) s.volume_view.emplace(s.baked->volume->tree);
        return s.volume_view->draw(s.draw.programs, shows_radiance(frame.show));
    });
    passes.run(PassKind::Sky, [&] { return s.sky.draw(s.draw.programs, s.lighting.suns.size()); });
    passes.run(PassKind::Blended, [&] { return s.blend.draw(s.draw, frame.view, s.frame_defines(frame.show)); });
    glBindVertexArray(s.no_attributes.get());
    passes.run(PassKind::Resolve, [&] {
        s.target.resolve(s.draw.programs);
        return DrawCount{1, 1, 0, 0};
    });
    passes.run(PassKind::Meter, [&] {
        report.metered_ev = s.target.meter();
        return DrawCount{};
    });
    report.ev = s.ev = frame.ev.value_or(report.metered_ev);
    return report;
}

Image Renderer::read_radiance() const {
    return state_->target.read();
}

void Renderer::present(unsigned framebuffer, int width, int height) {
    State& s = *state_;
    const DrawState draw_state;
    glBindVertexArray(s.no_attributes.get());
    draw_display(s.target, s.draw.programs, s.shown, s.ev, framebuffer, width, height, true);
}

Image Renderer::read_display() {
    State& s = *state_;
    const DrawState draw_state;
    const int width = s.target.width(), height = s.target.height();
    const GlTexture texture = make_texture_2d(GL_RGBA32F, width, height);
    const GlFramebuffer framebuffer = make_framebuffer({texture.get()});
    glBindVertexArray(s.no_attributes.get());
    draw_display(s.target, s.draw.programs, s.shown, s.ev, framebuffer.get(), width, height, false);
    return read_texture(texture.get(), width, height);
}

std::string Renderer::reload_shaders() {
    return state_->draw.programs.reload();
}

}  // namespace daylit
