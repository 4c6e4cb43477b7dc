// SPDX-License-Identifier: MIT
#include "cli/frame_command.h"

#include <cstdio>
#include <fstream>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <utility>

#include "base/partial_file.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "export.h"
#include "frame.h"
#include "video/frame_source.h"

namespace sigs::cli {

namespace {

struct FrameOptions {
  ProjectOptions project;
  std::filesystem::path folder = ".";
  int frame = 0;
  bool stages = false;
  bool force = false;
};

Result<void> write_picture(const std::filesystem::path& path, const cv::Mat& picture, bool overwrite) {
  std::vector<uchar> bytes;
  cv::imencode(".png", picture, bytes);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (const Result<void> written = write_text(path, text, overwrite); !written) return written;
  std::printf("%s\n", path.c_str());
  return {};
}

Result<ComposedFrame> composed(const FrameOptions& options) {
  const Result<Project> project = project_of(options.project);
  if (!project) return fail(project.error());
  Result<FrameSource> source = FrameSource::open(resolved(*project, project->footage.video));
  if (!source) return fail(project->file.string() + ": footage.video", source.error().text(), source.error().kind);
  const int count = source->info().frame_count();
  if (options.frame < 0 || options.frame >= count)
    return fail("--frame " + std::to_string(options.frame), "the footage has frames 0 to " + std::to_string(count - 1),
                ErrorKind::usage);
  const Result<Scene> scene = open_scene(*project, shape_of(source->info()));
  if (!scene) return fail(scene.error());
  for (const Warning& warning : scene->warnings) print_warning(warning);
  Result<Frame> background = source->read(options.frame);
  if (!background) return fail(background.error());
  Bench bench;
  return compose_frame(*scene, options.frame, std::move(*background), bench,
                       options.stages ? Stages::keep : Stages::leave_out);
}

Result<void> run(const FrameOptions& options) {
  const Result<ComposedFrame> frame = composed(options);
  if (!frame) return fail(frame.error());
  defer_interrupts();
  std::error_code code;
  std::filesystem::create_directories(options.folder, code);
  if (code) return fail(options.folder.string(), "cannot be created: " + code.message(), ErrorKind::cannot_create);
  const std::string base = "frame_" + std::to_string(options.frame);
  Result<void> step = write_picture(options.folder / (base + ".png"), bgr_of(frame->picture), options.force);
  for (std::size_t i = 0; step && i < frame->stages.size(); ++i) {
    const std::string number = (i < 10 ? "0" : "") + std::to_string(i);
    step = write_picture(options.folder / (base + "_" + number + "_" + frame->stages[i].name + ".png"),
                         frame->stages[i].picture, options.force);
  }
  return step;
}

}  // namespace

std::function<Result<void>()> add_frame_command(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("frame", "write one composited frame as PNG");
  const auto options = std::make_shared<FrameOptions>();
  add_project_options(*command, options->project);
  command->add_option("--frame", options->frame, "which one, counted from 0 in the footage")
      ->required()
      ->option_text("N");
  command->add_option("--out", options->folder, "folder to write into; made where it is not there")
      ->capture_default_str()
      ->check(output_path());
  command->add_flag("--stages", options->stages, "write every intermediate picture too");
  command->add_flag("--force", options->force, "overwrite what is there");
  return [options] { return run(*options); };
}

}  // namespace sigs::cli
