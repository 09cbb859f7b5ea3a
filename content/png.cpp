#include "content/png.h"

#include <zlib.h>

#include <cstdlib>

namespace {

// stb's own deflate takes five times as long for these pictures.
unsigned char* compress_with_zlib(unsigned char* data, int length, int* compressed_length, int) {
    uLongf size = compressBound(uLong(length));
    auto* out = static_cast<unsigned char*>(std::malloc(size));  // freed by stb
    if (out && compress2(out, &size, data, uLong(length), 5) != Z_OK) {
        std::free(out);
        out = nullptr;
    }
    *compressed_length = int(size);
    return out;
}

}  // namespace

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBIW_ZLIB_COMPRESS compress_with_zlib
#include <stb/stb_image_write.h>

namespace daylit::content {

std::vector<std::uint8_t> encode_png(int width, int height, int channels, const std::vector<std::uint8_t>& pixels) {
    std::vector<std::uint8_t> png;
    const auto append = [](void* out, void* data, int size) {
        const auto* bytes = static_cast<const std::uint8_t*>(data);
        auto& all = *static_cast<std::vector<std::uint8_t>*>(out);
        all.insert(all.end(), bytes, bytes + size);
    };
    stbi_write_png_to_func(append, &png, width, height, channels, pixels.data(), width * channels);
    return png;
}

}  // namespace daylit::content
