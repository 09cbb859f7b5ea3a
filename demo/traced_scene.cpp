#include "demo/traced_scene.h"

#include "demo/parse.h"
#include "engine/base/error.h"

namespace daylit {

TracedScene::TracedScene(const SceneOptions& options, const std::string& light_file, const std::string& hour_text,
                         const std::vector<std::string>& moves, double time)
    : loaded(load(options, light_file)), hour(parse_hour("--hour", hour_text)),
      pose(pose_scene(loaded.scene, time, parse_moves(loaded.scene, moves))),
      mesh(world_mesh(loaded.scene, pose, Part::All)), rays(loaded.scene, mesh),
      lamps(placed_lights(loaded.scene, pose)), lighting(LightModel(loaded.light, lamps).at(hour)) {}

ThreadLimit::ThreadLimit(int threads) {
    if (threads < 0 || threads > 4096) throw Error("--threads", "give 0 (all) to 4096");
    if (threads > 0)
        control_.emplace(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
}

}  // namespace daylit
