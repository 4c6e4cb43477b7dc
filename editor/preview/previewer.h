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

// What the project's video is, opened or with_preset in for by grey frames.
struct Footage {
  FootageShape shape;
  std::optional<VideoInfo> video;  // none: it could not be opened
  std::string problem;             // then, why
};

// A revision of the project, opened.
struct OpenedScene {
  std::uint64_t revision = 0;
  std::shared_ptr<const Project> project;
  std::shared_ptr<const Footage> footage;
  DraftScene draft;
};

// One composited frame, ready to be shown. revision is the one it was made of; later ones that change no image share
// it.
struct PreviewImage {
  std::uint64_t revision = 0;
  int frame = 0;
  std::optional<MethodChoice> method;  // other than the project's own, for comparing
  cv::Mat bgr;                         // CV_8UC3, what `sigs frame` writes
  cv::Mat mask;                        // CV_8UC1 or empty, as ComposedFrame::mask
  FrameTruth truth;
  std::vector<Stage> stages;  // where asked for
  std::string problem;        // not empty: bgr is the untouched footage, or another frame or grey replaces it, and
                              // this is why
  FrameTimes times;
};

// What the timeline's lanes show of one intruder; indices count the scene's frames from OpenedScene's first_frame.
struct Survey {
  std::uint64_t revision = 0;
  int first_frame = 0;
  std::vector<VisibilityEstimate> estimates;  // one a frame; grows while it is made
  std::vector<FlightState> flight;            // one a frame
  std::vector<FlightFlag> flags;
  ClosestApproach closest;
};

// A small image of a model, turning: CV_8UC4, RGBA, straight alpha.
struct ModelImage {
  std::filesystem::path file;
  double turn_rad = 0;
  cv::Mat rgba;
  glm::dvec3 size_m{0, 0, 0};  // extents along body X, Y, Z
  std::string problem;
};

// What the window wants to see. Asked anew each update; what is no longer wanted is dropped.
struct PreviewRequest {
  Revision revision;
  int frame = 0;
  int direction = 1;    // where the playhead will go: +1, -1; how far the next frames are fetched ahead is ours
  int range_first = 0;  // frames outside are not fetched ahead
  int range_last = 0;
  bool playing = false;
  bool footage = false;                      // the untouched frame too (for the wipe)
  bool stages = false;                       // stages of the frame
  std::optional<MethodChoice> compare_with;  // the same frame by another method
  struct Turntable {
    int intruder = 0;
    double turn_rad = 0;
    cv::Size size_px;
  };
  std::optional<Turntable> turntable;
};

// Bytes that are kept so that they need not be made again, by who keeps them; what is on the screen counts too. Files
// that were read, working memory and the steps of undo do not.
struct MemoryUse {
  std::size_t images = 0;    // composited frames
  std::size_t decoded = 0;   // frames of the footage
  std::size_t shown = 0;     // what the view asked for at this moment, where no cache holds it
  std::size_t textures = 0;  // the window's, as it says
  std::size_t limit = 0;     // for all of them

  [[nodiscard]] std::size_t sum() const { return images + decoded + shown + textures; }
};

// What there is to show at this moment. Pointers are never changed behind the reader's back; any may be null at first.
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
  // All of MemoryUse. Caches make room for what is shown; only that may be more.
  std::size_t cache_bytes = std::size_t(3) << 29;
  int ahead = 48;  // frames composited ahead of the playhead at most

  // What textures that are not on the screen may hold.
  [[nodiscard]] std::size_t texture_bytes() const { return cache_bytes / 16; }
};

// Opens, decodes and composes on threads of its own; every call here returns at once.
class Previewer {
 public:
  // wake  called from another thread whenever there is something new to show
  // Throws std::system_error where the system gives no threads: without them there is no editor.
  Previewer(PreviewLimits limits, std::function<void()> wake);
  ~Previewer();
  Previewer(const Previewer&) = delete;
  Previewer& operator=(const Previewer&) = delete;

  void want(const PreviewRequest& wanted);
  [[nodiscard]] PreviewOutput shown() const;

  // What the window holds in textures; the caches keep so much less.
  void set_texture_bytes(std::size_t bytes);

  // Exporting shares the machine: while set, nothing is fetched ahead.
  void set_prefetch_paused(bool paused);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sigs::editor
