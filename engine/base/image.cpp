#include "engine/base/image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/png_check.h"
#include "engine/base/text.h"

namespace daylit {
namespace {

constexpr int kMaxChannels = 64;
constexpr std::size_t kMaxFileBytes = std::size_t(1) << 30;
constexpr int kPngLevel = 3;  // zlib's: a twentieth more bytes than its default 6, in half the time
// What a file of few bytes may declare: 4 Mpixel and beyond them no more than any honest compression reaches.
constexpr std::size_t kFreePixels = std::size_t(1) << 22, kPixelsPerByte = 4096;

/// A file's format by its first bytes, never by its name: "OpenImageIO, try everything" would hand a stranger's bytes
/// to every reader there is. Empty when the format is none of ours.
std::string format_of(std::span<const std::uint8_t> bytes) {
    struct Magic {
        std::string_view bytes;
        const char* format;
    };
    using namespace std::string_view_literals;
    constexpr Magic kMagics[] = {{"\x89PNG\r\n\x1a\n"sv, "png"},
                                 {"\xff\xd8\xff"sv, "jpeg"},
                                 {"\x76\x2f\x31\x01"sv, "openexr"},
                                 {"#?"sv, "hdr"},
                                 {"PF"sv, "pnm"},
                                 {"Pf"sv, "pnm"},
                                 {"II*\0"sv, "tiff"},
                                 {"MM\0*"sv, "tiff"}};
    const std::string_view head(reinterpret_cast<const char*>(bytes.data()), std::min<std::size_t>(bytes.size(), 16));
    for (const Magic& magic : kMagics)
        if (head.starts_with(magic.bytes)) return magic.format;
    if (head.starts_with("RIFF") && head.size() >= 12 && head.substr(8, 4) == "WEBP") return "webp";
    return {};
}

std::string said_by(const OIIO::ImageInput& input) {
    const std::string message = one_line(input.geterror());
    return message.empty() ? "is damaged" : message;
}

void check_declared_size(const OIIO::ImageSpec& spec, std::size_t file_bytes, const std::string& name) {
    const auto refuse = [&](const std::string& what) { throw Error(name, what); };
    const std::string size = std::to_string(spec.width) + " x " + std::to_string(spec.height);
    if (spec.width <= 0 || spec.height <= 0) refuse("declares an empty image of " + size);
    if (spec.width > kMaxImageSide || spec.height > kMaxImageSide ||
        std::size_t(spec.width) * std::size_t(spec.height) > kMaxImagePixels)
        refuse("declares " + size + " pixels, more than the " + std::to_string(kMaxImageSide) +
               " a side that are read; scale it down");
    if (std::size_t(spec.width) * std::size_t(spec.height) > kFreePixels + kPixelsPerByte * file_bytes)
        refuse("declares " + size + " pixels, which its " + std::to_string(file_bytes) + " bytes cannot hold");
    if (spec.depth > 1) refuse("is a volume, not a picture");
    if (spec.deep) refuse("holds deep samples, which are not supported; flatten it");
    if (spec.nchannels < 1 || spec.nchannels > kMaxChannels)
        refuse("declares " + std::to_string(spec.nchannels) + " channels; 1 to " + std::to_string(kMaxChannels) +
               " are read");
    if (spec.tile_width > 0) {
        // One tile is decoded whole, whatever part of it lies in the picture.
        const double tile = double(spec.tile_width) * double(spec.tile_height) * std::max(1, spec.tile_depth);
        if (tile > double(kMaxImagePixels) / 4) refuse("declares tiles larger than are read; store it in scanlines");
    }
}

struct OpenImage {
    std::unique_ptr<OIIO::Filesystem::IOMemReader> memory;  // must outlive input
    std::unique_ptr<OIIO::ImageInput> input;
    OIIO::ImageSpec spec;
};

/// bytes must outlive the result. `path` is for formats that cannot be read from memory.
OpenImage open_image(std::span<const std::uint8_t> bytes, const std::string& name, const std::string& path) {
    if (bytes.empty()) throw Error(name, "is an empty file, not an image");
    const std::string format = format_of(bytes);
    if (format.empty()) throw Error(name, "is not an image of a known format (PNG, JPEG, EXR, HDR, PFM, TIFF, WebP)");
    if (format == "png")
        if (const std::string damage = png_damage(bytes); !damage.empty()) throw Error(name, damage);
    OpenImage image;
    image.input = OIIO::ImageInput::create(format);
    if (!image.input) throw Error(name, "OpenImageIO was built without " + format);
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    std::string opened = path;
    if (image.input->supports("ioproxy")) {
        image.memory =
            std::make_unique<OIIO::Filesystem::IOMemReader>(const_cast<std::uint8_t*>(bytes.data()), bytes.size());
        image.input->set_ioproxy(image.memory.get());
        opened = "memory." + format;
    } else if (path.empty()) {
        throw Error(name, "OpenImageIO cannot read " + format + " from memory; use PNG or JPEG");
    }
    if (!image.input->open(opened, image.spec, config)) throw Error(name, said_by(*image.input));
    check_declared_size(image.spec, bytes.size(), name);
    return image;
}

/// Any failure of OpenImageIO, exceptions of its readers included, as one Error.
template <typename Work>
auto guarded(const std::string& name, Work work) {
    try {
        return work();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw Error(name, "declares more pixels than there is memory for");
    } catch (const std::exception& exception) {
        throw Error(name, one_line(exception.what()));
    }
}

/// Channels of the file that stand for red, green and blue.
std::array<int, 3> rgb_channels(const OIIO::ImageSpec& spec) {
    std::array<int, 3> named = {-1, -1, -1};
    for (int c = 0; c < spec.nchannels; ++c)
        for (int i = 0; i < 3; ++i)
            if (spec.channelnames[std::size_t(c)] == std::string(1, "RGB"[i])) named[std::size_t(i)] = c;
    if (std::all_of(named.begin(), named.end(), [](int c) { return c >= 0; })) return named;
    if (spec.nchannels >= 3) return {0, 1, 2};
    return {0, 0, 0};
}

/// Integer pixels are pictures for a screen (sRGB) in every format that we read, floats are linear light.
bool is_srgb_coded(const OIIO::ImageSpec& spec) {
    return !spec.format.is_floating_point() && spec.get_string_attribute("oiio:ColorSpace") != "Linear";
}

template <typename T>
std::vector<T> read_pixels(OpenImage& image, OIIO::TypeDesc type, int channels, const std::string& name) {
    std::vector<T> values(std::size_t(image.spec.width) * std::size_t(image.spec.height) * std::size_t(channels));
    if (!image.input->read_image(0, 0, 0, channels, type, values.data())) throw Error(name, said_by(*image.input));
    return values;
}

Image decode_image(OpenImage& file, const std::string& name) {
    const std::array<int, 3> rgb = rgb_channels(file.spec);
    const int channels = 1 + *std::max_element(rgb.begin(), rgb.end());
    const std::vector<float> values = read_pixels<float>(file, OIIO::TypeFloat, channels, name);
    Image image(file.spec.width, file.spec.height);
    const bool coded = is_srgb_coded(file.spec);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const float value = values[i * std::size_t(channels) + std::size_t(rgb[std::size_t(c)])];
            image.pixels[i][c] = coded ? decode_srgb(value) : value;
        }
    return image;
}

Image8 decode_image8(OpenImage& file, const std::string& name) {
    const int channels = std::min(file.spec.nchannels, 4);
    std::vector<std::uint8_t> values = read_pixels<std::uint8_t>(file, OIIO::TypeUInt8, channels, name);
    Image8 image{file.spec.width, file.spec.height, {}};
    if (channels == 4) {
        image.rgba = std::move(values);
        return image;
    }
    const std::size_t count = values.size() / std::size_t(channels);
    image.rgba.resize(4 * count);
    const std::size_t green = channels >= 3 ? 1 : 0, blue = channels >= 3 ? 2 : 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* from = &values[i * std::size_t(channels)];
        std::uint8_t* to = &image.rgba[4 * i];
        to[0] = from[0], to[1] = from[green], to[2] = from[blue];
        to[3] = channels == 2 ? from[1] : 255;
    }
    return image;
}

