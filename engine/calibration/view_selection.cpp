// SPDX-License-Identifier: MIT
#include "calibration/view_selection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <utility>

namespace sigs {

namespace {

constexpr double kWidestEdge = 1.8;    // of the first quartile
constexpr double kSharpEdge_px = 2.5;  // no wider one is left out
constexpr double kAlike = 0.01;        // of the image's diagonal

using OuterCorners = std::array<cv::Point2d, 4>;  // shares of the image's diagonal

OuterCorners outer_corners(const BoardView& view, const CalibrationBoard& board, cv::Size size_px) {
  std::vector<cv::Point2d> on_board;
  for (const int id : view.ids) on_board.push_back(board.corner_m(id) / board.square_m);
  const double right = board.corners.width - 1;
  const double bottom = board.corners.height - 1;
  std::vector<cv::Point2d> outer{{0, 0}, {right, 0}, {right, bottom}, {0, bottom}};
  const cv::Mat homography = cv::findHomography(on_board, view.at_px);
  if (!homography.empty()) cv::perspectiveTransform(outer, outer, homography);
  OuterCorners shares;
  const double diagonal_px = std::hypot(size_px.width, size_px.height);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    // A corner that the homography takes far away says no more than that it is outside.
    const auto share = [&](double px) { return std::isfinite(px) ? std::clamp(px / diagonal_px, -0.5, 1.5) : 0.0; };
    shares[i] = {share(outer[i].x), share(outer[i].y)};
  }
  return shares;
}

// A chessboard looks the same upside down: the smaller difference counts.
double difference(const OuterCorners& a, const OuterCorners& b) {
  double same = 0;
  double turned = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    same += (a[i] - b[i]).ddot(a[i] - b[i]);
    turned += (a[i] - b[(i + 2) % 4]).ddot(a[i] - b[(i + 2) % 4]);
  }
  return std::sqrt(std::min(same, turned) / 4);
}

int drop_blurred(std::vector<BoardView>& views) {
  if (views.empty()) return 0;
  std::vector<double> edges_px;
  for (const BoardView& view : views) edges_px.push_back(view.edge_px);
  std::ranges::sort(edges_px);
  const double widest_px = std::max(kSharpEdge_px, kWidestEdge * edges_px[edges_px.size() / 4]);
  return static_cast<int>(std::erase_if(views, [&](const BoardView& view) { return view.edge_px > widest_px; }));
}

// Indices of the views taken, ascending.
std::vector<std::size_t> most_different(const std::vector<BoardView>& views, const std::vector<OuterCorners>& corners,
                                        int most) {
  std::vector<std::size_t> taken;
  std::vector<double> distances(views.size(), std::numeric_limits<double>::infinity());
  const auto sharper = [](const BoardView& a, const BoardView& b) { return a.edge_px < b.edge_px; };
  auto next = static_cast<std::size_t>(std::ranges::min_element(views, sharper) - views.begin());
  while (static_cast<int>(taken.size()) < most && distances[next] > kAlike) {
    taken.push_back(next);
    for (std::size_t i = 0; i < views.size(); ++i)
      distances[i] = std::min(distances[i], difference(corners[i], corners[next]));
    next = static_cast<std::size_t>(std::ranges::max_element(distances) - distances.begin());
  }
  std::ranges::sort(taken);
  return taken;
}

}  // namespace

ViewSelection selected_views(std::vector<BoardView> views, const CalibrationBoard& board, cv::Size size_px, int most) {
  ViewSelection selection;
  selection.blurred = drop_blurred(views);
  if (views.empty()) return selection;
  std::vector<OuterCorners> corners;
  for (const BoardView& view : views) corners.push_back(outer_corners(view, board, size_px));
  const std::vector<std::size_t> taken = most_different(views, corners, most);
  selection.alike = static_cast<int>(views.size() - taken.size());
  for (const std::size_t i : taken) selection.views.push_back(std::move(views[i]));
  return selection;
}

}  // namespace sigs
