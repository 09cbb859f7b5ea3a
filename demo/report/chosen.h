#pragma once
// What a report is about.
#include "demo/report/methods.h"
#include "demo/report/study.h"

namespace daylit {

/// The path tracer is always compared with.
struct Chosen {
    std::vector<ReportMethod> methods;
    std::vector<ReportStudy> studies;

    bool wants(bool in_space) const;
};

/// names   "all", or a list of methods and studies
/// quick   few settings and small volumes
/// throws UsageError for a name that is not known.
Chosen chosen(const std::string& names, bool quick, const BakeSettings& base);

}  // namespace daylit
