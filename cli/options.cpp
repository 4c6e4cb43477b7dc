// SPDX-License-Identifier: MIT
#include "cli/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

#include "base/ensure.h"
#include "base/input_file.h"
#include "base/json.h"
#include "base/paths.h"
#include "base/text.h"
#include "project/fields.h"
#include "project/json.h"
#include "project/project.h"

namespace sigs::cli {

namespace {

std::optional<int> whole_number(std::string_view text) {
  const std::optional<int> number = parsed_number<int>(text);
  return number && *number >= 0 ? number : std::nullopt;
}

Field field_of(Project& project, const std::string& key) {
  const std::vector<Field> fields = fields_of(project);
  const auto field = std::ranges::find(fields, key, &Field::key);
  ENSURE(field != fields.end());
  return *field;
}

std::string whole_text(double number) {
  return std::to_string(static_cast<int64_t>(number));
}

std::string default_of(const char* key) {
  Project project;
  const Field field = field_of(project, key);
  if (const auto* const choice = std::get_if<Choice>(&field.value))
    return std::string(choice->names[static_cast<std::size_t>(choice->get())]);
  return std::to_string(*std::get<int*>(field.value));
}

std::string choice_error(const Choice& choice, const std::string& text) {
  std::string names;
  for (const std::string_view name : choice.names) {
    if (name == text) return "";
    names += (names.empty() ? "" : " or ") + std::string(name);
  }
  return fmt::format("is {}, must be {}", text, names);
}

std::string number_error(const Field& field, const std::string& text) {
  int64_t number = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_negative = text.starts_with('-');
  if (end != text.data() + text.size() || code == std::errc::invalid_argument)
    return fmt::format("is {}, must be a whole number", text);
  const bool is_too_long = code == std::errc::result_out_of_range;
  const auto value = static_cast<double>(number);
  if (is_too_long ? is_negative : value < field.minimum)
    return fmt::format("is {}, must be {} or more", text, whole_text(field.minimum));
  if (is_too_long || value > field.maximum)
    return fmt::format("is {}, must be {} or less", text, whole_text(field.maximum));
  return "";
}

// A term in the engine's messages, and the option that sets it here.
constexpr std::pair<std::string_view, std::string_view> kOptionTexts[] = {
    {"exists already; overwriting was not asked for", "exists already; --force overwrites it"},
    {"choose another folder for the dataset", "choose another --out"},
    {"resuming goes on", "--resume goes on"},
    {"resuming makes them", "--resume makes them"},
    {"merging makes the index", "--merge makes the index"},
    {"made from other settings, inputs", "made from other settings (recipe or --set), inputs"},
    {"or raise the limit: footage.", "or raise the limit: --set footage."}};

std::string with_options(std::string text) {
  for (const auto& [engine_text, option_text] : kOptionTexts)
    if (const std::size_t place = text.find(engine_text); place != std::string::npos)
      text.replace(place, engine_text.size(), option_text);
  return text;
}

// Empty: the value is valid for the setting.
std::string value_error(const std::string& key, const std::string& text) {
  if (text.empty()) return "is empty";
  Project project;
  const Field field = field_of(project, key);
  if (const auto* const choice = std::get_if<Choice>(&field.value)) return choice_error(*choice, text);
  return number_error(field, text);
}

// Whether a text is meant to be a project, be it broken: an object with a member that projects or recipes have, or,
// where it is not JSON, one that begins as projects do.
bool is_meant_as_project(const std::string& text) {
  constexpr const char* kSpace = " \t\r\n";
  const std::string_view begin = without_bom(text);
  const std::size_t brace = begin.find_first_not_of(kSpace);
  if (brace == std::string_view::npos || begin[brace] != '{') return false;
  if (const Result<Json> json = parsed_json(text, "", ErrorKind::bad_project)) {
    const auto has = [&](const char* key) { return json->contains(key); };
    return has("sigs") || has("sigs_dataset") || has("footage") || has("intruders");
  }
  const std::size_t key = begin.find_first_not_of(kSpace, brace + 1);
  return key != std::string_view::npos && begin.substr(key).starts_with("\"sigs\"");
}

}  // namespace

bool is_project_file(const std::filesystem::path& file) {
  return lower_extension(file) == ".json";
}

void add_project_options(CLI::App& command, ProjectOptions& options) {
  command.add_option("PROJECT", options.file, "the project file")->required();
  add_camera_option(command, options.camera);
  add_set_option(command, options);
}

void add_camera_option(CLI::App& command, std::string& camera) {
  add_value(command, "--camera", camera, "NAME", "of a project with several cameras: which one");
}

void add_set_option(CLI::App& command, ProjectOptions& options) {
  add_value(command, "--set", options.settings, "KEY=VALUE ...",
            "change a setting of the project for this once: --set camera.speed_mps=30; may be repeated")
      ->allow_extra_args(false);
}

Result<Project> whole_project_of(const ProjectOptions& options) {
  Result<ReadProject> read = read_project(options.file);
  if (!read) return fail(read.error());
  for (const Warning& warning : read->warnings) print_warning(warning);
  if (const Result<void> set = set_all(read->project, options.settings); !set) return fail(set.error());
  if (!options.camera.empty())
    if (const Result<std::size_t> camera = camera_of_option(read->project, options.camera); !camera)
      return fail(camera.error());
  return std::move(read->project);
}

Result<Project> project_of(const ProjectOptions& options) {
  Result<Project> project = whole_project_of(options);
  if (!project || project->cameras.empty()) return project;
  if (options.camera.empty()) {
    std::fprintf(stderr, "note: camera \"%s\", the first of %zu; --camera chooses\n",
                 project->cameras.front().name.c_str(), project->cameras.size());
    return seen_by(*project, 0);
  }
  const Result<std::size_t> camera = camera_of_option(*project, options.camera);
  return camera ? seen_by(*project, *camera) : Result<Project>(fail(camera.error()));
}

Result<Project> first_camera_of(Result<ReadProject> read) {
  if (!read) return fail(read.error());
  for (const Warning& warning : read->warnings) print_warning(warning);
  return read->project.cameras.empty() ? std::move(read->project) : seen_by(read->project, 0);
}

Result<std::optional<Project>> project_in(const std::filesystem::path& file) {
  const Result<std::string> text = read_text(file, kProjectLimit_bytes);
  if (!text || !is_meant_as_project(*text)) return std::nullopt;
  Result<Project> project = first_camera_of(parse_project(*text, file));
  if (!project) return fail(project.error());
  return std::move(*project);
}

Result<std::size_t> camera_of_option(const Project& project, const std::string& name) {
  Result<std::size_t> camera = camera_named(project, name);
  if (!camera) return fail("--" + camera.error().where, camera.error().what, camera.error().kind);
  return camera;
}

Result<void> rewrite_project(const Project& changed, const std::filesystem::path& file) {
  if (!changed.rig_view) return write_project(changed, file, true);
  const Result<ReadProject> whole = read_project(file);
  return whole ? write_project(put_back(whole->project, changed), file, true) : fail(whole.error());
}

Result<void> set_all(Project& project, const std::vector<std::string>& assignments) {
  for (const std::string& assignment : assignments)
    if (const Result<void> set = set_field(project, assignment); !set)
      return fail("--set " + set.error().where, set.error().what, set.error().kind);
  return {};
}

Result<void> set_option_settings(Project& project, const OptionSettings& settings) {
  for (const auto& [key, value] : settings)
    if (!value.empty())
      if (const Result<void> set = set_field(project, key + "=" + value); !set)
        return fail(key + ": " + value, set.error().what, ErrorKind::usage);
  return {};
}

void add_setting_option(CLI::App& command, const SettingOption& option, OptionSettings& settings) {
  const std::string key = option.key;
  command.add_option(option.name, settings[key], option.help)
      ->type_name(option.value)
      ->default_str(default_of(option.key))
      ->check(CLI::Validator([key](const std::string& text) { return value_error(key, text); }, ""));
}

CLI::Validator not_empty() {
  return {[](const std::string& text) { return std::string(text.empty() ? "is empty" : ""); }, ""};
}

CLI::Validator output_path() {
  return {[](const std::string& text) -> std::string {
            if (text.empty()) return "is empty";
            return text == "-" ? "would be standard output, which is not written to; name a file or folder "
                                 "(./- for one of that name)"
                               : "";
          },
          ""};
}

CLI::Option* add_output(CLI::App& command, const char* name, std::filesystem::path& path, const char* help,
                        const char* value) {
  return add_value(command, name, path, value, help)->check(output_path());
}

CLI::Option* add_subject(CLI::App& command, const char* name, std::filesystem::path& path, const char* help) {
  return command.add_option(name, path, help)->required()->check(not_empty());
}

std::optional<std::vector<double>> numbers_of(const std::string& text, std::size_t count) {
  std::vector<double> numbers;
  for (const std::string_view field : csv_fields(text)) {
    const std::optional<double> number = finite_number(field);
    if (!number || std::abs(*number) >= 1e6) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers.size() == count ? std::optional(numbers) : std::nullopt;
}

std::optional<std::pair<int, int>> fraction_of(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) return std::nullopt;
  const std::optional<int> part = parsed_number<int>(text.substr(0, slash));
  const std::optional<int> whole = parsed_number<int>(text.substr(slash + 1));
  return part && whole ? std::optional(std::pair(*part, *whole)) : std::nullopt;
}

Result<Box> box_of_option(const std::string& option, const std::string& text) {
  const auto numbers = numbers_of(text, 4);
  if (!numbers || (*numbers)[2] <= 0 || (*numbers)[3] <= 0)
    return fail(option + " " + text, "expected X,Y,W,H in pixels, with width and height above 0", ErrorKind::usage);
  return Box{(*numbers)[0] - 0.5, (*numbers)[1] - 0.5, (*numbers)[2], (*numbers)[3]};
}

CLI::Validator from_to(double low, double high) {
  const auto wrong = [low, high](const std::string& text) -> std::string {
    double number = 0;
    const bool is_number = CLI::detail::lexical_cast(text, number);
    if (is_number && number >= low && number <= high) return {};
    return fmt::format("must lie between {} and {}, not {}", number_text(low, 3), number_text(high, 3), text);
  };
  return {wrong, ""};
}

void add_timing_options(CLI::App& command, SequenceTiming& timing) {
  CLI::Option* const rate = add_range(command, "--frame-rate", timing.frame_rate_hz, "HZ", 0.001, 1e6,
                                      "frames a second of images, which do not state it");
  add_input(command, "--timestamps", timing.times_file, "of images: a file with the time of each")->excludes(rate);
}

int jobs_of_option(int jobs) {
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  return jobs > 0 ? jobs : std::max(1, cores - 1);
}

std::string path_beside(const std::filesystem::path& file, const std::filesystem::path& project) {
  const std::filesystem::path relative =
      canonical_name(file).lexically_relative(canonical_path(std::filesystem::absolute(project).parent_path()));
  return relative.empty() ? canonical_name(file).string() : relative.generic_string();
}

void add_progress_option(CLI::App& command, std::string& style) {
  add_value(command, "--progress", style, "STYLE", "auto, plain, json or none")
      ->check(CLI::IsMember({"auto", "plain", "json", "none"}));
}

Result<std::optional<FrameRange>> frame_range_of(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::size_t dash = text.find('-');
  const std::optional<int> first = whole_number(std::string_view(text).substr(0, dash));
  const std::optional<int> last =
      dash == std::string::npos ? first : whole_number(std::string_view(text).substr(dash + 1));
  if (!first || !last || *last < *first)
    return fail("--frames " + text, "expected A-B with A not after B, as in 0-99", ErrorKind::usage);
  return FrameRange{*first, *last};
}

void print_warning(const Warning& warning) {
  std::fprintf(stderr, "warning: %s\n", Warning{warning.where, with_options(warning.what)}.text().c_str());
}

void print_error(const Error& error) {
  std::fprintf(stderr, "error: %s\n", Error{error.where, with_options(error.what), error.kind}.text().c_str());
}

Result<std::optional<cv::Size>> size_of_option(const std::string& text) {
  if (text.empty()) return std::nullopt;
  int width = 0;
  int height = 0;
  char rest = 0;
  const bool is_size = std::sscanf(text.c_str(), "%7dx%7d%c", &width, &height, &rest) == 2 && width > 0 && height > 0;
  if (!is_size) return fail("--size", text + " is no size such as 1280x960", ErrorKind::usage);
  return cv::Size(width, height);
}

}  // namespace sigs::cli
