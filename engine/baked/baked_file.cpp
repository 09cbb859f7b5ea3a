#include "engine/baked/baked_file.h"

#include <xxhash.h>

#include <iterator>
#include <memory>

#include "engine/baked/lightmap_sections.h"
#include "engine/baked/settings_section.h"
#include "engine/baked/volume_sections.h"
#include "engine/base/error.h"

namespace daylit {
namespace {

using Path = std::filesystem::path;

/// What a part of the bake takes of the file.
std::uint64_t bytes_of_part(const std::vector<CodedSection>& sections) {
    std::uint64_t bytes = 0;
    for (const CodedSection& s : sections) bytes += s.stored.size();
    return bytes;
}

}  // namespace

std::uint64_t geometry_hash(const WorldMesh& mesh) {
    const std::unique_ptr<XXH64_state_t, decltype(&XXH64_freeState)> state(XXH64_createState(), XXH64_freeState);
    XXH64_reset(state.get(), 0);
    const auto add = [&](const auto& values) {
        const std::uint64_t count = values.size();
        XXH64_update(state.get(), &count, sizeof count);
        if (count) XXH64_update(state.get(), values.data(), count * sizeof(values[0]));
    };
    add(mesh.positions);
    add(mesh.normals);
    add(mesh.indices);
    return XXH64_digest(state.get());
}

Baked read_baked(const Path& path, const BakedParts& wanted) {
    const SectionFile file(path);
    Baked baked;
    decode_settings(file.open("SETT"), baked);
    baked.plan = decode_plan(file.open("PLAN"));
    if (wanted.lightmap && has_lightmap(file)) baked.lightmap = read_lightmap(file);
    if (wanted.volume && has_volume(file)) baked.volume = read_volume(file);
    return baked;
}

void write_baked(const Path& path, const Baked& baked) {
    std::vector<CodedSection> lightmap, volume;
    if (baked.lightmap) lightmap = code_lightmap(*baked.lightmap);
    if (baked.volume) volume = code_volume(*baked.volume);
    std::vector<PlanItem> plan = baked.plan;
    for (PlanItem& item : plan)
        item.bytes = item.part == "lightmap" ? bytes_of_part(lightmap)
                     : item.part == "volume" ? bytes_of_part(volume)
                                             : 0;
    std::vector<CodedSection> sections = {code_section("SETT", code_settings(baked)),
                                          code_section("PLAN", code_plan(plan))};
    for (std::vector<CodedSection>* part : {&lightmap, &volume})
        std::move(part->begin(), part->end(), std::back_inserter(sections));
    write_sections(path, std::move(sections));
}

void require_same_geometry(const Baked& baked, const Path& baked_path, const WorldMesh& static_mesh,
                           const Path& scene_path) {
    const bool same = baked.geometry_hash == geometry_hash(static_mesh);
    const bool same_corners = !baked.lightmap || baked.lightmap->corner_uvs.size() == 3 * static_mesh.triangle_count();
    if (!same || !same_corners)
        throw Error(baked_path.string(), "was baked for other static geometry than that of " + scene_path.string() +
                                             "; bake that scene again");
}

}  // namespace daylit
