// SPDX-License-Identifier: MIT
#include "ego_motion/features.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "base/statistics.h"

namespace sigs {

namespace {

constexpr int kWindow_px = 15;  // of Lucas and Kanade: wide enough for cloud edges, narrow enough for the horizon
constexpr int kLevels = 3;      // above the reduced image: motions up to 7 * 2^3 px
constexpr int kIterations = 8;
constexpr double kStop_px = 0.02;
constexpr float kReturn_px = 0.3F;   // a feature followed back misses its start by no more
constexpr char kPerCell = 2;         // features; more in one place tell the same again
constexpr float kFar_px = 3;         // features look different after a longer way
constexpr float kApart_px = 6;       // features of one scene move alike to this, most of them
constexpr int kBorder_px = 8;        // of the image and of the own body: half a window
constexpr float kMinCorner = 5e-5F;  // smallest eigenvalue, in OpenCV's units; about that of noise of sigma 2
constexpr int kCorner_px = 5;        // of the window that a corner's strength is summed over
constexpr float kRepeated = 1.5F;    // codes; frames that repeat one another differ less, even when coded again
const cv::Size kWindow{kWindow_px, kWindow_px};

cv::Mat allowed_in(cv::Size reduced_size, const cv::Mat& own_body) {
  cv::Mat allowed(reduced_size, CV_8UC1, cv::Scalar(255));
  if (!own_body.empty()) {
    cv::Mat body;
    cv::resize(own_body, body, reduced_size, 0, 0, cv::INTER_AREA);
    cv::dilate(body > 8, body, cv::Mat::ones(2 * kBorder_px + 1, 2 * kBorder_px + 1, CV_8U));
    allowed.setTo(0, body);
  }
  const cv::Rect inside(kBorder_px, kBorder_px, reduced_size.width - 2 * kBorder_px,
                        reduced_size.height - 2 * kBorder_px);
  cv::Mat border(reduced_size, CV_8UC1, cv::Scalar(255));
  if (inside.width > 0 && inside.height > 0) border(inside).setTo(0);
  allowed.setTo(0, border);
  return allowed;
}

double reduction_of(cv::Size size_px, int max_width) {
  return std::max(1.0, static_cast<double>(size_px.width) / max_width);
}

// Every 16th row tells whether two frames show the same.
bool is_same_image(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size()) return false;
  double sum = 0;
  int count = 0;
  for (int y = 0; y < a.rows; y += 16) {
    if (cv::norm(a.row(y), b.row(y), cv::NORM_INF) > 3 * kRepeated) return false;
    sum += cv::norm(a.row(y), b.row(y), cv::NORM_L1);
    count += a.cols;
  }
  return sum < 0.1 * count;
}

cv::TermCriteria stop() {
  return {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, kIterations, kStop_px};
}

constexpr int kNode_px = 80;            // between places at which the gradient is found; between them it is linear
constexpr float kNear_px = 60;          // neighbours at this distance have a quarter of the weight
constexpr int kRounds = 2;              // the second with weights by how far features agree
constexpr float kSameMotion_px = 0.2F;  // with the displacement of their neighbours
constexpr float kPrior_px2 = 100;       // spread of the places from which on the gradient is believed

// Displacements around one place as d + A x, x from the place in units of kNear_px.
struct LocalFit {
  cv::Vec3f dx{0, 0, 0};  // (d, A11, A12)
  cv::Vec3f dy{0, 0, 0};
};

LocalFit refined(const LocalFit& fit, cv::Point2f place, std::span<const cv::Point2f> from,
                 std::span<const cv::Point2f> to, bool first) {
  cv::Matx33f normal =
      cv::Matx33f::diag({1e-6F, kPrior_px2 / (kNear_px * kNear_px), kPrior_px2 / (kNear_px * kNear_px)});
  cv::Vec3f right_x{0, 0, 0};
  cv::Vec3f right_y{0, 0, 0};
  for (std::size_t i = 0; i < from.size(); ++i) {
    const cv::Vec3f at{1, (from[i].x - place.x) / kNear_px, (from[i].y - place.y) / kNear_px};
    const float far = at[1] * at[1] + at[2] * at[2];
    if (far > 4) continue;
    const cv::Point2f moved = to[i] - from[i];
    float weight = 1 / ((1 + far) * (1 + far));
    if (!first) {
      const float x = (moved.x - fit.dx.dot(at)) / kSameMotion_px;
      const float y = (moved.y - fit.dy.dot(at)) / kSameMotion_px;
      weight /= (1 + x * x + y * y) * (1 + x * x + y * y);
    }
    normal += weight * at * at.t();
    right_x += weight * moved.x * at;
    right_y += weight * moved.y * at;
  }
  const cv::Matx33f inverse = normal.inv(cv::DECOMP_CHOLESKY);
  return {inverse * right_x, inverse * right_y};
}

}  // namespace

