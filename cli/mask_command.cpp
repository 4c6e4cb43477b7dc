// SPDX-License-Identifier: MIT
#include "cli/commands.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/numbered_files.h"
#include "base/paths.h"
#include "base/result.h"
#include "base/threads.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/process.h"
#include "export/export_project.h"
#include "occlusion/detect.h"
#include "project/validate.h"
#include "scene/opened_project.h"
#include "scene/scene_parts.h"
#include "video/frame_source.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

// Where `sigs mask` writes.
struct MaskPaths {
  fs::path mask, confidence;  // PNG files; no confidence: not asked for
  fs::path stages;            // a folder for images of the steps; likewise
};

const cv::Vec3b kTint(255, 0, 255);  // magenta: neither sky nor ground nor paint
constexpr double kStrength = 0.5;

// The image with the mask tinted over it, for inspection. bgr: CV_8UC3; mask: CV_8UC1 of the same size.
cv::Mat tinted(const cv::Mat& bgr, const cv::Mat& mask) {
  cv::Mat image = bgr.clone();
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const double share = kStrength * mask.at<uchar>(y, x) / 255.0;
      cv::Vec3b& pixel = image.at<cv::Vec3b>(y, x);
      for (int i = 0; i < 3; ++i) pixel[i] = cv::saturate_cast<uchar>(pixel[i] + share * (kTint[i] - pixel[i]));
    }
  return image;
}

// The file names of every method's steps, and of the frame and the result around them.
constexpr std::string_view kStages[] = {
    "frame", "overlay",
    // paper
    "difference_sum", "canny", "dilated", "rough", "sobel", "closed", "padded", "filled", "refined",
    // stable
    "mean_gradient", "coherence", "variation", "drift", "moving", "walls", "labels", "own_body", "confidence"};

// Whether an image of a step, of any method, may have this name: "03_canny.png".
bool is_stage_name(std::string_view file_name) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (file_name.size() < 8 || !is_digit(file_name[0]) || !is_digit(file_name[1]) || file_name[2] != '_' ||
      !file_name.ends_with(".png"))
    return false;
  return std::ranges::find(kStages, file_name.substr(3, file_name.size() - 7)) != std::end(kStages);
}

bool is_taken_by_a_stage(const fs::path& file, const fs::path& stages) {
  if (!is_at_or_below(file, stages) || file == stages) return false;
  const fs::path first = *file.lexically_relative(stages).begin();
  return is_stage_name(first.string());
}

// Two outputs with the same path.
Result<void> check_distinct(const MaskPaths& paths) {
  const fs::path mask = canonical_name(paths.mask);
  const fs::path confidence = paths.confidence.empty() ? fs::path() : canonical_name(paths.confidence);
  if (!confidence.empty() && (is_at_or_below(confidence, mask) || is_at_or_below(mask, confidence)))
    return fail("--confidence " + paths.confidence.string(), "is where the mask goes", ErrorKind::usage);
  if (paths.stages.empty()) return {};
  const fs::path stages = canonical_path(paths.stages);
  const std::pair<std::string, fs::path> files[] = {{"--out " + paths.mask.string(), mask},
                                                    {"--confidence " + paths.confidence.string(), confidence}};
  for (const auto& [option, file] : files) {
    if (file.empty()) continue;
    if (is_at_or_below(stages, file))
      return fail(option, "is the folder that --stages makes; choose another name", ErrorKind::usage);
    if (is_taken_by_a_stage(file, stages))
      return fail(option, "is a name that --stages writes; choose another", ErrorKind::usage);
  }
  return {};
}

std::vector<fs::path> stages_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, code))
    if (is_stage_name(entry.path().filename().string())) found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

// The images of one run. They get their names together, or none of them and no folder is left.
class MaskOutputs {
 public:
  // Before the work begins: finding that a file stands in the way after minutes would be late. inputs: what the command
  // reads; may be empty paths. Errors: usage (not a PNG, one output where another goes), cannot_create.
  static Result<MaskOutputs> reserved(MaskPaths paths, const std::vector<fs::path>& inputs, bool overwrite) {
    if (const Result<void> apart = check_distinct(paths); !apart) return fail(apart.error());
    MaskOutputs out(std::move(paths), overwrite);
    Result<void> step = out.reserve("--out", out.paths_.mask, inputs);
    if (step && !out.paths_.confidence.empty()) step = out.reserve("--confidence", out.paths_.confidence, inputs);
    if (step && out.has_stages()) step = out.reserve_stages(inputs);
    if (!step) return fail(step.error());
    return out;
  }

  [[nodiscard]] bool has_stages() const { return !paths_.stages.empty(); }

