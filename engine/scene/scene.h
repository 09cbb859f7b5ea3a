#pragma once
// A level as plain data: what a glTF 2.0 file says, validated, with every default filled in.
// Indices are positions in the vectors of Scene; -1 means none. After load_scene every index is in range, every
// attribute of a primitive has as many elements as its positions, and every number is finite.
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/image.h"
#include "engine/base/units.h"
#include "engine/scene/day.h"

namespace daylit {

enum class Wrap : std::uint8_t { Repeat, Mirror, Clamp };
enum class Filter : std::uint8_t { Nearest, Linear };

struct Texture {
    int image = -1;  // an image that could not be read is refused on load, so never -1 after load_scene
    Wrap wrap_s = Wrap::Repeat;
    Wrap wrap_t = Wrap::Repeat;
    Filter filter = Filter::Linear;  // of both minification and magnification; mipmaps are always made by the renderer
};

/// A texture as a material uses it. texture == -1: the factor alone.
struct TextureRef {
    int texture = -1;
    int uv_set = 0;
    // KHR_texture_transform: uv' = transform * (u, v, 1), row by row: u' = m[0]*u + m[1]*v + m[2], v' = m[3]*u + ...
    std::array<float, 6> transform = {1, 0, 0, 0, 1, 0};
    bool has_transform() const { return transform != std::array<float, 6>{1, 0, 0, 0, 1, 0}; }
};

enum class AlphaMode : std::uint8_t { Opaque, Mask, Blend };

/// When a lamp or a material's emission shines, its extras.daylit.lit: "always" (the default) or from dusk till dawn,
/// "evening" (sky.h says how the change comes).
enum class Lit : std::uint8_t { Always, Evening };

/// A metallic-roughness material (specular-glossiness ones are converted on load).
struct Material {
    std::string name;
    Rgba base_color = Rgba(1.0f);  // linear albedo and coverage
    TextureRef base_color_texture;  // sRGB-coded RGB, linear A
    float metallic = 1.0f;
    float roughness = 1.0f;              // perceptual; alpha = roughness^2
    TextureRef metallic_roughness_texture;  // G roughness, B metallic, linear
    TextureRef normal_texture;              // tangent space, linear
    float normal_scale = 1.0f;
    TextureRef occlusion_texture;  // kept for `check`; unused, since occlusion is computed
    Rgb emission = Rgb(0.0f);      // radiance in cd/m^2: emissiveFactor * emissive_strength
    TextureRef emission_texture;   // sRGB-coded, multiplies emission
    Lit lit = Lit::Always;         // of emission
    AlphaMode alpha_mode = AlphaMode::Opaque;
    float alpha_cutoff = 0.5f;
    bool double_sided = false;        // concerns only what the camera sees
    bool unlit = false;               // KHR_materials_unlit: shows base colour as radiance in cd/m^2, reflects nothing
    float ior = 1.5f;                 // KHR_materials_ior
    float transmission = 0.0f;        // KHR_materials_transmission: share that is smooth glass, tinted by base colour
    TextureRef transmission_texture;  // R, linear, multiplies transmission
    float specular = 1.0f;            // KHR_materials_specular, strength
    TextureRef specular_texture;      // A, linear, multiplies specular
    Rgb specular_color = Rgb(1.0f);
    TextureRef specular_color_texture;  // sRGB-coded RGB, multiplies specular_color

