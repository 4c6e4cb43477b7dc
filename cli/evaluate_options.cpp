// SPDX-License-Identifier: MIT
#include "cli/evaluate_options.h"

#include <algorithm>
#include <string>
#include <vector>

#include "cli/options.h"

namespace sigs::cli {

void add_format_option(CLI::App& command, ResultsFormat& format) {
  const auto names = results_format_names();
  command
      .add_option_function<std::string>(
          "--format",
          [&format, names](const std::string& name) {
            format = static_cast<ResultsFormat>(std::find(names.begin(), names.end(), name) - names.begin());
          },
          "of the results: auto, otb, vot, mot, csv, aot or coco")
      ->option_text("NAME=auto")
      ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())));
}

void add_report_options(CLI::App& command, std::filesystem::path& folder, bool& force) {
  command.add_option("--out", folder, "folder to be made, with tables, plots and report.html")
      ->option_text("DIR")
      ->check(output_path());
  command.add_flag("--force", force, "replace an evaluation that is there");
}

}  // namespace sigs::cli
