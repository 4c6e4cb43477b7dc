// SPDX-License-Identifier: MIT
#include "editor/preview/preview_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <utility>

#include "base/text.h"
#include "base/threads.h"
#include "editor/document/content_id.h"
#include "editor/preview/opened_footage.h"
#include "editor/preview/preview_output.h"
#include "editor/preview/surveys.h"
#include "editor/preview/thumbnails.h"
#include "editor/preview/worker_thread.h"
#include "scene/opened_project.h"
#include "scene/scene_files.h"
#include "scene/scene_parts.h"
#include "video/frame.h"

namespace sigs::editor {

namespace {

constexpr std::size_t kModelsKept = 8;  // beside those of the scene
constexpr double kCrossLength_m = 10;

// The untouched footage where composing fails for want of OpenGL or memory.
Result<ComposedFrame> composed(const Scene& scene, int frame, Frame background, ComposeContext& context,
                               Stages stages) {
  return guarded([&] { return compose_frame(scene, frame, std::move(background), context, stages); }, "composing");
}

// Shares everything large with the scene it is made from.
Scene with_method(const Scene& scene, MethodChoice method) {
  Scene other = scene;
  other.compositing.method = method;
  return other;
}

constexpr std::chrono::milliseconds kEditPause(50);   // until edits have come to rest
constexpr std::chrono::milliseconds kOldSurvey(300);  // how long an older survey replaces one that is made
constexpr double kSurveySlice_s = 0.003;
constexpr int kBackgroundTasks = 3;

FootageId footage_id_of(const std::shared_ptr<const Project>& project) {
  const SequenceTiming timing = timing_of(*project);
  ContentId id = id_of(footage_stamp_of(*project));
  if (quantisers_for(*project) == Quantisers::read) id = combined_id(id, id);
  if (timing.frame_rate_hz > 0) id = combined_id(id, id_of(FileStamp{.path = exact_text(timing.frame_rate_hz)}));
  if (const CropSettings& crop = project->footage.crop; crop != CropSettings{})
    id = combined_id(
        id,
        id_of(FileStamp{.path = fmt::format("{} {} {} {}", crop.left_px, crop.top_px, crop.width_px, crop.height_px)}));
  if (!timing.times_file.empty()) id = combined_id(id, id_of(stamp_of(timing.times_file)));
  return {id, project};
}

// Opens revisions and composites their frames with files, models and an OpenGL context that it keeps from call to call,
// so that an edit reads and uploads only what it changed. All calls come from one thread: the OpenGL context belongs to
// it.
class SceneRenderer {
 public:
  // Opens a revision; never null. What cannot be read is replaced by a placeholder and named in the draft's problems.
  // Models of earlier scenes are kept up to a number, so that undo does not read them again.
  //   content  combined_id() of the revision and its files
  [[nodiscard]] std::shared_ptr<const OpenedScene> opened(const Revision& revision, const ContentId& content,
                                                          std::shared_ptr<const Footage> footage) {
    DraftScene draft = draft_scene(*revision.project, in_rig_time(footage->shape, *revision.project), files_);
    for (const std::shared_ptr<const Model>& model : draft.scene.models) keep(model);
    drop_unused(draft.scene.models.size());
    return std::make_shared<const OpenedScene>(OpenedScene{.revision = revision.number,
                                                           .content = content,
                                                           .project = revision.project,
                                                           .footage = std::move(footage),
                                                           .draft = std::move(draft)});
  }

