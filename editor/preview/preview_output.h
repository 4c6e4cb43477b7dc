// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "editor/document/document.h"
#include "editor/geometry/shown_image.h"
#include "encounter/encounter.h"
#include "frame/compose_frame.h"
#include "project/project.h"
#include "scene/draft.h"
#include "scene/flight.h"
#include "scene/scene.h"
#include "scene/visibility.h"
#include "truth/annotation.h"
#include "video/frame_source.h"

namespace sigs::editor {

// What the timeline and the inspector show of an intruder's encounter with the camera, known without rendering.

// The volumes that the editor shows: those of export.encounter that there are, in its order; `small-uas` where it names
// none.
[[nodiscard]] std::vector<WellClearVolume> shown_volumes(const Project& project);

// From one moment to another, in frames of the footage with fractions, and in seconds.
struct LossStretch {
  double first_frame = 0;
  double last_frame = 0;
  TimeInterval time_s;
  // False: it is lost in the first frame, or in the last one, already; what comes before or after is not known.
  bool has_entry = true;
  bool has_exit = true;

  // The first and the last whole frame within; the nearest one where there is none.
  [[nodiscard]] int entry_frame() const;
  [[nodiscard]] int exit_frame() const;
};

struct VolumeLosses {
  WellClearVolume volume;
  std::vector<LossStretch> losses;  // by time
};

struct EncounterSurvey {
  NearestMoment nearest;  // by horizontal distance
  double nearest_frame = 0;
  std::vector<VolumeLosses> volumes;  // those of shown_volumes()
  // One a frame each, from first_frame on. tau_mod is that of the first volume; infinite where the distance does not
  // fall.
  int first_frame = 0;
  std::vector<double> horizontal_range_m;
  std::vector<double> tau_mod_s;

  // Whether the frame lies within a loss of the volume with this index.
  [[nodiscard]] bool is_lost(std::size_t volume, double frame) const;
};

// Over the scene's frames.
//   intruder  index in Scene::intruders
//   volumes   one at least
// Places that are not finite: no losses, and no values.
[[nodiscard]] EncounterSurvey encounter_survey(const Scene& scene, int intruder,
                                               const std::vector<WellClearVolume>& volumes);

// The frames that the playhead, waypoints and the timeline count: those of the first camera of a rig, else those of the
// footage itself. At what time each is, and which of them the project uses, both included. The scene must outlive it.
struct CountedFrames {
  const FootageShape& footage;
  int first_frame = 0;
  int last_frame = 0;
};
[[nodiscard]] CountedFrames counted_frames(const Scene& scene);
// Those of them at whose time the scene's own camera films; one at least.
[[nodiscard]] CountedFrames filmed_frames(const Scene& scene);
// The frame of the scene's own footage that is nearest in time to a counted one, and the reverse; within what there is.
[[nodiscard]] int own_frame_at(const Scene& scene, double counted_frame);
[[nodiscard]] int counted_frame_at(const Scene& scene, int own_frame);

// The footage of a project: a video that was opened, or grey frames that replace it. Immutable and shared between
// threads.
struct Footage {
  // Size and times of the frames. For footage that was opened in vain it is filled by footage_for().
  FootageShape shape;
  // None: it could not be opened; `problem` says why. Where there is a video, problem is "".
  std::optional<VideoInfo> video;
  std::string problem;
};

// A revision of the project with all that it names opened, as far as it can be. Made by the rendering thread, then
// immutable and shared with the window.
struct OpenedScene {
  std::uint64_t revision = 0;  // Revision::number
  ContentId content;  // combined_id() of the project's settings and its files: images with this id show this scene
  std::shared_ptr<const Project> project;
  std::shared_ptr<const Footage> footage;
  DraftScene draft;  // the scene, with placeholders for what cannot be read, and its problems
};

// One composited frame, ready to be shown. It belongs to all revisions with the same content; `revision` is the number
// of the first of them.
struct PreviewImage {
  std::uint64_t revision = 0;
  int frame = 0;  // of the footage, from 0
  // Set where it was composited by another method than the project's own, for comparing.
  std::optional<MethodChoice> method;
  // Of the footage's size: what `sigs frame` writes, converted and in one piece (CV_8UC3) where it was made with stages
  // or by another method than the project's own.
  PatchedImage bgr;
  cv::Mat mask;  // opacity of the intruders: CV_8UC1 or empty, as ComposedFrame::mask
  FrameTruth truth;
  std::vector<Stage> stages;  // intermediate images; empty unless they were asked for
  std::string problem;  // why bgr is the untouched footage, another frame or grey; "" where it is the frame itself
  FrameTimes times;
};

// The camera's attitude in the world in one frame, for curves.
struct CameraTurn {
  Attitude attitude;           // yaw goes on beyond 180 degrees where the camera turns on
  std::optional<Attitude> sd;  // standard deviations of the three angles; none where they are not known
};

// What the lanes of the timeline show of one intruder, frame by frame, known without rendering. Index 0 is first_frame.
struct Survey {
  std::uint64_t revision = 0;
  int first_frame = 0;  // the scene's first frame, as a frame of the footage
  // One a frame each; fewer while the survey is being made. Both are empty for an intruder without waypoints.
  std::vector<VisibilityEstimate> estimates;
  std::vector<FlightState> flight;
  // Of the camera, one a frame too; empty where nothing turns it, there for an intruder without waypoints too.
  std::vector<CameraTurn> camera;
  // Known once all frames are there: where the flight exceeds a limit, and where it is nearest to the camera.
  std::vector<FlightFlag> flags;
  ClosestApproach closest;
  // Null: not asked for, or not made yet; also for an intruder without waypoints.
  std::shared_ptr<const EncounterSurvey> encounter;
};

// A small image of an intruder's model by itself, as turntable_image() draws it.
struct ModelImage {
  std::filesystem::path file;
  double turn_rad = 0;         // about the model's vertical axis, positive to the right, as yaw
  cv::Mat rgba;                // CV_8UC4, straight alpha; empty where it could not be drawn
  glm::dvec3 size_m{0, 0, 0};  // extents along body X, Y, Z
  std::string problem;         // why it is a cross or empty; "" where it is the model
};

// What the window wants to show. It is sent in each update; work that is no longer wanted is dropped. All frames are
// indices of the footage, from 0.
struct PreviewRequest {
  Revision revision;
  int frame = 0;
  int direction = 1;  // +1 or -1: towards later or earlier frames, which are then composited ahead
  // Frames outside of the range, both ends included, are not composited ahead.
  int range_first = 0;
  int range_last = 0;
  bool playing = false;                      // whether the frames ahead go on at the range's other end
  bool image = true;                         // the composited frame is wanted; false: the scene and its surveys alone
  bool footage = false;                      // the untouched frame is wanted too (for the wipe)
  bool stages = false;                       // images of all stages of the frame are wanted too
  std::optional<MethodChoice> compare_with;  // the same frame by another method is wanted too
  // An image of the model of one of the project's intruders, by index, of that size.
  struct Turntable {
    int intruder = 0;
    double turn_rad = 0;
    cv::Size size_px;

