#include "engine/render/volume_objects.h"

#include <cmath>
#include <map>

namespace daylit {
namespace {

double squared_edges(const DrawMesh& mesh, const Cluster& cluster) {
    double sum = 0.0;
    for (std::uint32_t i = cluster.first; i < cluster.first + cluster.count; i += 3)
        for (std::uint32_t k = 0; k < 3; ++k) {
            const Vec3 edge = mesh.positions[mesh.indices[i + (k + 1) % 3]] - mesh.positions[mesh.indices[i + k]];
            sum += double(glm::dot(edge, edge));
        }
    return sum;
}

}  // namespace

void VolumeObjects::set_mesh(const DrawMesh& mesh) {
    things_.clear(), thing_of_.clear(), modes_.clear(), light_.clear();
    std::map<std::uint32_t, std::uint32_t> thing_of_node;
    std::vector<double> squares, edges;  // by thing
    for (const Cluster& cluster : mesh.clusters) {
        const auto [at, is_new] = thing_of_node.try_emplace(cluster.node, std::uint32_t(things_.size()));
        if (is_new) things_.emplace_back(), squares.push_back(0.0), edges.push_back(0.0);
        thing_of_.push_back(at->second);
        things_[at->second].box.add(cluster.bounds.min);
        things_[at->second].box.add(cluster.bounds.max);
        squares[at->second] += squared_edges(mesh, cluster);
        edges[at->second] += double(cluster.count);
    }
    for (std::size_t i = 0; i < things_.size(); ++i) things_[i].edge = float(std::sqrt(squares[i] / edges[i]));
}

void VolumeObjects::set_light(const VolumeLight& light, VolumeMode asked) {
    modes_.resize(things_.size());
    light_.resize(things_.size());
    for (std::size_t i = 0; i < things_.size(); ++i) {
        modes_[i] = asked == VolumeMode::Auto ? volume_mode_of(things_[i], light.tree()) : asked;
        if (modes_[i] == VolumeMode::Object)
            light_[i] = light.radiance(0.5f * (things_[i].box.min + things_[i].box.max));
    }
}

VolumeUse VolumeObjects::use(std::uint32_t cluster) const {
    if (modes_.empty()) return {};
    const std::uint32_t thing = thing_of_[cluster];
    return {modes_[thing], modes_[thing] == VolumeMode::Object ? thing : 0};
}

}  // namespace daylit
