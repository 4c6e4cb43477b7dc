// SPDX-License-Identifier: MIT
#include "editor/views/viewport/real_aircraft_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "base/staged_outputs.h"
#include "editor/document/project_paths.h"

namespace sigs::editor {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxStates = 100;  // of history
// Lines have 4 decimals: each of three numbers is off by half of the last one.
constexpr double kRounding_px = 1.1e-4;

// Of its aircraft in another frame; null: none.
const RealAircraftBox* box_in_frame(const RealAircraftBoxes& boxes, const std::string& label, int frame) {
  for (const RealAircraftBox& one : boxes_of_frame(boxes, frame))
    if (one.label == label) return &one;
  return nullptr;
}

// The straight line between two boxes of an aircraft, at a frame between theirs: each of the four numbers by itself.
Box box_between(const RealAircraftBox& before, const RealAircraftBox& after, int frame) {
  const double share = static_cast<double>(frame - before.frame) / (after.frame - before.frame);
  const Box& a = before.box;
  const Box& b = after.box;
  return {std::lerp(a.x, b.x, share), std::lerp(a.y, b.y, share), std::lerp(a.width, b.width, share),
          std::lerp(a.height, b.height, share)};
}

bool are_near(const Box& a, const Box& b) {
  const auto is_near = [](double one, double other) { return std::abs(one - other) <= kRounding_px; };
  return is_near(a.x, b.x) && is_near(a.y, b.y) && is_near(a.width, b.width) && is_near(a.height, b.height);
}

Box clipped(const Box& box, const cv::Size& image_px) {
  const double left = std::max(box.x, -0.5), right = std::min(box.x + box.width, image_px.width - 0.5);
  const double top = std::max(box.y, -0.5), bottom = std::min(box.y + box.height, image_px.height - 0.5);
  return {left, top, right - left, bottom - top};
}

void sort_by_frame(RealAircraftBoxes& boxes) {
  std::ranges::stable_sort(boxes, {}, &RealAircraftBox::frame);
}

fs::path named_file(const Project& project) {
  const std::string& named = project.footage.real_aircraft;
  return named.empty() ? fs::path() : fs::absolute(resolved(project, named)).lexically_normal();
}

}  // namespace

std::span<const RealAircraftBox> boxes_of_frame(const RealAircraftBoxes& boxes, int frame) {
  const auto first = std::ranges::lower_bound(boxes, frame, {}, &RealAircraftBox::frame);
  const auto end = std::ranges::upper_bound(boxes, frame, {}, &RealAircraftBox::frame);
  return {first, end};
}

bool is_filled(const RealAircraftBoxes& boxes, std::size_t index) {
  const RealAircraftBox& box = boxes[index];
  const RealAircraftBox* const before = box_in_frame(boxes, box.label, box.frame - 1);
  const RealAircraftBox* const after = box_in_frame(boxes, box.label, box.frame + 1);
  return before != nullptr && after != nullptr && are_near(box_between(*before, *after, box.frame), box.box) &&
         box.line == real_aircraft_box(box.frame, box.label, box.box).line;
}

Result<RealAircraftBoxes> with_box(const RealAircraftBoxes& boxes, const std::string& label, int frame, const Box& box,
                                   const FootageBounds& footage) {
  if (frame < 0 || frame >= footage.frames) return fail("", fmt::format("the footage has no frame {}", frame));
  const Box inside = clipped(box, footage.size_px);
  if (!(inside.width >= 1 && inside.height >= 1)) return fail("", "the box has less than a pixel within the image");
  const RealAircraftBox marked = real_aircraft_box(frame, label, inside);
  // Its boxes that stay for sure, nearest in time.
  std::optional<RealAircraftBox> before, after;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const RealAircraftBox& other = boxes[i];
    const bool is_nearer = other.frame < frame ? !before || other.frame > before->frame
                                               : other.frame > frame && (!after || other.frame < after->frame);
    if (other.label == label && is_nearer && !is_filled(boxes, i)) (other.frame < frame ? before : after) = other;
  }
  const int first = before ? before->frame + 1 : frame;
  const int last = after ? after->frame - 1 : frame;
  RealAircraftBoxes changed;
  for (const RealAircraftBox& other : boxes)
    if (other.label != label || other.frame < first || other.frame > last) changed.push_back(other);
  for (int i = first; i < frame; ++i) changed.push_back(real_aircraft_box(i, label, box_between(*before, marked, i)));
  changed.push_back(marked);
  for (int i = frame + 1; i <= last; ++i)
    changed.push_back(real_aircraft_box(i, label, box_between(marked, *after, i)));
  sort_by_frame(changed);
  return changed;
}

