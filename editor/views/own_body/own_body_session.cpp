// SPDX-License-Identifier: MIT
#include "editor/views/own_body/own_body_session.h"

#include <utility>

#include "base/paths.h"
#include "editor/document/field_edits.h"
#include "editor/document/project_paths.h"
#include "occlusion/detect.h"
#include "scene/scene_files.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

constexpr const char* kMaskEnding = "_own_body";

cv::Mat bytes_of(const cv::Mat& share) {
  cv::Mat mask;
  share.convertTo(mask, CV_8U, 255);
  return mask;
}

fs::path file_named(const Project& project, const std::string& named) {
  return named.empty() ? fs::path() : fs::absolute(resolved(project, named)).lexically_normal();
}

fs::path project_mask_file(const Project& project) {
  return file_named(project, project.footage.own_body_mask);
}

// A soft edge is centred on the border.
cv::Mat hard(const cv::Mat& mask) {
  return mask > 127;
}

bool is_png(const fs::path& path) {
  return lower_extension(path) == ".png";
}

// What was found with one edge, with another.
cv::Mat with_edge(const cv::Mat& mask, double has_px, double wanted_px) {
  return has_px == wanted_px ? mask : soft_edged(hard(mask), wanted_px);
}

// Where a painting comes from.
constexpr const char* kOfClouds = "clouds of a frame";

fs::path new_mask_file(const Project& project) {
  return new_file_beside(project, kMaskEnding, ".png");
}

}  // namespace

fs::path usual_mask_file(const Project& project) {
  const fs::path named = project_mask_file(project);
  return is_png(named) ? named : file_beside(project, kMaskEnding, ".png");
}

OwnBodySession::OwnBodySession(Edits& edits, std::function<void()> wake, OwnBodyJob::Work detect)
    : edits_(edits), job_(std::move(wake), std::move(detect)) {}

void OwnBodySession::forget() {
  job_.forget();
  detection_ = {};
  painting_ = {};
  camera_ = 0;
  footage_px_ = {};
  project_mask_ = cv::Mat();
  taken_ = nullptr;
  video_.clear();
  origin_.clear();
  remember_file({}, false);
  found_state_ = feathered_state_ = share_state_ = 0;
  share_ = 0;
}

void OwnBodySession::begin(const cv::Mat& mask, std::string origin) {
  painting_ = MaskPainting(mask, painting_.last_state() + 1);
  origin_ = {{painting_.whole_state(), std::move(origin)}};
  remember_file({}, false);
  mask_edge_px_ = edge_px_;
  found_state_ = feathered_state_ = share_state_ = 0;
}

MaskToKeep OwnBodySession::to_keep() const {
  return {.state = unsaved(),
          .pixels = painting_.mask(),
          .has_strokes = painting_.has_strokes(),
          .camera = camera_,
          .is_changing = painting_.is_stroking()};
}

void OwnBodySession::recover(const RecoveredMask& mask) {
  begin(mask.pixels, "recovered");
  camera_ = mask.camera;
  edge_px_ = mask_edge_px_ = -1;  // as the settings have it, which are not known yet
  painting_.mark_unsaved();
  if (mask.has_strokes) {
    painting_.mark_strokes();
    origin_[painting_.whole_state()] = "recovered";
  }
}

void OwnBodySession::replace(const cv::Mat& mask, std::string step, std::string origin) {
  painting_.replace(mask, std::move(step));
  origin_[painting_.whole_state()] = std::move(origin);
  mask_edge_px_ = edge_px_;
}

void OwnBodySession::remember_file(const fs::path& file, bool written_here) {
  file_ = file;
  file_is_own_ = written_here;
  file_whole_ = painting_.whole_state();
}

void OwnBodySession::measure_share() {
  if (painting_.state() == share_state_ && !painting_.is_stroking()) return;
  share_state_ = painting_.is_stroking() ? 0 : painting_.state();
  const cv::Mat& mask = painting_.mask();
  share_ = mask.empty() ? 0 : static_cast<double>(cv::countNonZero(hard(mask))) / static_cast<double>(mask.total());
}

void OwnBodySession::note_active_camera(const Document& document) {
  is_elsewhere_ = document.active_camera() != camera_ && painting_.has_unsaved_changes();
}

void OwnBodySession::follow(const Document& document, const OpenedScene* scene) {
  const Project& project = document.project();
  note_active_camera(document);
  if (is_elsewhere_) return;
  if (document.active_camera() != camera_) forget();
  camera_ = document.active_camera();
  // What was found in other footage says nothing of this.
  const fs::path video = resolved(project, project.footage.video);
  if (std::exchange(video_, video) != video) job_.forget();
  detection_ = job_.state();
  measure_share();
  if (scene == nullptr || scene->revision != document.revision().number) return;
  footage_px_ = scene->draft.scene.footage.size_px;
  if (!fits()) {
    if (painting_.has_unsaved_changes()) return;
    begin_anew();
  }
  if (painting_.is_stroking()) return;
  take_soft_edge(project.own_body.soft_edge_px);
  take_project_mask(project, scene->draft.scene.own_body);
  if (found_waits() && (!painting_.has_strokes() || !painting_.has_unsaved_changes())) take_found();
}

