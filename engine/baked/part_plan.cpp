#include "engine/baked/part_plan.h"

#include <algorithm>

namespace daylit {
namespace {

std::string count(std::size_t n, const char* noun) {
    return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

PlanItem lightmap(const SceneFacts& facts) {
    if (!facts.has_static()) return {"lightmap", false, "no static geometry"};
    return {"lightmap", true, count(facts.static_triangles, "static triangle")};
}

PlanItem for_dynamic(const char* part, const SceneFacts& facts) {
    if (!facts.has_dynamic()) return {part, false, "no dynamic node"};
    return {part, true, count(facts.dynamic_nodes_with_mesh, "dynamic node")};
}

PlanItem dirmap(const SceneFacts& facts) {
    const std::string largest =
        "largest Phong exponent of a static surface is " + std::to_string(int(facts.static_exponent));
    if (facts.static_exponent <= kDirmapExponent)
        return {
            "dirmap", false,
            "no material is glossy enough: " + largest + ", a cell's width is " + std::to_string(int(kDirmapExponent))};
    return {"dirmap", true,
            largest + (facts.glossiest_material.empty() ? "" : ", of '" + facts.glossiest_material + "'")};
}

PlanItem caustics(const SceneFacts& facts) {
    if (!facts.has_glass && !facts.has_mirror) return {"caustics", false, "no glass and no mirror"};
    return {"caustics", true,
            facts.has_glass && facts.has_mirror ? "glass and mirrors"
            : facts.has_glass                   ? "glass"
                                                : "mirrors"};
}

}  // namespace

std::vector<PlanItem> plan_parts(const SceneFacts& facts, std::span<const std::string> asked) {
    std::vector<PlanItem> plan = {lightmap(facts), for_dynamic("volume", facts), dirmap(facts),
                                  for_dynamic("antiradiance", facts), caustics(facts)};
    if (asked.empty()) return plan;
    for (PlanItem& item : plan) {
        const bool wanted = std::find(asked.begin(), asked.end(), item.part) != asked.end();
        if (wanted && !item.done) item.why = "asked for, though " + item.why;
        if (!wanted) item.why = "not asked for";
        item.done = wanted;
    }
    // Asking cannot give a lightmap something to lie on.
    if (!facts.has_static()) plan.front() = lightmap(facts);
    if (!facts.has_static() && !facts.has_dynamic()) plan[1] = {"volume", false, "no geometry"};
    return plan;
}

bool bakes_part(std::string_view part) {
    return part == "lightmap" || part == "volume";
}

std::vector<PlanItem> plan_of_this_version(std::vector<PlanItem> plan) {
    for (PlanItem& item : plan) {
        if (bakes_part(item.part) || !item.done) continue;
        item.done = false;
        item.why = "not baked by this version, though the scene has use for it (" + item.why + ")";
    }
    return plan;
}

}  // namespace daylit
