#include "demo/report/study.h"

#include "demo/report/lightmap_encodings.h"
#include "demo/report/seen_frames.h"
#include "demo/report/volume_modes.h"
#include "demo/report/whole_day.h"

namespace daylit {
namespace {

constexpr const char* kEncodings =
    "How one day's lightmaps are stored: as bakes do, in tiles of few patterns (at rising errors); by the scheme of "
    "Bahnsen et al. 2012, unweighted principal components over all texels; as frames in half floats, all of them or "
    "those that the paper's test of intervals keeps. Bytes are those of the light alone; worst hours are judged "
    "against the uncompressed lightmap.";
constexpr const char* kWholeDay =
    "What a whole day costs beside one hour: lightmaps with the same rays per texel, which are traced once for all "
    "hours.";
constexpr const char* kSeenFrames =
    "Whether a viewer can tell compressed lightmaps from uncompressed ones: the same frames drawn with both, as "
    "displayed at the uncompressed frame's automatic exposure, by Yee's metric at 67 pixels per degree.";
constexpr const char* kVolumeModes =
    "How an irradiance volume is kept and looked up: cells of one size or an octree; corners blended trilinearly, by "
    "Oat's extrapolation, by Annen's distances to the power -4, with half gradients or by Adini-Hermite, as the "
    "runtime does; two to four bands of spherical harmonics, two with a guessed third (ZH3). Octrees are refined and "
    "records fitted for each blend, from samples of eight times a bake's rays. Irradiance has no part of the fourth "
    "band, which costs bytes alone. Normals are even over the sphere.";

}  // namespace

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
    const auto with = [](const auto& study, const BakeSettings& settings) {
        return [study, settings](const Judges& judges, const Progress& progress) {
            return study(settings, judges, progress);
        };
    };
    return {{"encodings", kEncodings, false, with(compare_lightmap_encodings, day)},
            {"whole-day", kWholeDay, false, with(compare_whole_day, day)},
            {"seen-frames", kSeenFrames, false, with(compare_seen_frames, day)},
            {"volume-modes", kVolumeModes, true, with(compare_volume_modes, base)}};
}

}  // namespace daylit
