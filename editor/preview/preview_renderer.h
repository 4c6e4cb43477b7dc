// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "editor/document/content_id.h"
#include "editor/preview/preview_output.h"
#include "editor/preview/preview_state.h"
#include "editor/preview/surveys.h"
#include "scene/scene_files.h"
#include "video/frame.h"

namespace sigs::editor {

// Opens revisions and composites their frames with files, models and an OpenGL context that it keeps from call to call.
// For one thread.
class SceneRenderer {
 public:
  // Opens a revision. What cannot be read is replaced by a placeholder and named in the draft's problems.
  [[nodiscard]] std::shared_ptr<const OpenedScene> opened(const Revision& revision, const ContentId& content,
                                                          std::shared_ptr<const Footage> footage);

  // A composited frame of the scene that was opened last. method: none for the project's own. Where composing fails the
  // image is the untouched footage, with the problem.
  [[nodiscard]] std::shared_ptr<const PreviewImage> image(const OpenedScene& opened, int frame,
                                                          const DecodedFrame& footage, Stages stages,
                                                          std::optional<MethodChoice> method);

  // A model that cannot be read is shown as the cross that replaces it.
  [[nodiscard]] std::shared_ptr<const ModelImage> model_image(const Project& project,
                                                              const PreviewRequest::Turntable& wanted);

 private:
  void keep(const std::shared_ptr<const Model>& model);
  void drop_unused(std::size_t in_use);

  SceneFiles files_;
  std::deque<std::shared_ptr<const Model>> drawn_;  // last used at the back; the context knows them by their address
  ComposeContext context_;
};

// The work of the rendering thread. Each step takes a snapshot of the preview state and does the first thing that is
// missing: the wanted image of the newest revision, what else the view asked for, then in turns one of the next frames,
// a slice of the survey, the image of the model. A step that opens a revision composes it too, so that edits that come
// faster than images do not stop the images.
class PreviewRenderer {
 public:
  explicit PreviewRenderer(PreviewState& preview_state) : preview_state_(preview_state) {}

  // Returns when the preview state is stopped.
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

  void check_input_files(const PreviewSnapshot& snapshot);
  void open_revision(const PreviewSnapshot& snapshot);
  [[nodiscard]] bool scene_fits() const { return scene_ && scene_->content == content_; }
  [[nodiscard]] int clamped(int frame) const;
  [[nodiscard]] std::shared_ptr<const DecodedFrame> footage_frame(int frame) const;

  PreviewState& preview_state_;
  SceneRenderer scene_renderer_;

  std::uint64_t revision_ = 0;  // whose files were looked at last
  Clock::time_point files_checked_{};
  ContentId content_;  // combined_id() of that revision and its files
  FootageId footage_;

  std::shared_ptr<const OpenedScene> scene_;
  ContentId scene_footage_;

  SurveyBuilder survey_builder_;
  ContentId survey_content_;
  bool survey_is_shown_ = false;
  Clock::time_point survey_begun_{};

  struct ModelKey {
    ContentId content;
    int intruder = 0;
    double turn_rad = 0;
    cv::Size size_px;
    [[nodiscard]] bool operator==(const ModelKey&) const = default;
  };
  std::optional<ModelKey> model_;
  int next_background_task_ = 0;
};

}  // namespace sigs::editor
