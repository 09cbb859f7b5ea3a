#pragma once
// What `daylit report` compares of the ways to store one solution.
#include <string>
#include <variant>
#include <vector>

#include "gi/encode/encode_lightmap.h"

namespace daylit {

/// The scheme of Bahnsen et al. 2012 (paper_pca.h).
struct PaperSettings {
    std::size_t vectors = 0;  // 0: the frames themselves, as half floats
    bool intervals = false;   // of all frames, those that the paper's test keeps
};

struct LightmapEncoding {
    std::string axis, name;
    std::variant<LightmapSettings, PaperSettings> settings;
};

/// Tiles as bakes keep them (the first), and coarser; the paper's scheme with its own 10 and 20 vectors, and with fewer
/// and more; frames as they are.
std::vector<LightmapEncoding> lightmap_encodings();

}  // namespace daylit
