// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "export/export_project.h"
#include "project/json.h"
#include "project/project.h"
#include "video/image_sequence.h"

namespace sigs::cli {

// What export, frame, mask and check share: which project, and what to change in it for this once.
struct ProjectOptions {
  std::filesystem::path file;
  std::vector<std::string> settings;  // --set key=value
  std::string camera;                 // --camera NAME; empty: the first camera of a rig
};

// Whether a file given as "a video or a project" is a project, by its extension.
[[nodiscard]] bool is_project_file(const std::filesystem::path& file);

void add_project_options(CLI::App& command, ProjectOptions& options);
void add_set_option(CLI::App& command, ProjectOptions& options);  // --set alone
void add_camera_option(CLI::App& command, std::string& camera);

// Reads the project, says its warnings on stderr, applies --set.
[[nodiscard]] Result<Project> whole_project_of(const ProjectOptions& options);

// The same as one camera sees it: of a rig the one that is asked for, else the first, of which a note tells.
[[nodiscard]] Result<Project> project_of(const ProjectOptions& options);

// The same of a project that was read in another way: warnings are printed, of a rig it is what the first camera sees.
[[nodiscard]] Result<Project> first_camera_of(Result<ReadProject> read);

// The project in a file; none where the file is no project: not JSON that has a member of projects or begins as one, or
// not readable. Warnings are printed. Errors are those of read_project(): a project, but a broken one.
[[nodiscard]] Result<std::optional<Project>> project_in(const std::filesystem::path& file);

// The index of the camera of --camera. Error usage.
[[nodiscard]] Result<std::size_t> camera_of_option(const Project& project, const std::string& name);

// Rewrites a project file with what was changed of project_of() it.
[[nodiscard]] Result<void> rewrite_project(const Project& changed, const std::filesystem::path& file);

// Applies --set.
[[nodiscard]] Result<void> set_all(Project& project, const std::vector<std::string>& assignments);

// What options say that stand for one setting of the project each, by its key; empty: not given.
using OptionSettings = std::map<std::string, std::string>;
[[nodiscard]] Result<void> set_option_settings(Project& project, const OptionSettings& settings);

// An option that stands for one setting: a whole number or a choice.
struct SettingOption {
  const char* name;   // "--frames"
  const char* key;    // "own_body.frames"
  const char* value;  // what the help calls the value: "N"
  const char* help;
};

// Adds it, its default shown. A value that the setting cannot have is the command line's fault, whatever the project.
void add_setting_option(CLI::App& command, const SettingOption& option, OptionSettings& settings);

// For paths: an option or argument that is given says something.
[[nodiscard]] CLI::Validator not_empty();

// For what is written: the same, and not "-", which stands for standard output elsewhere.
[[nodiscard]] CLI::Validator output_path();

// An option with a value.
//   unit  what the help calls it
template <class Value>
CLI::Option* add_value(CLI::App& command, const std::string& name, Value& value, const std::string& unit,
                       const std::string& help) {
  return command.add_option(name, value, help)->option_text(unit);
}

// An option that names a file or folder to read (or several of them), or one to write.
//   value  what the help calls it
template <class Paths>
CLI::Option* add_input(CLI::App& command, const char* name, Paths& paths, const char* help,
                       const char* value = "FILE") {
  return add_value(command, name, paths, value, help)->check(not_empty());
}
CLI::Option* add_output(CLI::App& command, const char* name, std::filesystem::path& path, const char* help,
                        const char* value = "FILE");

// What a command is about, without an option's name before it.
CLI::Option* add_subject(CLI::App& command, const char* name, std::filesystem::path& path, const char* help);

// A number of this range, its default shown.
template <class Number>
CLI::Option* add_number(CLI::App& command, const char* name, Number& value, const char* unit,
                        std::type_identity_t<Number> low, std::type_identity_t<Number> high, const char* help) {
  return add_value(command, name, value, unit, help)->capture_default_str()->check(CLI::Range(low, high));
}

// A number of this range. CLI::Range lets NaN through.
[[nodiscard]] CLI::Validator from_to(double low, double high);

// An option of such a number, without its default: it says nothing, or the help has it.
template <class Number>
CLI::Option* add_range(CLI::App& command, const char* name, Number& value, const char* unit, double low, double high,
                       const char* help) {
  return add_value(command, name, value, unit, help)->check(from_to(low, high));
}

// The same with its default shown.
template <class Number>
CLI::Option* add_figure(CLI::App& command, const char* name, Number& value, const char* unit, double low, double high,
                        const char* help) {
  return command.add_option(name, value, help)->type_name(unit)->capture_default_str()->check(from_to(low, high));
}

// The value of --size, as in "1280x960"; none where it is not given. Error usage.
[[nodiscard]] Result<std::optional<cv::Size>> size_of_option(const std::string& text);

// Numbers separated by commas, as many as `count`, each below a million in size; none where the text says anything
// else.
[[nodiscard]] std::optional<std::vector<double>> numbers_of(const std::string& text, std::size_t count);

// "3/5" as two whole numbers; none where the text says anything else.
[[nodiscard]] std::optional<std::pair<int, int>> fraction_of(const std::string& text);

// The value of --box, X,Y,W,H: the first column and row, the width and height in pixels. Error usage.
[[nodiscard]] Result<Box> box_of_option(const std::string& option, const std::string& text);

// --progress, as Progress takes it.
void add_progress_option(CLI::App& command, std::string& style);

// The value of --jobs: 0 stands for one less than there are cores, as decoding and writing, or trackers, occupy one.
[[nodiscard]] int jobs_of_option(int jobs);

// As a project names a file: relative to its own folder, so that both can be moved together.
[[nodiscard]] std::string path_beside(const std::filesystem::path& file, const std::filesystem::path& project);

// --frame-rate and --timestamps, for commands that take footage and not the project that names it.
void add_timing_options(CLI::App& command, SequenceTiming& timing);

// The value of --frames, "10-20" or "10"; none where it is not given. Error usage.
[[nodiscard]] Result<std::optional<FrameRange>> frame_range_of(const std::string& text);

// A line on stderr. The engine's texts know no options: where one asks for something that an option does, the option is
// named in its place ("exists already; --force overwrites it").
void print_warning(const Warning& warning);
void print_error(const Error& error);

}  // namespace sigs::cli