FeatureTracker::FeatureTracker(cv::Size size_px, const cv::Mat& own_body, const EgoMotionSettings& settings)
    : settings_(settings), scale_(reduction_of(size_px, settings.max_width_px)) {
  const cv::Size reduced_size(std::max(1, static_cast<int>(std::lround(size_px.width / scale_))),
                              std::max(1, static_cast<int>(std::lround(size_px.height / scale_))));
  allowed_ = allowed_in(reduced_size, own_body);
}

cv::Point2f FeatureTracker::full(const cv::Point2f& p) const {
  const auto scale = static_cast<float>(scale_);
  return {(p.x + 0.5F) * scale - 0.5F, (p.y + 0.5F) * scale - 0.5F};
}

std::vector<cv::Point2f> FeatureTracker::predicted() const {
  std::vector<cv::Point2f> guess = points_;
  constexpr float kFast_px = 6;  // slower motions are found without a guess
  if (std::hypot(drift_.x, drift_.y) > kFast_px)
    for (cv::Point2f& p : guess) p += drift_;
  return guess;
}

bool FeatureTracker::is_allowed(const cv::Point2f& reduced_px) const {
  const cv::Point at(cvRound(reduced_px.x), cvRound(reduced_px.y));
  return at.x >= 0 && at.y >= 0 && at.x < allowed_.cols && at.y < allowed_.rows && allowed_.at<uchar>(at) != 0;
}

void FeatureTracker::keep(const std::vector<char>& good) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!good[i]) continue;
    points_[kept] = points_[i];
    key_points_[kept] = key_points_[i];
    responses_[kept] = responses_[i];
    bias_[kept] = bias_[i];
    ids_[kept++] = ids_[i];
  }
  points_.resize(kept);
  key_points_.resize(kept);
  responses_.resize(kept);
  bias_.resize(kept);
  ids_.resize(kept);
}

void FeatureTracker::follow() {
  if (points_.empty()) return;
  std::vector<cv::Point2f> there = predicted();
  std::vector<uchar> found;
  cv::calcOpticalFlowPyrLK(key_pyramid_, pyramid_, key_points_, there, found, cv::noArray(), kWindow, kLevels, stop(),
                           cv::OPTFLOW_USE_INITIAL_FLOW);
  const std::size_t before = points_.size();
  std::vector<char> good(before, 0);
  std::vector<float> dx;
  std::vector<float> dy;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!found[i] || !is_allowed(there[i])) continue;
    good[i] = 1;
    dx.push_back(there[i].x - points_[i].x);
    dy.push_back(there[i].y - points_[i].y);
  }
  points_ = there;
  keep(good);
  unbias();
  drift_ = dx.empty() ? cv::Point2f() : cv::Point2f(cv::Point2d(median(dx), median(dy)));
  std::size_t together = 0;
  for (std::size_t i = 0; i < dx.size(); ++i)
    together += std::hypot(dx[i] - drift_.x, dy[i] - drift_.y) < kApart_px + 0.5F * std::hypot(drift_.x, drift_.y);
  scattered_ = 2 * together < before;
}

// Takes out of the places what windows that grow or turn add to them.
void FeatureTracker::unbias() {
  const std::vector<cv::Vec4f> gradients = displacement_gradients(key_points_, points_, allowed_.size());
  std::vector<char> good(points_.size(), 0);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const cv::Vec2f added = responses_[i] * gradients[i];
    bias_[i] = {added[0], added[1]};
    points_[i] -= bias_[i];
    good[i] = is_allowed(points_[i]) ? 1 : 0;
  }
  keep(good);
}

