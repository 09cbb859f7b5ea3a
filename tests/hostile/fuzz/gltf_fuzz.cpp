// Any bytes as a glTF file: refused with an Error, or a scene that everything after the reader can use.
#include "engine/base/error.h"
#include "engine/scene/gltf.h"
#include "engine/scene/scene_facts.h"
#include "tests/hostile/fuzz/one_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace daylit;
    try {
        const Scene scene = load_scene(fuzz::file_with({data, size}, ".glb"));
        const Pose pose = pose_scene(scene, 0.5);
        world_mesh(scene, pose, Part::All);
        placed_lights(scene, pose);
        scene_facts(scene);
        for (std::size_t node = 0; node < scene.nodes.size(); ++node)
            if (scene.nodes[node].skin >= 0) skin_matrices(scene, pose, int(node));
    } catch (const Error&) {
    }
    return 0;
}
