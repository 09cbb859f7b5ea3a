// daylit check SCENE: does it load, what daylit would do with it and why, what it would ignore.
#include <CLI/App.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "demo/commands.h"
#include "demo/options.h"
#include "engine/baked/part_plan.h"
#include "engine/scene/scene_facts.h"

namespace daylit {
namespace {

struct CheckOptions {
    SceneOptions scene;
    bool json = false;
};

nlohmann::json bounds_json(const Bounds& bounds) {
    if (bounds.empty()) return nullptr;
    const auto corner = [](const Vec3& p) { return nlohmann::json{p.x, p.y, p.z}; };
    return {{"min", corner(bounds.min)}, {"max", corner(bounds.max)}};
}

nlohmann::json describe(const LoadedScene& loaded) {
    const Scene& scene = loaded.scene;
    const SceneFacts facts = scene_facts(scene);
    nlohmann::json out;
    out["scene"] = scene.path.string();
    out["metres_per_unit"] = loaded.unit;
    out["bounds"] = bounds_json(facts.bounds);
    out["counts"] = {{"triangles", facts.static_triangles + facts.dynamic_triangles},
                     {"static_triangles", facts.static_triangles},
                     {"dynamic_triangles", facts.dynamic_triangles},
                     {"emissive_triangles", facts.emissive_triangles},
                     {"masked_triangles", facts.masked_triangles},
                     {"blended_triangles", facts.blended_triangles},
                     {"points", facts.points},
                     {"nodes", scene.order.size()},
                     {"dynamic_nodes", facts.dynamic_nodes_with_mesh},
                     {"meshes", scene.meshes.size()},
                     {"materials", scene.materials.size() - 1},
                     {"textures", scene.textures.size()},
                     {"images", scene.images.size()},
                     {"skins", scene.skins.size()},
                     {"directional_lights", facts.directional_lights},
                     {"point_lights", facts.point_lights},
                     {"spot_lights", facts.spot_lights},
                     {"lights_lit_in_the_evening", facts.evening_lights},
                     {"triangles_lit_in_the_evening", facts.evening_triangles}};
    out["cameras"] = nlohmann::json::array();
    for (const Camera& camera : scene.cameras) out["cameras"].push_back(camera.name);
    out["animations"] = nlohmann::json::array();
    for (const Animation& animation : scene.animations)
        out["animations"].push_back(
            {{"name", animation.name}, {"seconds", animation.duration}, {"channels", animation.channels.size()}});
    out["plan"] = nlohmann::json::array();
    const std::vector<PlanItem> plan = plan_parts(facts), now = plan_of_this_version(plan);
    for (std::size_t i = 0; i < plan.size(); ++i)
        out["plan"].push_back(
            {{"part", plan[i].part}, {"needed", plan[i].done}, {"baked", now[i].done}, {"why", now[i].why}});
    out["notes"] = scene.notes;
    return out;
}

void print_counts(const nlohmann::json& facts) {
    for (const auto& [name, count] : facts["counts"].items()) {
        if (count == 0) continue;
        std::string words = name;
        for (char& c : words)
            if (c == '_') c = ' ';
        std::printf("  %-28s %zu\n", words.c_str(), count.get<std::size_t>());
    }
}

void print(const nlohmann::json& facts) {
    std::printf("%s loads; %g m a unit\n", facts["scene"].get<std::string>().c_str(),
                facts["metres_per_unit"].get<double>());
    print_counts(facts);
    if (!facts["bounds"].is_null()) {
        const auto edge = [&](const char* end, int axis) {
            return facts["bounds"][end][std::size_t(axis)].get<double>();
        };
        std::printf("  %-28s %g to %g, %g to %g, %g to %g m\n", "bounds x, y, z", edge("min", 0), edge("max", 0),
                    edge("min", 1), edge("max", 1), edge("min", 2), edge("max", 2));
    }
    for (const auto& camera : facts["cameras"])
        std::printf("  %-28s %s\n", "camera", camera.get<std::string>().c_str());
    for (const auto& animation : facts["animations"])
        std::printf("  %-28s %s, %g s\n", "animation", animation["name"].get<std::string>().c_str(),
                    animation["seconds"].get<double>());
    for (const auto& item : facts["plan"])
        std::printf("%s %-12s %s\n", item["baked"].get<bool>() ? "bake" : "skip",
                    item["part"].get<std::string>().c_str(), item["why"].get<std::string>().c_str());
    for (const auto& note : facts["notes"]) std::printf("note: %s\n", note.get<std::string>().c_str());
}

}  // namespace

void add_check(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("check", "Does SCENE load, what daylit would do with it, what it would ignore");
    auto options = std::make_shared<CheckOptions>();
    add_scene_options(*command, options->scene);
    command->add_flag("--json", options->json, "everything as JSON on stdout");
    command->callback([options] {
        const nlohmann::json facts = describe(load(options->scene));
        if (options->json)
            std::printf("%s\n", facts.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
        else
            print(facts);
    });
}

}  // namespace daylit
