// SPDX-License-Identifier: MIT
#include "editor/views/own_body/own_body_work.h"

#include <algorithm>
#include <cctype>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/partial_file.h"
#include "editor/document/field_texts.h"
#include "editor/document/moved_paths.h"
#include "scene/own_body_mask.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

cv::Mat bytes_of(const cv::Mat& share) {
  cv::Mat mask;
  share.convertTo(mask, CV_8U, 255);
  return mask;
}

fs::path project_mask_file(const Project& project) {
  const std::string& named = project.footage.own_body_mask;
  return named.empty() ? fs::path() : fs::absolute(resolved(project, named)).lexically_normal();
}

bool is_png(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension == ".png";
}

// 1: without a number.
fs::path mask_file_beside(const Project& project, int number) {
  const fs::path beside = !project.file.empty()            ? project.file
                          : !project.footage.video.empty() ? resolved(project, project.footage.video)
                                                           : fs::path(project.name);
  std::string name = beside.stem().string().append("_own_body");
  if (number > 1) name.append("_").append(std::to_string(number));
  return fs::absolute(beside.parent_path() / name.append(".png")).lexically_normal();
}

}  // namespace

fs::path new_mask_file(const Project& project) {
  std::error_code code;
  int number = 1;
  while (fs::exists(mask_file_beside(project, number), code)) ++number;
  return mask_file_beside(project, number);
}

fs::path usual_mask_file(const Project& project) {
  const fs::path named = project_mask_file(project);
  return is_png(named) ? named : mask_file_beside(project, 1);
}

Result<void> write_mask(const cv::Mat& mask, const fs::path& path, bool overwrite) {
  std::vector<uchar> bytes;
  try {
    cv::imencode(".png", mask, bytes);
  } catch (const cv::Exception&) {
    return fail(path.string(), "the mask cannot be written as a PNG", ErrorKind::write_failed);
  }
  return write_text(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, overwrite);
}

OwnBodyWork::OwnBodyWork(Edits& edits, std::function<void()> wake, OwnBodyJob::Detect detect)
    : edits_(edits), job_(std::move(wake), std::move(detect)) {}

void OwnBodyWork::forget() {
  job_.forget();
  detection_ = {};
  painting_ = {};
  footage_px_ = {};
  project_mask_ = cv::Mat();
  taken_ = nullptr;
  video_.clear();
  file_.clear();
}

void OwnBodyWork::begin(const cv::Mat& mask) {
  painting_ = MaskPainting(mask);
  file_.clear();
}

void OwnBodyWork::follow(const Document& document, const OpenedScene* scene) {
  const Project& project = document.project();
  // What was found in other footage says nothing of this.
  const fs::path video = resolved(project, project.footage.video);
  if (std::exchange(video_, video) != video) job_.forget();
  detection_ = job_.state();
  if (scene == nullptr || scene->revision != document.revision().number) return;
  footage_px_ = scene->draft.scene.footage.size_px;
  if (!fits()) {
    if (painting_.has_unsaved_changes()) return;
    begin(cv::Mat::zeros(footage_px_, CV_8UC1));
    project_mask_ = cv::Mat();
  }
  if (painting_.is_stroking()) return;
  take_project_mask(project, scene->draft.scene.own_body);
  if (found_waits() && (!painting_.has_strokes() || !painting_.has_unsaved_changes())) take_found();
}

// Only where the project's mask has changed. One that was written here comes back with the same bytes: no step.
void OwnBodyWork::take_project_mask(const Project& project, const cv::Mat& own_body) {
  if (own_body.data == project_mask_.data) return;
  project_mask_ = own_body;
  if (painting_.has_unsaved_changes()) return;
  const cv::Mat mask = own_body.empty() ? cv::Mat::zeros(footage_px_, CV_8UC1) : bytes_of(own_body);
  if (painting_.can_undo() || painting_.can_redo())
    painting_.replace(mask, "the project's mask");
  else
    begin(mask);
  painting_.mark_saved();
  file_ = own_body.empty() ? fs::path() : project_mask_file(project);
}

