// Contexts that need a display: run by tests/with_display.
#include "tests/gl/context_suite.h"

namespace daylit::context_tests {
namespace {

INSTANTIATE_TEST_SUITE_P(Window, Contexts, testing::Values(ContextKind::Glfw), kind_name);

TEST(ContextMix, platforms_do_not_disturb_each_other_gl) {
    const auto egl = make_context(ContextKind::Egl);
    const auto osmesa = make_context(ContextKind::OsMesa);
    const auto glfw = make_context(ContextKind::Glfw);
    for (int round = 0; round < 2; ++round) {
        for (GlContext* context : {egl.get(), osmesa.get(), glfw.get(), osmesa.get()}) {
            context->make_current();
            const Rgb color(float(round), 0.25f, 2.0f);
            EXPECT_EQ(clear_and_read(color), color) << context->description();
        }
    }
}

}  // namespace
}  // namespace daylit::context_tests
