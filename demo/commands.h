#pragma once
// One function a subcommand: adds it to the app; its callback does the work and throws Error on failure.

namespace CLI {
class App;
}

namespace daylit {

void add_make(CLI::App& app);
void add_check(CLI::App& app);
void add_compare(CLI::App& app);
#ifdef DAYLIT_WITH_BAKER
void add_bake(CLI::App& app);
void add_reference(CLI::App& app);
void add_points(CLI::App& app);
void add_report(CLI::App& app);
#endif
void add_info(CLI::App& app);
#ifdef DAYLIT_WITH_GL
void add_shot(CLI::App& app);
void add_day(CLI::App& app);
void add_walk(CLI::App& app);
#endif

}  // namespace daylit
