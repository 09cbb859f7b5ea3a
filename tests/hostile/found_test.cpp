// Inputs by which a fuzzer (tests/hostile/fuzz) once brought a reader down: refused now, or read soundly.
#include <gtest/gtest.h>

#include "engine/baked/baked_file.h"
#include "engine/base/error.h"
#include "engine/scene/gltf.h"
#include "engine/scene/scene_facts.h"

namespace daylit {
namespace {

namespace fs = std::filesystem;

template <class Read>
void read_all(const char* extension, const Read& read) {
    for (const auto& entry : fs::directory_iterator(DAYLIT_TESTS_DIR "/hostile/found")) {
        if (entry.path().extension() != extension) continue;
        SCOPED_TRACE(entry.path().filename().string());
        try {
            read(entry.path());
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(entry.path().filename().string()), std::string::npos)
                << error.what();
        }
    }
}

TEST(Found, Gltf) {
    read_all(".glb", [](const fs::path& path) {
        const Scene scene = load_scene(path);
        const Pose pose = pose_scene(scene, 0.5);
        for (const Vec3& p : world_mesh(scene, pose, Part::All).positions)
            for (int axis = 0; axis < 3; ++axis) EXPECT_TRUE(std::isfinite(p[axis]));
        scene_facts(scene);
    });
}

TEST(Found, Daylit) {
    read_all(".daylit", [](const fs::path& path) { read_baked(path); });
}

}  // namespace
}  // namespace daylit
