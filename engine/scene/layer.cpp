#include "engine/scene/layer.h"

#include <array>

#include "engine/base/error.h"

namespace daylit {
namespace {

constexpr std::array<const char*, 12> kLayerNames = {"final",  "direct", "indirect",     "irradiance",
                                                     "albedo", "normal", "depth",        "lightmap",
                                                     "volume", "dirmap", "antiradiance", "caustics"};

}  // namespace

Layer parse_layer(const std::string& name) {
    std::string list;
    for (std::size_t i = 0; i < kLayerNames.size(); ++i) {
        if (name == kLayerNames[i]) return Layer(i);
        list += (i ? ", " : "") + std::string(kLayerNames[i]);
    }
    throw UsageError("--show", "no layer '" + name + "'; one of " + list);
}

const char* name(Layer layer) {
    return kLayerNames[std::size_t(layer)];
}

}  // namespace daylit
