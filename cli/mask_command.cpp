// SPDX-License-Identifier: MIT
#include "cli/mask_command.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "cli/interrupt.h"
#include "cli/options.h"
#include "cli/overlay.h"
#include "cli/picture_files.h"
#include "cli/progress.h"
#include "export.h"
#include "occlusion/detect.h"
#include "project/validate.h"
#include "scene/scene_parts.h"
#include "video/frame_source.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

struct MaskOptions {
  ProjectOptions project;  // its file may be a video too
  fs::path mask;           // empty: named after the video
  fs::path confidence;     // empty: not asked for
  fs::path stages;         // folder; empty: not asked for
  GivenSettings settings;
  bool force = false;
  std::string progress = "auto";
};

bool is_project(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".json";
}

// A video alone is a project with nothing else in it, at the place where the program was started.
Result<Project> read(const ProjectOptions& options) {
  if (is_project(options.file)) return project_of(options);
  Project project;
  project.footage.video = options.file.string();
  if (const Result<void> set = set_all(project, options.settings); !set) return fail(set.error());
  return project;
}

// The detection needs neither calibration nor intruders; what is wrong with them is no matter here.
bool matters(const Problem& problem) {
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
  if (const Result<void> set = set_given(*project, options.settings); !set) return fail(set.error());
  for (const Problem& problem : validate(*project))
    if (matters(problem)) return fail(error_in(*project, problem));
  return project;
}

Result<FrameSource> footage_of(const Project& project) {
  Result<FrameSource> source = FrameSource::open(resolved(project, project.footage.video));
  if (!source && !project.file.empty())
    return fail(project.file.string() + ": footage.video", source.error().text(), source.error().kind);
  if (source)
    for (const Warning& warning : warnings_of(source->info())) print_warning(warning);
  return source;
}

Result<void> check_name(const char* option, const fs::path& path, const std::array<fs::path, 2>& inputs) {
  const std::string where = std::string(option) + " " + path.string();
  if (path.extension() != ".png") return fail(where, "is written as PNG; end its name in .png", ErrorKind::usage);
  std::error_code code;
  for (const fs::path& input : inputs)
    if (!input.empty() && fs::equivalent(input, path, code))
      return fail(where, "is read by this command; choose another name", ErrorKind::cannot_create);
  return {};
}

Result<void> make_folder(const fs::path& folder) {
  std::error_code code;
  if (!folder.empty()) fs::create_directories(folder, code);
  if (code) return fail(folder.string(), "cannot be created: " + code.message(), ErrorKind::cannot_create);
  return {};
}

// Takes the name of a picture, in a folder that is made where it is not there.
Result<void> reserve(PictureFiles& files, const char* option, const fs::path& path,
                     const std::array<fs::path, 2>& inputs) {
  Result<void> step = check_name(option, path, inputs);
  if (step) step = make_folder(path.parent_path());
  if (step) step = files.reserve(path);
  return step;
}

// What the command writes, and where.
struct Outputs {
  fs::path mask;
  fs::path confidence;
  fs::path stages;
  PictureFiles files;

  [[nodiscard]] fs::path stage(std::size_t number, const std::string& name) const {
    return stages / ((number < 10 ? "0" : "") + std::to_string(number) + "_" + name + ".png");
  }
};

// Before the work begins: finding that a file stands in the way after minutes would be late.
Result<Outputs> reserved(const MaskOptions& options, const Project& project, const fs::path& video) {
  Outputs out{.mask = options.mask.empty() ? fs::path(video.stem().string() + ".own-body.png") : options.mask,
              .confidence = options.confidence,
              .stages = options.stages,
              .files = PictureFiles(options.force)};
  if (out.confidence.lexically_normal() == out.mask.lexically_normal())
    return fail("--confidence " + out.confidence.string(), "is where the mask goes", ErrorKind::usage);
  const std::array<fs::path, 2> inputs{video, project.file};
  Result<void> step = reserve(out.files, "--out", out.mask, inputs);
  if (step && !out.confidence.empty()) step = reserve(out.files, "--confidence", out.confidence, inputs);
  if (!step) return fail(step.error());
  if (out.stages.empty()) return out;
  if (const Result<void> made = make_folder(out.stages); !made) return fail(made.error());
  if (const Result<void> first = out.files.reserve(out.stage(0, "frame")); !first) return fail(first.error());
  return out;
}