// Only where the project's mask has changed. One that was written here comes back with the same bytes: no step. What
// was made here stays when the project is undone, or names another file.
void OwnBodySession::take_project_mask(const Project& project, const cv::Mat& own_body) {
  if (own_body.data == project_mask_.data) return;
  project_mask_ = own_body;
  const bool was_worked_on = painting_.can_undo() || painting_.can_redo();
  const bool is_another = own_body.empty() || file_ != project_mask_file(project);
  if (painting_.has_unsaved_changes() || (was_worked_on && !file_.empty() && is_another)) return;
  if (was_worked_on) return start_from_project(project);
  const fs::path file = own_body.empty() ? fs::path() : project_mask_file(project);
  begin(own_body.empty() ? cv::Mat::zeros(footage_px_, CV_8UC1) : bytes_of(own_body),
        file.empty() ? std::string() : "from " + file.filename().string());
  remember_file(file, false);
}

void OwnBodySession::take_found() {
  taken_ = detection_.value;
  taken_edge_px_ = detection_.value_request.own_body.soft_edge_px;
  if (taken_->mask.size() != painting_.mask().size() || taken_->mask.type() != CV_8UC1) return;
  replace(with_edge(taken_->mask, taken_edge_px_, edge_px_), "detected mask", "detected");
  found_state_ = feathered_state_ = painting_.state();
}

// What was found and not changed since follows at once, by one step at most; back at its own edge it is as it was.
void OwnBodySession::take_soft_edge(double edge_px) {
  if (edge_px_ < 0) edge_px_ = mask_edge_px_ = edge_px;
  if (std::exchange(edge_px_, edge_px) == edge_px || !taken_) return;
  const std::uint64_t state = painting_.state();
  if (state != found_state_ && state != feathered_state_) return;
  if (state != found_state_) painting_.undo();
  replace(with_edge(taken_->mask, taken_edge_px_, edge_px_), "soft edge", "detected");
  feathered_state_ = painting_.state();
}

void OwnBodySession::feather() {
  const std::string name = origin_of_whole();
  replace(soft_edged(hard(painting_.mask()), edge_px_), "soft edge", name);
}

bool OwnBodySession::edge_waits() const {
  return mask_edge_px_ != edge_px_ && share_ > 0 && fits();
}

bool OwnBodySession::start(const Document& document) {
  const bool started = job_.start(document.project());
  detection_ = job_.state();
  return started;
}

void OwnBodySession::begin_anew() {
  is_elsewhere_ = false;
  begin(cv::Mat::zeros(footage_px_, CV_8UC1), "");
  project_mask_ = cv::Mat();
}

void OwnBodySession::start_from_found() {
  if (detection_.value && fits()) take_found();
}

void OwnBodySession::start_from_empty() {
  if (!painting_.empty()) replace(cv::Mat::zeros(painting_.mask().size(), CV_8UC1), "clear", "");
}

std::string OwnBodySession::origin_of_whole() const {
  const auto found = origin_.find(painting_.whole_state());
  return found == origin_.end() ? std::string() : found->second;
}

bool OwnBodySession::could_start_from_project(const Project& project) const {
  return fits() && project_mask_.size() == footage_px_ && !project_mask_file(project).empty();
}

// It counts as saved: it lies in the project's file.
void OwnBodySession::start_from_project(const Project& project) {
  if (!could_start_from_project(project)) return;
  const fs::path file = project_mask_file(project);
  const cv::Mat mask = bytes_of(project_mask_);
  if (cv::norm(mask, painting_.mask(), cv::NORM_INF) > 0)
    replace(mask, "the project's mask", "from " + file.filename().string());
  painting_.mark_saved();
  remember_file(file, file_is_own_ && file == file_);
}

void OwnBodySession::start_from_clouds(const cv::Mat& opacity) {
  if (opacity.size() == painting_.mask().size() && opacity.type() == CV_8UC1)
    replace(opacity.clone(), "clouds", kOfClouds);
}

void OwnBodySession::ask_start_from_file(const Project& project) {
  edits_.ask(AskForFile{.title = "Start from a mask",
                        .extensions = extensions_for("footage.own_body_mask"),
                        .start = usual_mask_file(project).parent_path(),
                        .chosen = [this](const fs::path& path) {
                          const Result<cv::Mat> read = read_own_body_mask(path, footage_px_);
                          if (!read)
                            edits_.ask(ShowMessage{read.error().text(), true});
                          else if (fits())
                            replace(bytes_of(*read), "start from " + path.filename().string(),
                                    "from " + path.filename().string());
                        }});
}

