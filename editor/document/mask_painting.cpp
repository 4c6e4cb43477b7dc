// SPDX-License-Identifier: MIT
#include "editor/document/mask_painting.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "base/ensure.h"
#include "base/image_codecs.h"
#include "base/staged_outputs.h"

namespace sigs::editor {

bool is_same_mask(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size()) return false;
  for (int y = 0; y < a.rows; ++y)
    if (!std::equal(a.ptr<uchar>(y), a.ptr<uchar>(y) + a.cols, b.ptr<uchar>(y))) return false;
  return true;
}

Result<void> write_mask(const cv::Mat& mask, const std::filesystem::path& path, bool overwrite) {
  std::vector<uchar> bytes;
  try {
    image_codecs::imencode(".png", mask, bytes);
  } catch (const std::exception&) {
    return fail(path.string(), "the mask cannot be written as a PNG", ErrorKind::write_failed);
  }
  return write_text(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, overwrite);
}

Result<cv::Mat> read_mask(const std::filesystem::path& path) {
  const Result<std::string> bytes = read_text(path);
  if (!bytes) return fail(bytes.error());
  cv::Mat mask;
  try {
    mask = image_codecs::imdecode(
        cv::Mat(1, static_cast<int>(bytes->size()), CV_8UC1, const_cast<char*>(bytes->data())), cv::IMREAD_UNCHANGED);
  } catch (const std::exception&) {
    mask = cv::Mat();
  }
  if (mask.type() != CV_8UC1 || mask.empty()) return fail(path.string(), "is not a mask that was kept here");
  return mask;
}

