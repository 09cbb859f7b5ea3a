#include <CLI/App.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

#include "content/content.h"
#include "demo/commands.h"
#include "engine/base/error.h"

namespace daylit {
namespace {

struct MakeOptions {
    std::string name, output;
    bool list = false;
};

void list_scenes() {
    std::size_t width = 0;
    for (const ContentScene& scene : content_scenes()) width = std::max(width, scene.name.size());
    for (const ContentScene& scene : content_scenes())
        std::printf("%-*s  %s\n", int(width), scene.name.c_str(), scene.purpose.c_str());
}

void make(const MakeOptions& options) {
    if (options.list && !(options.name.empty() && options.output.empty()))
        throw UsageError("--list", "goes alone; leave it out to make a scene");
    if (options.list) return list_scenes();
    if (options.name.empty()) throw UsageError("make", "give the NAME of a scene, or --list to see them");
    if (options.output.empty()) throw UsageError("make", "give -o FILE.glb, where to write the scene");
    if (std::filesystem::path(options.output).extension() != ".glb")
        throw UsageError("-o", "'" + options.output + "' does not end in .glb, the one format that make writes");
    make_scene(options.name, options.output);
}

}  // namespace

void add_make(CLI::App& app) {
    const auto options = std::make_shared<MakeOptions>();
    CLI::App* command = app.add_subcommand("make", "Write the demo level (koldinghus) or a proof scene");
    command->add_option("name", options->name, "Which scene; --list shows them");
    command->add_option("-o,--output", options->output, "The .glb to write");
    command->add_flag("--list", options->list, "List the scenes and what each is for");
    command->callback([options] { make(*options); });
}

}  // namespace daylit