std::uint64_t OwnBodySession::unsaved() const {
  return painting_.has_unsaved_changes() ? painting_.state() : 0;
}

bool OwnBodySession::is_used(const Project& project) const {
  return unsaved() == 0 && !file_.empty() && file_ == project_mask_file(project);
}

std::string OwnBodySession::mask_text(const Project& project) const {
  const std::string name = file_.filename().string();
  if (is_used(project)) return name + ", used in the project";
  if (unsaved() == 0 && !file_.empty() && file_ == file_named(project, project.footage.occluder_mask))
    return name + ", the project's occluder";
  if (unsaved() == 0) return name.empty() ? "Nothing painted" : name + ", not used in the project";
  // Nothing but strokes lies between the file and this.
  if (!name.empty() && painting_.whole_state() == file_whole_) return name + ", changed, not saved";
  const std::string from = origin_of_whole();
  if (painting_.whole_state() == 0) return from + ", not saved";
  if (from.empty()) return painting_.has_strokes() ? "painted, not saved" : "emptied, not saved";
  return from + (painting_.has_strokes() ? ", painted on, not saved" : ", not saved");
}

bool OwnBodySession::write(const fs::path& path) {
  const fs::path place = fs::absolute(path).lexically_normal();
  if (const Result<void> written = write_mask(painting_.mask(), place, true); !written) {
    edits_.ask(ShowMessage{written.error().text() + "; the mask was not saved", true});
    return false;
  }
  painting_.mark_saved();
  remember_file(place, true);
  return true;
}

void OwnBodySession::ask_save(const fs::path& proposed, std::function<void()> next) {
  edits_.ask(AskForFile{.title = "Save the mask as",
                        .extensions = {".png"},
                        .for_saving = true,
                        .start = proposed,
                        .chosen = [this, next = std::move(next)](const fs::path& path) {
                          if (!write(path)) return;
                          edits_.ask(ShowMessage{"Saved " + file_.filename().string()});
                          if (next) next();
                        }});
}

void OwnBodySession::ask_save_as(const Project& project, std::function<void()> next) {
  ask_save(file_is_own_ ? file_ : new_mask_file(project), std::move(next));
}

void OwnBodySession::name_in_project() {
  if (is_elsewhere_) edits_.activate_camera(camera_);
  edits_.change("use own-body mask",
                [file = file_](Project& project) { project.footage.own_body_mask = path_in_project(project, file); });
  edits_.ask(ShowMessage{file_.filename().string() + " hides intruders"});
}

void OwnBodySession::use(const Project& project) {
  if (unsaved() == 0 && !file_.empty())
    name_in_project();
  else
    ask_save_and_use(project);
}

void OwnBodySession::ask_save_and_use(const Project& project, std::function<void()> next) {
  const bool has_own = file_is_own_ && file_ != project_mask_file(project);
  ask_save(has_own ? file_ : new_mask_file(project), [this, next = std::move(next)] {
    name_in_project();
    if (next) next();
  });
}

void OwnBodySession::ask_use_as_occluder(const Project& project, int frame) {
  ask_save(new_file_beside(project, "_occluder", ".png"), [this, frame] {
    const bool has_clouds = origin_of_whole() == kOfClouds;
    edits_.change("use occluder", [file = file_, frame, has_clouds](Project& changed) {
      FootageSettings& footage = changed.footage;
      footage.occluder_mask = path_in_project(changed, file);
      footage.occluder_frame = frame;
      if (footage.occluder_distance_m == 0) footage.occluder_distance_m = footage.cloud_distance_m.value_or(0);
      if (has_clouds) footage.cloud_distance_m.reset();
    });
    edits_.ask(ShowMessage{file_.filename().string() + " hides what is farther away" +
                           (has_clouds ? ", in place of the clouds that are found" : "")});
  });
}

void OwnBodySession::ask_keep(const Document& document, std::function<void()> next) {
  note_active_camera(document);
  const std::shared_ptr<const Project> project = revision_of_camera(document.state(), camera_).project;
  painting_.mask().size() == footage_px_ ? ask_save_and_use(*project, std::move(next))
                                         : ask_save_as(*project, std::move(next));
}

bool OwnBodySession::could_replace(const Project& project) const {
  const fs::path named = project_mask_file(project);
  return file_.empty() ? is_png(named) : unsaved() != 0 && is_png(named) && file_ == named;
}

void OwnBodySession::replace_and_use(const Project& project) {
  if (could_replace(project) && write(project_mask_file(project))) name_in_project();
}

}  // namespace sigs::editor
