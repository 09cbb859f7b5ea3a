#pragma once
// What the methods are judged by: path-traced light at points and in pictures, with its own standard error.
#include <string>
#include <vector>

#include "demo/report/finished.h"
#include "demo/report/result.h"
#include "demo/traced_scene.h"
#include "engine/base/compare.h"

namespace daylit {

/// A scene at rest, to be lit at several hours.
struct LevelAtRest {
    explicit LevelAtRest(const SceneOptions& options);
    LevelAtRest(const LevelAtRest&) = delete;
    LoadedScene loaded;
    Pose pose;
    WorldMesh mesh;
    RayScene rays;
    std::vector<PlacedLight> lamps;
    LightModel light;
    std::vector<Lighting> at(const std::vector<double>& hours) const;
};

/// Indirect irradiance at points at several hours, lux.
using LightAtPoints = std::vector<std::vector<Rgb>>;  // [hour][point]
struct PointTruth {
    std::vector<SurfaceSample> points;
    std::vector<double> hours;
    LightAtPoints light;
    double standard_error = 0.0;  // nrmse that a perfect answer would still show: RMS over mean, mean of the hours
};

/// Four independent estimates of spp / 4 paths each; their mean is the truth, their spread its error.
PointTruth trace_points(const LevelAtRest& level, std::vector<SurfaceSample> points, const std::vector<double>& hours,
                        int spp, const Progress& progress);
/// One estimate of a given number of paths; lighting is that of the truth's hours.
LightAtPoints trace_once(const LevelAtRest& level, const PointTruth& at, const std::vector<Lighting>& lighting, int spp,
                         std::uint64_t seed, const Progress& progress);

/// nrmse, nrmse_worst and bias over the hours at which there is light; by key of measures().
std::map<std::string, double> judge(const LightAtPoints& found, const PointTruth& truth);

struct ViewAt {
    std::string view;
    View camera;
    double hour = 0.0;
};
struct PictureTruth {
    ViewAt at;
    Image radiance;               // cd/m^2
    double ev = 0.0;              // both sides are displayed by it
    double standard_error = 0.0;  // RMS over pixels over the picture's mean
};
PictureTruth trace_picture(const LevelAtRest& level, const ViewAt& at, Size size, int spp, const Progress& progress);

/// A picture as displayed at the truth's exposure, its FLIP map and their measures.
struct JudgedPicture {
    PictureResult result;
    Image shown;
    std::vector<float> flip;
};
JudgedPicture judge(const Image& radiance, const PictureTruth& truth);

void to_json(nlohmann::json& json, const PointTruth& truth);
void from_json(const nlohmann::json& json, PointTruth& truth);

}  // namespace daylit