void write_pixels(const std::filesystem::path& path, const std::string& format, const OIIO::ImageSpec& spec,
                  OIIO::TypeDesc type, const void* pixels) {
    write_whole(path, [&](const std::filesystem::path& temporary) {
        const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
        if (!output) throw Error(path.string(), "OpenImageIO was built without " + format);
        if (!output->open(temporary.string(), spec) || !output->write_image(type, pixels) || !output->close())
            throw Error(path.string(), "cannot be written: " + one_line(output->geterror()));
    });
}

std::string lower_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

}  // namespace

Image read_image(const std::filesystem::path& path) {
    const std::string name = path.string();
    const std::vector<std::uint8_t> bytes = read_file(path, kMaxFileBytes);
    return guarded(name, [&] {
        OpenImage file = open_image(bytes, name, name);
        return decode_image(file, name);
    });
}

Image8 read_image8(const std::filesystem::path& path) {
    return read_image8(read_file(path, kMaxFileBytes), path.string());
}

Image8 read_image8(std::span<const std::uint8_t> bytes, const std::string& name) {
    return guarded(name, [&] {
        OpenImage file = open_image(bytes, name, {});
        return decode_image8(file, name);
    });
}

std::array<int, 2> declared_image_size(std::span<const std::uint8_t> bytes, const std::string& name) {
    return guarded(name, [&] {
        const OpenImage file = open_image(bytes, name, {});
        return std::array<int, 2>{file.spec.width, file.spec.height};
    });
}

