#include "demo/movie.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <vector>

#include "engine/base/error.h"

extern char** environ;

namespace daylit {
namespace {

std::vector<std::string> arguments(const std::filesystem::path& output, int width, int height, double rate) {
    char frames_per_second[32];
    std::snprintf(frames_per_second, sizeof frames_per_second, "%g", rate);
    // A name that starts with '-' or holds ':' would be read as an option or a protocol; file: takes any.
    return {"ffmpeg", "-nostdin", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24", "-video_size",
            std::to_string(width) + "x" + std::to_string(height), "-framerate", frames_per_second, "-i", "pipe:0",
            "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p",
            "-movflags", "+faststart", "-f", "mp4", "file:" + std::filesystem::absolute(output).string()};
}

pid_t spawn(const std::filesystem::path& program, std::vector<std::string> words, int standard_input) {
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, standard_input, STDIN_FILENO);
    posix_spawnattr_t attributes;  // a process group of its own: Ctrl-C is for us, and we end ffmpeg
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    pid_t process = -1;
    const int problem = posix_spawn(&process, program.c_str(), &actions, &attributes, argv.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (problem != 0) throw Error(program.string(), std::string("cannot be started: ") + std::strerror(problem));
    return process;
}

}  // namespace

std::filesystem::path find_ffmpeg() {
    const char* path = std::getenv("PATH");
    std::stringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const std::filesystem::path candidate = std::filesystem::path(folder) / "ffmpeg";
        if (access(candidate.c_str(), X_OK) == 0) return candidate;
    }
    throw Error("-o", "an .mp4 needs ffmpeg, which is not installed (apt-get install ffmpeg); give a folder for frames or "
                      "a .png for a contact sheet");
}

Movie::Movie(const std::filesystem::path& ffmpeg, const std::filesystem::path& output, int width, int height,
             double frames_per_second)
    : output_(output), width_(width), height_(height) {
    std::signal(SIGPIPE, SIG_IGN);  // an ffmpeg that stops early is an error of write(), not the end of this process
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw Error(output.string(), std::string("no pipe: ") + std::strerror(errno));
    pipe_ = ends[1];
    try {
        process_ = spawn(ffmpeg, arguments(output, width, height, frames_per_second), ends[0]);
    } catch (...) {
        close(ends[0]);
        close_pipe();
        throw;
    }
    close(ends[0]);
}

Movie::~Movie() {
    if (process_ > 0) kill(process_, SIGKILL);
    close_pipe();
    if (process_ > 0) waitpid(process_, nullptr, 0);
}

void Movie::close_pipe() {
    if (pipe_ >= 0) close(pipe_);
    pipe_ = -1;
}

void Movie::add(const Image& frame) {
    assert(frame.width == width_ && frame.height == height_);
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * frame.pixels.size());
    for (const Rgb& pixel : frame.pixels) {
        for (int c = 0; c < 3; ++c) bytes.push_back(std::uint8_t(std::lround(255.0f * encode_srgb(pixel[c]))));
    }
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t written = write(pipe_, bytes.data() + done, bytes.size() - done);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) throw Error(output_.string(), "ffmpeg stopped before the last frame; see its message above");
        done += std::size_t(written);
    }
}

void Movie::finish() {
    close_pipe();
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        throw Error(output_.string(), "ffmpeg could not write it; see its message above");
    }
}

}  // namespace daylit
