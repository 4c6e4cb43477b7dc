// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "editor/document/document.h"
#include "frame/compose_frame.h"
#include "scene/draft.h"
#include "scene/flight.h"
#include "scene/visibility.h"
#include "truth/annotation.h"
#include "video/frame_source.h"

namespace sigs::editor {

// The footage of a project: a video that was opened, or grey frames that replace it.
struct Footage {
  FootageShape shape;
  std::optional<VideoInfo> video;  // none: it could not be opened
  std::string problem;             // why there is no video; "" where there is one
};

// A revision of the project with all that it names opened, as far as it can be.
struct OpenedScene {
  std::uint64_t revision = 0;
  ContentId content;  // combined_id() of the project and its files
  std::shared_ptr<const Project> project;
  std::shared_ptr<const Footage> footage;
  DraftScene draft;
};

// One composited frame, ready to be shown. It belongs to all revisions with the same content; `revision` is the first
// of them.
struct PreviewImage {
  std::uint64_t revision = 0;
  int frame = 0;
  std::optional<MethodChoice> method;  // other than the project's own, for comparing
  cv::Mat bgr;                         // CV_8UC3, what `sigs frame` writes
  cv::Mat mask;                        // CV_8UC1 or empty, as ComposedFrame::mask
  FrameTruth truth;
  std::vector<Stage> stages;  // where asked for
  std::string problem;        // why bgr is the untouched footage, another frame or grey; "" where it is itself
  FrameTimes times;
};

// What the lanes of the timeline show of one intruder, frame by frame. Index 0 is first_frame.
struct Survey {
  std::uint64_t revision = 0;
  int first_frame = 0;
  std::vector<VisibilityEstimate> estimates;  // one a frame; fewer while the survey is being made
  std::vector<FlightState> flight;            // one a frame
  std::vector<FlightFlag> flags;
  ClosestApproach closest;
};

// A small image of a turned model.
struct ModelImage {
  std::filesystem::path file;
  double turn_rad = 0;
  cv::Mat rgba;                // CV_8UC4, straight alpha
  glm::dvec3 size_m{0, 0, 0};  // extents along body X, Y, Z
  std::string problem;
};

// What the window wants to show. It is sent in each update; work that is no longer wanted is dropped.
struct PreviewRequest {
  Revision revision;
  int frame = 0;
  int direction = 1;    // +1 or -1: towards later or earlier frames, which are then composited ahead
  int range_first = 0;  // frames outside of the range are not composited ahead
  int range_last = 0;
  bool playing = false;
  bool footage = false;                      // the untouched frame too (for the wipe)
  bool stages = false;                       // images of all stages of the frame too
  std::optional<MethodChoice> compare_with;  // the same frame by another method
  struct Turntable {
    int intruder = 0;
    double turn_rad = 0;
    cv::Size size_px;

    [[nodiscard]] bool operator==(const Turntable&) const = default;
  };
  std::optional<Turntable> turntable;

  [[nodiscard]] bool operator==(const PreviewRequest&) const = default;
};

// Bytes of images that are kept to be shown (again), by where they are kept. Files that were read, working memory and
// the steps of undo do not count.
struct MemoryUse {
  std::size_t images = 0;    // composited frames
  std::size_t decoded = 0;   // frames of the footage
  std::size_t shown = 0;     // what the view asked for at this moment, where no cache holds it
  std::size_t textures = 0;  // the window's, as it says
  std::size_t limit = 0;     // for all of them

  [[nodiscard]] std::size_t sum() const { return images + decoded + shown + textures; }
};

// What there is to show at this moment. What the pointers point to never changes; each of them may be null at first.
struct PreviewOutput {
  std::shared_ptr<const OpenedScene> scene;            // newest revision that is open
  std::shared_ptr<const PreviewImage> image;           // of the wanted frame and revision, else the best there is
  bool image_is_current = false;                       // exactly what was wanted
  std::shared_ptr<const cv::Mat> footage;              // the wanted frame untouched, BGR; null: not there (yet)
  std::shared_ptr<const PreviewImage> staged;          // the wanted frame with its stages
  std::shared_ptr<const PreviewImage> compared;        // by compare_with
  std::vector<std::shared_ptr<const Survey>> surveys;  // one for each of the project's intruders, null: not yet
  std::shared_ptr<const ModelImage> model;
  std::vector<bool> cached;  // by frame: composited and in memory, of the newest revision
  bool opening = false;      // the wanted footage is still being opened; the scene is the one before, or null
  double compose_ms = 0;     // of the newest image
  bool busy = false;
  MemoryUse memory;
};

struct PreviewLimits {
  // Limit for all of MemoryUse. Caches give way to what is shown; only that may exceed the limit.
  std::size_t cache_bytes = std::size_t(3) << 29;
  int ahead = 48;  // frames composited ahead of the playhead at most

  // Limit for textures that are not on the screen.
  [[nodiscard]] std::size_t texture_bytes() const { return cache_bytes / 16; }
};

}  // namespace sigs::editor
