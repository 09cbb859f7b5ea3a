#pragma once
// An .mp4 through the ffmpeg program, fed frame by frame.
#include <filesystem>
#include <string>
#include <sys/types.h>

#include "engine/base/image.h"

namespace daylit {

/// Where ffmpeg is, by PATH. throws Error with the way out when it is not installed.
std::filesystem::path find_ffmpeg();

/// Starts ffmpeg when made; H.264, yuv420p, sides made even. Without finish() (an exception, Ctrl-C) it is ended and
/// what it wrote is not to be used.
class Movie {
  public:
    Movie(const std::filesystem::path& ffmpeg, const std::filesystem::path& output, int width, int height,
          double frames_per_second);
    ~Movie();
    Movie(const Movie&) = delete;
    Movie& operator=(const Movie&) = delete;

    /// Display-linear in [0,1], of the size named above. throws Error when ffmpeg has stopped.
    void add(const Image& frame);
    /// Waits for ffmpeg. throws Error when it failed.
    void finish();

  private:
    void close_pipe();
    std::filesystem::path output_;
    int width_, height_;
    int pipe_ = -1;
    pid_t process_ = -1;
};

}  // namespace daylit
