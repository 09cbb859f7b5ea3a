#include "engine/base/file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "engine/base/error.h"

namespace daylit {
namespace fs = std::filesystem;
namespace {

/// Hidden, beside its target (rename is atomic only within a file system), and unique among threads and processes.
fs::path temporary_beside(const fs::path& path) {
    static std::atomic<unsigned> counter{0};
    const std::string unique = std::to_string(::getpid()) + "-" + std::to_string(counter++);
    std::string name = ".";
    name += path.stem().string() + ".part-" + unique + path.extension().string();
    return path.parent_path() / name;
}

/// Removes the file unless kept.
class Temporary {
  public:
    explicit Temporary(fs::path path) : path_(std::move(path)) {}
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    ~Temporary() {
        std::error_code ignored;
        fs::remove(path_, ignored);
    }
    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

void require_writable_place(const fs::path& path) {
    std::error_code code;
    if (path.empty() || path.filename().empty()) throw Error(path.string(), "is not the name of a file to write");
    const fs::file_status status = fs::status(path, code);
    if (fs::exists(status) && !fs::is_regular_file(status))
        throw Error(path.string(), "exists and is not a regular file; choose another name");
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, code))
        throw Error(path.string(), "the folder " + folder.string() + " does not exist");
}

}  // namespace

std::vector<std::uint8_t> read_file(const fs::path& path, std::size_t limit) {
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (!fs::exists(status)) throw Error(path.string(), "no such file");
    if (!fs::is_regular_file(status)) throw Error(path.string(), "is not a regular file");
    const std::uintmax_t size = fs::file_size(path, code);
    if (code) throw Error(path.string(), "cannot be read: " + code.message());
    if (size > limit)
        throw Error(path.string(),
                    "is " + std::to_string(size) + " bytes long; at most " + std::to_string(limit) + " are accepted");
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw Error(path.string(), std::string("cannot be read: ") + std::strerror(errno));
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (static_cast<std::size_t>(stream.gcount()) != bytes.size()) throw Error(path.string(), "ended while being read");
    return bytes;
}

void write_whole(const fs::path& path, const std::function<void(const fs::path& temporary)>& write) {
    require_writable_place(path);
    const Temporary temporary(temporary_beside(path));
    write(temporary.path());
    std::error_code code;
    fs::rename(temporary.path(), path, code);
    if (code) throw Error(path.string(), "cannot be written: " + code.message());
}

void write_file(const fs::path& path, std::span<const std::uint8_t> bytes) {
    write_whole(path, [&](const fs::path& temporary) {
        std::ofstream stream(temporary, std::ios::binary);
        stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        stream.flush();
        if (!stream) throw Error(path.string(), std::string("cannot be written: ") + std::strerror(errno));
    });
}

void write_file(const fs::path& path, const std::string& text) {
    write_file(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

}  // namespace daylit
