// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <optional>

#include "editor/document/content_id.h"
#include "editor/preview/opened_footage.h"
#include "editor/preview/preview_output.h"
#include "editor/preview/preview_state.h"
#include "editor/preview/surveys.h"
#include "scene/scene_files.h"
#include "video/frame.h"

namespace sigs::editor {

// Opens revisions and composites their frames with files, models and an OpenGL context that it keeps from call to call,
// so that an edit reads and uploads only what it changed. All calls come from one thread: the OpenGL context belongs to
// it.
class SceneRenderer {
 public:
  // Opens a revision; never null. What cannot be read is replaced by a placeholder and named in the draft's problems.
  // Models of earlier scenes are kept up to a number, so that undo does not read them again.
  //   content  combined_id() of the revision and its files
  [[nodiscard]] std::shared_ptr<const OpenedScene> opened(const Revision& revision, const ContentId& content,
                                                          std::shared_ptr<const Footage> footage);

  // A composited frame of the scene that was opened last; never null. Where composing fails the image is the untouched
  // footage, with the problem.
  //   frame    of the footage, from 0; one that the footage has
  //   footage  that frame, decoded; not null
  //   method   none: the project's own
  [[nodiscard]] std::shared_ptr<const PreviewImage> image(const OpenedScene& opened, int frame,
                                                          const std::shared_ptr<const DecodedFrame>& footage,
                                                          Stages stages, std::optional<MethodChoice> method);

  // The untouched footage, CV_8UC3; the same samples as those under the composited images of the same frame.
  [[nodiscard]] cv::Mat footage_bgr(const std::shared_ptr<const DecodedFrame>& footage) { return copies_.bgr(footage); }

  // A model that cannot be read is shown as the cross that replaces it. Never null; the image is empty where OpenGL
  // cannot be had. wanted.intruder has to be one of the project's.
  [[nodiscard]] std::shared_ptr<const ModelImage> model_image(const Project& project,
                                                              const PreviewRequest::Turntable& wanted);

 private:
  // Marks a model as the last that was used.
  void keep(const std::shared_ptr<const Model>& model);
  // Forgets the oldest models beyond those in use and eight more, on the graphics card too.
  void drop_unused(std::size_t in_use);

  SceneFiles files_;
  // Last used at the back. The context knows meshes by their address, so a model lives here until the context forgets
  // it.
  std::deque<std::shared_ptr<const Model>> drawn_;
  ComposeContext context_;
  FootageCopies copies_;
};

// The work of the rendering thread. Each step takes a snapshot of the preview state and does the first thing that is
// missing: the wanted image of the newest revision, what else the view asked for, then in turns one of the next frames,
// a slice of the survey, the image of the model. A step that opens a revision composes it too, so that edits that come
// faster than images do not stop the images.
class PreviewRenderer {
 public:
  // The preview state has to outlive it.
  explicit PreviewRenderer(PreviewState& preview_state) : preview_state_(preview_state) {}

  // The thread's body, at kPreviewNiceness; returns when the preview state is stopped. Where it has nothing to do, it
  // still looks at the project's files once a second.
  void run();

 private:
  using Clock = std::chrono::steady_clock;

  // Each returns whether there was anything to do. One call makes one image, or works on the survey for some 3 ms: a
  // newer request waits no longer than that.
  bool step(const PreviewSnapshot& snapshot);
  // The wanted frame. While that is being decoded, the last frame that was wanted before it.
  bool render_requested(const PreviewSnapshot& snapshot);
  // The untouched footage, the frame by another method, the frame with its stages: the first that is missing.
  bool render_extras(const PreviewSnapshot& snapshot);
  // One frame ahead of the playhead.
  bool prefetch(const PreviewSnapshot& snapshot);
  bool survey(const PreviewRequest& wanted);
  bool render_turntable(const PreviewSnapshot& snapshot);
  // False where the footage's frame is not decoded yet.
  bool compose(int frame, bool was_wanted);

  // Looks at the project's files on disk: for another revision at once, else once a second. Sets content_ and footage_.
  void check_input_files(const PreviewSnapshot& snapshot);
  // Opens the wanted revision where its footage is there and it is not open yet.
  void open_revision(const PreviewSnapshot& snapshot);
  // Whether the scene that is open is that of the wanted content; while footage is being opened it is an older one.
  [[nodiscard]] bool scene_fits() const { return scene_ && scene_->content == content_; }
  [[nodiscard]] int clamped(int frame) const;
  // Null: not decoded yet. Grey where the footage has no video.
  [[nodiscard]] std::shared_ptr<const DecodedFrame> footage_frame(int frame) const;

  PreviewState& preview_state_;
  SceneRenderer scene_renderer_;

  std::uint64_t revision_ = 0;         // whose files were looked at last
  Clock::time_point files_checked_{};  // when its files were looked at
  // combined_id() of that revision and its files, and the footage among them.
  ContentId content_;
  ContentId input_files_;
  FootageId footage_;

  // The scene that is open, and the id of the footage that it was opened with.
  std::shared_ptr<const OpenedScene> scene_;
  ContentId scene_footage_;

  SurveyBuilder survey_builder_;
  // Of the scene whose survey is being made or is done, whether all of it was shown, and when it was begun.
  ContentId survey_content_;
  bool survey_is_shown_ = false;
  Clock::time_point survey_begun_{};

  // What the model's image was last made for. Nothing else of the project changes it: least of all a waypoint that is
  // dragged.
  struct ModelKey {
    ContentId input_files;
    std::filesystem::path project;  // relative names of files are from its folder
    ModelSettings model;
    int intruder = 0;
    double turn_rad = 0;
    cv::Size size_px;
    [[nodiscard]] bool operator==(const ModelKey&) const = default;
  };
  std::optional<ModelKey> model_;
  int next_background_task_ = 0;  // which of prefetch, survey and turntable had the last turn
};

}  // namespace sigs::editor
