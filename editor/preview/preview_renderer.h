// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "editor/preview/content_id.h"
#include "editor/preview/preview_state.h"
#include "editor/preview/scene_renderer.h"
#include "editor/preview/survey_builder.h"

namespace sigs::editor {

// The rendering thread's work. Each step looks at what is wanted by then and does the first thing that is missing:
// the newest revision's wanted image, what else the view asked for, and in turns the next frames, the survey and
// the model. A step that opens a revision composes it too, so edits that come faster than images starve nothing.
class PreviewRenderer {
 public:
  explicit PreviewRenderer(PreviewState& preview_state) : preview_state_(preview_state) {}

  // Until the preview state says stop.
  void run();

 private:
  using Clock = std::chrono::steady_clock;

  // Each returns whether there was anything to do.
  bool step(const PreviewSnapshot& snapshot);
  bool render_requested(const PreviewSnapshot& snapshot);
  bool render_extras(const PreviewSnapshot& snapshot);
  bool prefetch(const PreviewSnapshot& snapshot);
  bool survey();
  bool render_turntable(const PreviewSnapshot& snapshot);
  bool compose(int frame, bool was_wanted);

  void identify_revision(const PreviewSnapshot& snapshot);
  void open_revision(const PreviewSnapshot& snapshot);
  [[nodiscard]] bool scene_fits() const { return scene_ && scene_state_ == state_; }
  [[nodiscard]] int clamped(int frame) const;
  [[nodiscard]] std::shared_ptr<const DecodedFrame> footage_frame(int frame) const;

  PreviewState& preview_state_;
  SceneRenderer scene_renderer_;
  IdTable<ContentId> content_ids_;
  IdTable<FileStamp> footage_ids_;

  std::uint64_t revision_ = 0;  // that was named last
  Clock::time_point named_{};
  std::uint64_t state_ = 0;
  FootageId footage_;

  std::shared_ptr<const OpenedScene> scene_;
  std::uint64_t scene_state_ = 0;
  std::uint64_t scene_footage_ = 0;

  SurveyBuilder survey_builder_;
  std::uint64_t survey_state_ = 0;
  bool survey_is_shown_ = false;
  Clock::time_point survey_begun_{};

  struct ModelKey {
    std::uint64_t state = 0;
    int intruder = 0;
    double turn_rad = 0;
    cv::Size size_px;
    [[nodiscard]] bool operator==(const ModelKey&) const = default;
  };
  std::optional<ModelKey> model_;
  int next_background_task_ = 0;
};

}  // namespace sigs::editor
