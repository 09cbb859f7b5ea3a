#pragma once
// The report as one HTML page that needs no network: charts, tables, pictures beside their differences.
#include <string>
#include <vector>

#include "demo/report/result.h"

namespace daylit {

/// A sentence with the number that it is about.
struct Finding {
    std::string key;  // in JSON
    double value = 0.0;
    std::string text;
};

struct ReportedMethod {
    std::string name, about;
    bool in_space = false, in_pictures = false;
    double standard_error = 0.0;  // of the reference at this method's points
    std::vector<RunResult> runs;  // the first is the base
    std::vector<Finding> findings = {};
};

struct ReportedPicture {
    std::string view;
    double hour = 0.0;
    std::string reference;        // PNG
    double standard_error = 0.0;  // relative, of a pixel
};

struct Report {
    std::string scene, machine, driver;  // driver: empty without pictures
    std::string no_pictures;             // why there are none
    std::string settings;                // a sentence: points, paths, hours
    std::vector<ReportedMethod> methods;
    std::vector<RunResult> traced;  // the path tracer at surface points, at points in space and in pictures
    std::vector<ReportedPicture> pictures;
};

/// Well-formed XML as well as HTML.
std::string page(const Report& report);

}  // namespace daylit
