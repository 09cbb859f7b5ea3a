#include "content/content.h"

#include <array>

#include "content/glb_writer.h"
#include "content/levels.h"
#include "engine/base/error.h"

namespace daylit {
namespace {

struct Entry {
    ContentScene scene;
    content::Level (*make)();
};

const std::array<Entry, 10>& entries() {
    static const std::array<Entry, 10> all = {{
        {{"koldinghus", "the demo level: a castle after Koldinghus with hall, treasury, cellar maze and courtyard"},
         content::koldinghus},
        {{"furnace", "a closed room that emits 50 cd/m^2 at albedo 0.5: radiance is 100 everywhere"}, content::furnace},
        {{"cornell_box", "the measured Cornell box: colour bleeding and soft shadows from an area light"},
         content::cornell_box},
        {{"two_rooms", "a sunlit room beside a closed one, wall of 0.2 m: no light leaks"}, content::two_rooms},
        {{"thin_wall", "a lamp on one side of a wall of 0.02 m: no light leaks through a wall thinner than a texel"},
         content::thin_wall},
        {{"sealed_room", "a closed room under the open sky: darkness"}, content::sealed_room},
        {{"maze", "light that reaches the far end only round six corners"}, content::maze},
        {{"tunnel", "thirty metres lit from one end: light falls with depth, by bounces alone"}, content::tunnel},
        {{"glossy_floor", "Phong floors of four exponents under glowing blocks and lamps"}, content::glossy_floor},
        {{"caustic", "a glass sphere in the sun: a caustic that moves with the hour"}, content::caustic},
    }};
    return all;
}

}  // namespace

std::span<const ContentScene> content_scenes() {
    static const std::vector<ContentScene> scenes = [] {
        std::vector<ContentScene> list;
        for (const Entry& entry : entries()) list.push_back(entry.scene);
        return list;
    }();
    return scenes;
}

void make_scene(const std::string& name, const std::filesystem::path& path) {
    std::string names;
    for (const Entry& entry : entries()) {
        if (entry.scene.name == name) return content::write_glb(entry.make(), path);
        names += (names.empty() ? "" : ", ") + entry.scene.name;
    }
    throw Error(name, "no scene of this name can be made; one of " + names);
}

}  // namespace daylit
