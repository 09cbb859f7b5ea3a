#include "engine/baked/day_basis_bytes.h"

namespace daylit {

void code_curves(const DayBasis& basis, ByteWriter& w) {
    w.put_all(basis.hours);
    w.put_all(basis.curves);
}

void decode_curves(ByteReader& r, std::size_t keyframes, DayBasis& basis) {
    basis.hours = r.get_all<double>(keyframes);
    for (std::size_t i = 0; i < keyframes; ++i) {
        const double hour = basis.hours[i];
        if (!(hour >= 0.0 && hour <= 24.0) || (i > 0 && hour <= basis.hours[i - 1]))
            r.fail("has hours that do not ascend from 0 to 24");
    }
    basis.curves = r.get_all<float>(std::size_t(basis.components) * keyframes);
    for (float weight : basis.curves)
        if (!std::isfinite(weight)) r.fail("holds a weight that is not finite");
}

std::vector<std::uint16_t> finite_halves(ByteReader& r, std::size_t count, const char* what) {
    std::vector<std::uint16_t> halves = r.get_all<std::uint16_t>(count);
    for (std::uint16_t half : halves)
        if ((half & 0x7C00u) == 0x7C00u) r.fail(std::string("holds a ") + what + " that is not finite");
    r.expect_end();
    return halves;
}

}  // namespace daylit
