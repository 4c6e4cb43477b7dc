// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/staged_outputs.h"
#include "export/frame_renderer.h"
#include "project/project.h"
#include "scene/scene_files.h"
#include "scene/visibility.h"
#include "truth/annotation.h"
#include "video/frame_source.h"
#include "video/video_writer.h"

namespace sigs {

// What follows the project's name in the file that sums its encounters up (engine/export/export_files.h).
inline constexpr std::string_view kEncounterSuffix = ".encounter.json";

struct ExportRequest {
  Project project;
  std::filesystem::path folder;      // created if it is missing
  std::optional<FrameRange> frames;  // none: the project's own range; numbers are the footage's
  int jobs = 1;                      // frames composed in parallel; the bytes do not depend on it
  bool overwrite = false;
  // Open descriptors of the process that are written to frame by frame; -1: none. docs/streams.md.
  int video_descriptor = -1;       // the video goes there, as nut or y4m, and no file is written
  int labels_descriptor = -1;      // JSON lines, each before its frame's image
  bool in_real_time = false;       // no frame goes out before its time has passed since the first one
  FrameSource* footage = nullptr;  // the project's, as open_project() takes it; null: is opened
  SceneFiles* files = nullptr;     // likewise; null: all are read anew
  // Takes the finished outputs, which get their final names with its commit(); null: each gets its name at the end.
  StagedOutputs* outputs = nullptr;
  std::function<void(const FrameTruth&)> see_truth = {};  // called with the truth of each frame, in order; empty: not
};

// Seconds spent in each stage, added up over frames (stages run in parallel).
struct StageTimes {
  double decode_s = 0;
  double draw_s = 0;
  double composite_s = 0;
  double encode_s = 0;
  double wall_s = 0;
};

struct ExportReport {
  std::vector<std::filesystem::path> written;
  std::vector<Warning> warnings;
  int frames = 0;
  int damaged_frames = 0;
  int copied_frames = 0;  // of the codec source: their packets are the footage's
  StageTimes times;
  std::vector<Visibility> visibilities;  // of each intruder in the frames written, by the truth
  std::string renderer_description;      // what Renderer::description says; empty: no intruder came into view
};

struct ExportControl {
  std::function<void(int done, int total)> progress;  // called from the calling thread after each frame
  std::function<void(const Warning&)> warn;           // as soon as something is known
  const std::atomic<bool>* cancel = nullptr;          // set: stops soon with error interrupted, and leaves no file
};

// All frames of a project: NAME.mkv (or the container asked for; for png, tiff and jpeg a folder NAME of images),
// NAME.masks.mkv (or a folder NAME.masks), labels such as NAME.xml and, where encounters are asked for,
// NAME.encounter.json. Each appears under its final name only when all are complete. With a video_descriptor none of
// them is written, and the frames that have gone out before an error or an interruption stay with the reader.
[[nodiscard]] Result<ExportReport> export_project(const ExportRequest& request, const ExportControl& control);

// The same for a request of a single frame, with a renderer that keeps footage, models and OpenGL from call to call.
// The bytes are those of export_project(); an intruder that is not in the picture gives no warning.
[[nodiscard]] Result<ExportReport> export_frame(const ExportRequest& request, FrameRenderer& renderer,
                                                const ExportControl& control);

// What follows the project's name in the files with the truth of a rig (rig/rig_truth.h).
inline constexpr std::string_view kRigSuffix = ".rig.json";
inline constexpr std::string_view kRigTableSuffix = ".rig.csv";

struct RigReport {
  std::vector<std::filesystem::path> written;
  std::vector<ExportReport> cameras;  // in the project's order
};

// export_project() of each camera of a project with several, as NAME.CAMERA.mkv and so on, and NAME.rig.json and
// NAME.rig.csv with what they see together. Cameras of the same footage are exported at the same time with one decoder,
// the others one after the other; models and calibrations are read once. The files of a camera get their names when
// that is complete, those of the rig last.
//   request  its frames count those of the first camera; the others have the frames of the same time. Its streams,
//            footage and files have no meaning
//   control  progress counts the frames of all cameras; warnings name the camera's project
// Errors as those of export_project().
[[nodiscard]] Result<RigReport> export_rig(const ExportRequest& request, const ExportControl& control);

// The label formats asked for that name an image for each frame where a video is written and no images: "coco, yolo".
// Empty: none.
[[nodiscard]] std::string labels_without_images(const ExportSettings& output);

// The container that a project is exported into. auto: mkv for ffv1, mp4 for h264, hevc and av1, avi for mjpeg, nut for
// raw, the footage's own for source; mkv in place of avi, which has no times, where a frame lies more than 1 ms beside
// the nominal rate. Images: of no meaning.
[[nodiscard]] Container container_of(const ExportSettings& output, const VideoInfo& footage);

// Errors in a project's outputs that only the footage can show: h264 of an odd size, avi or y4m, which have no times,
// for frames that are not evenly spaced; source for footage that cannot be copied in part. Names the field.
[[nodiscard]] Result<void> check_output(const Project& project, const VideoInfo& footage);

}  // namespace sigs
