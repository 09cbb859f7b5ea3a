// daylit day: the same view through the hours, as frames, as a contact sheet, or as a film.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "demo/commands.h"
#include "demo/contact_sheet.h"
#include "demo/movie.h"
#include "demo/output.h"
#include "demo/picture.h"
#include "demo/progress.h"
#include "engine/base/error.h"
#include "engine/base/file.h"

namespace daylit {
namespace {

struct DayOptions {
    PictureOptions picture;
    std::string output, from = "0", to = "24", every;
    double frames_per_second = 24.0;
    bool json = false;
};

enum class Target { Folder, Sheet, Film };

Target target_of(const std::string& output) {
    const std::string extension = std::filesystem::path(output).extension().string();
    if (extension == ".mp4") return Target::Film;
    if (extension == ".png") return Target::Sheet;
    if (!extension.empty() && !std::filesystem::is_directory(output)) {
        throw UsageError("-o", "'" + output + "' is neither a folder nor a .png (contact sheet) nor an .mp4");
    }
    return Target::Folder;
}

/// Like --hour, but a day also ends at 24.
double parse_end(const std::string& option, const std::string& text) {
    return text == "24" || text == "24:00" ? 24.0 : parse_hour(option, text);
}

/// Whole seconds, so that 10 minutes times 6 is an hour exactly.
std::vector<long> seconds_of_day(const DayOptions& options, Target target) {
    const auto seconds = [](double hours) { return std::lround(hours * 3600.0); };
    const long from = seconds(parse_hour("--from", options.from)), to = seconds(parse_end("--to", options.to));
    const std::string every = !options.every.empty() ? options.every : target == Target::Sheet ? "1h" : "10m";
    const long step = seconds(parse_duration_hours("--every", every));
    if (to < from) throw Error("--to", options.to + " lies before --from " + options.from);
    std::vector<long> times;
    for (long time = from; time <= to && time < 24 * 3600; time += step) times.push_back(time);
    return times;
}

std::string time_text(long seconds, const char* separator) {
    char text[32];
    const int minutes = int(seconds / 60 % 60);
    if (seconds % 60 == 0) {
        std::snprintf(text, sizeof text, "%02d%s%02d", int(seconds / 3600), separator, minutes);
    } else {
        std::snprintf(text, sizeof text, "%02d%s%02d%s%02d", int(seconds / 3600), separator, minutes, separator,
                      int(seconds % 60));
    }
    return text;
}

struct Frame {
    long seconds;
    Image shown;  // display-linear
    double ev;
};

/// Takes the day's pictures one after the other and hands each over.
void photograph(const DayOptions& options, const std::vector<long>& times, const std::function<void(const Frame&)>& use) {
    const Layer layer = parse_layer(options.picture.view.show);
    const double seconds = seconds_of(options.picture.view);
    Photographer photographer(options.picture);
    const Progress progress = make_progress("day");
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (!progress(double(i) / double(times.size()))) throw Interrupted();
        const Picture picture = photographer.take(double(times[i]) / 3600.0, seconds);
        use({times[i], displayed(picture, layer), picture.ev});
    }
    progress(1.0);
}

void make_folder(const std::filesystem::path& folder) {
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    if (problem || !std::filesystem::is_directory(folder)) {
        throw Error(folder.string(), "is no folder and cannot be made one; give another -o");
    }
}

nlohmann::ordered_json frame_json(const Frame& frame) {
    return {{"hour", double(frame.seconds) / 3600.0}, {"ev", frame.ev}};
}

nlohmann::ordered_json write_sheet(const DayOptions& options, const std::vector<long>& times) {
    const Size size = parse_size(options.picture.view.size);
    ContactSheet sheet(int(times.size()), size.width, size.height);
    nlohmann::ordered_json frames = nlohmann::ordered_json::array();
    photograph(options, times, [&](const Frame& frame) {
        sheet.add(frame.shown, time_text(frame.seconds, ":"));
        frames.push_back(frame_json(frame));
    });
    write_image(options.output, sheet.image());
    return frames;
}

nlohmann::ordered_json write_frames(const DayOptions& options, const std::vector<long>& times) {
    const std::filesystem::path folder = options.output;
    make_folder(folder);
    const Size size = parse_size(options.picture.view.size);
    ContactSheet sheet(int(times.size()), size.width, size.height);
    nlohmann::ordered_json frames = nlohmann::ordered_json::array();
    photograph(options, times, [&](const Frame& frame) {
        const std::filesystem::path file = folder / (time_text(frame.seconds, "h") + ".png");
        write_image(file, frame.shown);
        sheet.add(frame.shown, time_text(frame.seconds, ":"));
        frames.push_back(frame_json(frame));
        frames.back()["file"] = file.string();
    });
    write_image(folder / "sheet.png", sheet.image());
    return frames;
}

nlohmann::ordered_json write_film(const DayOptions& options, const std::vector<long>& times) {
    const std::filesystem::path ffmpeg = find_ffmpeg();
    const Size size = parse_size(options.picture.view.size);
    nlohmann::ordered_json frames = nlohmann::ordered_json::array();
    write_whole(options.output, [&](const std::filesystem::path& temporary) {
        Movie movie(ffmpeg, temporary, size.width, size.height, options.frames_per_second);
        photograph(options, times, [&](const Frame& frame) {
            movie.add(frame.shown);
            frames.push_back(frame_json(frame));
        });
        movie.finish();
    });
    return frames;
}

void show_day(const DayOptions& options) {
    check_range("--fps", options.frames_per_second, 0.1, 240);
    const Target target = target_of(options.output);
    if (target != Target::Folder) check_output(options.output, {".png", ".mp4"});
    const std::vector<long> times = seconds_of_day(options, target);
    const auto write = target == Target::Film ? write_film : target == Target::Sheet ? write_sheet : write_frames;
    const nlohmann::ordered_json frames = write(options, times);
    if (options.json) std::printf("%s\n", nlohmann::ordered_json{{"output", options.output}, {"frames", frames}}.dump(2).c_str());
}

}  // namespace

void add_day(CLI::App& app) {
    CLI::App* command = app.add_subcommand("day", "The same view through the hours: frames, a contact sheet or a film");
    const auto options = std::make_shared<DayOptions>();
    add_picture_options(*command, options->picture, false);
    command->add_option("-o,--output", options->output,
                        "a folder (06h30.png ... and sheet.png), a .png (contact sheet) or an .mp4 (by ffmpeg)")
        ->required();
    command->add_option("--from", options->from, "first hour, 4.5 or 04:30")->capture_default_str();
    command->add_option("--to", options->to, "last hour")->capture_default_str();
    command->add_option("--every", options->every, "10m, 1h, 30s; when not given 10m, for a contact sheet 1h");
    command->add_option("--fps", options->frames_per_second, "frames a second of a film")->capture_default_str();
    command->add_flag("--json", options->json, "hours, exposures and files on stdout");
    command->callback([options] { show_day(*options); });
}

}  // namespace daylit