Result<OwnBody> found_in(FrameSource& footage, const FrameRange& range, const Project& project,
                         const MaskOptions& options) {
  OwnBodySettings settings = project.own_body;
  settings.frames = std::min(settings.frames, range.last - range.first + 1);
  Progress progress(progress_style(options.progress));
  const DetectionControl control{.progress = [&](int done, int total) { progress.update(done, total); },
                                 .cancel = &interrupt_flag(),
                                 .stages = options.stages.empty() ? KeepStages::no : KeepStages::yes};
  Result<OwnBody> found = detect_own_body(footage, range.first, settings, control);
  progress.end();
  return found;
}

// The steps of the method, between a frame of the footage and what was found tinted over it.
Result<void> write_stages(Outputs& out, const OwnBody& found, const Frame& frame) {
  const cv::Mat picture = bgr_of(frame);
  Result<void> step = out.files.write(out.stage(0, "frame"), picture);
  std::size_t number = 1;
  for (const DetectionStage& stage : found.stages)
    if (step) step = out.files.write(out.stage(number++, stage.name), stage.picture);
  if (step) step = out.files.write(out.stage(number, "overlay"), tinted(picture, found.mask));
  return step;
}

Result<void> write(Outputs& out, const OwnBody& found, FrameSource& footage, int first_frame) {
  Result<void> step = out.files.write(out.mask, found.mask);
  if (step && !out.confidence.empty()) step = out.files.write(out.confidence, found.confidence);
  if (step && !out.stages.empty()) {
    const Result<Frame> middle = footage.read(first_frame + found.frames_passed / 2);
    if (!middle) return fail(middle.error());
    step = write_stages(out, found, *middle);
  }
  if (!step) return step;
  const Result<std::vector<fs::path>> written = out.files.keep();
  if (!written) return fail(written.error());
  for (const fs::path& path : *written) std::printf("%s\n", path.c_str());
  return {};
}

void say(const OwnBody& found, const Project& project) {
  for (const Warning& warning : found.warnings) print_warning(warning);
  if (found.share > 0)
    std::fprintf(stderr, "own body: %.1f %% of the picture, %d frames used\n", 100 * found.share, found.frames_used);
  else
    std::fprintf(stderr, "own body: none found, %d frames used; the mask is black\n", found.frames_used);
  if (found.settled)
    std::fprintf(stderr, "settled after %d of at most %d frames; the last look changed %.2g %% of the mask\n",
                 found.frames_passed, project.own_body.frames, 100 * found.last_change);
}

Result<void> run(const MaskOptions& options) {
  const Result<Project> project = project_of(options);
  if (!project) return fail(project.error());
  Result<FrameSource> footage = footage_of(*project);
  if (!footage) return fail(footage.error());
  const Made<FrameRange> range = made_range(project->footage, shape_of(footage->info()));
  if (!range) return fail(error_in(*project, range.error()));
  Result<Outputs> out = reserved(options, *project, footage->info().path);
  if (!out) return fail(out.error());
  const Result<OwnBody> found = found_in(*footage, *range, *project, options);
  if (!found) return fail(found.error());
  if (const Result<void> written = write(*out, *found, *footage, range->first); !written) return written;
  say(*found, *project);
  return {};
}

}  // namespace

std::function<Result<void>()> add_mask_command(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("mask", "find which pixels of a video show the UAV's own body");
  const auto options = std::make_shared<MaskOptions>();
  command->add_option("FILE", options->project.file, "a video, or a project (json): its footage, range and settings")
      ->required();
  add_set_option(*command, options->project);
  command->add_option("--out", options->mask, "the mask, a PNG; without it VIDEO.own-body.png in the current folder")
      ->option_text("FILE");
  const std::array<std::array<const char*, 4>, 3> settings{
      {{"--frames", "own_body.frames", "N", "how many frames are looked through; 1500 if nothing is said"},
       {"--every", "own_body.every", "K", "use each K-th of them alone"},
       {"--method", "own_body.method", "NAME", "stable or paper"}}};
  for (const auto& [option, key, text, help] : settings)
    command->add_option(option, options->settings[key], help)->option_text(text);
  command->add_option("--confidence", options->confidence, "write how sure each pixel is too: a 16-bit PNG")
      ->option_text("FILE");
  command->add_option("--stages", options->stages, "write the picture of every step into this folder")
      ->option_text("DIR");
  command->add_flag("--force", options->force, "overwrite what is there");
  add_progress_option(*command, options->progress);
  return [options] { return run(*options); };
}

}  // namespace sigs::cli
