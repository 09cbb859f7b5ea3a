// daylit info FILE.daylit: every part with its bytes, its error estimate and why it is there; what was skipped and why.
#include "demo/info.h"

#include <CLI/App.hpp>
#include <array>
#include <cstdio>

#include "demo/commands.h"
#include "engine/baked/baked_file.h"

namespace daylit {
namespace {

const char* name_of(SunSource source) {
    switch (source) {
        case SunSource::Day:
            return "day";
        case SunSource::Scene:
            return "scene";
        case SunSource::None:
            return "none";
        case SunSource::Given:
            return "given";
    }
    return "";
}

const char* name_of(SkySource source) {
    switch (source) {
        case SkySource::Day:
            return "day";
        case SkySource::None:
            return "none";
        case SkySource::File:
            return "file";
        case SkySource::Constant:
            return "constant";
    }
    return "";
}

nlohmann::json describe_light(const Baked& baked) {
    const LightSettings& light = baked.light;
    char date[32];
    std::snprintf(date, sizeof date, "%04d-%02d-%02d", light.day.date.year, light.day.date.month, light.day.date.day);
    return {{"latitude", light.day.latitude},
            {"longitude", light.day.longitude},
            {"date", date},
            {"utc_offset", light.day.utc_offset},
            {"north", light.day.north},
            {"sun", name_of(light.sun)},
            {"sky", name_of(light.sky)},
            {"turbidity", light.turbidity},
            {"clouds", light.clouds},
            {"metres_per_unit", baked.unit},
            {"materials", baked.lambert ? "lambert" : "full"}};
}

nlohmann::json describe_volume(const IrradianceVolume& volume) {
    const VolumeTree& tree = volume.tree;
    const Bounds box = tree.bounds();
    return {{"cells", tree.cells.size()},
            {"walls", tree.cuts.size()},
            {"corners", tree.samples},
            {"hanging", tree.hanging.size()},
            {"components", volume.basis.components},
            {"hours", volume.basis.hours},
            {"min", {box.min.x, box.min.y, box.min.z}},
            {"max", {box.max.x, box.max.y, box.max.z}}};
}

nlohmann::json describe_lightmap(const DayLightmap& map) {
    std::array<std::size_t, DayLightmap::kMostPatterns + 1> tiles{};  // by their number of patterns
    for (std::uint8_t patterns : map.tile_patterns) ++tiles[patterns];
    return {{"width", map.width},
            {"height", map.height},
            {"components", map.slots()},
            {"tiles_by_components", tiles},
            {"basis_components", map.basis.components},
            {"hours", map.basis.hours},
            {"error", map.error}};
}

std::string text(const char* format, double a, double b) {
    char buffer[256];
    std::snprintf(buffer, sizeof buffer, format, a, b);
    return buffer;
}

std::string part_line(const nlohmann::json& part) {
    std::string line = part["done"].get<bool>() ? "  baked    " : "  skipped  ";
    line += part["part"].get<std::string>();
    line.resize(std::max<std::size_t>(line.size() + 1, 25), ' ');
    if (part["done"].get<bool>()) {
        line += text("%.2f MB, ", part["bytes"].get<double>() / 1e6, 0);
        if (!part["error"].is_null()) line += text("encoding error %.2g, ", part["error"].get<double>(), 0);
    }
    return line + part["why"].get<std::string>();
}

}  // namespace

nlohmann::json describe_baked(const std::filesystem::path& path) {
    const Baked baked = read_baked(path);
    nlohmann::json about = {
        {"file", path.string()}, {"bytes", std::filesystem::file_size(path)}, {"light", describe_light(baked)}};
    about["parts"] = nlohmann::json::array();
    for (const PlanItem& item : baked.plan) {
        nlohmann::json part = {
            {"part", item.part}, {"done", item.done}, {"why", item.why}, {"bytes", item.bytes}, {"error", nullptr}};
        if (item.error >= 0.0) part["error"] = item.error;
        about["parts"].push_back(part);
    }
    if (const auto& map = baked.lightmap) about["lightmap"] = describe_lightmap(*map);
    if (const auto& volume = baked.volume) about["volume"] = describe_volume(*volume);
    return about;
}

std::string summary(const nlohmann::json& about) {
    const nlohmann::json& light = about["light"];
    std::string lines = about["file"].get<std::string>() + text(": %.2f MB", about["bytes"].get<double>() / 1e6, 0);
    lines += ", " + light["date"].get<std::string>() +
             text(" at %.4f N %.4f E", light["latitude"].get<double>(), light["longitude"].get<double>()) + ", sun " +
             light["sun"].get<std::string>() + ", sky " + light["sky"].get<std::string>();
    if (about.contains("lightmap")) {
        const nlohmann::json& map = about["lightmap"];
        lines += text("\n  lightmap of %.0f x %.0f texels", map["width"].get<double>(), map["height"].get<double>());
    }
    for (const nlohmann::json& part : about["parts"]) lines += "\n" + part_line(part);
    if (about.contains("seconds")) lines += text("\n  in %.1f s", about["seconds"].get<double>(), 0);
    return lines;
}

void add_info(CLI::App& app) {
    CLI::App* command = app.add_subcommand("info", "what a baked file holds, and why");
    struct Options {
        std::string file;
        bool json = false;
    };
    const auto options = std::make_shared<Options>();
    command->add_option("FILE", options->file, "baked file, .daylit")->required();
    command->add_flag("--json", options->json, "everything as JSON on stdout");
    command->callback([options] {
        const nlohmann::json about = describe_baked(options->file);
        if (options->json)
            std::printf("%s\n", about.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
        else
            std::printf("%s\n", summary(about).c_str());
    });
}

}  // namespace daylit
