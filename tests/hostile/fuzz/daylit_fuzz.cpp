// Any bytes as a baked file, and any sections inside of a sound container: refused with an Error, or light that can be
// looked up.
#include "engine/baked/baked_file.h"
#include "engine/base/error.h"
#include "tests/hostile/fuzz/one_file.h"
#include "tests/hostile/fuzz/records.h"

namespace {

void read(const std::string& path) {
    using namespace daylit;
    const Baked baked = read_baked(path);
    if (baked.lightmap) {
        const std::vector<float> weights = baked.lightmap->basis.weights(7.3);
        for (const Vec2& uv : {Vec2(0.0f), Vec2(1.0f), Vec2(0.3f, 0.7f)}) baked.lightmap->irradiance(uv, weights);
    }
    if (baked.volume) {
        const std::vector<float> weights = baked.volume->basis.weights(7.3);
        for (const Vec3& place : {Vec3(0.0f), Vec3(1e6f), Vec3(-3.0f, 0.5f, 2.0f)})
            baked.volume->irradiance(place, Vec3(0, 1, 0), weights);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace daylit;
    try {
        const std::string& path = fuzz::file_with({data, size}, ".daylit");
        if (size >= 8 && std::memcmp(data, "DAYLIT", 6) == 0) {
            read(path);
        } else {
            write_sections(path, fuzz::from_records({data, size}));
            read(path);
        }
    } catch (const Error&) {
    }
    return 0;
}
