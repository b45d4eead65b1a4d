// SPDX-License-Identifier: Apache-2.0
// The files of a bake -> one self-contained page that shows and judges it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace surimi {

struct ReportRequest {
    std::filesystem::path bake;                     ///< folder of a bake, or its manifest
    std::filesystem::path out;                      ///< empty: NAME.report.html beside the manifest
    std::filesystem::path study;                    ///< of `surimi study --json`; empty: NAME.study.json or study.json
                                                    ///< beside the manifest, where there is one
    std::vector<std::filesystem::path> references;  ///< a map or lightmaps for each page; empty: no comparison
};

/// The page, HTML that opens from disk: no file, server or network is needed to see it. Depends on the files alone.
/// What is missing or was changed since the bake is said in it. Throws Error(scene) for files that cannot be read and
/// Error(usage) for references that do not fit.
std::string make_report(const ReportRequest& request);

/// Writes the page and returns its path. Throws what make_report throws, and Error(cannot_write).
std::filesystem::path write_report(const ReportRequest& request);

}  // namespace surimi