void OwnBodyWork::take_found() {
  taken_ = detection_.found;
  if (taken_->mask.size() == painting_.mask().size() && taken_->mask.type() == CV_8UC1)
    painting_.replace(taken_->mask, "detected mask");
}

bool OwnBodyWork::start(const Document& document) {
  const Project& project = document.project();
  const bool started = job_.start({.video = resolved(project, project.footage.video),
                                   .first_frame = project.footage.first_frame,
                                   .settings = project.own_body});
  detection_ = job_.state();
  return started;
}

void OwnBodyWork::begin_anew() {
  begin(cv::Mat::zeros(footage_px_, CV_8UC1));
  project_mask_ = cv::Mat();
}

void OwnBodyWork::start_from_found() {
  if (detection_.found && fits()) take_found();
}

void OwnBodyWork::start_from_empty() {
  if (!painting_.empty()) painting_.replace(cv::Mat::zeros(painting_.mask().size(), CV_8UC1), "clear");
}

void OwnBodyWork::ask_start_from_file(const Project& project) {
  edits_.ask(AskForFile{.title = "Start from a mask",
                        .extensions = extensions_for("footage.own_body_mask"),
                        .start = usual_mask_file(project).parent_path(),
                        .chosen = [this](const fs::path& path) {
                          const Result<cv::Mat> read = read_own_body_mask(path, footage_px_);
                          if (!read)
                            edits_.ask(Say{read.error().text(), true});
                          else if (fits())
                            painting_.replace(bytes_of(*read), "start from " + path.filename().string());
                        }});
}

std::uint64_t OwnBodyWork::unsaved() const {
  return painting_.has_unsaved_changes() ? painting_.state() : 0;
}

bool OwnBodyWork::is_used(const Project& project) const {
  return unsaved() == 0 && !file_.empty() && file_ == project_mask_file(project);
}

bool OwnBodyWork::write(const fs::path& path) {
  const fs::path place = fs::absolute(path).lexically_normal();
  if (const Result<void> written = write_mask(painting_.mask(), place, true); !written) {
    edits_.ask(Say{written.error().text() + "; the mask was not saved", true});
    return false;
  }
  file_ = place;
  painting_.mark_saved();
  return true;
}

void OwnBodyWork::ask_save(const fs::path& proposed, std::function<void()> next) {
  edits_.ask(AskForFile{.title = "Save the mask as",
                        .extensions = {".png"},
                        .for_saving = true,
                        .start = proposed,
                        .chosen = [this, next = std::move(next)](const fs::path& path) {
                          if (!write(path)) return;
                          edits_.ask(Say{"Saved " + file_.filename().string()});
                          if (next) next();
                        }});
}

void OwnBodyWork::ask_save_as(const Project& project, std::function<void()> next) {
  ask_save(is_png(file_) ? file_ : usual_mask_file(project), std::move(next));
}

void OwnBodyWork::name_in_project() {
  edits_.change("use own-body mask",
                [file = file_](Project& project) { project.footage.own_body_mask = path_in_project(project, file); });
  edits_.ask(Say{file_.filename().string() + " hides intruders"});
}

void OwnBodyWork::use(const Project& project) {
  if (unsaved() == 0 && !file_.empty())
    name_in_project();
  else
    ask_save_and_use(project);
}

void OwnBodyWork::ask_save_and_use(const Project& project) {
  const bool has_own = is_png(file_) && file_ != project_mask_file(project);
  ask_save(has_own ? file_ : new_mask_file(project), [this] { name_in_project(); });
}

bool OwnBodyWork::could_replace(const Project& project) const {
  return (unsaved() != 0 || file_.empty()) && is_png(project_mask_file(project));
}

void OwnBodyWork::replace_and_use(const Project& project) {
  if (could_replace(project) && write(project_mask_file(project))) name_in_project();
}

}  // namespace sigs::editor
