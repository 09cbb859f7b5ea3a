#pragma once
// What the report measures: one list of measures, shared by tables, charts, CSV and JSON.
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace daylit {

/// How a measure is written for people.
enum class Unit { Share, Seconds, Bytes, Number };
/// e.g. 0.0312 -> "3.1 %", 0.0042 -> "4.2 ms", 1.2e6 -> "1.2 MB"; three digits at most.
std::string written(double value, Unit unit);

struct Measure {
    const char* key;    // in CSV and JSON, and in RunResult::values; SI units
    const char* label;  // heads a column
    Unit unit;
    bool glance;       // stands in the short table too
    const char* what;  // one line of explanation
};
std::span<const Measure> measures();

/// One picture of a run, judged against the reference's of the same view and hour.
struct PictureResult {
    std::string view;
    double hour = 0.0;
    std::map<std::string, double> values;  // nrmse, bias, flip_mean, flip_p95, yee_share
    std::string file, difference;          // PNG beside the page; empty: not kept
};

/// One setting of one method.
struct RunResult {
    std::string method, axis, name;
    std::map<std::string, double> values = {};  // by Measure::key; only what was measured
    std::vector<PictureResult> pictures = {};
    std::string note = {};     // what the bake says of itself
    std::string failure = {};  // why there are no values; empty: it went well
    std::optional<double> value(const std::string& key) const;
};

void to_json(nlohmann::json& json, const PictureResult& picture);
void from_json(const nlohmann::json& json, PictureResult& picture);
void to_json(nlohmann::json& json, const RunResult& run);
void from_json(const nlohmann::json& json, RunResult& run);

/// A head line and a line a run; empty cells for what was not measured.
std::string csv_text(std::span<const RunResult> runs);

}  // namespace daylit
