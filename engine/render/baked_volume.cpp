#include "engine/render/baked_volume.h"

#include <string>

#include "engine/base/error.h"
#include "engine/gl/target.h"
#include "shaders/shared/frame_block.h"
#include "shaders/shared/sh.h"

namespace daylit {
namespace {

constexpr int kCoefficients = glsl::kShCoefficients;

}  // namespace

BakedVolume::BakedVolume(const IrradianceVolume& volume) : volume_(volume) {
    const auto [nx, ny, nz] = volume.size;
    GLint largest = 0;
    glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &largest);
    if (nx > largest || kCoefficients * ny > largest || nz > largest)
        throw Error("volume", std::to_string(nx) + "x" + std::to_string(ny) + "x" + std::to_string(nz) +
                                  " probes are more than this driver's " + std::to_string(largest) +
                                  " texels; bake with a larger --error");
    sh_ = make_texture_3d(GL_RGBA32F, nx, kCoefficients * ny, nz);
    const glsl::VolumeBlock block{Vec4(volume.origin, 1.0f / volume.spacing), Vec4(nx, ny, nz, 0.0f)};
    grid_ = make_buffer(std::vector<glsl::VolumeBlock>{block});
}

bool BakedVolume::stale(double hour) const {
    return !weights_ || volume_.basis.weights(hour) != *weights_;
}

void BakedVolume::set_hour(double hour) {
    if (!stale(hour)) return;
    weights_ = volume_.basis.weights(hour);
    const std::vector<Rgb> sh = volume_.combined(*weights_);
    const auto [nx, ny, nz] = volume_.size;
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (int i = 0; i < kCoefficients; ++i)
        glTextureSubImage3D(sh_.get(), 0, 0, i * ny, 0, nx, ny, nz, GL_RGB, GL_FLOAT,
                            sh.data() + std::size_t(i) * volume_.probes());
}

void BakedVolume::bind() const {
    glBindTextureUnit(10, sh_.get());
    glBindSampler(10, 0);
    glBindBufferBase(GL_UNIFORM_BUFFER, 3, grid_.get());
}

}  // namespace daylit
