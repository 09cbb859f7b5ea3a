// The daylit command: reads the options, calls the library, prints one line when something is wrong.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "demo/commands.h"
#include "demo/progress.h"
#include "engine/base/error.h"

namespace {

constexpr int kFailure = 1, kWrongUsage = 2, kInterrupted = 130;

void add_commands(CLI::App& app) {
    daylit::add_make(app);
    daylit::add_check(app);
#ifdef DAYLIT_WITH_BAKER
    daylit::add_bake(app);
#endif
    daylit::add_info(app);
#ifdef DAYLIT_WITH_GL
    daylit::add_walk(app);
    daylit::add_shot(app);
    daylit::add_day(app);
#endif
#ifdef DAYLIT_WITH_BAKER
    daylit::add_reference(app);
    daylit::add_points(app);
    daylit::add_report(app);
#endif
    daylit::add_compare(app);
}

/// Empty text is no value of any option; without this it would count as the option left out.
void refuse_empty_values(CLI::App& app) {
    const auto problem = [](const std::string& text) {
        return std::string(text.empty() ? "is given empty; give a value or leave it out" : "");
    };
    for (CLI::App* command : app.get_subcommands({}))
        for (CLI::Option* option : command->get_options()) option->check(problem);
}

/// The word that stands where a command should, or none.
std::string unknown_command(const CLI::App& app) {
    const std::vector<std::string> rest = app.remaining();
    return app.get_subcommands().empty() && !rest.empty() ? rest.front() : "";
}

std::string unknown_command_line(const CLI::App& app, const std::string& word) {
    std::string names;
    for (const CLI::App* command : app.get_subcommands({})) names += (names.empty() ? "" : ", ") + command->get_name();
    return "'" + word + "' is no command; there are " + names;
}

int fail(int status, const char* message) {
    std::fprintf(stderr, "daylit: %s\n", message);
    return status;
}

bool processor_fits() {
#ifdef DAYLIT_NEEDS_AVX2
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
    return true;
#endif
}

int run(int argc, char** argv) {
    CLI::App app("daylit lights game levels through a whole day.", "daylit");
    app.require_subcommand(1);
    add_commands(app);
    refuse_empty_values(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp& help) {
        return app.exit(help);
    } catch (const CLI::CallForAllHelp& help) {
        return app.exit(help);
    } catch (const CLI::ParseError& error) {
        const std::string unknown = unknown_command(app);
        if (!unknown.empty()) return fail(kWrongUsage, unknown_command_line(app, unknown).c_str());
        return fail(kWrongUsage, (std::string(error.what()) + " (see daylit --help)").c_str());
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (!processor_fits())
        return fail(kFailure,
                    "this build needs a processor with AVX2; configure it with -DDAYLIT_BAKER_ARCH= for any other");
    try {
        return run(argc, argv);
    } catch (const daylit::UsageError& error) {
        return fail(kWrongUsage, error.what());
    } catch (const daylit::Error& error) {
        return fail(kFailure, error.what());
    } catch (const daylit::Stopped& stopped) {
        return fail(kInterrupted, stopped.what());
    } catch (const daylit::Interrupted&) {
        return fail(kInterrupted, "stopped; nothing was written");
    } catch (const std::bad_alloc&) {
        return fail(kFailure, "out of memory; try a smaller --size or a coarser --quality");
    } catch (const std::exception& error) {
        return fail(kFailure, error.what());
    }
}
