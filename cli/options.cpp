// SPDX-License-Identifier: MIT
#include "cli/options.h"

#include <charconv>
#include <cstdio>
#include <optional>

#include "project/json.h"
#include "project/set_field.h"

namespace sigs::cli {

namespace {

std::optional<int> whole_number(std::string_view text) {
  int number = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || code != std::errc() || end != text.data() + text.size() || number < 0) return std::nullopt;
  return number;
}

}  // namespace

void add_project_options(CLI::App& command, ProjectOptions& options) {
  command.add_option("PROJECT", options.file, "the project file")->required();
  add_set_option(command, options);
}

void add_set_option(CLI::App& command, ProjectOptions& options) {
  command
      .add_option("--set", options.settings,
                  "change a setting of the project for this once: --set camera.speed_mps=30; may be repeated")
      ->option_text("KEY=VALUE ...")
      ->allow_extra_args(false);
}

Result<Project> project_of(const ProjectOptions& options) {
  Result<ReadProject> read = read_project(options.file);
  if (!read) return fail(read.error());
  for (const Warning& warning : read->warnings) print_warning(warning);
  if (const Result<void> set = set_all(read->project, options.settings); !set) return fail(set.error());
  return std::move(read->project);
}

Result<void> set_all(Project& project, const std::vector<std::string>& assignments) {
  for (const std::string& assignment : assignments)
    if (const Result<void> set = set_field(project, assignment); !set) return set;
  return {};
}

Result<void> set_given(Project& project, const GivenSettings& settings) {
  for (const auto& [key, value] : settings)
    if (!value.empty())
      if (const Result<void> set = set_field(project, key + "=" + value); !set)
        return fail(key + ": " + value, set.error().what, ErrorKind::usage);
  return {};
}

void add_progress_option(CLI::App& command, std::string& style) {
  command.add_option("--progress", style, "auto, plain, json or none")
      ->option_text("STYLE")
      ->check(CLI::IsMember({"auto", "plain", "json", "none"}));
}

Result<FrameRange> frame_range_of(const std::string& text) {
  const std::size_t dash = text.find('-');
  const std::optional<int> first = whole_number(std::string_view(text).substr(0, dash));
  const std::optional<int> last =
      dash == std::string::npos ? first : whole_number(std::string_view(text).substr(dash + 1));
  if (!first || !last || *last < *first)
    return fail("--frames " + text, "expected A-B with A not after B, as in 0-99", ErrorKind::usage);
  return FrameRange{*first, *last};
}

void print_warning(const Warning& warning) {
  std::fprintf(stderr, "warning: %s\n", warning.text().c_str());
}

void print_error(const Error& error) {
  std::fprintf(stderr, "error: %s\n", error.text().c_str());
}

}  // namespace sigs::cli
