// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "base/paths.h"
#include "base/result.h"
#include "base/threads.h"
#include "project/project.h"
#include "scene/scene.h"
#include "scene/scene_files.h"
#include "scene/visibility.h"
#include "video/frame_source.h"
#include "video/video_writer.h"

// The way from a project to a scene: validate, open the footage, open what else the project names.
namespace sigs {

// The project's first problem (project/validate.h) as an error "x.json: intruders[0].model.file: no such file".
// A project with several cameras is one too: each of them has a scene of its own (project/project.h).
// Every way from a project to a scene validates it once: open_project and open_scene by this function, `sigs check` and
// draft_scene by validate(), as they list all problems.
[[nodiscard]] Result<void> check_valid(const Project& project);

// The scene of a project that has been validated. footage: size and times of the project's video. files: files that
// were read before are taken from it. Errors name project file and field.
[[nodiscard]] Result<Scene> open_valid_scene(const Project& project, const FootageShape& footage, SceneFiles& files);

// check_valid, then open_valid_scene; without `files` all files are read anew.
[[nodiscard]] Result<Scene> open_scene(const Project& project, const FootageShape& footage, SceneFiles& files);
[[nodiscard]] Result<Scene> open_scene(const Project& project, const FootageShape& footage);

// A project that is ready for its frames to be composed.
struct OpenedProject {
  FrameSource source;
  Scene scene;
  std::vector<Warning> warnings;  // of the footage, then of the rest
};

// Validates the project and opens all that it names. Errors name the project file and the field.
//   cancel   set to true: ends soon with the error `interrupted`. May be null; must outlive the opened project.
//   footage  the project's, opened with quantisers_for() it, and moved from; null: is opened
//   files    as open_valid_scene() takes them; null: all are read anew
[[nodiscard]] Result<OpenedProject> open_project(const Project& project, const std::atomic<bool>* cancel,
                                                 FrameSource* footage = nullptr, SceneFiles* files = nullptr);

// Whether the frames of a project's footage need their quantisers: where the codec match is to be by the footage's own,
// and where groups of its pictures are encoded as the others are (codec source).
[[nodiscard]] Quantisers quantisers_for(const Project& project);

// The footage of a project: a video, or images with the times that the project states, of which footage.crop leaves a
// part. Errors and arguments are those of FrameSource::open() and crop(); they do not name the project: see
// footage_error().
[[nodiscard]] Result<FrameSource> open_footage(const Project& project, const std::atomic<bool>* cancel = nullptr,
                                               Quantisers quantisers = Quantisers::leave_out);

// An error of open_footage() with the project's file and field.
[[nodiscard]] Error footage_error(const Project& project, const Error& error);

// An error of composing a frame: with the project's file where a setting of the footage contradicts what a frame shows
// (check_spectrum() in frame/compose_frame.h), else as it is.
[[nodiscard]] Error composing_error(const Project& project, const Error& error);

// Stamp of the project's video or folder of images, under its absolute path. A pattern names no file: the stamp is that
// of the images' folder.
[[nodiscard]] FileStamp footage_stamp_of(const Project& project);

// The footage that was opened for a project whose crop leaves all of it, as this project crops it.
[[nodiscard]] Result<FrameSource> cropped_footage(FrameSource whole, const Project& project);

// What decides which frames the footage of a project has: its file, times stated, crop.
using FootageKey = std::tuple<std::string, double, std::string, int, int, int, int>;
[[nodiscard]] FootageKey footage_key(const Project& project);

// The times that settings state of footage in images; the file of times is the project's.
[[nodiscard]] SequenceTiming timing_of(const Project& project);

// What the scene of a project has to know of its footage: shape_of() with the times of the rig's clock, if it has one.
[[nodiscard]] FootageShape in_rig_time(FootageShape shape, const Project& project);
[[nodiscard]] FootageShape footage_shape(const Project& project, const VideoInfo& video);

// Warnings to be given before a video is used: its own, and that its samples are converted to 8 bits.
[[nodiscard]] std::vector<Warning> warnings_of(const VideoInfo& video);

// Warnings to be given before the frames of a scene are composed: those of the files that were read, implausible
// settings (Scene::issues), and intruders that are never visible; not the latter where other cameras may show them.
//   visibilities  of each intruder of the scene; empty: not looked at
[[nodiscard]] std::vector<Warning> warnings_of(const Project& project, const Scene& scene,
                                               const std::vector<Visibility>& visibilities);

// That none of a rig's cameras shows an intruder, by its index in the project.
[[nodiscard]] Warning visible_in_no_camera(const Project& project, std::size_t intruder);

// What becomes of the footage's coding: that the codec match has to do with a default quantiser, as neither the footage
// nor the project states one; of footage of more than 8 bits, what rounds its samples, and that there is no codec
// match.
[[nodiscard]] std::vector<Warning> codec_warnings_of(const Project& project, const VideoInfo& video);

// Number of frames sampled to find intruders that are never visible, where each is visible in one of these.
inline constexpr int kVisibilitySampleFrames = 20;

// The frames to compose: those asked for, else the scene's range. Error `usage`: they are not within that range.
[[nodiscard]] Result<FrameRange> range_in(const Scene& scene, const std::optional<FrameRange>& asked_for);

// The files that a project is read from: its own, those that its fields name, and those that its models name (MTL
// files, images). Of a model that cannot be read only the model file itself.
[[nodiscard]] std::vector<std::filesystem::path> files_read_by(const Project& project);

// check_inputs_not_overwritten() (base/paths.h) with files_read_by(project) as the inputs. Reads no file
// where none of the outputs exists.
[[nodiscard]] Result<void> check_inputs_not_overwritten(const Project& project,
                                                        const std::vector<std::filesystem::path>& outputs,
                                                        std::string_view reader = "command");

}  // namespace sigs
