#include "demo/report/result.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace daylit {
namespace {

constexpr Measure kMeasures[] = {
    {"nrmse", "nrmse", Unit::Share, true, "RMS error at points over the mean of the reference, mean of the hours"},
    {"nrmse_worst", "worst hour", Unit::Share, true, "nrmse of the worst hour"},
    {"bias", "bias", Unit::Share, true, "mean over mean of the reference, less 1; mean of the hours"},
    {"gather_nrmse", "against the gather", Unit::Share, true,
     "nrmse against the gather itself at these points, with many rays: what storing and interpolating adds"},
    {"gather_p95", "95 % of them", Unit::Share, true,
     "95th percentile of the difference from the gather over its mean, mean of the hours: without the few worst "
     "places"},
    {"displayed_worst", "worst hour displayed", Unit::Share, false,
     "RMS of sRGB values of grey texels at the automatic exposure of the worst hour, against the uncompressed "
     "lightmap"},
    {"displayed_sunlit", "sun up", Unit::Share, false, "the same for the worst hour while the sun is up"},
    {"flip_mean", "FLIP", Unit::Number, true, "mean LDR-FLIP of the pictures, 67 pixels per degree"},
    {"flip_worst", "worst FLIP", Unit::Number, false, "mean LDR-FLIP of the worst picture"},
    {"yee_share", "Yee", Unit::Share, true, "pixels whose difference is visible by Yee 2004, of all pictures"},
    {"bake_seconds", "bake", Unit::Seconds, true, "wall time of the bake"},
    {"bake_processor_seconds", "processor", Unit::Seconds, false, "processor time of the bake, all threads"},
    {"peak_bytes", "peak memory", Unit::Bytes, false,
     "the most resident memory that the bake had beyond what was there before"},
    {"file_bytes", "file", Unit::Bytes, true, "size of the baked file"},
    {"look_up_seconds", "look-up", Unit::Seconds, true, "processor time of one look-up"},
    {"relight_seconds", "relight", Unit::Seconds, true, "what a moved hour adds to a frame"},
    {"frame_seconds", "frame", Unit::Seconds, true, "wall time of a frame of a still sun"},
    {"frame_processor_seconds", "frame processor", Unit::Seconds, false, "processor time of that frame, all threads"},
    {"answers", "answers", Unit::Number, false, "places times hours that the bake holds light for"},
    {"traced_alike_seconds", "traced alike", Unit::Seconds, true,
     "time to path-trace every one of the answers apart, at as many paths as give the same nrmse; from the measured "
     "rate"},
};

std::string digits(double value) {
    char text[64];
    std::snprintf(text, sizeof text, std::abs(value) >= 999.5 ? "%.0f" : "%.3g", value);
    return text;
}

std::string scaled(double value, std::initializer_list<std::pair<double, const char*>> units) {
    for (const auto& [size, unit] : units)
        if (std::abs(value) >= 0.9995 * size) return digits(value / size) + " " + unit;
    const auto& [size, unit] = *(units.end() - 1);
    return digits(value / size) + " " + unit;
}

/// Quoted where it has to be (RFC 4180).
std::string csv_cell(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}

}  // namespace

std::string written(double value, Unit unit) {
    if (!std::isfinite(value)) return "undefined";
    switch (unit) {
        case Unit::Share:
            return digits(100.0 * value) + " %";
        case Unit::Seconds:
            return scaled(
                value, {{86400, "days"}, {3600, "h"}, {60, "min"}, {1, "s"}, {1e-3, "ms"}, {1e-6, "µs"}, {1e-9, "ns"}});
        case Unit::Bytes:
            return scaled(value, {{1e9, "GB"}, {1e6, "MB"}, {1e3, "kB"}, {1, "B"}});
        case Unit::Number:
            break;
    }
    return std::abs(value) >= 1e4 ? scaled(value, {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}}) : digits(value);
}

std::span<const Measure> measures() {
    return kMeasures;
}

std::optional<double> RunResult::value(const std::string& key) const {
    const auto found = values.find(key);
    return found == values.end() ? std::nullopt : std::optional(found->second);
}

void to_json(nlohmann::json& json, const PictureResult& p) {
    json = {{"view", p.view}, {"hour", p.hour}, {"values", p.values}, {"file", p.file}, {"difference", p.difference}};
}

void from_json(const nlohmann::json& json, PictureResult& p) {
    json.at("view").get_to(p.view), json.at("hour").get_to(p.hour), json.at("values").get_to(p.values);
    json.at("file").get_to(p.file), json.at("difference").get_to(p.difference);
}

void to_json(nlohmann::json& json, const RunResult& r) {
    json = {{"method", r.method},     {"axis", r.axis}, {"name", r.name},      {"values", r.values},
            {"pictures", r.pictures}, {"note", r.note}, {"failure", r.failure}};
}

void from_json(const nlohmann::json& json, RunResult& r) {
    json.at("method").get_to(r.method), json.at("axis").get_to(r.axis), json.at("name").get_to(r.name);
    json.at("values").get_to(r.values), json.at("pictures").get_to(r.pictures);
    json.at("note").get_to(r.note), json.at("failure").get_to(r.failure);
}

std::string csv_text(std::span<const RunResult> runs) {
    std::string text = "method,axis,setting";
    for (const Measure& measure : kMeasures) text += std::string(",") + measure.key;
    text += ",failure\n";
    for (const RunResult& run : runs) {
        text += csv_cell(run.method) + "," + csv_cell(run.axis) + "," + csv_cell(run.name);
        for (const Measure& measure : kMeasures) {
            char number[64] = "";
            if (const auto value = run.value(measure.key)) std::snprintf(number, sizeof number, "%.9g", *value);
            text += std::string(",") + number;
        }
        text += "," + csv_cell(run.failure) + "\n";
    }
    return text;
}

}  // namespace daylit
