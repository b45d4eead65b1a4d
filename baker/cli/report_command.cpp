// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

#include "baker/cli/commands.h"
#include "baker/report/report.h"

namespace surimi {

Run add_report_command(CLI::App& app) {
    const auto request = std::make_shared<ReportRequest>();
    CLI::App* command = app.add_subcommand("report", "A page that shows and judges a bake; opens in any browser");
    command->add_option("bake", request->bake, "Folder of a bake, or its NAME.visibility.json")
        ->required()
        ->type_name("BAKE");
    command->add_option("-o,--output", request->out, "Page to write [NAME.report.html beside the bake]")
        ->type_name("FILE");
    command
        ->add_option("--study", request->study,
                     "Result of surimi study --json, to plot [NAME.study.json or study.json beside the bake, if there]")
        ->type_name("FILE");
    command
        ->add_option(
            "--reference", request->references,
            "Map or lightmaps (EXR) of a more accurate bake with the same UVs, to compare with; repeatable, in "
            "order, if there are several maps")
        ->type_name("FILE")
        ->allow_extra_args(false);
    return [request] {
        fmt::print("{}\n", write_report(*request).string());
        return 0;
    };
}

}  // namespace surimi
