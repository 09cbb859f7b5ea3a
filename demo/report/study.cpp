#include "demo/report/study.h"

#include "demo/report/lightmap_encodings.h"
#include "demo/report/volume_modes.h"
#include "demo/report/whole_day.h"

namespace daylit {

void to_json(nlohmann::json& json, const Finding& finding) {
    json = {{"key", finding.key}, {"value", finding.value}, {"text", finding.text}};
}

void from_json(const nlohmann::json& json, Finding& finding) {
    json.at("key").get_to(finding.key), json.at("value").get_to(finding.value), json.at("text").get_to(finding.text);
}

void to_json(nlohmann::json& json, const StudyResult& study) {
    json = {{"runs", study.runs}, {"findings", study.findings}};
}

void from_json(const nlohmann::json& json, StudyResult& study) {
    json.at("runs").get_to(study.runs), json.at("findings").get_to(study.findings);
}

std::vector<ReportStudy> report_studies(const BakeSettings& base, const BakeSettings& day) {
    std::vector<ReportStudy> studies;
    studies.push_back(
        {"encodings",
         "How one day's lightmaps are stored: as bakes do, in tiles of few patterns (at rising errors); by "
         "the scheme of Bahnsen et al. 2012, unweighted principal components over all texels; as frames in "
         "half floats, all of them or those that the paper's test of intervals keeps. Bytes are those of "
         "the light alone; worst hours are judged against the uncompressed lightmap.",
         false, [day](const Judges& judges, const Progress& progress) {
             return compare_lightmap_encodings(day, judges, progress);
         }});
    studies.push_back(
        {"whole-day",
         "What a whole day costs beside one hour: lightmaps with the same rays per texel, which are traced "
         "once for all hours.",
         false,
         [day](const Judges& judges, const Progress& progress) { return compare_whole_day(day, judges, progress); }});
    studies.push_back(
        {"volume-modes",
         "How an irradiance volume is kept and looked up: cells of one size or an octree; corners blended "
         "trilinearly, by Oat's extrapolation, by Annen's distances, with half gradients or by "
         "Adini-Hermite, as the runtime does; two to four bands of spherical harmonics. Octrees are refined "
         "and records fitted for each blend. Normals are even over the sphere.",
         true, [base](const Judges& judges, const Progress& progress) {
             return compare_volume_modes(base, judges, progress);
         }});
    return studies;
}

}  // namespace daylit