  // A composited frame of the scene that was opened last; never null. Where composing fails the image is the untouched
  // footage, with the problem.
  //   frame    of the footage, from 0; one that the footage has
  //   footage  that frame, decoded; not null
  //   method   none: the project's own
  [[nodiscard]] std::shared_ptr<const PreviewImage> image(const OpenedScene& opened, int frame,
                                                          const std::shared_ptr<const DecodedFrame>& footage,
                                                          Stages stages, std::optional<MethodChoice> method) {
    const Scene& own = opened.draft.scene;
    auto image = std::make_shared<PreviewImage>(
        PreviewImage{.revision = opened.revision, .frame = frame, .method = method, .problem = footage->problem});
    const bool in_one_piece = stages == Stages::keep || method;
    Frame background = in_one_piece ? cloned(footage->frame) : copies_.to_composite(footage);
    Result<ComposedFrame> made =
        method ? composed(with_method(own, *method), frame, std::move(background), context_, stages)
               : composed(own, frame, std::move(background), context_, stages);
    if (!made) {
      image->bgr.ground = in_one_piece ? ShownImage(bgr_of(footage->frame)) : shown(footage);
      image->truth = {.index = frame, .time_s = time_of_frame_s(own.footage, frame)};
      image->problem = made.error().text();
      return image;
    }
    if (in_one_piece)
      image->bgr.ground = bgr_of(made->image);
    else
      image->bgr = copies_.patched(footage, *made);
    image->mask = made->mask;
    image->truth = std::move(made->truth);
    image->stages = std::move(made->stages);
    image->times = made->times;
    return image;
  }

  // A model that cannot be read is shown as the cross that replaces it. Never null; the image is empty where OpenGL
  // cannot be had. wanted.intruder has to be one of the project's.
  [[nodiscard]] std::shared_ptr<const ModelImage> model_image(const Project& project,
                                                              const PreviewRequest::Turntable& wanted) {
    const Project clean = sanitized(project);
    const auto intruder = static_cast<std::size_t>(wanted.intruder);
    const ModelSettings& settings = clean.intruders[intruder].model;
    auto image =
        std::make_shared<ModelImage>(ModelImage{.file = resolved(project, settings.file), .turn_rad = wanted.turn_rad});
    const Result<std::shared_ptr<const Model>, Problem> made = scene_model(clean, intruder, files_);
    if (!made) image->problem = made.error().what;
    const std::shared_ptr<const Model> model =
        made ? *made : files_.cross(settings.length_m > 0 ? settings.length_m : kCrossLength_m);
    keep(model);
    image->size_m = glm::dvec3(model->mesh.high_m) - glm::dvec3(model->mesh.low_m);
    const Result<Renderer*> renderer = context_.renderer();
    const Result<cv::Mat> rgba = renderer ? turntable_image(model->mesh, wanted.turn_rad, wanted.size_px, **renderer)
                                          : Result<cv::Mat>(fail(renderer.error()));
    if (rgba)
      image->rgba = *rgba;
    else
      image->problem = rgba.error().text();
    return image;
  }

 private:
  // Marks a model as the last that was used.
  void keep(const std::shared_ptr<const Model>& model) {
    std::erase(drawn_, model);
    drawn_.push_back(model);
  }

  // Forgets the oldest models beyond those in use and eight more, on the graphics card too.
  void drop_unused(std::size_t in_use) {
    while (drawn_.size() > in_use + kModelsKept) {
      context_.forget(drawn_.front()->mesh);
      drawn_.pop_front();
    }
  }

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