  // Writes all; what the files are called. bgr: a frame of the footage, for the stages; empty where there are none.
  // Images of stages that another run has left in the folder go: they would look like steps of this one.
  Result<std::vector<fs::path>> write(const OwnBody& found, const cv::Mat& bgr) {
    Result<void> step = files_.write(paths_.mask, found.mask);
    if (step && !paths_.confidence.empty()) step = files_.write(paths_.confidence, found.confidence);
    if (step && has_stages()) step = write_stages(found, bgr);
    if (step) step = files_.commit();
    if (!step) return fail(step.error());
    const std::vector<fs::path> written = files_.final_paths();
    if (!has_stages() || !overwrite_) return written;
    std::error_code code;
    for (const fs::path& there : stages_in(paths_.stages))
      if (std::ranges::find(written, there) == written.end() && !fs::is_directory(there, code)) fs::remove(there, code);
    return written;
  }

 private:
  MaskOutputs(MaskPaths paths, bool overwrite) : paths_(std::move(paths)), overwrite_(overwrite), files_(overwrite) {}

  // Reserves the name of an image, in a folder that is created if it is missing. option: named in the error.
  Result<void> reserve(const char* option, const fs::path& path, const std::vector<fs::path>& inputs) {
    Result<void> step = check_png_output(option, path, inputs);
    if (step) step = folders_.make(path.parent_path());
    if (step) step = files_.reserve(path);
    return step;
  }

  // Which steps there will be is known only at the end; any existing one is an error.
  Result<void> reserve_stages(const std::vector<fs::path>& inputs) {
    if (const Result<void> made = folders_.make(paths_.stages); !made) return made;
    const std::vector<fs::path> there = stages_in(paths_.stages);
    if (!overwrite_ && !there.empty())
      return fail(there.front().string(), "exists already; --force replaces the stages that are there",
                  ErrorKind::cannot_create);
    if (const Result<void> kept = check_inputs_not_overwritten(there, inputs); !kept) return kept;
    return files_.reserve(stage(0, "frame"));
  }

  // The steps of the method, between a frame of the footage and that frame with the result tinted over it.
  Result<void> write_stages(const OwnBody& found, const cv::Mat& bgr) {
    Result<void> step = files_.write(stage(0, "frame"), bgr);
    std::size_t number = 1;
    for (const DetectionStage& made : found.stages)
      if (step) step = files_.write(stage(number++, made.name), made.image);
    if (step) step = files_.write(stage(number, "overlay"), tinted(bgr, found.mask));
    return step;
  }

  // File of a step in the folder, by its number and name.
  [[nodiscard]] fs::path stage(std::size_t number, std::string_view name) const {
    std::string file = std::to_string(number);
    if (number < 10) file.insert(0, 1, '0');
    return paths_.stages / file.append("_").append(name).append(".png");
  }

  MaskPaths paths_;
  bool overwrite_ = false;
  CreatedFolders folders_;  // outlives the files: a folder can go only once it is empty
  OutputFiles files_;
};

constexpr const char* kMaskFooter =
    "Examples:\n"
    "  sigs mask flight.mp4\n"
    "  sigs mask flight.mp4 --out own_body.png --confidence sure.png --stages steps\n"
    "  sigs mask encounter.json --out own_body.png --frames 600 --set own_body.soft_edge_px=3\n"
    "  sigs mask flight.mp4 --method paper --every 2 --out own_body.png --force\n"
    "\n"
    "A project's own settings stand where an option is not given.";

struct MaskOptions {
  ProjectOptions project;  // its file may be a video too
  MaskPaths paths;         // mask empty: named after the video
  OptionSettings settings;
  bool force = false;
  std::string progress = "auto";
};

// A video alone is a project with nothing else in it, at the place where the program was started.
Result<Project> read(const ProjectOptions& options) {
  if (is_project_file(options.file)) return project_of(options);
  Project project;
  project.footage.video = options.file.string();
  if (const Result<void> set = set_all(project, options.settings); !set) return fail(set.error());
  return project;
}

// The detection needs neither calibration nor intruders; errors in them are ignored here.
bool concerns_detection(const Problem& problem) {
  return problem.field.starts_with("own_body.") || problem.field == "footage.video" ||
         problem.field == "footage.first_frame" || problem.field == "footage.last_frame";
}

Error error_in(const Project& project, const Problem& problem) {
  if (!project.file.empty()) return error_of(project, problem);
  if (problem.field == "footage.video") return {project.footage.video, "no such file", problem.kind};
  return {problem.field, problem.what, ErrorKind::usage};
}

Result<Project> project_of(const MaskOptions& options) {
  Result<Project> project = read(options.project);
  if (!project) return project;
  if (const Result<void> set = set_option_settings(*project, options.settings); !set) return fail(set.error());
  for (const Problem& problem : validate(*project))
    if (concerns_detection(problem)) return fail(error_in(*project, problem));
  return project;
}

Result<FrameSource> footage_of(const Project& project) {
  Result<FrameSource> source = open_footage(project);
  if (!source && !project.file.empty()) return fail(footage_error(project, source.error()));
  if (source)
    for (const Warning& warning : warnings_of(source->info())) print_warning(warning);
  return source;
}

fs::path default_mask(const fs::path& video) {
  // Of images the folder that they are in: "images/%06d.png" and "images/" give "images".
  const bool is_pattern = is_number_pattern(video) && video.has_parent_path();
  const fs::path named = is_pattern || !video.has_filename() ? video.parent_path() : video;
  return named.stem().string() + ".own-body.png";
}

