// Validation and decoding of accessors (glTF 2.0, sections 3.6.2 and 5.1).
#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "engine/scene/gltf_file.h"

namespace daylit::gltf {
namespace {

// A few bytes of JSON can ask for any number of zeros (accessors without a view) and for the same data again and again.
// Honest files stay far below: one read of every element, widened from bytes to floats, is 4 times the buffers.
constexpr std::uint64_t kFreeBytes = std::uint64_t(1) << 26;
constexpr std::uint64_t kDecodedPerBufferByte = 64;

/// First byte, bytes from one element to the next; base null: zeros.
struct Elements {
    const std::uint8_t* base = nullptr;
    std::size_t stride = 0;
};

std::size_t component_size(int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            return 0;
    }
}

/// Bytes of one element, the padding of matrix columns to 4 bytes included (section 3.6.2.4).
std::size_t element_size(const AccessorShape& shape, int type) {
    const std::size_t size = component_size(shape.component_type);
    if (size == 1 && type == TINYGLTF_TYPE_MAT2) return 8;
    if (size == 1 && type == TINYGLTF_TYPE_MAT3) return 12;
    if (size == 2 && type == TINYGLTF_TYPE_MAT3) return 24;
    return size * std::size_t(shape.components);
}

/// Where component c of an element starts.
std::size_t component_offset(const AccessorShape& shape, int type, int c) {
    const std::size_t size = component_size(shape.component_type);
    const bool padded = element_size(shape, type) != size * std::size_t(shape.components);
    if (!padded) return size * std::size_t(c);
    const int rows = type == TINYGLTF_TYPE_MAT2 ? 2 : 3;
    const std::size_t column = size == 1 ? 4 : 8;
    return std::size_t(c / rows) * column + size * std::size_t(c % rows);
}

/// The bytes of `count` elements of `size` bytes at `offset` in a view; fails unless all of them lie in its buffer.
Elements locate(const File& file, int view_index, std::size_t offset, std::size_t count, std::size_t size,
                std::size_t alignment, bool may_stride, const std::string& place) {
    if (!in_range(view_index, file.model.bufferViews))
        file.fail(place, "refers to bufferView " + std::to_string(view_index) + ", which does not exist");
    const tinygltf::BufferView& view = file.model.bufferViews[std::size_t(view_index)];
    const std::string where = place + " bufferView " + std::to_string(view_index);
    if (!in_range(view.buffer, file.model.buffers))
        file.fail(where, "refers to buffer " + std::to_string(view.buffer) + ", which does not exist");
    const std::vector<unsigned char>& data = file.model.buffers[std::size_t(view.buffer)].data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
        file.fail(where, "reaches beyond the " + std::to_string(data.size()) + " bytes of its buffer");
    const std::size_t stride = may_stride && view.byteStride != 0 ? view.byteStride : size;
    if (stride < size) file.fail(where, "has a stride of " + std::to_string(stride) + " bytes, less than one element");
    if (offset > view.byteLength) file.fail(place, "starts beyond the end of bufferView " + std::to_string(view_index));
    const std::size_t room = view.byteLength - offset;
    if (count > 0 && (room < size || (room - size) / stride < count - 1))
        file.fail(place, "needs " + std::to_string(count) + " elements, more than bufferView " +
                             std::to_string(view_index) + " holds");
    if ((view.byteOffset + offset) % alignment != 0 || stride % alignment != 0)
        file.fail(place, "is not aligned to its " + std::to_string(alignment) + "-byte components");
    return {data.data() + view.byteOffset + offset, stride};
}

template <typename T>
T load(const std::uint8_t* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

std::uint32_t load_unsigned(int type, const std::uint8_t* bytes) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return *bytes;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load<std::uint16_t>(bytes);
        default:
            return load<std::uint32_t>(bytes);
    }
}

template <typename T>
float to_float(T value, bool normalized) {
    if constexpr (std::is_floating_point_v<T>) {
        return value;
    } else {
        const float number = float(value);
        // Section 3.6.2.2: signed values are clamped, so that -128 and -127 both are -1.
        return normalized ? std::max(number / float(std::numeric_limits<T>::max()), -1.0f) : number;
    }
}

float load_float(const AccessorShape& shape, const std::uint8_t* bytes) {
    const auto as = [&](auto type) { return to_float(load<decltype(type)>(bytes), shape.normalized); };
    switch (shape.component_type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return as(std::int8_t());
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return as(std::uint8_t());
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return as(std::int16_t());
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return as(std::uint16_t());
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return as(std::uint32_t());
        default:
            return as(float());
    }
}

Elements dense_part(const File& file, const tinygltf::Accessor& accessor, const AccessorShape& shape,
                    const std::string& place) {
    if (accessor.bufferView < 0) return {};
    return locate(file, accessor.bufferView, accessor.byteOffset, shape.count, element_size(shape, accessor.type),
                  component_size(shape.component_type), true, place);
}

/// The replaced elements: ascending indices and their values.
struct Sparse {
    std::vector<std::uint32_t> indices;
    Elements values;
    /// Position of an element among the replaced ones, or -1.
    std::ptrdiff_t find(std::size_t element) const {
        const auto found = std::lower_bound(indices.begin(), indices.end(), element);
        return found != indices.end() && *found == element ? found - indices.begin() : -1;
    }
};

