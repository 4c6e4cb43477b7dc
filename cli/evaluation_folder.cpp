// SPDX-License-Identifier: MIT
#include "cli/evaluation_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

#include "base/paths.h"
#include "base/text.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "evaluation/opencv_tracker.h"
#include "labels/label_files.h"

namespace sigs::cli {

namespace fs = std::filesystem;

namespace {

constexpr const char* kEvaluateFooter =
    "Examples:\n"
    "  sigs evaluate track projects/crossing/crossing.json --tracker csrt,kcf --out report\n"
    "  sigs evaluate track out/crossing.xml --results mine.txt --format otb\n"
    "  sigs evaluate detect out/crossing.xml --results found.csv\n"
    "  sigs evaluate performance datasets/mine --results found --out report --sensor sensor.json\n"
    "  sigs evaluate rig out/ring.rig.json --results found --out report\n"
    "\n"
    "sigs evaluate track --help, detect --help, performance --help and rig --help have the options of each.";

Error not_free(const fs::path& folder, const std::string& what) {
  return {folder.string(), what, ErrorKind::cannot_create};
}

bool is_csv(const fs::path& path) {
  std::error_code code;
  return path.extension() == ".csv" && fs::symlink_status(path, code).type() == fs::file_type::regular;
}

bool is_tracker(const fs::path& name) {
  return std::ranges::find(tracker_names(), name.string()) != tracker_names().end();
}

// Named after a tracker that ran, with nothing but a file for each clip, as evaluate track writes it of many.
bool is_results_folder(const fs::path& path) {
  std::error_code code;
  if (fs::symlink_status(path, code).type() != fs::file_type::directory || !is_tracker(path.filename())) return false;
  const Result<std::vector<fs::path>> files = folder_contents(path);
  return files && std::ranges::all_of(*files, is_csv);
}

// The first entry of the folder that no evaluation writes; empty: there is none.
Result<std::string> foreign_content_of(const fs::path& folder) {
  const Result<std::vector<fs::path>> paths = folder_contents(folder);
  if (!paths) return fail(paths.error());
  for (const fs::path& path : *paths) {
    const std::string name = path.filename().string();
    if (std::error_code code; is_report_file(name) && fs::is_regular_file(path, code)) continue;
    if (name != "results" || !is_folder(path)) return name;
    const Result<std::vector<fs::path>> results = folder_contents(path);
    if (!results) return fail(results.error());
    for (const fs::path& result : *results) {
      const bool is_result_file = is_csv(result) && is_tracker(result.stem());
      if (!is_result_file && !is_results_folder(result)) return "results/" + result.filename().string();
    }
  }
  return std::string();
}

Result<void> check_free(const fs::path& shown, const fs::path& place, bool overwrite) {
  std::error_code code;
  if (!fs::exists(place, code)) return {};
  if (!fs::is_directory(place, code)) return fail(not_free(shown, "is a file; a folder is to be written"));
  if (fs::equivalent(place, fs::current_path(code), code))
    return fail(not_free(shown, "is the current folder; name one that is to be made"));
  if (fs::is_empty(place, code)) return {};
  if (!overwrite) return fail(not_free(shown, "exists already; --force overwrites it"));
  const Result<std::string> foreign = foreign_content_of(place);
  if (!foreign) return fail(foreign.error());
  if (!foreign->empty())
    return fail(not_free(shown, fmt::format("holds {}, which no evaluation wrote; choose another folder", *foreign)));
  return {};
}

}  // namespace

Result<std::optional<EvaluationFolder>> EvaluationFolder::reserved(const fs::path& folder, bool overwrite,
                                                                   const std::vector<fs::path>& inputs) {
  if (folder.empty()) return std::nullopt;
  const fs::path place = canonical_path(folder);
  if (const Result<void> kept = check_inputs_not_overwritten(std::vector{folder}, inputs); !kept)
    return fail(kept.error());
  if (const Result<void> free = check_free(folder, place, overwrite); !free) return fail(free.error());
  CreatedFolders above;
  if (const Result<void> made = above.make(place.parent_path()); !made) return fail(made.error());
  Result<TemporaryFile> file = TemporaryFile::create_folder(
      place, true, [overwrite](const fs::path& there) { return check_free(there, there, overwrite); });
  if (!file) return fail(file.error());
  return std::optional(EvaluationFolder(folder, std::move(above), std::move(*file)));
}

Result<void> EvaluationFolder::write_results(const fs::path& name, const Results& results) const {
  const fs::path file = (staging_path() / "results" / name).concat(".csv");
  if (const Result<void> made = make_inner_folder(file.parent_path()); !made) return made;
  return write_text(file, csv_text(results), true);
}

Result<void> EvaluationFolder::commit(const Result<WrittenReport>& written) {
  if (!written) return fail(written.error());
  std::vector<fs::path> final_paths;
  for (const fs::path& path : written->files) final_paths.push_back(shown_ / path.lexically_relative(staging_path()));
  if (const Result<void> kept = file_.commit(); !kept) return fail(kept.error());
  print_written(final_paths);
  return {};
}

void add_format_option(CLI::App& command, ResultsFormat& format) {
  const auto names = results_format_names();
  command
      .add_option_function<std::string>(
          "--format",
          [&format, names](const std::string& name) {
            format = static_cast<ResultsFormat>(std::find(names.begin(), names.end(), name) - names.begin());
          },
          "of the results: " + listed(names))
      ->option_text("NAME=auto")
      ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())));
}

Command add_evaluate_command(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("evaluate", "measure trackers and detectors against the truth");
  command->footer(kEvaluateFooter);
  return add_below(*command, {add_evaluate_track, add_evaluate_detect, add_evaluate_performance, add_evaluate_rig});
}

void add_report_options(CLI::App& command, std::filesystem::path& folder, bool& force) {
  add_output(command, "--out", folder, "folder to be made, with tables, plots and report.html", "DIR");
  command.add_flag("--force", force, "replace an evaluation that is there");
}

}  // namespace sigs::cli
