// SPDX-License-Identifier: MIT
#include "made_boards/made_board.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace sigs::made {

namespace {

constexpr int kPatternPx = 48;    // of a square in the drawing of a ChArUco board
constexpr double kBorder = 0.75;  // white border, squares
constexpr float kWhite = 0.80F;
constexpr float kBlack = 0.07F;

std::vector<cv::Point2d> undistorted(const BoardCamera& camera, const std::vector<cv::Point2d>& pixels) {
  std::vector<cv::Point2d> plane;
  const cv::TermCriteria exactly(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 100, 1e-10);
  if (camera.fisheye)
    cv::fisheye::undistortPoints(pixels, plane, camera.matrix, camera.coefficients);
  else
    cv::undistortPoints(pixels, plane, camera.matrix, camera.coefficients, cv::noArray(), cv::noArray(), exactly);
  return plane;
}

// The directions of all samples of a row of samples; NaN where the way back does not lead to the pixel.
void fill_row(const BoardCamera& camera, int samples, int row, cv::Mat& rays) {
  std::vector<cv::Point2d> pixels;
  for (int i = 0; i < rays.cols; ++i) pixels.emplace_back((i + 0.5) / samples - 0.5, (row + 0.5) / samples - 0.5);
  const std::vector<cv::Point2d> plane = undistorted(camera, pixels);
  std::vector<cv::Point3d> points;
  for (const cv::Point2d& p : plane) points.emplace_back(p.x, p.y, 1);
  const std::vector<cv::Point2d> back = projected_by_opencv(camera, points);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (int i = 0; i < rays.cols; ++i) {
    const bool is_good = cv::norm(plane[i]) < 60 && cv::norm(back[i] - pixels[i]) < 0.01;
    rays.at<cv::Vec2f>(row, i) =
        is_good ? cv::Vec2f(static_cast<float>(plane[i].x), static_cast<float>(plane[i].y)) : cv::Vec2f(nan, nan);
  }
}

// A room out of focus: neither flat nor with edges.
cv::Mat room(cv::Size size_px) {
  cv::Mat light(size_px, CV_32FC1);
  for (int y = 0; y < size_px.height; ++y)
    for (int x = 0; x < size_px.width; ++x)
      light.at<float>(y, x) = static_cast<float>(0.35 + 0.1 * std::sin(x * 0.013 + 1) * std::cos(y * 0.017) +
                                                 0.06 * std::sin((x + 2.0 * y) * 0.031));
  return light;
}

}  // namespace

std::vector<cv::Point2d> projected_by_opencv(const BoardCamera& camera, const std::vector<cv::Point3d>& p_in_optical) {
  std::vector<cv::Point2d> pixels;
  const cv::Vec3d zero(0, 0, 0);
  if (camera.fisheye)
    cv::fisheye::projectPoints(p_in_optical, pixels, zero, zero, camera.matrix, camera.coefficients);
  else
    cv::projectPoints(p_in_optical, zero, zero, camera.matrix, camera.coefficients, pixels);
  return pixels;
}

std::vector<cv::Point3d> MadeBoard::corners_m() const {
  std::vector<cv::Point3d> all;
  for (int y = 0; y < corners.height; ++y)
    for (int x = 0; x < corners.width; ++x) all.emplace_back(x * square_m, y * square_m, 0);
  return all;
}

BoardRenderer::BoardRenderer(BoardCamera camera, MadeBoard board, int samples_a_side)
    : camera_(std::move(camera)), board_(board), samples_(samples_a_side), background_(room(camera_.size_px)) {
  rays_.create(camera_.size_px * samples_, CV_32FC2);
  for (int row = 0; row < rays_.rows; ++row) fill_row(camera_, samples_, row, rays_);
  if (board_.marker_m <= 0) return;
  const cv::Size squares(board_.corners.width + 1, board_.corners.height + 1);
  const auto charuco = cv::aruco::CharucoBoard::create(
      squares.width, squares.height, static_cast<float>(board_.square_m), static_cast<float>(board_.marker_m),
      cv::aruco::getPredefinedDictionary(board_.dictionary));
  charuco->draw(squares * kPatternPx, pattern_);
}

std::vector<cv::Point3d> BoardRenderer::outline_m() const {
  constexpr int kSteps = 12;
  const double left = -(1 + kBorder);
  const cv::Point2d end(board_.corners.width + kBorder, board_.corners.height + kBorder);
  std::vector<cv::Point3d> outline;
  for (int i = 0; i <= kSteps; ++i) {
    const double x = left + (end.x - left) * i / kSteps;
    const double y = left + (end.y - left) * i / kSteps;
    for (const cv::Point2d p :
         {cv::Point2d(x, left), cv::Point2d(x, end.y), cv::Point2d(left, y), cv::Point2d(end.x, y)})
      outline.emplace_back(p.x * board_.square_m, p.y * board_.square_m, 0);
  }
  return outline;
}

std::vector<cv::Point2d> BoardRenderer::corners_px(const cv::Affine3d& optical_from_board) const {
  std::vector<cv::Point3d> points;
  for (const cv::Point3d& p : board_.corners_m()) points.push_back(optical_from_board * p);
  return projected_by_opencv(camera_, points);
}

