#pragma once
// Comparisons for which one solution serves many settings: how it is stored, how it is looked up.
#include "demo/report/page.h"
#include "demo/report/sweep_runner.h"

namespace daylit {

struct StudyResult {
    std::vector<RunResult> runs;  // the first is what bakes do
    std::vector<Finding> findings;
};
void to_json(nlohmann::json& json, const Finding& finding);
void from_json(const nlohmann::json& json, Finding& finding);
void to_json(nlohmann::json& json, const StudyResult& study);
void from_json(const nlohmann::json& json, StudyResult& study);

struct ReportStudy {
    std::string name, about;
    bool in_space = false;  // judged at points in free space instead of on surfaces
    std::function<StudyResult(const Judges& judges, const Progress& progress)> run;
};

/// In the order of the page.
/// base   of the report's bakes
/// day    the same for studies of the whole day
std::vector<ReportStudy> report_studies(const BakeSettings& base, const BakeSettings& day);

}  // namespace daylit
