#include "engine/render/baked_volume.h"

#include <string>

#include "engine/base/error.h"
#include "engine/gl/target.h"

namespace daylit {
namespace {

/// A buffer needs some content, also where there is nothing to say.
template <class T>
GlBuffer storage(std::vector<T> values, GLbitfield flags = 0) {
    if (values.empty()) values.emplace_back();
    return make_buffer(values, flags);
}

}  // namespace

BakedVolume::BakedVolume(const IrradianceVolume& volume) : volume_(volume) {
    const VolumeTree& tree = volume.tree;
    const std::size_t bytes = tree.records() * glsl::kVolumeNumbers * sizeof(Vec4);
    GLint64 largest = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &largest);
    if (bytes > std::size_t(largest))
        throw Error("volume", std::to_string(tree.records()) + " records need " + std::to_string(bytes >> 20) +
                                  " MB, this driver's buffers hold " + std::to_string(largest >> 20) +
                                  "; bake with a larger --error");
}

bool BakedVolume::stale(const LightScales& scales, double hour) const {
    return !weights_ || volume_.basis.weights(scales, hour) != *weights_;
}

void BakedVolume::set_light(const LightScales& scales, double hour) {
    if (!stale(scales, hour)) return;
    weights_ = volume_.basis.weights(scales, hour);
    light_.emplace(volume_, *weights_);
    batch_.reset();
    uploaded_ = false;
}

const VolumeBatch& BakedVolume::batch() {
    if (!batch_) batch_.emplace(*light_);
    return *batch_;
}

void BakedVolume::bind() {
    if (!grid_.get()) {
        const VolumeTree& tree = volume_.tree;
        grid_ = make_buffer(std::vector<glsl::VolumeGrid>{tree.grid()});
        nodes_ = storage(tree.nodes), cells_ = storage(tree.cells), cuts_ = storage(tree.cuts);
        records_ = storage(std::vector<Vec4>(tree.records() * glsl::kVolumeNumbers), GL_DYNAMIC_STORAGE_BIT);
    }
    if (!uploaded_ && light_)
        glNamedBufferSubData(records_.get(), 0, GLsizeiptr(light_->records().size() * sizeof(Vec4)),
                             light_->records().data());
    uploaded_ = light_.has_value();
    glBindBufferBase(GL_UNIFORM_BUFFER, 3, grid_.get());
    const GLuint buffers[] = {nodes_.get(), cells_.get(), cuts_.get(), records_.get()};
    for (GLuint i = 0; i < 4; ++i) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4 + i, buffers[i]);
}

}  // namespace daylit
