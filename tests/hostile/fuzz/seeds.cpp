// Writes the seeds that the fuzzers start from: the proof scenes, and baked files as they are and as records.
//   daylit_fuzz_seeds FOLDER [FILE.daylit ...]
#include <cstdio>
#include <string>

#include "content/content.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "tests/hostile/fuzz/records.h"

int main(int argc, char** argv) {
    using namespace daylit;
    if (argc < 2) return std::fprintf(stderr, "usage: daylit_fuzz_seeds FOLDER [FILE.daylit ...]\n"), 2;
    try {
        const std::filesystem::path folder = argv[1];
        std::filesystem::create_directories(folder / "gltf");
        std::filesystem::create_directories(folder / "daylit");
        constexpr std::uintmax_t kLargestSeed = 200000;  // larger ones are slow to change and to read
        for (const ContentScene& scene : content_scenes()) {
            if (scene.name == "koldinghus") continue;
            const std::filesystem::path file = folder / "gltf" / (scene.name + ".glb");
            make_scene(scene.name, file);
            if (std::filesystem::file_size(file) > kLargestSeed) std::filesystem::remove(file);
        }
        for (int i = 2; i < argc; ++i) {
            const std::string name = std::to_string(i) + "-" + std::filesystem::path(argv[i]).stem().string();
            if (std::filesystem::file_size(argv[i]) <= kLargestSeed)
                write_file(folder / "daylit" / name, read_file(argv[i]));
            const Bytes records = fuzz::to_records(argv[i]);
            if (records.size() <= kLargestSeed) write_file(folder / "daylit" / (name + "-records"), records);
        }
    } catch (const Error& error) {
        return std::fprintf(stderr, "daylit_fuzz_seeds: %s\n", error.what()), 1;
    }
    return 0;
}