    /// Those that decide how it looks, so all but occlusion.
    std::array<const TextureRef*, 7> textures() const {
        return {&base_color_texture, &metallic_roughness_texture, &normal_texture,      &emission_texture,
                &specular_texture,   &specular_color_texture,     &transmission_texture};
    }
};

/// A morph target's displacements; each vector is empty or as long as the primitive's positions.
struct MorphTarget {
    std::vector<Vec3> positions, normals, tangents;
};

enum class Topology : std::uint8_t { Triangles, Points };

/// One drawable with one material. Strips and fans become triangle lists on load; lines are dropped with a note.
/// Missing normals are made flat (by splitting vertices, as glTF asks), missing tangents by MikkTSpace-like averaging.
struct Primitive {
    Topology topology = Topology::Triangles;
    int material = 0;  // Scene::materials always ends up with at least the default material
    std::vector<std::uint32_t> indices;  // 3 per triangle (Triangles) or 1 per point (Points); always present
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;
    std::vector<Vec4> tangents;               // xyz and handedness; empty when the material has no normal texture
    std::vector<std::vector<Vec2>> uvs;       // uvs[set][vertex]; may be empty
    std::vector<Rgba> colors;                 // linear COLOR_0; empty when absent (then white)
    std::vector<std::array<std::uint16_t, 4>> joints;  // empty when not skinned
    std::vector<Vec4> weights;                         // sum to 1; empty when not skinned
    std::vector<MorphTarget> morph_targets;
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
    std::vector<float> morph_weights;  // defaults, one per morph target
};

struct Camera {
    std::string name;  // of its node where the node has one, else of the camera, else "camera<i>"
    int node = -1;
    bool orthographic = false;
    float vertical_fov = 1.0f;  // radians (perspective)
    float height = 2.0f;        // metres top to bottom (orthographic)
    float z_near = 0.05f;
    float z_far = 0.0f;  // 0: infinite
};

enum class LightKind : std::uint8_t { Directional, Point, Spot };

/// KHR_lights_punctual. Shines along -Z of its node.
struct PunctualLight {
    std::string name;
    LightKind kind = LightKind::Point;
    int node = -1;
    Rgb intensity = Rgb(1.0f);  // candela for point and spot, lux for directional; colour times intensity
    Lit lit = Lit::Always;      // directional ones are suns, and always there
    float range = 0.0f;         // metres, 0: infinite; glTF's window max(1 - (d/range)^4, 0)
    float inner_cone = 0.0f;    // radians (spot)
    float outer_cone = 0.78539816f;
};

struct Skin {
    std::vector<int> joints;                // nodes
    std::vector<Mat4> joint_from_mesh;      // inverse bind matrices, one per joint
};

struct Node {
    std::string name;
    int parent = -1;
    std::vector<int> children;
    Vec3 translation = Vec3(0.0f);
    Quat rotation = Quat(1, 0, 0, 0);
    Vec3 scale = Vec3(1.0f);
    std::optional<Mat4> matrix;  // when the file gives a matrix, it replaces TRS (such nodes are not animated)
    int mesh = -1;
    int skin = -1;
    int camera = -1;
    int light = -1;
    std::vector<Mat4> instances;   // EXT_mesh_gpu_instancing, node_from_instance; empty: the mesh once
    std::vector<float> morph_weights;  // overrides the mesh's; empty: the mesh's
    bool dynamic = false;  // animated, skinned by animated joints, below such a node, or extras.daylit.dynamic
};

enum class AnimationPath : std::uint8_t { Translation, Rotation, Scale, Weights };
enum class Interpolation : std::uint8_t { Step, Linear, CubicSpline };

struct AnimationChannel {
    int node = -1;
    AnimationPath path = AnimationPath::Translation;
    Interpolation interpolation = Interpolation::Linear;
    std::vector<float> times;   // seconds, ascending, finite
    std::vector<float> values;  // components per key as glTF: 3, 4 or the number of weights; x3 for CubicSpline
};

struct Animation {
    std::string name;
    float duration = 0.0f;  // seconds; walk and day loop it
    std::vector<AnimationChannel> channels;
};

/// What the file's scene.extras.daylit says; stands below the command line and above the defaults.
/// Keys in the file: latitude, longitude, date ("YYYY-MM-DD"), utc_offset, north, turbidity, clouds, unit, lightmap.
struct SceneExtras {
    std::optional<double> latitude, longitude, utc_offset, north, turbidity, clouds, unit;
    std::optional<Date> date;
    std::optional<glm::ivec2> lightmap;  // "lightmap": [width, height], texels that TEXCOORD_1 was laid out for
};

struct Scene {
    std::filesystem::path path;
    std::vector<Image8> images;
    std::vector<std::string> image_names;  // file name or "image 3", for messages
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Node> nodes;  // the nodes of the file, in its order; only those of the default scene are in `order`
    std::vector<int> order;   // nodes of the default scene, every parent before its children
    std::vector<Camera> cameras;
    std::vector<PunctualLight> lights;  // one per node that has a light
    std::vector<Skin> skins;
    std::vector<Animation> animations;
    SceneExtras extras;
    std::vector<std::string> notes;  // one line each: what was ignored, dropped or repaired, for `daylit check`
};

}  // namespace daylit
