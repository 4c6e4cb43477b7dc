// SPDX-License-Identifier: MIT
#include <cstdio>
#include <filesystem>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "cli/commands.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/process.h"
#include "occlusion/parallax.h"
#include "scene/opened_project.h"
#include "scene/scene_at.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kOccluderFooter =
    "Examples:\n"
    "  sigs occluder encounter.json --frame 120 --out trees.png\n"
    "  sigs occluder encounter.json --frame 120 --max-distance 400 --out trees.png --overlay look.png\n"
    "  sigs export encounter.json --set footage.occluder_mask=trees.png --set footage.occluder_frame=120 --out out";

struct OccluderOptions {
  ProjectOptions project;
  fs::path mask;
  fs::path overlay;  // empty: none
  int frame = 0;
  int span = ParallaxSettings{}.span;
  double min_parallax_px = ParallaxSettings{}.min_parallax_px;
  std::optional<double> max_m;
  bool force = false;
  std::string progress = "auto";
};

// The frame with the mask tinted over it.
cv::Mat overlay_of(const Frame& frame, const cv::Mat& mask) {
  cv::Mat image = bgr_of(frame);
  cv::Mat tinted;
  cv::addWeighted(image, 0.5, cv::Mat(image.size(), CV_8UC3, cv::Scalar(60, 60, 255)), 0.5, 0, tinted);
  tinted.copyTo(image, mask);
  return image;
}

// The camera and its motion need no intruder: those of the project are left out, with their errors.
Result<OpenedProject> opened_without_intruders(const OccluderOptions& options) {
  Result<Project> project = project_of(options.project);
  if (!project) return fail(project.error());
  project->intruders.clear();
  project->footage.occluder_mask.clear();
  project->footage.own_body_mask.clear();
  return open_project(*project, &interrupt_flag());
}

Result<NearScenery> scenery_in(OpenedProject& opened, const OccluderOptions& options) {
  const Scene& scene = opened.scene;
  const auto count = static_cast<int>(scene.footage.times_s.size());
  if (options.frame >= count)
    return fail("--frame", "the footage has " + std::to_string(count) + " frames, counted from 0", ErrorKind::usage);
  const CameraPoseAt pose_at = [&](int frame) {
    return camera_at(scene.motion, time_of_frame_s(scene.footage, frame));
  };
  Progress progress(options.progress);
  return near_scenery(opened.source, scene.camera, pose_at,
                      {.frame = options.frame,
                       .span = options.span,
                       .min_parallax_px = options.min_parallax_px,
                       .max_m = options.max_m},
                      {.progress = progress.counter(), .cancel = &interrupt_flag()});
}

Result<void> run(const OccluderOptions& options) {
  defer_interrupts();
  Result<OpenedProject> opened = opened_without_intruders(options);
  if (!opened) return fail(opened.error());
  CreatedFolders folders;
  OutputFiles files(options.force);
  for (const fs::path& path : {options.mask, options.overlay}) {
    if (path.empty()) continue;
    if (const Result<void> made = folders.make(path.parent_path()); !made) return made;
    if (const Result<void> reserved = files.reserve(path); !reserved) return reserved;
  }
  if (options.max_m && !opened->scene.motion.path && opened->scene.motion.speed_mps == 0)
    return fail("--max-distance", "needs the camera's way: a track with positions, or camera.speed_mps",
                ErrorKind::usage);
  const Result<NearScenery> found = scenery_in(*opened, options);
  if (!found) return fail(found.error());
  const auto overlay = [&]() -> Result<std::string> {
    const Result<Frame> frame = opened->source.read(options.frame);
    return frame ? Result<std::string>(png_bytes(overlay_of(*frame, found->mask))) : fail(frame.error());
  };
  const Result<void> written =
      files.write_and_commit({{options.mask, [&] { return png_bytes(found->mask); }}, {options.overlay, overlay}});
  if (!written) return written;
  print_written(files.final_paths());
  for (const Warning& warning : found->warnings) print_warning(warning);
  const double share = static_cast<double>(cv::countNonZero(found->mask)) / static_cast<double>(found->mask.total());
  std::fprintf(stderr, "occluder: %.1f %% of the image; parallax up to %.1f px in %d frames, seen in %.0f %% of it\n",
               100 * share, found->largest_parallax_px, options.span, 100 * found->known_share);
  return {};
}

}  // namespace

Command add_occluder_command(CLI::App& program) {
  CLI::App* const command =
      program.add_subcommand("occluder", "find what stands near the camera and hides what is farther away");
  const auto options = std::make_shared<OccluderOptions>();
  add_project_options(*command, options->project);
  add_value(*command, "--frame", options->frame, "N", "frame of the footage that the mask is made of, from 0")
      ->check(CLI::Range(0, 1'000'000'000));
  add_number(*command, "--span", options->span, "N", 1, 100'000,
             "frames before and after it that are compared with it");
  add_value(*command, "--min-parallax", options->min_parallax_px, "PX", "px against infinity within the span: near")
      ->capture_default_str()
      ->check(from_to(0.01, 1e4));
  add_range(*command, "--max-distance", options->max_m, "M", 0.1, 1e7,
            "instead: what is nearer than this, by the camera's way");
  add_output(*command, "--out", options->mask, "the mask, a PNG")->required();
  add_output(*command, "--overlay", options->overlay, "the frame with the mask tinted over it, a PNG");
  command->add_flag("--force", options->force, "overwrite what is there");
  add_progress_option(*command, options->progress);
  command->footer(kOccluderFooter);
  return [options] { return run(*options); };
}

}  // namespace sigs::cli
