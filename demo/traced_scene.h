#pragma once
// A scene at one moment, ready for tracing: what `reference` and `points` share.
#include <tbb/global_control.h>

#include <optional>
#include <string>
#include <vector>

#include "demo/options.h"
#include "gi/transport/path_trace/path_trace.h"

namespace daylit {

struct TracedScene {
    TracedScene(const SceneOptions& options, const std::string& light_file, const std::string& hour,
                const std::vector<std::string>& moves = {}, double time = 0.0);
    TracedScene(const TracedScene&) = delete;

    LoadedScene loaded;
    double hour;
    Pose pose;
    WorldMesh mesh;  // static and dynamic
    RayScene rays;
    std::vector<PlacedLight> lamps;
    Lighting lighting;
};

/// Limits the threads of everything while it lives; 0: as many as there are cores.
class ThreadLimit {
  public:
    explicit ThreadLimit(int threads);

  private:
    std::optional<tbb::global_control> control_;
};

}  // namespace daylit