bool BoardRenderer::is_inside(const cv::Affine3d& optical_from_board, double margin_px) const {
  std::vector<cv::Point3d> points;
  for (const cv::Point3d& p : outline_m()) {
    points.push_back(optical_from_board * p);
    if (points.back().z < 0.05 * cv::norm(points.back())) return false;
  }
  for (const cv::Point2d& at : projected_by_opencv(camera_, points)) {
    if (!(at.x > margin_px && at.y > margin_px && at.x < camera_.size_px.width - 1 - margin_px &&
          at.y < camera_.size_px.height - 1 - margin_px))
      return false;
    const auto ray = rays_.at<cv::Vec2f>(cvRound(at.y * samples_), cvRound(at.x * samples_));
    if (std::isnan(ray[0])) return false;
  }
  return true;
}

// All of the image where a part of the board is behind the camera.
cv::Rect BoardRenderer::touched(std::span<const cv::Affine3d> poses) const {
  const cv::Rect whole({}, camera_.size_px);
  std::vector<cv::Point2f> all;
  for (const cv::Affine3d& pose : poses) {
    std::vector<cv::Point3d> points;
    for (const cv::Point3d& p : outline_m()) points.push_back(pose * p);
    for (const cv::Point3d& p : points)
      if (p.z < 0.05 * cv::norm(p)) return whole;
    for (const cv::Point2d& at : projected_by_opencv(camera_, points)) all.emplace_back(at);
  }
  const cv::Rect box = cv::boundingRect(all);
  return cv::Rect(box.x - 8, box.y - 8, box.width + 16, box.height + 16) & whole;
}

// Negative beside the board.
float BoardRenderer::brightness(float x, float y) const {
  const auto border = static_cast<float>(kBorder);
  const auto columns = static_cast<float>(board_.corners.width);
  const auto rows = static_cast<float>(board_.corners.height);
  if (x < -1 - border || y < -1 - border || x > columns + border || y > rows + border) return -1;
  if (x < -1 || y < -1 || x > columns || y > rows) return kWhite;
  if (pattern_.empty())
    return ((static_cast<int>(std::floor(x)) + static_cast<int>(std::floor(y))) & 1) != 0 ? kWhite : kBlack;
  const float u = std::clamp((x + 1) * kPatternPx - 0.5F, 0.0F, static_cast<float>(pattern_.cols) - 1.001F);
  const float v = std::clamp((y + 1) * kPatternPx - 0.5F, 0.0F, static_cast<float>(pattern_.rows) - 1.001F);
  const int i = static_cast<int>(u);
  const int j = static_cast<int>(v);
  const float a = u - static_cast<float>(i);
  const float b = v - static_cast<float>(j);
  const auto at = [this](int column, int row) { return static_cast<float>(pattern_.at<uchar>(row, column)); };
  const float ink =
      (1 - b) * ((1 - a) * at(i, j) + a * at(i + 1, j)) + b * ((1 - a) * at(i, j + 1) + a * at(i + 1, j + 1));
  return kBlack + (kWhite - kBlack) * ink / 255;
}

cv::Mat BoardRenderer::image(std::span<const cv::Affine3d> optical_from_board, const Exposure& exposure) const {
  cv::Mat light = background_.clone();
  const cv::Rect box = touched(optical_from_board);
  const auto count = static_cast<float>(samples_ * samples_) * static_cast<float>(optical_from_board.size());
  std::vector<cv::Matx33f> board_from_ray;  // (x / z, y / z, 1) to homogeneous squares of the board
  for (const cv::Affine3d& pose : optical_from_board) {
    const cv::Matx33d r = pose.rotation();
    const cv::Vec3d t = pose.translation() / board_.square_m;
    board_from_ray.emplace_back(
        cv::Matx33d(r(0, 0), r(0, 1), t[0], r(1, 0), r(1, 1), t[1], r(2, 0), r(2, 1), t[2]).inv());
  }
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x) {
      const float behind = background_.at<float>(y, x);
      float sum = 0;
      for (int s = 0; s < samples_ * samples_; ++s) {
        const auto ray = rays_.at<cv::Vec2f>(y * samples_ + s / samples_, x * samples_ + s % samples_);
        for (const cv::Matx33f& m : board_from_ray) {
          const cv::Vec3f p = m * cv::Vec3f(ray[0], ray[1], 1);
          const float seen = p[2] > 0 ? brightness(p[0] / p[2], p[1] / p[2]) : -1;  // false for NaN too
          sum += seen >= 0 ? seen : behind;
        }
      }
      light.at<float>(y, x) = sum / count;
    }
  if (exposure.blur_px > 0) cv::GaussianBlur(light, light, {}, exposure.blur_px, exposure.blur_px);
  cv::Mat noise(light.size(), CV_32FC1);
  cv::RNG random(exposure.seed * 2654435761U + 12345U);
  random.fill(noise, cv::RNG::NORMAL, 0, std::max(exposure.noise, 1e-6));
  cv::Mat image;
  light.convertTo(image, CV_32FC1, 255 * exposure.gain);
  image += noise;
  image.convertTo(image, CV_8UC1);
  return image;
}

}  // namespace sigs::made