namespace {

bool is_finite(const glm::dvec2& p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

double distance_to_line(const glm::dvec2& p, const glm::dvec2& from, const glm::dvec2& along, double length_squared) {
  const double share = length_squared > 0 ? std::clamp(glm::dot(p - from, along) / length_squared, 0.0, 1.0) : 0;
  return glm::length(p - from - share * along);
}

// Whole pixels within a reach of a stretch, of `count` of them. Far away, double keeps what int cannot hold.
cv::Range within(double low, double high, double reach, int count) {
  const double first = std::clamp(std::ceil(low - reach), 0.0, static_cast<double>(count));
  const double last = std::clamp(std::floor(high + reach) + 1, first, static_cast<double>(count));
  return {static_cast<int>(first), static_cast<int>(last)};
}

// The columns of a row that the brush can reach: of a long slanting line a small part.
cv::Range columns_of_row(int row, const glm::dvec2& from, const glm::dvec2& along, double reach, int count) {
  double first = 0;
  double last = 1;
  if (along.y != 0) {
    const double one = (row - reach - from.y) / along.y;
    const double other = (row + reach - from.y) / along.y;
    first = std::clamp(std::min(one, other), 0.0, 1.0);
    last = std::clamp(std::max(one, other), 0.0, 1.0);
  }
  const double one_x = from.x + first * along.x;
  const double other_x = from.x + last * along.x;
  return within(std::min(one_x, other_x), std::max(one_x, other_x), reach, count);
}

constexpr std::size_t kMaxBytesInHistory = std::size_t(256) << 20;
constexpr std::size_t kMaxStrokes = 1000;

}  // namespace

double covered(const Brush& brush, double distance_px) {
  if (!(brush.edge_px > 0)) return distance_px <= brush.radius_px ? 1 : 0;
  return std::clamp((brush.radius_px - distance_px) / brush.edge_px + 0.5, 0.0, 1.0);
}

cv::Rect move_brush(cv::Mat& mask, const Brush& brush, const glm::dvec2& from, const glm::dvec2& to) {
  ENSURE(mask.type() == CV_8UC1);
  if (!is_finite(from) || !is_finite(to)) return {};
  const double reach = brush.radius_px + std::max(0.0, brush.edge_px) / 2;
  const glm::dvec2 along = to - from;
  const double length_squared = glm::dot(along, along);
  const cv::Range rows = within(std::min(from.y, to.y), std::max(from.y, to.y), reach, mask.rows);
  const cv::Range columns = within(std::min(from.x, to.x), std::max(from.x, to.x), reach, mask.cols);
  if (rows.empty() || columns.empty()) return {};
  for (int y = rows.start; y < rows.end; ++y) {
    uchar* const line = mask.ptr<uchar>(y);
    const cv::Range part = columns_of_row(y, from, along, reach, mask.cols);
    for (int x = part.start; x < part.end; ++x) {
      const double distance_px = distance_to_line({x, y}, from, along, length_squared);
      const auto share = static_cast<uchar>(std::lround(255 * covered(brush, distance_px)));
      line[x] = brush.erases ? std::min(line[x], static_cast<uchar>(255 - share)) : std::max(line[x], share);
    }
  }
  return {columns.start, rows.start, columns.size(), rows.size()};
}

double stepped_radius_px(double radius_px, int steps) {
  constexpr double kStep = 1.15;
  const double wanted = radius_px * std::pow(kStep, steps);
  // At least half a pixel a step: small brushes would hardly change.
  const double minimum = radius_px + 0.5 * steps;
  return std::clamp(steps > 0 ? std::max(wanted, minimum) : std::min(wanted, minimum), kMinRadius_px, kMaxRadius_px);
}

MaskPainting::MaskPainting(const cv::Mat& mask, std::uint64_t first_state)
    : mask_(mask.clone()),
      state_(first_state),
      last_state_(first_state),
      saved_state_(first_state),
      whole_state_(first_state) {
  ENSURE(mask.type() == CV_8UC1);
}

void MaskPainting::begin_stroke(const Brush& brush, const glm::dvec2& at) {
  if (mask_.empty()) return;
  end_stroke();
  stroke_ = Stroke{.brush = brush, .at = at, .before = mask_.clone()};
  move(at);
}

void MaskPainting::extend_stroke(const glm::dvec2& to) {
  if (stroke_ && to != stroke_->at) move(to);
}

void MaskPainting::move(const glm::dvec2& to) {
  const cv::Rect touched = move_brush(mask_, stroke_->brush, stroke_->at, to);
  stroke_->at = to;
  if (!touched.empty()) stroke_->touched |= touched;
}

void MaskPainting::end_stroke() {
  if (!stroke_) return;
  const Stroke stroke = std::move(*stroke_);
  stroke_.reset();
  remember(stroke.brush.erases ? "erase" : "paint", stroke.touched, stroke.before, false);
}

void MaskPainting::take_back_stroke() {
  if (!stroke_) return;
  stroke_->before.copyTo(mask_);
  stroke_.reset();
}

void MaskPainting::replace(const cv::Mat& mask, std::string name) {
  ENSURE(mask.type() == CV_8UC1 && mask.size() == mask_.size());
  end_stroke();
  const cv::Mat before = std::exchange(mask_, mask.clone());
  remember(std::move(name), {{0, 0}, mask_.size()}, before, true);
}

// A step that left every byte as it was is none.
void MaskPainting::remember(std::string name, const cv::Rect& place, const cv::Mat& before, bool is_whole) {
  if (is_same_mask(mask_(place), before(place))) {
    if (is_whole) whole_state_ = state_;
    return;
  }
  past_.push_back({std::move(name), place, before(place).clone(), state_, whole_state_});
  future_.clear();
  state_ = ++last_state_;
  if (is_whole) whole_state_ = state_;
  forget_oldest();
}

void MaskPainting::move_last(std::vector<Step>& from, std::vector<Step>& to) {
  Step& step = from.back();
  cv::Mat here = mask_(step.place);
  const cv::Mat held = here.clone();
  step.other.copyTo(here);
  step.other = held;
  std::swap(step.other_state, state_);
  std::swap(step.other_whole_state, whole_state_);
  to.push_back(std::move(step));
  from.pop_back();
}

void MaskPainting::undo() {
  if (can_undo()) move_last(past_, future_);
}

void MaskPainting::redo() {
  if (can_redo()) move_last(future_, past_);
}

// The newest stays, however large.
void MaskPainting::forget_oldest() {
  std::size_t bytes = 0;
  std::size_t kept = 0;
  while (kept < past_.size() && kept < kMaxStrokes) {
    bytes += past_[past_.size() - 1 - kept].other.total();
    if (kept > 0 && bytes > kMaxBytesInHistory) break;
    ++kept;
  }
  past_.erase(past_.begin(), past_.end() - static_cast<std::ptrdiff_t>(kept));
}

}  // namespace sigs::editor
