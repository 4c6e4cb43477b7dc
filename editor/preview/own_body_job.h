// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "editor/preview/rate_meter.h"
#include "occlusion/detect.h"

namespace sigs::editor {

// What is looked through, and how.
struct DetectionRequest {
  std::filesystem::path video;
  int first_frame = 0;
  OwnBodySettings settings;

  [[nodiscard]] bool operator==(const DetectionRequest&) const = default;
};

// The engine's detection in a video of its own; stages are kept.
[[nodiscard]] Result<OwnBody> detected(const DetectionRequest& request, const DetectionControl& control);

enum class DetectionPhase { none, running, done, cancelled, failed };

// A detection as it stands.
struct DetectionState {
  DetectionPhase phase = DetectionPhase::none;
  bool is_stopping = false;  // running, and asked to stop
  int done = 0;              // frames passed
  int total = 0;             // 0: not known yet
  std::optional<double> left_s;
  DetectionRequest request;              // the last one
  Error error;                           // of phase failed
  std::shared_ptr<const OwnBody> found;  // by the last one that came to its end; null: none has
  DetectionRequest found_by;             // what that was asked

  [[nodiscard]] bool is_running() const { return phase == DetectionPhase::running; }
};

// Finds the own body in the background, one detection at a time, at low priority: the window and its images come
// first.
class OwnBodyJob {
 public:
  using Detect = std::function<Result<OwnBody>(const DetectionRequest&, const DetectionControl&)>;

  // wake  called from the detection's thread as it goes on, some ten times a second, and at the end
  explicit OwnBodyJob(std::function<void()> wake, Detect detect = detected);
  ~OwnBodyJob();  // stops it
  OwnBodyJob(const OwnBodyJob&) = delete;
  OwnBodyJob& operator=(const OwnBodyJob&) = delete;

  // False, and nothing happens, while one is running. Where no thread can be had it has failed at once, and says so.
  bool start(DetectionRequest request);
  void cancel();
  // What was found is no longer of use, nor what is being looked for.
  void forget();
  [[nodiscard]] bool is_running() const;
  [[nodiscard]] DetectionState state() const;

 private:
  void run(const DetectionRequest& request);
  void note(int done, int total);
  void finish(Result<OwnBody> result);

  std::function<void()> wake_;
  Detect detect_;
  mutable std::mutex mutex_;
  DetectionState state_;
  RateMeter rate_;
  double last_wake_s_ = 0;  // when the window was woken last
  bool forget_ = false;
  std::atomic<bool> cancel_{false};
  std::thread thread_;
};

}  // namespace sigs::editor
