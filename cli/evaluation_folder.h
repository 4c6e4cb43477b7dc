// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <vector>

#include "base/result.h"
#include "base/staged_outputs.h"
#include "cli/output_files.h"
#include "evaluation/readers/results.h"
#include "evaluation/reports/report.h"

namespace sigs::cli {

// The folder of one evaluation: there whole, or not at all.
class EvaluationFolder {
 public:
  // Keeps the name for this run; none where no folder is named. A folder that is there must be empty or, with
  // overwrite, hold nothing but what an evaluation writes. inputs are read by this run and may not lie in it. Error
  // cannot_create.
  [[nodiscard]] static Result<std::optional<EvaluationFolder>> reserved(
      const std::filesystem::path& folder, bool overwrite, const std::vector<std::filesystem::path>& inputs);

  // Where its files are written to.
  [[nodiscard]] const std::filesystem::path& staging_path() const { return file_.temporary_path(); }

  // Writes results/NAME.csv, which --results takes again.
  [[nodiscard]] Result<void> write_results(const std::filesystem::path& name, const Results& results) const;

  // Gives it its name and prints the names of the files that were written to staging_path().
  [[nodiscard]] Result<void> commit(const Result<WrittenReport>& written);

 private:
  EvaluationFolder(std::filesystem::path shown, CreatedFolders folders, TemporaryFile file)
      : shown_(std::move(shown)), folders_(std::move(folders)), file_(std::move(file)) {}

  std::filesystem::path shown_;  // as the user calls it
  CreatedFolders folders_;       // those above it
  TemporaryFile file_;
};

// --format; --out and --force. What is added to must outlive the command.
void add_format_option(CLI::App& command, ResultsFormat& format);
void add_report_options(CLI::App& command, std::filesystem::path& folder, bool& force);

}  // namespace sigs::cli
