#include "gi/encode/sweep.h"

#include <cstdio>

namespace daylit {
namespace {

LightmapEncoding tiles(double factor) {
    LightmapSettings settings;
    settings.error *= factor, settings.step *= factor;
    settings.basis.dropped *= factor, settings.basis.keyframes *= factor;
    char name[64];
    std::snprintf(name, sizeof name, "tiles, error %g", settings.error);
    return {"tiles", name, settings};
}

}  // namespace

std::vector<LightmapEncoding> lightmap_encodings() {
    std::vector<LightmapEncoding> all;
    for (const double factor : {1.0, 2.0, 4.0, 8.0}) all.push_back(tiles(factor));
    for (const std::size_t vectors : {5, 10, 20, 40})
        all.push_back({"paper", "paper, " + std::to_string(vectors) + " vectors", PaperSettings{vectors, false}});
    all.push_back({"paper's intervals", "paper's intervals, 20 vectors", PaperSettings{20, true}});
    all.push_back({"paper's intervals", "paper's intervals, frames", PaperSettings{0, true}});
    all.push_back({"frames", "all frames", PaperSettings{0, false}});
    return all;
}

}  // namespace daylit