// Leaves out features that do not lead back to where they were in the key frame.
void FeatureTracker::check_back() {
  if (points_.empty()) return;
  std::vector<cv::Point2f> back = key_points_;
  std::vector<uchar> found;
  // The way back ends where the way there began, so that the finest level is enough.
  cv::calcOpticalFlowPyrLK(new_key_pyramid_, key_pyramid_, points_, back, found, cv::noArray(), kWindow, 0, stop(),
                           cv::OPTFLOW_USE_INITIAL_FLOW);
  std::vector<char> good(points_.size(), 0);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    // On the way back the window shrinks by as much.
    const cv::Point2f miss = back[i] - key_points_[i] + bias_[i];
    good[i] = found[i] && std::hypot(miss.x, miss.y) < kReturn_px ? 1 : 0;
  }
  keep(good);
}

void FeatureTracker::detect() {
  const double area = static_cast<double>(allowed_.total());
  const int cell = std::max(8, static_cast<int>(std::sqrt(1.25 * area / settings_.features)));
  const int columns = (allowed_.cols + cell - 1) / cell;
  const int rows = (allowed_.rows + cell - 1) / cell;
  // Of several features in a cell the oldest stays: it has seen the longest way.
  std::vector<char> taken(static_cast<std::size_t>(columns * rows), 0);
  std::vector<char> good(points_.size(), 0);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    char& here = taken[static_cast<std::size_t>(cvRound(points_[i].y) / cell * columns + cvRound(points_[i].x) / cell)];
    if (here >= kPerCell) continue;
    ++here;
    good[i] = 1;
  }
  keep(good);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      if (taken[static_cast<std::size_t>(row * columns + column)]) continue;
      const cv::Rect area_px = cv::Rect(column * cell, row * cell, cell, cell) & cv::Rect({0, 0}, allowed_.size());
      double best = 0;
      cv::Point at;
      // With what lies around the cell, so that a corner at its border is as strong as it is elsewhere.
      const cv::Rect wide_px = cv::Rect(area_px.x - kCorner_px, area_px.y - kCorner_px, area_px.width + 2 * kCorner_px,
                                        area_px.height + 2 * kCorner_px) &
                               cv::Rect({0, 0}, allowed_.size());
      cv::cornerMinEigenVal(reduced_(wide_px), corner_, kCorner_px);
      cv::minMaxLoc(corner_(area_px - wide_px.tl()), nullptr, &best, nullptr, &at, allowed_(area_px));
      if (best < kMinCorner) continue;
      points_.emplace_back(static_cast<float>(area_px.x + at.x), static_cast<float>(area_px.y + at.y));
      key_points_.push_back(points_.back());
      responses_.emplace_back();
      bias_.emplace_back();
      ids_.push_back(next_id_++);
    }
}

// Halves as often as that is no more than what is wanted: fast, and each sample counts; the rest by interpolation.
void FeatureTracker::reduce(const cv::Mat& luma) {
  if (luma.size() == allowed_.size()) {
    luma.copyTo(reduced_);
    return;
  }
  cv::Mat from = luma;
  std::size_t step = 0;
  while (from.cols / 2 >= allowed_.cols && from.rows / 2 >= allowed_.rows) {
    if (halved_.size() <= step) halved_.emplace_back();
    cv::resize(from, halved_[step], {from.cols / 2, from.rows / 2}, 0, 0, cv::INTER_AREA);
    from = halved_[step++];
  }
  cv::resize(from, reduced_, allowed_.size(), 0, 0, cv::INTER_LINEAR);
}

const std::vector<Feature>& FeatureTracker::next(const cv::Mat& luma) {
  cv::swap(reduced_, before_);
  reduce(luma);
  repeated_ = !before_.empty() && is_same_image(reduced_, before_);
  if (!repeated_) {
    cv::buildOpticalFlowPyramid(reduced_, pyramid_, kWindow, kLevels, false);
    follow();
    travelled_ += static_cast<float>(std::hypot(drift_.x, drift_.y));
  }
  const bool many_gone = 5 * points_.size() < 3 * key_count_ || key_count_ == 0;
  const bool is_due = ++since_detection_ >= settings_.key_every || many_gone || next_id_ == 0;
  if (is_due || travelled_ > kFar_px || scattered_) take_as_key(is_due);
  features_.clear();
  for (std::size_t i = 0; i < points_.size(); ++i) features_.push_back({ids_[i], full(points_[i])});
  return features_;
}

