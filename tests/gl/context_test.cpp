// Contexts without a display, their mixture, and what is said when there is none.
#include <cstdlib>

#include "engine/base/error.h"
#include "tests/gl/context_suite.h"

namespace daylit::context_tests {
namespace {

INSTANTIATE_TEST_SUITE_P(Offscreen, Contexts, testing::Values(ContextKind::Egl, ContextKind::OsMesa), kind_name);

TEST(ContextMix, platforms_do_not_disturb_each_other_gl) {
    const auto egl = make_context(ContextKind::Egl);
    const auto osmesa = make_context(ContextKind::OsMesa);
    for (int round = 0; round < 2; ++round) {
        for (GlContext* context : {egl.get(), osmesa.get()}) {
            context->make_current();
            const Rgb color(float(round), 0.25f, 2.0f);
            EXPECT_EQ(clear_and_read(color), color) << context->description();
        }
    }
}

TEST(ContextMix, any_context_is_found_gl) {
    const auto context = make_any_context();
    EXPECT_EQ(clear_and_read(Rgb(3.0f)), Rgb(3.0f));
}

TEST(ContextMix, host_loads_through_its_own_loader_gl) {
    const auto context = make_context(ContextKind::Egl);
    int asked = 0;
    EXPECT_THROW(load_gl([&](const char*) -> void* {
                     ++asked;
                     return nullptr;
                 }),
                 Error);
    EXPECT_GT(asked, 0);
    context->make_current();  // back to the working functions
    EXPECT_EQ(clear_and_read(Rgb(1.0f)), Rgb(1.0f));
}

TEST(ContextErrors, no_display_is_one_clear_line_gl) {
    const char* display = std::getenv("DISPLAY");
    const std::string kept = display ? display : "";
    ::setenv("DISPLAY", ":987654", 1);
    std::string line;
    try {
        make_context(ContextKind::Glfw);
    } catch (const Error& error) {
        line = error.what();
    }
    display ? ::setenv("DISPLAY", kept.c_str(), 1) : ::unsetenv("DISPLAY");
    EXPECT_NE(line.find("no display"), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos);
}

TEST(ContextErrors, names_gl) {
    EXPECT_EQ(parse_context_kind("osmesa"), ContextKind::OsMesa);
    EXPECT_THROW(parse_context_kind("vulkan"), UsageError);
}

}  // namespace
}  // namespace daylit::context_tests
