// SPDX-License-Identifier: Apache-2.0
// The subcommands: each declares its options and says what to run when it is chosen.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace surimi {

/// Runs a chosen subcommand and returns the exit code; throws Error.
using Run = std::function<int()>;

Run add_inspect_command(CLI::App& app);
Run add_unwrap_command(CLI::App& app);
Run add_bake_command(CLI::App& app);
Run add_preview_command(CLI::App& app);
Run add_compare_command(CLI::App& app);
Run add_study_command(CLI::App& app);
Run add_plan_command(CLI::App& app);
Run add_validate_command(CLI::App& app);
Run add_doctor_command(CLI::App& app);
Run add_completion_command(CLI::App& app);
Run add_ratio_command(CLI::App& app);
Run add_report_command(CLI::App& app);
Run add_export_command(CLI::App& app);

}  // namespace surimi
