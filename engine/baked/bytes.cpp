#include "engine/baked/bytes.h"

namespace daylit {

void ByteWriter::append(const void* values, std::size_t bytes) {
    const auto* first = static_cast<const std::uint8_t*>(values);
    bytes_.insert(bytes_.end(), first, first + bytes);
}

}  // namespace daylit
