#pragma once
// A section's bytes, written and read one number after the other. Little-endian, as they lie in memory.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/units.h"

namespace daylit {

static_assert(std::endian::native == std::endian::little, "files are little-endian and copied as they lie in memory");

using Bytes = std::vector<std::uint8_t>;
inline constexpr std::uint32_t kMaxString = 65536;

class ByteWriter {
  public:
    template <class T>
    void put(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        append(&value, sizeof(T));
    }
    template <class T>
    void put_all(const std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        append(values.data(), values.size() * sizeof(T));
    }
    void put_string(const std::string& text) {
        const std::size_t length = std::min<std::size_t>(text.size(), kMaxString);
        put(std::uint32_t(length));
        append(text.data(), length);
    }
    Bytes take() { return std::move(bytes_); }

  private:
    void append(const void* values, std::size_t bytes);

    Bytes bytes_;
};

template <class T>
Bytes bytes_of(const std::vector<T>& values) {
    ByteWriter w;
    w.put_all(values);
    return w.take();
}

/// Reads one section; every step is checked against its end and throws Error that names the file and the section.
class ByteReader {
  public:
    ByteReader(Bytes bytes, std::filesystem::path path, std::string place)
        : bytes_(std::move(bytes)), path_(std::move(path)), place_(std::move(place)) {}

    template <class T>
    T get() {
        T value;
        std::memcpy(&value, take(sizeof(T)), sizeof(T));
        return value;
    }
    template <class T>
    std::vector<T> get_all(std::size_t count) {
        if (count > (bytes_.size() - at_) / sizeof(T)) fail("ends too early");
        std::vector<T> values(count);
        if (count) std::memcpy(values.data(), take(count * sizeof(T)), count * sizeof(T));
        return values;
    }
    double finite() {
        const double value = get<double>();
        if (!std::isfinite(value)) fail("holds a number that is not finite");
        return value;
    }
    Vec3 finite_vec3() {
        const Vec3 v = get<Vec3>();
        if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
            fail("holds a number that is not finite");
        return v;
    }
    bool boolean() { return number(std::uint8_t(0), std::uint8_t(1), "a boolean") == 1; }
    template <class T>
    T number(T least, T most, const char* what) {
        const T value = get<T>();
        if (value < least || value > most) fail(std::string(what) + " is out of range");
        return value;
    }
    std::string string() {
        const std::size_t length = number<std::uint32_t>(0, kMaxString, "a string's length");
        const std::uint8_t* text = take(length);
        return {text, text + length};
    }
    void expect_end() const {
        if (at_ != bytes_.size()) fail("is longer than what it holds");
    }
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(path_.string(), place_ + " " + what + "; bake the scene again");
    }

  private:
    const std::uint8_t* take(std::size_t count) {
        if (count > bytes_.size() - at_) fail("ends too early");
        at_ += count;
        return bytes_.data() + at_ - count;
    }

    Bytes bytes_;
    std::size_t at_ = 0;
    std::filesystem::path path_;
    std::string place_;
};

}  // namespace daylit
