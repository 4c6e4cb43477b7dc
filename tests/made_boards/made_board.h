// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/core/affine.hpp>
#include <span>
#include <string>
#include <vector>

namespace sigs::made {

// A camera as OpenCV describes it. With `fisheye` four coefficients of cv::fisheye, else those of cv::projectPoints.
struct BoardCamera {
  std::string name;
  cv::Size size_px;
  cv::Matx33d matrix;
  std::vector<double> coefficients;
  bool fisheye = false;
};

// Pixels of points in the optical frame by OpenCV's projectPoints or fisheye::projectPoints.
[[nodiscard]] std::vector<cv::Point2d> projected_by_opencv(const BoardCamera& camera,
                                                           const std::vector<cv::Point3d>& p_in_optical);

// A chessboard, or a ChArUco board where there is a marker.
struct MadeBoard {
  cv::Size corners{9, 6};  // inner ones
  double square_m = 0.03;
  double marker_m = 0;
  int dictionary = 0;

  // Inner corners row by row from the upper left, in metres from it; z = 0.
  [[nodiscard]] std::vector<cv::Point3d> corners_m() const;
};

// How the image is taken.
struct Exposure {
  double blur_px = 0.7;    // standard deviation of the lens' blur
  double noise = 2;        // standard deviation, grey values
  double gain = 1;         // of the light
  std::uint32_t seed = 1;  // of the noise
};

// Draws the board. The pose takes points of the board to the optical frame.
class BoardRenderer {
 public:
  BoardRenderer(BoardCamera camera, MadeBoard board, int samples_a_side = 3);

  // CV_8UC1. With several poses it is the mean over them: motion during the exposure.
  [[nodiscard]] cv::Mat image(std::span<const cv::Affine3d> optical_from_board, const Exposure& exposure) const;

  // Where the corners are in the image, exactly.
  [[nodiscard]] std::vector<cv::Point2d> corners_px(const cv::Affine3d& optical_from_board) const;

  // Whether the whole board with its white border is in the image, `margin_px` from its edges.
  [[nodiscard]] bool is_inside(const cv::Affine3d& optical_from_board, double margin_px) const;

  [[nodiscard]] const BoardCamera& camera() const { return camera_; }
  [[nodiscard]] const MadeBoard& board() const { return board_; }

 private:
  [[nodiscard]] cv::Rect touched(std::span<const cv::Affine3d> poses) const;
  [[nodiscard]] std::vector<cv::Point3d> outline_m() const;
  [[nodiscard]] float brightness(float x_squares, float y_squares) const;

  BoardCamera camera_;
  MadeBoard board_;
  int samples_;
  cv::Mat rays_;        // CV_32FC2: x / z and y / z of each sample; NaN where there is none
  cv::Mat pattern_;     // of a ChArUco board, CV_8UC1
  cv::Mat background_;  // CV_32FC1, 0..1
};

}  // namespace sigs::made