// Derivatives are needed of the frame that features are followed from, the key frame alone.
void FeatureTracker::take_as_key(bool detects) {
  cv::buildOpticalFlowPyramid(reduced_, new_key_pyramid_, kWindow, kLevels, true);
  check_back();
  // After a cut features are followed to anywhere, and the way back shows it.
  if (detects || 5 * points_.size() < 3 * key_count_) {
    detect();
    since_detection_ = 0;
  }
  travelled_ = 0;
  scattered_ = false;
  std::swap(key_pyramid_, new_key_pyramid_);
  key_points_ = points_;
  bias_.assign(points_.size(), {});
  responses_.clear();
  for (const cv::Point2f& p : key_points_) responses_.push_back(window_response(key_pyramid_[1], p, kWindow_px / 2));
  key_count_ = points_.size();
}

WindowResponse window_response(const cv::Mat& derivatives, cv::Point2f middle, int half) {
  const int column = cvRound(middle.x);
  const int row = cvRound(middle.y);
  float xx = 0, xy = 0, yy = 0;
  WindowResponse sums = WindowResponse::zeros();
  for (int y = row - half; y <= row + half; ++y) {
    const auto* line = derivatives.ptr<cv::Vec2s>(y);
    const float v = static_cast<float>(y) - middle.y;
    for (int x = column - half; x <= column + half; ++x) {
      const float u = static_cast<float>(x) - middle.x;
      const auto gx = static_cast<float>(line[x][0]);
      const auto gy = static_cast<float>(line[x][1]);
      const float a = gx * gx, b = gx * gy, c = gy * gy;
      xx += a;
      xy += b;
      yy += c;
      sums(0, 0) += a * u;
      sums(0, 1) += a * v;
      sums(0, 2) += b * u;
      sums(0, 3) += b * v;
      sums(1, 2) += c * u;
      sums(1, 3) += c * v;
    }
  }
  sums(1, 0) = sums(0, 2);
  sums(1, 1) = sums(0, 3);
  const float determinant = xx * yy - xy * xy;
  if (!(determinant > 1e-4F * (xx + yy) * (xx + yy))) return WindowResponse::zeros();
  return cv::Matx22f(yy, -xy, -xy, xx) * (1 / determinant) * sums;
}

std::vector<cv::Vec4f> displacement_gradients(std::span<const cv::Point2f> from, std::span<const cv::Point2f> to,
                                              cv::Size size_px) {
  const int columns = (size_px.width + kNode_px - 1) / kNode_px;
  const int rows = (size_px.height + kNode_px - 1) / kNode_px;
  std::vector<cv::Vec4f> nodes;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const cv::Point2f place((static_cast<float>(column) + 0.5F) * static_cast<float>(kNode_px),
                              (static_cast<float>(row) + 0.5F) * static_cast<float>(kNode_px));
      LocalFit fit;
      for (int round = 0; round < kRounds; ++round) fit = refined(fit, place, from, to, round == 0);
      nodes.push_back(cv::Vec4f(fit.dx[1], fit.dx[2], fit.dy[1], fit.dy[2]) / kNear_px);
    }
  std::vector<cv::Vec4f> gradients;
  for (const cv::Point2f& p : from) {
    const float x = std::clamp(p.x / static_cast<float>(kNode_px) - 0.5F, 0.0F, static_cast<float>(columns - 1));
    const float y = std::clamp(p.y / static_cast<float>(kNode_px) - 0.5F, 0.0F, static_cast<float>(rows - 1));
    const int column = std::min(static_cast<int>(x), std::max(0, columns - 2));
    const int row = std::min(static_cast<int>(y), std::max(0, rows - 2));
    const float u = x - static_cast<float>(column);
    const float v = y - static_cast<float>(row);
    const auto node = [&](int i, int j) {
      return nodes[static_cast<std::size_t>(std::min(row + j, rows - 1) * columns + std::min(column + i, columns - 1))];
    };
    gradients.push_back((1 - v) * ((1 - u) * node(0, 0) + u * node(1, 0)) +
                        v * ((1 - u) * node(0, 1) + u * node(1, 1)));
  }
  return gradients;
}

}  // namespace sigs
