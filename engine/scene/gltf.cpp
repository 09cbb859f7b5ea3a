#include "engine/scene/gltf.h"

#include "engine/scene/gltf_file.h"

namespace daylit {
namespace {

constexpr double kMinUnit = 1e-6, kMaxUnit = 1e6;

double metres_per_unit(const gltf::File& file, const LoadOptions& options, const SceneExtras& extras) {
    const double unit = options.unit != 0 ? options.unit : extras.unit.value_or(1.0);
    if (!(unit >= kMinUnit && unit <= kMaxUnit))
        file.fail("unit", "is " + std::to_string(unit) + " metres; it must lie between 1e-6 and 1e6");
    return unit;
}

Scene convert(gltf::File file, const LoadOptions& options) {
    Scene scene;
    scene.path = file.path;
    scene.extras = gltf::read_extras(file);
    file.unit = float(metres_per_unit(file, options, scene.extras));
    file.lambert = options.lambert;
    gltf::read_materials(file, scene);
    gltf::read_textures(file, scene);
    gltf::read_meshes(file, scene);
    gltf::read_nodes(file, scene);
    gltf::read_animations(file, scene);
    gltf::check_placement(file, scene);
    scene.notes = std::move(file.notes);
    return scene;
}

}  // namespace

Scene load_scene(const std::filesystem::path& path, const LoadOptions& options) {
    // tinygltf and the JSON parser below it throw exceptions of their own on some broken files.
    try {
        return convert(gltf::open(path), options);
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw Error(path.string(), "declares more data than there is memory for");
    } catch (const std::exception& exception) {
        throw Error(path.string(), std::string("cannot be read as glTF: ") + exception.what());
    }
}

}  // namespace daylit