bool RealAircraftSession::follow(const Document& document) {
  const bool is_other = std::exchange(document_, document.first_number()) != document.first_number();
  const bool is_other_camera = std::exchange(camera_, document.active_camera()) != document.active_camera();
  const FileStamp present = stamp_of(named_file(document.project()));
  if (present != stamp_) {
    stamp_ = present;
    read();
  }
  return is_other || is_other_camera;
}

void RealAircraftSession::read() {
  past_.clear();
  future_.clear();
  problem_.reset();
  header_ = kRealAircraftHeader;
  RealAircraftBoxes boxes;
  if (stamp_.exists) {
    Result<RealAircraftFile> file = read_real_aircraft(stamp_.path);
    if (file) {
      header_ = std::move(file->header);
      boxes = std::move(file->boxes);
    } else {
      problem_ = file.error();
    }
  }
  sort_by_frame(boxes);
  boxes_ = std::make_shared<const RealAircraftBoxes>(std::move(boxes));
}

std::string RealAircraftSession::new_label() const {
  std::set<std::string> labels;
  for (const RealAircraftBox& box : *boxes_) labels.insert(box.label);
  int number = 1;
  while (labels.contains(fmt::format("aircraft {}", number))) ++number;
  return fmt::format("aircraft {}", number);
}

bool RealAircraftSession::is_track(const std::string& label) const {
  std::set<int> frames;
  return std::ranges::all_of(
      *boxes_, [&](const RealAircraftBox& box) { return box.label != label || frames.insert(box.frame).second; });
}

Result<void> RealAircraftSession::mark(const Document& document, Edits& edits, const std::string& label, int frame,
                                       const Box& box, const FootageBounds& footage) {
  Result<RealAircraftBoxes> boxes = with_box(*boxes_, label, frame, box, footage);
  if (!boxes) return fail(boxes.error());
  return change(document, edits, *std::move(boxes));
}

Result<void> RealAircraftSession::remove(const Document& document, Edits& edits, const RealAircraftBox& box) {
  RealAircraftBoxes boxes = *boxes_;
  if (const auto found = std::ranges::find(boxes, box); found != boxes.end()) boxes.erase(found);
  return change(document, edits, std::move(boxes));
}

Result<void> RealAircraftSession::remove_all(const Document& document, Edits& edits, const std::string& label) {
  RealAircraftBoxes boxes = *boxes_;
  std::erase_if(boxes, [&](const RealAircraftBox& box) { return box.label == label; });
  return change(document, edits, std::move(boxes));
}

Result<void> RealAircraftSession::change(const Document& document, Edits& edits, RealAircraftBoxes boxes) {
  if (boxes == *boxes_) return {};
  const State before = boxes_;
  if (Result<void> written = write(document, edits, std::make_shared<const RealAircraftBoxes>(std::move(boxes)));
      !written)
    return written;
  past_.push_back(before);
  if (past_.size() > kMaxStates) past_.erase(past_.begin());
  future_.clear();
  return {};
}

Result<void> RealAircraftSession::write(const Document& document, Edits& edits, const State& boxes) {
  const Project& project = document.project();
  if (!document.has_file()) return fail("", "save the project first: the boxes are kept in a file beside it");
  if (problem_) return fail(*problem_);
  if (stamp_of(stamp_.path) != stamp_) {
    follow(document);
    return fail(stamp_.path.string(), "was changed by another program, and is read again; nothing was marked");
  }
  const fs::path file = stamp_.path.empty() ? new_file_beside(project, ".real", ".csv") : stamp_.path;
  std::string text = header_.empty() ? kRealAircraftHeader : header_;
  text += '\n';
  for (const RealAircraftBox& box : *boxes) text += box.line + '\n';
  if (Result<void> written = write_text(file, text, !stamp_.path.empty()); !written) return written;
  if (stamp_.path.empty())
    edits.change("use boxes of real aircraft",
                 [file](Project& changed) { changed.footage.real_aircraft = path_in_project(changed, file); });
  stamp_ = stamp_of(file);
  boxes_ = boxes;
  return {};
}

Result<void> RealAircraftSession::step(const Document& document, Edits& edits, std::vector<State>& from,
                                       std::vector<State>& to) {
  if (from.empty()) return {};
  const State before = boxes_;
  const State wanted = from.back();
  if (Result<void> written = write(document, edits, wanted); !written) return written;
  from.pop_back();
  to.push_back(before);
  return {};
}

Result<void> RealAircraftSession::undo(const Document& document, Edits& edits) {
  return step(document, edits, past_, future_);
}

Result<void> RealAircraftSession::redo(const Document& document, Edits& edits) {
  return step(document, edits, future_, past_);
}

}  // namespace sigs::editor