void write_image(const std::filesystem::path& path, const Image& image, const std::string& comment) {
    const std::string extension = lower_extension(path);
    if (image.empty()) throw Error(path.string(), "there are no pixels to write");
    const bool exr = extension == ".exr";
    if (!exr && extension != ".png") throw Error(path.string(), "pictures are written as .exr or .png");
    OIIO::ImageSpec spec(image.width, image.height, 3, exr ? OIIO::TypeFloat : OIIO::TypeUInt8);
    if (!comment.empty()) spec.attribute("ImageDescription", comment);
    // A fixed date: without one the writers put in the time of day, and the same picture would have other bytes.
    spec.attribute("DateTime", "2000:01:01 00:00:00");
    if (exr) {
        spec.attribute("compression", "zip");
        spec.attribute("oiio:ColorSpace", "Linear");
        return write_pixels(path, "openexr", spec, OIIO::TypeFloat, image.pixels.data());
    }
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("png:compressionLevel", kPngLevel);
    std::vector<std::uint8_t> coded(3 * image.pixels.size());
    tbb::parallel_for(0, image.height, [&](int y) {
        const std::size_t row = std::size_t(image.width) * std::size_t(y);
        for (std::size_t i = row; i < row + std::size_t(image.width); ++i)
            for (int c = 0; c < 3; ++c)
                coded[3 * i + std::size_t(c)] = std::uint8_t(encode_srgb(image.pixels[i][c]) * 255.0f + 0.5f);
    });
    write_pixels(path, "png", spec, OIIO::TypeUInt8, coded.data());
}

float encode_srgb(float linear) {
    if (!(linear > 0.0f)) return 0.0f;  // NaN included
    if (linear >= 1.0f) return 1.0f;
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float decode_srgb(float coded) {
    if (!(coded > 0.0f)) return 0.0f;
    if (coded >= 1.0f) return 1.0f;
    return coded <= 0.04045f ? coded / 12.92f : std::pow((coded + 0.055f) / 1.055f, 2.4f);
}

}  // namespace daylit