Result<OwnBody> found_in(FrameSource& footage, const FrameRange& range, const Project& project,
                         const MaskOptions& options) {
  OwnBodySettings settings = project.own_body;
  settings.frames = std::min(settings.frames, range.last - range.first + 1);
  Progress progress(options.progress);
  const DetectionControl control{.progress = progress.counter(),
                                 .cancel = &interrupt_flag(),
                                 .stages = options.paths.stages.empty() ? KeepStages::no : KeepStages::yes};
  return detect_own_body(footage, range.first, settings, control);
}

Result<void> write(MaskOutputs& out, const OwnBody& found, FrameSource& footage, int first_frame) {
  cv::Mat image;
  if (out.has_stages()) {
    const Result<Frame> middle = footage.read(first_frame + found.frames_passed / 2);
    if (!middle) return fail(middle.error());
    image = bgr_of(*middle);
  }
  const Result<std::vector<fs::path>> written = out.write(found, image);
  if (!written) return fail(written.error());
  print_written(*written);
  return {};
}

void print_summary(const OwnBody& found, const Project& project) {
  for (const Warning& warning : found.warnings) print_warning(warning);
  if (found.share > 0)
    std::fprintf(stderr, "own body: %.1f %% of the image, %d frames used\n", 100 * found.share, found.frames_used);
  else
    std::fprintf(stderr, "own body: none found, %d frames used; the mask is black\n", found.frames_used);
  if (found.converged)
    std::fprintf(stderr, "converged after %d of at most %d frames; the last check changed %.2g %% of the mask\n",
                 found.frames_passed, project.own_body.frames, 100 * found.last_change);
}

// Where the result may well be wrong and has to be inspected.
void warn_of_doubtful_mask(const OwnBody& found, const VideoInfo& footage, int first_frame) {
  constexpr double kRounding_s = 0.05;  // 9.95 is printed as 10.0
  const auto first = static_cast<std::size_t>(first_frame);
  const auto steps = static_cast<std::size_t>(found.frames_passed - 1);
  const double from_first_to_last_s = footage.times_s[first + steps] - footage.times_s[first];
  const double passed_s = from_first_to_last_s * (1 + 1 / static_cast<double>(steps));  // the last one is shown too
  if (passed_s < kEnoughFootage_s - kRounding_s) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "only %.1f s of footage were looked through, parts of the world may be masked; look at the mask, or "
                  "take 10 s or more",
                  passed_s);
    print_warning({footage.path.string(), text});
  }
  if (found.share > kLargeShare)
    print_warning({footage.path.string(), "more than half of the image is masked; look whether all of it is the UAV"});
}

Result<void> run(const MaskOptions& options) {
  tune_allocator();
  const Result<Project> project = project_of(options);
  if (!project) return fail(project.error());
  Result<FrameSource> footage = footage_of(*project);
  if (!footage) return fail(footage.error());
  const Result<FrameRange, Problem> range = scene_range(project->footage, shape_of(footage->info()));
  if (!range) return fail(error_in(*project, range.error()));
  defer_interrupts();
  MaskPaths paths = options.paths;
  const fs::path& video = footage->info().path;
  if (paths.mask.empty()) paths.mask = default_mask(video);
  Result<MaskOutputs> out = MaskOutputs::reserved(std::move(paths), {video, project->file}, options.force);
  if (!out) return fail(out.error());
  const Result<OwnBody> found = found_in(*footage, *range, *project, options);
  if (!found) return fail(found.error());
  if (const Result<void> written = write(*out, *found, *footage, range->first); !written) return written;
  print_summary(*found, *project);
  warn_of_doubtful_mask(*found, footage->info(), range->first);
  return {};
}

}  // namespace

Command add_mask_command(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("mask", "find which pixels of a video show the UAV's own body");
  const auto options = std::make_shared<MaskOptions>();
  add_subject(*command, "FILE", options->project.file, "a video, or a project (json): its footage, range and settings");
  add_set_option(*command, options->project);
  add_camera_option(*command, options->project.camera);
  add_output(*command, "--out", options->paths.mask,
             "the mask, a PNG; without it VIDEO.own-body.png in the current folder");
  for (const SettingOption& option : {SettingOption{"--frames", "own_body.frames", "N",
                                                    "how many frames are looked through; all where there are fewer"},
                                      SettingOption{"--every", "own_body.every", "K", "use each K-th of them alone"},
                                      SettingOption{"--method", "own_body.method", "NAME", "stable or paper"}})
    add_setting_option(*command, option, options->settings);
  add_output(*command, "--confidence", options->paths.confidence, "write how sure each pixel is too: a 16-bit PNG");
  add_output(*command, "--stages", options->paths.stages, "write the image of every step into this folder", "DIR");
  command->add_flag("--force", options->force, "overwrite what is there");
  add_progress_option(*command, options->progress);
  command->footer(kMaskFooter);
  return [options] { return run(*options); };
}

}  // namespace sigs::cli
