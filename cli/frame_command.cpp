// SPDX-License-Identifier: MIT
#include "cli/commands.h"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "base/paths.h"
#include "base/threads.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/process.h"
#include "export/export_project.h"
#include "frame/compose_frame.h"
#include "scene/opened_project.h"
#include "scene/scene_files.h"
#include "scene/visibility.h"
#include "video/frame_source.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

struct FrameOptions {
  ProjectOptions project;
  std::filesystem::path out = ".";  // a folder, or a PNG
  int frame = 0;
  bool stages = false;
  bool force = false;
};

// Reads a frame of the footage while OpenGL is made ready on this thread, where an intruder is in view. If OpenGL
// fails, the frame's error gives the reason.
Result<Frame> background_of(FrameSource& source, const Scene& scene, int frame, ComposeContext& context) {
  const bool draws = any_in_view(scene, frame);
  std::optional<Result<Frame>> background;
  Result<std::thread> reading = started_thread([&] { background = guarded([&] { return source.read(frame); }); });
  if (draws) static_cast<void>(guarded([&] { return context.renderer(); }));
  if (!reading) return source.read(frame);
  reading->join();
  return *std::move(background);
}

Result<ComposedFrame> composed(const Project& project, const FrameOptions& options) {
  Result<FrameSource> source = open_footage(project, nullptr, quantisers_for(project));
  if (!source) return fail(footage_error(project, source.error()));
  const int count = source->info().frame_count();
  if (options.frame < 0 || options.frame >= count)
    return fail(fmt::format("--frame {}", options.frame), fmt::format("the footage has frames 0 to {}", count - 1),
                ErrorKind::usage);
  const Result<Scene> scene = open_scene(project, footage_shape(project, source->info()));
  if (!scene) return fail(scene.error());
  const std::vector<Visibility> visibilities = estimated_visibilities(*scene, kVisibilitySampleFrames);
  for (const Warning& warning : warnings_of(project, *scene, visibilities)) print_warning(warning);
  for (const Warning& warning : codec_warnings_of(project, source->info())) print_warning(warning);
  ComposeContext context;
  Result<Frame> background = background_of(*source, *scene, options.frame, context);
  if (!background) return fail(background.error());
  if (background->damaged)
    print_warning({source->info().path.string(),
                   fmt::format("frame {} is damaged; another frame of the footage stands in for it", options.frame)});
  Result<ComposedFrame> composed = compose_frame(*scene, options.frame, std::move(*background), context,
                                                 options.stages ? Stages::keep : Stages::leave_out);
  if (!composed) return fail(composing_error(project, composed.error()));
  return composed;
}

using NamedImages = std::vector<std::pair<fs::path, cv::Mat>>;

// The frame's own file: the one that is named, else frame_N.png in the folder that is. A folder there is one, whatever
// its name.
fs::path image_path(const FrameOptions& options) {
  if (lower_extension(options.out) == ".png" && !fs::is_directory(options.out)) return options.out;
  return options.out / fmt::format("frame_{}.png", options.frame);
}

// By their final names; those of the stages begin as the frame's does.
NamedImages stage_images(const ComposedFrame& frame, const fs::path& path) {
  NamedImages images{{path, frame.image.bit_depth > 8 ? bgr16_of(frame.image) : bgr_of(frame.image)}};
  for (std::size_t i = 0; i < frame.stages.size(); ++i)
    images.emplace_back(
        path.parent_path() / fmt::format("{}_{:02}_{}.png", path.stem().string(), i, frame.stages[i].name),
        frame.stages[i].image);
  return images;
}

Result<void> write(const NamedImages& images, const Project& project, bool overwrite) {
  std::vector<fs::path> paths;
  for (const auto& [path, image] : images) paths.push_back(path);
  if (const Result<void> kept = check_inputs_not_overwritten(project, paths); !kept) return kept;
  OutputFiles files(overwrite);
  for (const auto& [path, image] : images)
    if (const Result<void> step = files.write(path, image); !step) return step;
  if (const Result<void> done = files.commit(); !done) return done;
  print_written(files.final_paths());
  return {};
}

Result<void> run(const FrameOptions& options) {
  const Result<Project> project = project_of(options.project);
  if (!project) return fail(project.error());
  const Result<ComposedFrame> frame = composed(*project, options);
  if (!frame) return fail(frame.error());
  defer_interrupts();
  const fs::path path = image_path(options);
  CreatedFolders folders;
  if (const Result<void> made = folders.make(path.has_parent_path() ? path.parent_path() : fs::path(".")); !made)
    return made;
  return write(stage_images(*frame, path), *project, options.force);
}

}  // namespace

Command add_frame_command(CLI::App& program) {
  CLI::App* const command = program.add_subcommand("frame", "write one composited frame as PNG");
  const auto options = std::make_shared<FrameOptions>();
  add_project_options(*command, options->project);
  command->add_option("--frame", options->frame, "which one, counted from 0 in the footage")
      ->required()
      ->option_text("N");
  command->add_option("--out", options->out, "a PNG, or a folder to write into; made where it is not there")
      ->capture_default_str()
      ->check(output_path());
  command->add_flag("--stages", options->stages, "write every intermediate image too");
  command->add_flag("--force", options->force, "overwrite what is there");
  return [options] { return run(*options); };
}

}  // namespace sigs::cli