    [[nodiscard]] bool operator==(const Turntable&) const = default;
  };
  std::optional<Turntable> turntable;
  bool encounters = false;  // Survey::encounter is wanted too

  [[nodiscard]] bool operator==(const PreviewRequest&) const = default;
};

// Bytes of images that are kept to be shown (again), by where they are kept. Files that were read, working memory and
// the steps of undo do not count.
struct MemoryUse {
  std::size_t images = 0;    // composited frames in the cache
  std::size_t decoded = 0;   // frames of the footage in the cache
  std::size_t shown = 0;     // what the view shows or asks for at this moment, where no cache holds it
  std::size_t textures = 0;  // on the graphics card with the images they are made of, as the window says
  std::size_t limit = 0;     // PreviewLimits::cache_bytes: for all of them together

  [[nodiscard]] std::size_t sum() const { return images + decoded + shown + textures; }
};

// What there is to show at this moment. What the pointers point to never changes; each of them may be null at first.
// One output may hold results of different revisions, as their numbers or content say.
struct PreviewOutput {
  std::shared_ptr<const OpenedScene> scene;  // the newest revision that is open
  // Of the wanted frame and content where image_is_current, else the last that could be shown.
  std::shared_ptr<const PreviewImage> image;
  bool image_is_current = false;  // exactly what was wanted
  // The wanted frame untouched; null: not there yet, or not asked for.
  std::shared_ptr<const ShownImage> footage;
  // The wanted frame with its stages, and by the method of compare_with; null as above.
  std::shared_ptr<const PreviewImage> staged;
  std::shared_ptr<const PreviewImage> compared;
  std::vector<std::shared_ptr<const Survey>> surveys;  // one for each of the project's intruders, null: not yet
  std::shared_ptr<const ModelImage> model;
  // By frame of the footage: whether it is composited and in the cache, for the wanted content.
  std::vector<bool> cached;
  bool opening = false;   // the wanted footage is still being opened; the scene is the one before, or null
  double compose_ms = 0;  // time that composing the newest wanted image took
  bool busy = false;      // something that is wanted is still being made, or frames are being made ahead
  MemoryUse memory;
};

struct PreviewLimits {
  // Limit for all of MemoryUse. Caches give way to what is shown; only that may exceed the limit.
  std::size_t cache_bytes = std::size_t(3) << 29;
  int ahead = 48;  // how many frames are composited ahead of the playhead at most

  // Limit for textures that are not on the screen.
  [[nodiscard]] std::size_t texture_bytes() const { return cache_bytes / 16; }
};

}  // namespace sigs::editor