Sparse sparse_part(const File& file, const tinygltf::Accessor& accessor, const AccessorShape& shape,
                   const std::string& place) {
    if (!accessor.sparse.isSparse) return {};
    const auto& sparse = accessor.sparse;
    const std::string where = place + " sparse part";
    if (sparse.count < 1 || std::size_t(sparse.count) > shape.count)
        file.fail(where,
                  "replaces " + std::to_string(sparse.count) + " of " + std::to_string(shape.count) + " elements");
    if (sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0) file.fail(where, "has a negative offset");
    const int type = sparse.indices.componentType;
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        file.fail(where, "has indices that are not unsigned integers");
    const std::size_t count = std::size_t(sparse.count), size = component_size(type);
    const Elements indices = locate(file, sparse.indices.bufferView, std::size_t(sparse.indices.byteOffset), count,
                                    size, size, false, where + " indices");
    Sparse part;
    part.values =
        locate(file, sparse.values.bufferView, std::size_t(sparse.values.byteOffset), count,
               element_size(shape, accessor.type), component_size(shape.component_type), false, where + " values");
    part.indices.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t index = load_unsigned(type, indices.base + i * indices.stride);
        if (index >= shape.count)
            file.fail(where, "replaces element " + std::to_string(index) + ", which does not exist");
        if (!part.indices.empty() && index <= part.indices.back()) file.fail(where, "has indices that do not ascend");
        part.indices.push_back(index);
    }
    return part;
}

/// All elements, or a selection of them; asks `decode(bytes or null for zero, out)` for each component.
template <typename T, typename Decode>
std::vector<T> read(File& file, int index, const std::span<const std::uint32_t>* selection, const std::string& place,
                    Decode decode) {
    const AccessorShape shape = check_accessor(file, index, place);
    const tinygltf::Accessor& accessor = file.model.accessors[std::size_t(index)];
    const std::size_t count = selection ? selection->size() : shape.count;
    const std::size_t components = std::size_t(shape.components);
    file.charge(std::uint64_t(count) * components * sizeof(T), place);
    const Elements dense = dense_part(file, accessor, shape, place);
    const Sparse sparse = sparse_part(file, accessor, shape, place);
    std::vector<std::size_t> offsets;
    for (int c = 0; c < shape.components; ++c) offsets.push_back(component_offset(shape, accessor.type, c));
    std::vector<T> values(count * components);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t element = selection ? (*selection)[i] : i;
        const std::uint8_t* bytes = dense.base ? dense.base + element * dense.stride : nullptr;
        if (!sparse.indices.empty())
            if (const std::ptrdiff_t found = sparse.find(element); found >= 0)
                bytes = sparse.values.base + std::size_t(found) * sparse.values.stride;
        if (!bytes) continue;
        for (std::size_t c = 0; c < components; ++c) values[i * components + c] = decode(shape, bytes + offsets[c]);
    }
    return values;
}

std::vector<float> read_floats(File& file, int index, const std::span<const std::uint32_t>* selection,
                               const std::string& place) {
    std::vector<float> values = read<float>(file, index, selection, place, load_float);
    for (const float value : values)
        if (!std::isfinite(value)) file.fail(place, "holds NaN or infinity");
    return values;
}

std::vector<std::uint32_t> read_integers(File& file, int index, const std::span<const std::uint32_t>* selection,
                                         const std::string& place) {
    const AccessorShape shape = check_accessor(file, index, place);
    if (shape.component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
        shape.component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        shape.component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        file.fail(place, "must hold unsigned integers");
    return read<std::uint32_t>(file, index, selection, place, [](const AccessorShape& s, const std::uint8_t* bytes) {
        return load_unsigned(s.component_type, bytes);
    });
}

}  // namespace

void File::charge(std::uint64_t bytes, const std::string& where) {
    decoded_bytes += bytes;
    if (decoded_bytes > kFreeBytes + kDecodedPerBufferByte * buffer_bytes)
        fail(where, "asks for far more data than the file holds");
}

AccessorShape check_accessor(File& file, int index, const std::string& place) {
    if (!in_range(index, file.model.accessors))
        file.fail(place, "refers to accessor " + std::to_string(index) + ", which does not exist");
    file.used_accessors.resize(file.model.accessors.size(), false);
    file.used_accessors[std::size_t(index)] = true;
    const tinygltf::Accessor& accessor = file.model.accessors[std::size_t(index)];
    AccessorShape shape;
    shape.count = accessor.count;
    shape.components = tinygltf::GetNumComponentsInType(std::uint32_t(accessor.type));
    shape.component_type = accessor.componentType;
    shape.normalized = accessor.normalized;
    if (shape.components < 1 || component_size(shape.component_type) == 0)
        file.fail(place, "has an accessor of an unknown component type");
    if (shape.count < 1 || shape.count > std::numeric_limits<std::uint32_t>::max())
        file.fail(place, "has an accessor of " + std::to_string(shape.count) + " elements");
    dense_part(file, accessor, shape, place);
    return shape;
}

std::vector<float> read_floats(File& file, int accessor, const std::string& place) {
    return read_floats(file, accessor, nullptr, place);
}

std::vector<float> read_floats(File& file, int accessor, std::span<const std::uint32_t> elements,
                               const std::string& place) {
    return read_floats(file, accessor, &elements, place);
}

std::vector<std::uint32_t> read_integers(File& file, int accessor, const std::string& place) {
    return read_integers(file, accessor, nullptr, place);
}

std::vector<std::uint32_t> read_integers(File& file, int accessor, std::span<const std::uint32_t> elements,
                                         const std::string& place) {
    return read_integers(file, accessor, &elements, place);
}

}  // namespace daylit::gltf
