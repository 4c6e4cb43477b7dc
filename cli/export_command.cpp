// SPDX-License-Identifier: MIT
#include "cli/commands.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "base/output_stream.h"
#include "base/text.h"
#include "base/threads.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/process.h"
#include "export/export_project.h"
#include "labels/labels.h"
#include "project/fields.h"
#include "project/project.h"
#include "project/validate.h"

namespace sigs::cli {

namespace {

struct ExportOptions {
  ProjectOptions project;
  std::filesystem::path folder = ".";
  std::string frames;
  OptionSettings settings;
  std::string labels;
  int jobs = 0;
  bool force = false;
  bool times = false;
  int labels_descriptor = -1;
  bool in_real_time = false;
  std::string progress = "auto";
};

// Options that set one setting each; the value is checked with the project.
struct SettingText {
  const char* option;
  const char* key;
  const char* value;
  const char* help;
  bool is_threshold = false;  // of labels
};

constexpr SettingText kSettings[] = {
    {"--codec", "export.video.codec", "NAME", "ffv1, h264, hevc, av1, mjpeg, png, tiff, jpeg, raw or source"},
    {"--crf", "export.video.crf", "N", "quality: 0 lossless to 51 worst (h264, hevc), 63 (av1)"},
    {"--container", "export.video.container", "NAME", "mkv, mp4, avi, nut or y4m"},
    {"--quality", "export.video.quality", "N", "quality of jpeg: 1 worst to 100 best"},
    {"--method", "compositing.method", "NAME", "direct, classic or plain"},
    {"--masks", "export.masks", "NAME", "video, png or none"},
    {"--min-pixels", "export.label_min_pixels", "N", "no label where fewer pixels are visible", true},
    {"--min-visible", "export.label_min_visible_fraction", "F",
     "no label where less of the intruder is visible, 0 to 1", true},
};

std::string help_of(const SettingText& setting) {
  if (!setting.is_threshold) return setting.help;
  return fmt::format("{}; not for {}", setting.help, listed(names_without_thresholds()));
}

std::string label_names() {
  std::string names;
  for (const LabelFormat& format : label_formats()) names.append(names.empty() ? "" : ", ").append(format.name);
  return names;
}

std::string json_list(const std::string& comma_separated) {
  std::string list = "[\"";
  for (const char c : comma_separated) list += c == ',' ? std::string("\",\"") : std::string(1, c);
  return comma_separated.empty() ? "[]" : list + "\"]";
}

std::string given(const ExportOptions& options, const std::string& key) {
  const auto setting = options.settings.find(key);
  return setting == options.settings.end() ? std::string() : setting->second;
}

// An error in a setting that an option gave is reported with the option: the project may be valid.
Result<void> set_options(Project& project, const ExportOptions& options) {
  std::map<std::string, std::string> option_of_key;
  for (const SettingText& setting : kSettings) {
    const std::string value = given(options, setting.key);
    if (value.empty()) continue;
    const std::string option = std::string(setting.option) + " " + value;
    const bool depends_on_codec = std::string_view(setting.key) == "export.video.container";
    if (!depends_on_codec) option_of_key[setting.key] = option;
    if (const Result<void> set = set_field(project, std::string(setting.key) + "=" + value); !set)
      return fail(option, set.error().what, ErrorKind::usage);
  }
  if (!options.labels.empty()) {
    const std::string option = "--labels " + options.labels;
    option_of_key["export.labels"] = option;
    const std::string list = options.labels == "none" ? "[]" : json_list(options.labels);
    if (const Result<void> set = set_field(project, "export.labels=" + list); !set)
      return fail(option, set.error().what, ErrorKind::usage);
  }
  for (const Problem& problem : validate(project))
    if (const auto option = option_of_key.find(problem.field); option != option_of_key.end())
      return fail(option->second, problem.what, ErrorKind::usage);
  return {};
}

bool is_stream(const ExportOptions& options) {
  return options.folder == "-";
}

// A stream has a container that can be read as it comes, and no other outputs beside it.
Result<void> prepare_for_stream(Project& project, const ExportOptions& options) {
  ExportSettings& output = project.output;
  const auto wrong = [](const std::string& where, const char* what) { return fail(where, what, ErrorKind::usage); };
  if (is_terminal(STDOUT_FILENO))
    return wrong("--out -", "standard output is a terminal; let a program read it: ... --out - | ffmpeg -i - ...");
  if (options.labels_descriptor == STDOUT_FILENO) return wrong("--labels-fd 1", "the video goes there by --out -");
  if (!options.labels.empty() && options.labels != "none")
    return wrong("--labels " + options.labels, "is for files; beside a stream labels go to --labels-fd");
  if (const std::string masks = given(options, "export.masks"); !masks.empty() && masks != "none")
    return wrong("--masks " + masks, "is for files; standard output has the video alone");
  if (writes_images(output.codec))
    return wrong("--out -", "numbered images are files; choose the codec ffv1, h264, mjpeg or raw");
  if (output.codec == VideoCodec::source)
    return wrong("--out -", "source copies a file into a file; choose the codec ffv1, h264, mjpeg or raw");
  const bool can_stream = output.container == ContainerChoice::nut || output.container == ContainerChoice::y4m;
  if (!can_stream && !given(options, "export.video.container").empty())
    return wrong("--container " + given(options, "export.video.container"),
                 "cannot be read as it comes; use nut or y4m with --out -");
  if (!can_stream) output.container = ContainerChoice::nut;
  return {};
}

Result<ExportRequest> request_of(const ExportOptions& options) {
  Result<Project> project = whole_project_of(options.project);
  if (!project) return fail(project.error());
  // Another codec gets its own default container, not the one that the project has for its codec.
  const bool codec_alone =
      !given(options, "export.video.codec").empty() && given(options, "export.video.container").empty();
  if (codec_alone) project->output.container = ContainerChoice::automatic;
  // y4m holds nothing else.
  if (given(options, "export.video.container") == "y4m" && given(options, "export.video.codec").empty())
    project->output.codec = VideoCodec::raw;
  if (const Result<void> set = set_options(*project, options); !set) return fail(set.error());
  if (!options.project.camera.empty()) {
    const Result<std::size_t> camera = camera_of_option(*project, options.project.camera);
    if (!camera) return fail(camera.error());
    *project = seen_by(*project, *camera);
  }
  if (!project->cameras.empty() && (is_stream(options) || options.labels_descriptor >= 0))
    return fail("--out " + options.folder.string(),
                "is one stream, the project has several cameras; choose one with --camera", ErrorKind::usage);
  if (is_stream(options))
    if (const Result<void> stream = prepare_for_stream(*project, options); !stream) return fail(stream.error());
  ExportRequest request{.project = std::move(*project),
                        .folder = options.folder,
                        .overwrite = options.force,
                        .labels_descriptor = options.labels_descriptor,
                        .in_real_time = options.in_real_time};
  request.jobs = jobs_of_option(options.jobs);
  const Result<std::optional<FrameRange>> range = frame_range_of(options.frames);
  if (!range) return fail(range.error());
  request.frames = *range;
  return request;
}

void print_times(const ExportReport& report) {
  const StageTimes& times = report.times;
  const double per_frame_ms = 1000.0 / std::max(1, report.frames);
  std::fprintf(stderr,
               "%d frames in %s, %.1f frames/s; per frame: decode %.2f ms, draw %.2f ms, composite %.2f ms, "
               "encode %.2f ms%s%s\n",
               report.frames, clock_text(times.wall_s).c_str(), report.frames / std::max(times.wall_s, 1e-6),
               times.decode_s * per_frame_ms, times.draw_s * per_frame_ms, times.composite_s * per_frame_ms,
               times.encode_s * per_frame_ms, report.renderer_description.empty() ? "" : "; drawn with ",
               report.renderer_description.c_str());
}

// A line for each intruder, the first few where there are many.
void print_visibilities(const Project& project, const std::vector<Visibility>& visibilities) {
  constexpr std::size_t kNamed = 10;
  const std::size_t named = std::min(kNamed, visibilities.size());
  for (std::size_t i = 0; i < named; ++i)
    std::fprintf(stderr, "%s: %s\n", project.intruders[i].name.c_str(), text_of(visibilities[i]).c_str());
  if (named == visibilities.size()) return;
  const auto visible = std::count_if(visibilities.begin() + named, visibilities.end(),
                                     [](const Visibility& one) { return one.visible > 0; });
  std::fprintf(stderr, "%zu more intruders: %td visible, %td never\n", visibilities.size() - named, visible,
               static_cast<std::ptrdiff_t>(visibilities.size() - named) - visible);
}

// All cameras of a rig.
Result<void> run_rig(const ExportRequest& request, const ExportOptions& options, const ExportControl& control,
                     Progress& progress) {
  const Result<RigReport> report = export_rig(request, control);
  progress.end();
  if (!report) return fail(report.error());
  print_written(report->written);
  for (std::size_t i = 0; i < report->cameras.size(); ++i) {
    if (options.progress != "none") std::fprintf(stderr, "camera \"%s\":\n", request.project.cameras[i].name.c_str());
    if (options.times) print_times(report->cameras[i]);
    if (options.progress != "none") print_visibilities(request.project, report->cameras[i].visibilities);
  }
  return {};
}

Result<void> run(const ExportOptions& options) {
  Result<ExportRequest> request = request_of(options);
  if (!request) return fail(request.error());
  if (is_stream(options)) {
    const Result<int> descriptor = taken_standard_output();
    if (!descriptor) return fail(descriptor.error());
    request->video_descriptor = *descriptor;
  }
  defer_interrupts();
  tune_allocator();
  Progress progress(options.progress);
  const ExportControl control{.progress = progress.counter(),
                              .warn =
                                  [&](const Warning& warning) {
                                    progress.end();
                                    print_warning(warning);
                                  },
                              .cancel = &interrupt_flag()};
  if (!request->project.cameras.empty()) return run_rig(*request, options, control, progress);
  const Result<ExportReport> report = export_project(*request, control);
  progress.end();
  if (!report) return fail(report.error());
  if (options.labels_descriptor != STDOUT_FILENO) print_written(report->written);
  if (options.times) print_times(*report);
  if (options.progress == "none") return {};
  if (request->project.output.codec == VideoCodec::source)
    std::fprintf(stderr, "%d of %s copied as in the footage, %d encoded\n", report->copied_frames,
                 count_text(report->frames, "frame").c_str(), report->frames - report->copied_frames);
  print_visibilities(request->project, report->visibilities);
  return {};
}

}  // namespace

Command add_export_command(CLI::App& program) {
  CLI::App* const command =
      program.add_subcommand("export", "write a project's video, masks and annotations; prints the files written");
  const auto options = std::make_shared<ExportOptions>();
  add_project_options(*command, options->project);
  command
      ->add_option("--out", options->folder,
                   "folder to write into, made where it is not there; -: the video to standard output")
      ->capture_default_str()
      ->check(not_empty());
  add_value(*command, "--frames", options->frames, "A-B", "only these frames of the footage");
  for (const SettingText& setting : kSettings)
    add_value(*command, setting.option, options->settings[setting.key], setting.value, help_of(setting));
  add_value(*command, "--labels", options->labels, "NAMES",
            fmt::format("annotation formats, separated by commas: {}; none", label_names()));
  command->add_option("--jobs", options->jobs, "frames composed side by side; 0: one less than processor cores")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  add_value(*command, "--labels-fd", options->labels_descriptor, "N",
            "labels as JSON lines to an open file descriptor, each before its frame")
      ->check(CLI::Range(0, 1 << 20));
  command->add_flag("--realtime", options->in_real_time, "no frame goes out before its time");
  command->add_flag("--force", options->force, "overwrite what is there");
  command->add_flag("--times", options->times, "say at the end how long each stage took");
  add_progress_option(*command, options->progress);
  return [options] { return run(*options); };
}

}  // namespace sigs::cli