  void run() {
    lower_thread_priority(kPreviewNiceness);
    while (const std::optional<PreviewSnapshot> snapshot = preview_state_.snapshot()) {
      // What failed for want of memory is tried again in the next round, when something else may have given it back.
      const Result<bool> did = guarded([&]() -> Result<bool> { return step(*snapshot); });
      if (did && *did) continue;
      preview_state_.wait_for_changes(snapshot->version, did && snapshot->ahead ? kFileCheckInterval : kEditPause);
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  // Each returns whether there was anything to do. One call makes one image, or works on the survey for some 3 ms: a
  // newer request waits no longer than that.
  bool step(const PreviewSnapshot& snapshot) {
    if (!snapshot.wanted || !snapshot.wanted->revision.project) return false;
    check_input_files(snapshot);
    open_revision(snapshot);
    const bool shows_image = snapshot.wanted->image && scene_fits();
    if (shows_image && (render_requested(snapshot) || render_extras(snapshot))) return true;
    for (int i = 0; i < kBackgroundTasks; ++i) {
      next_background_task_ = (next_background_task_ + 1) % kBackgroundTasks;
      const bool did = next_background_task_ == 0   ? prefetch(snapshot)
                       : next_background_task_ == 1 ? survey(*snapshot.wanted)
                                                    : render_turntable(snapshot);
      if (did) return true;
    }
    return false;
  }

  // The wanted frame. While that is still being decoded, the one that was wanted before it is better than nothing: a
  // fast scrub shows images on its way.
  bool render_requested(const PreviewSnapshot& snapshot) {
    const int frame = clamped(snapshot.wanted->frame);
    if (preview_state_.has_image({content_, frame})) return false;
    if (compose(frame, true)) return true;
    const bool is_fresh = snapshot.fresh && snapshot.fresh->content == scene_footage_;
    return is_fresh && !preview_state_.has_image({content_, snapshot.fresh->frame}) &&
           compose(snapshot.fresh->frame, true);
  }

  // The untouched footage, the frame by another method, the frame with its stages: the first that is missing.
  bool render_extras(const PreviewSnapshot& snapshot) {
    const PreviewRequest& wanted = *snapshot.wanted;
    const FrameKey key{content_, clamped(wanted.frame)};
    const FrameKey footage_key{scene_footage_, key.frame};
    const bool untouched = wanted.footage && !preview_state_.has_untouched(footage_key);
    const bool compared = wanted.compare_with && !preview_state_.has_compared(key, *wanted.compare_with, wanted.stages);
    const bool staged = wanted.stages && !preview_state_.has_staged(key);
    if (!untouched && !compared && !staged) return false;
    const std::shared_ptr<const DecodedFrame> footage = footage_frame(key.frame);
    if (!footage) return false;
    if (untouched)
      preview_state_.put_untouched(footage_key, std::make_shared<const ShownImage>(shown(footage)));
    else if (compared)
      preview_state_.put_compared(
          key, scene_renderer_.image(*scene_, key.frame, footage, wanted.stages ? Stages::keep : Stages::leave_out,
                                     wanted.compare_with));
    else
      preview_state_.put_staged(key, scene_renderer_.image(*scene_, key.frame, footage, Stages::keep, std::nullopt));
    return true;
  }

  // One frame ahead of the playhead.
  bool prefetch(const PreviewSnapshot& snapshot) {
    if (!snapshot.ahead || !snapshot.wanted->image || !scene_fits()) return false;
    const int count = static_cast<int>(scene_->footage->shape.times_s.size());
    const std::optional<int> frame = preview_state_.next_prefetch(snapshot, content_, count);
    return frame && compose(*frame, false);
  }

  // The survey of the revision before stays for a moment, so that it does not shrink and grow with every step of a
  // drag.
  bool survey(const PreviewRequest& wanted) {
    if (!scene_fits()) return false;
    survey_builder_.want_volumes(wanted.encounters ? shown_volumes(*wanted.revision.project)
                                                   : std::vector<WellClearVolume>());
    if (survey_content_ != scene_->content) {
      survey_builder_.begin(scene_);
      survey_content_ = scene_->content;
      survey_is_shown_ = false;
      survey_begun_ = Clock::now();
    }
    if (survey_builder_.done() && survey_is_shown_) return false;
    const bool has_more = survey_builder_.work(kSurveySlice_s);
    if (!has_more || (!survey_builder_.done() && Clock::now() - survey_begun_ < kOldSurvey)) return true;
    preview_state_.put_surveys(survey_builder_.surveys());
    survey_is_shown_ = survey_builder_.done();
    return true;
  }

  bool render_turntable(const PreviewSnapshot& snapshot) {
    const std::optional<PreviewRequest::Turntable>& wanted = snapshot.wanted->turntable;
    const auto intruders = static_cast<int>(snapshot.wanted->revision.project->intruders.size());
    if (!wanted || wanted->intruder < 0 || wanted->intruder >= intruders || wanted->size_px.empty()) return false;
    const Project& project = *snapshot.wanted->revision.project;
    const ModelSettings& settings = project.intruders[static_cast<std::size_t>(wanted->intruder)].model;
    const ModelKey key{input_files_, project.file, settings, wanted->intruder, wanted->turn_rad, wanted->size_px};
    if (model_ == key) return false;
    model_ = key;
    preview_state_.put_model(scene_renderer_.model_image(project, *wanted));
    return true;
  }

  // False where the footage's frame is not decoded yet.
  bool compose(int frame, bool was_wanted) {
    const std::shared_ptr<const DecodedFrame> footage = footage_frame(frame);
    if (!footage) return false;
    const Clock::time_point start = Clock::now();
    auto image = scene_renderer_.image(*scene_, frame, footage, Stages::leave_out, std::nullopt);
    const std::chrono::duration<double, std::milli> took = Clock::now() - start;
    preview_state_.put_image({content_, frame}, std::move(image), took.count(), was_wanted);
    return true;
  }

  // Looks at the project's files on disk: for another revision at once, else once a second. Sets content_ and footage_.
  void check_input_files(const PreviewSnapshot& snapshot) {
    const Revision& revision = snapshot.wanted->revision;
    const Clock::time_point now = Clock::now();
    if (revision.number == revision_ && now - files_checked_ < kFileCheckInterval) return;
    const ContentId input_files = input_files_id_of(*revision.project, model_stamps_);
    content_ = combined_id(revision.content, input_files);
    input_files_ = input_files;
    footage_ = footage_id_of(revision.project);
    revision_ = revision.number;
    files_checked_ = now;
    preview_state_.set_input_files(input_files, footage_);
  }

  // Opens the wanted revision where its footage is there and it is not open yet.
  // Also where only the number is new: whoever looks at the scene finds the project that it belongs to.
  void open_revision(const PreviewSnapshot& snapshot) {
    if (snapshot.footage.id != footage_.id || !snapshot.opened_footage) return;
    const bool is_open = scene_fits() && scene_->revision == revision_ && scene_footage_ == footage_.id;
    if (is_open) return;
    const Revision& revision = snapshot.wanted->revision;
    scene_ = scene_renderer_.opened(revision, content_, footage_for(*revision.project, snapshot.opened_footage));
    scene_footage_ = footage_.id;
    preview_state_.put_scene(scene_);
  }

  // Whether the scene that is open is that of the wanted content; while footage is being opened it is an older one.
  [[nodiscard]] bool scene_fits() const { return scene_ && scene_->content == content_; }
  [[nodiscard]] int clamped(int frame) const {
    return std::clamp(frame, 0, static_cast<int>(scene_->footage->shape.times_s.size()) - 1);
  }

  // Null: not decoded yet. Grey where the footage has no video.
  [[nodiscard]] std::shared_ptr<const DecodedFrame> footage_frame(int frame) const {
    if (scene_->footage->video) return preview_state_.decoded({scene_footage_, frame});
    return std::make_shared<const DecodedFrame>(DecodedFrame{grey_frame(scene_->footage->shape, frame), ""});
  }

  PreviewState& preview_state_;
  SceneRenderer scene_renderer_;

  std::uint64_t revision_ = 0;         // whose files were looked at last
  Clock::time_point files_checked_{};  // when its files were looked at
  // combined_id() of that revision and its files, and the footage among them.
  ContentId content_;
  ContentId input_files_;
  ModelStamps model_stamps_;
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

}  // namespace

void run_renderer(PreviewState& preview_state) {
  PreviewRenderer(preview_state).run();
}

}  // namespace sigs::editor
