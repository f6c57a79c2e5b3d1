// SPDX-License-Identifier: Apache-2.0
// The commands. Each function adds one subcommand whose callback does the work and throws
// std::exception on failure.
#pragma once

#include <CLI/CLI.hpp>

namespace skyfit::cli {

void add_fit_command(CLI::App& app);
void add_report_command(CLI::App& app);
void add_campaign_command(CLI::App& app);
void add_sky_command(CLI::App& app);
void add_sky_map_command(CLI::App& app);
void add_export_command(CLI::App& app);
void add_import_command(CLI::App& app);
void add_completion_command(CLI::App& app);
void add_man_command(CLI::App& app);
void add_doctor_command(CLI::App& app);
void add_plot_command(CLI::App& app);
void add_render_command(CLI::App& app);
void add_view_command(CLI::App& app);
void add_tables_command(CLI::App& app);
void add_presets_command(CLI::App& app);
void add_parameters_command(CLI::App& app);
void add_references_command(CLI::App& app);
void add_check_command(CLI::App& app);
void add_classify_command(CLI::App& app);
void add_compare_command(CLI::App& app);

}  // namespace skyfit::cli
