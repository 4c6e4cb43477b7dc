// SPDX-License-Identifier: MIT
#include "calibration/board.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/aruco/dictionary.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <utility>

#include "base/statistics.h"
#include "base/text.h"

namespace sigs {

namespace {

// By their numbers in OpenCV.
constexpr std::array<std::string_view, 17> kDictionaries{
    "DICT_4X4_50",  "DICT_4X4_100",  "DICT_4X4_250", "DICT_4X4_1000", "DICT_5X5_50",        "DICT_5X5_100",
    "DICT_5X5_250", "DICT_5X5_1000", "DICT_6X6_50",  "DICT_6X6_100",  "DICT_6X6_250",       "DICT_6X6_1000",
    "DICT_7X7_50",  "DICT_7X7_100",  "DICT_7X7_250", "DICT_7X7_1000", "DICT_ARUCO_ORIGINAL"};
static_assert(cv::aruco::DICT_4X4_50 == 0 && cv::aruco::DICT_7X7_1000 == 15 && cv::aruco::DICT_ARUCO_ORIGINAL == 16);

Result<void> check_markers(const CalibrationBoard& board) {
  if (!(board.marker_m > 0) || !(board.marker_m < board.square_m))
    return fail("--marker-m",
                fmt::format("a marker lies inside a square: give more than 0 and less than {}",
                            short_number_text(board.square_m)),
                ErrorKind::usage);
  const int markers = (board.corners.width + 1) * (board.corners.height + 1) / 2;
  const int available = cv::aruco::getPredefinedDictionary(board.dictionary)->bytesList.rows;
  if (markers > available)
    return fail(
        "--dictionary",
        fmt::format("{} has {} markers, the board needs {}", dictionary_name(board.dictionary), available, markers),
        ErrorKind::usage);
  return {};
}

}  // namespace

Result<void> check_board(const CalibrationBoard& board) {
  constexpr int kFewest = 3;
  constexpr int kMost = 100;
  const auto [columns, rows] = std::pair(board.corners.width, board.corners.height);
  if (std::min(columns, rows) < kFewest || std::max(columns, rows) > kMost)
    return fail("--corners",
                fmt::format("{} to {} inner corners a side can be found, not {}", kFewest, kMost,
                            image_size_text(board.corners)),
                ErrorKind::usage);
  if (!(board.square_m > 0) || !std::isfinite(board.square_m))
    return fail("--square-m", "must be more than 0", ErrorKind::usage);
  return board.kind == BoardKind::charuco ? check_markers(board) : Result<void>();
}

Result<int> dictionary_of(std::string_view name) {
  const auto found = std::ranges::find(kDictionaries, name);
  if (found != kDictionaries.end()) return static_cast<int>(found - kDictionaries.begin());
  return fail("--dictionary", fmt::format("there is no {}; there are {}", name, listed(kDictionaries)),
              ErrorKind::usage);
}

std::string dictionary_name(int dictionary) {
  const auto index = static_cast<std::size_t>(dictionary);  // beyond the end for negative ones
  return index < kDictionaries.size() ? std::string(kDictionaries[index]) : std::to_string(dictionary);
}

namespace {

constexpr int kSearchedWidth_px = 1280;
constexpr double kChessboardWindow = 0.4;  // half the window in which a corner is refined, squares
constexpr double kBesideMarker = 0.8;      // the same of ChArUco: share of the gap between corner and marker

// The corners by their ids, to find the neighbours of each.
class CornerGrid {
 public:
  CornerGrid(const BoardView& view, const CalibrationBoard& board)
      : view_(view), size_(board.corners), at_(static_cast<std::size_t>(board.corner_count()), -1) {
    for (std::size_t i = 0; i < view.size(); ++i) at_[static_cast<std::size_t>(view.ids[i])] = static_cast<int>(i);
  }

  // Index in the view of the corner so many columns and rows on from corner i; -1: not seen.
  [[nodiscard]] int neighbour(std::size_t i, int columns, int rows) const {
    const int column = view_.ids[i] % size_.width + columns;
    const int row = view_.ids[i] / size_.width + rows;
    if (column < 0 || row < 0 || column >= size_.width || row >= size_.height) return -1;
    return at_[static_cast<std::size_t>(row * size_.width + column)];
  }

  // To the nearest neighbour seen; 0 where there is none.
  [[nodiscard]] double spacing_px(std::size_t i) const {
    double nearest = 0;
    for (const auto& [columns, rows] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
      const int other = neighbour(i, columns, rows);
      if (other < 0) continue;
      const double distance = cv::norm(view_.at_px[i] - view_.at_px[static_cast<std::size_t>(other)]);
      nearest = nearest > 0 ? std::min(nearest, distance) : distance;
    }
    return nearest;
  }

 private:
  const BoardView& view_;
  cv::Size size_;
  std::vector<int> at_;
};

// Half of what lies around a corner without anything else, squares.
double free_around(const CalibrationBoard& board) {
  if (board.kind == BoardKind::chessboard) return kChessboardWindow;
  return kBesideMarker * (1 - board.marker_m / board.square_m) / 2;
}

void refine(const cv::Mat& luma, const CalibrationBoard& board, BoardView& view) {
  constexpr int kSmallest_px = 2;
  constexpr int kLargest_px = 30;
  const cv::TermCriteria enough(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 50, 1e-4);
  const BoardView before = view;
  const CornerGrid grid(before, board);
  for (std::size_t i = 0; i < view.size(); ++i) {
    const double window_px = free_around(board) * grid.spacing_px(i);
    const int half_px = std::clamp(static_cast<int>(window_px), kSmallest_px, kLargest_px);
    std::vector<cv::Point2f> corner{cv::Point2f(view.at_px[i])};
    cv::cornerSubPix(luma, corner, {half_px, half_px}, {-1, -1}, enough);
    view.at_px[i] = corner.front();
  }
}

// The image as it is searched; `scale` takes its pixels to those of the whole image.
cv::Mat searched(const cv::Mat& luma, double& scale) {
  scale = std::max(1.0, static_cast<double>(luma.cols) / kSearchedWidth_px);
  if (scale == 1) return luma;
  cv::Mat small;
  cv::resize(luma, small, {}, 1 / scale, 1 / scale, cv::INTER_AREA);
  scale = static_cast<double>(luma.cols) / small.cols;
  return small;
}

std::optional<BoardView> found_chessboard(const cv::Mat& luma, const CalibrationBoard& board) {
  double scale = 1;
  std::vector<cv::Point2f> corners;
  if (!cv::findChessboardCornersSB(searched(luma, scale), board.corners, corners, cv::CALIB_CB_NORMALIZE_IMAGE))
    return std::nullopt;
  if (corners.size() != static_cast<std::size_t>(board.corner_count())) return std::nullopt;
  BoardView view;
  for (const cv::Point2f corner : corners) {
    view.ids.push_back(static_cast<int>(view.ids.size()));
    // Pixel centres are whole numbers: the image's left edge is at -0.5 at every size.
    view.at_px.emplace_back((corner.x + 0.5) * scale - 0.5, (corner.y + 0.5) * scale - 0.5);
  }
  return view;
}

struct Markers {
  std::vector<std::vector<cv::Point2f>> corners_px;
  std::vector<int> ids;
};

Markers markers_in(const cv::Mat& luma, int dictionary) {
  Markers found;
  cv::aruco::detectMarkers(luma, cv::aruco::getPredefinedDictionary(dictionary), found.corners_px, found.ids);
  return found;
}

std::optional<BoardView> found_charuco(const cv::Mat& luma, const CalibrationBoard& board) {
  const Markers markers = markers_in(luma, board.dictionary);
  if (markers.ids.size() < 2) return std::nullopt;
  const auto charuco = cv::aruco::CharucoBoard::create(
      board.corners.width + 1, board.corners.height + 1, static_cast<float>(board.square_m),
      static_cast<float>(board.marker_m), cv::aruco::getPredefinedDictionary(board.dictionary));
  cv::Mat corners, ids;
  cv::aruco::interpolateCornersCharuco(markers.corners_px, markers.ids, luma, charuco, corners, ids);
  BoardView view;
  for (int i = 0; i < ids.rows; ++i) {
    const cv::Point2f at = corners.at<cv::Point2f>(i);
    const bool is_inside = cv::Rect({}, luma.size()).contains(cv::Point(at));
    if (!is_inside || ids.at<int>(i) < 0 || ids.at<int>(i) >= board.corner_count()) continue;
    view.ids.push_back(ids.at<int>(i));
    view.at_px.emplace_back(at);
  }
  return view;
}

// Whether the corners determine a pose: 8 or more, in two rows and two columns or more.
bool is_enough(const BoardView& view, const CalibrationBoard& board) {
  constexpr std::size_t kFewest = 8;
  std::set<int> columns, rows;
  for (const int id : view.ids) {
    columns.insert(id % board.corners.width);
    rows.insert(id / board.corners.width);
  }
  return view.size() >= kFewest && columns.size() >= 2 && rows.size() >= 2;
}

double sample(const cv::Mat& luma, cv::Point2d at) {
  const int x = std::clamp(static_cast<int>(std::floor(at.x)), 0, luma.cols - 2);
  const int y = std::clamp(static_cast<int>(std::floor(at.y)), 0, luma.rows - 2);
  const double a = std::clamp(at.x - x, 0.0, 1.0);
  const double b = std::clamp(at.y - y, 0.0, 1.0);
  return (1 - b) * ((1 - a) * luma.at<uchar>(y, x) + a * luma.at<uchar>(y, x + 1)) +
         b * ((1 - a) * luma.at<uchar>(y + 1, x) + a * luma.at<uchar>(y + 1, x + 1));
}

// Width from 10 to 90 % of an edge that rises from the first to the last value; 0 without contrast.
double rise_px(std::vector<double> profile, double step_px) {
  constexpr double kContrast = 20;  // grey values
  constexpr std::size_t kEnds = 2;
  if (profile.front() > profile.back()) std::reverse(profile.begin(), profile.end());
  double low = 0;
  double high = 0;
  for (std::size_t i = 0; i < kEnds; ++i) {
    low += profile[i] / kEnds;
    high += profile[profile.size() - 1 - i] / kEnds;
  }
  if (high - low < kContrast) return 0;
  const auto crossing = [&](double share) {
    const double level = low + share * (high - low);
    for (std::size_t i = 1; i < profile.size(); ++i)
      if (profile[i] >= level && profile[i] > profile[i - 1])
        return static_cast<double>(i) - std::clamp((profile[i] - level) / (profile[i] - profile[i - 1]), 0.0, 1.0);
    return static_cast<double>(profile.size() - 1);
  };
  return std::max(0.0, crossing(0.9) - crossing(0.1)) * step_px;
}

// Of the edge between two neighbouring corners, at its middle.
double edge_width_px(const cv::Mat& luma, cv::Point2d a, cv::Point2d b, double reach_squares) {
  constexpr double kStep_px = 0.5;
  constexpr double kLongest_px = 12;
  const double length_px = cv::norm(b - a);
  const double reach_px = std::clamp(reach_squares * length_px, 2.5, kLongest_px);
  if (!(length_px > 2)) return 0;
  const cv::Point2d across(-(b.y - a.y) / length_px, (b.x - a.x) / length_px);
  std::vector<double> profile;
  for (double at = -reach_px; at <= reach_px; at += kStep_px)
    profile.push_back(sample(luma, (a + b) / 2 + across * at));
  return rise_px(std::move(profile), kStep_px);
}

// Of edges along rows or along columns.
double median_edge_px(const cv::Mat& luma, const BoardView& view, const CalibrationBoard& board, cv::Size step) {
  const CornerGrid grid(view, board);
  std::vector<double> widths_px;
  for (std::size_t i = 0; i < view.size(); ++i) {
    const int other = grid.neighbour(i, step.width, step.height);
    if (other < 0) continue;
    const double width_px =
        edge_width_px(luma, view.at_px[i], view.at_px[static_cast<std::size_t>(other)], 0.75 * free_around(board));
    if (width_px > 0) widths_px.push_back(width_px);
  }
  return widths_px.empty() ? 0 : median(std::move(widths_px));
}

}  // namespace

std::optional<BoardView> found_board(const cv::Mat& luma, const CalibrationBoard& board) {
  std::optional<BoardView> view =
      board.kind == BoardKind::chessboard ? found_chessboard(luma, board) : found_charuco(luma, board);
  if (!view || !is_enough(*view, board)) return std::nullopt;
  refine(luma, board, *view);
  view->edge_px = board_edge_px(luma, *view, board);
  return view;
}

double board_edge_px(const cv::Mat& luma, const BoardView& view, const CalibrationBoard& board) {
  return std::max(median_edge_px(luma, view, board, {1, 0}), median_edge_px(luma, view, board, {0, 1}));
}

std::string other_board_in(const cv::Mat& luma, const CalibrationBoard& board) {
  constexpr std::size_t kFewMarkers = 4;
  if (board.kind == BoardKind::charuco) {
    for (const int dictionary : {cv::aruco::DICT_4X4_1000, cv::aruco::DICT_5X5_1000, cv::aruco::DICT_6X6_1000,
                                 cv::aruco::DICT_7X7_1000, cv::aruco::DICT_ARUCO_ORIGINAL})
      if (const Markers found = markers_in(luma, dictionary); found.ids.size() >= kFewMarkers)
        return fmt::format("markers of {} with numbers up to {}", dictionary_name(dictionary),
                           *std::max_element(found.ids.begin(), found.ids.end()));
  }
  double scale = 1;
  cv::Mat corners, meta;
  const cv::Mat small = searched(luma, scale);
  if (!cv::findChessboardCornersSB(small, {3, 3}, corners, cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_LARGER, meta))
    return "";
  cv::Size size(meta.cols, meta.rows);
  if (size == board.corners && board.kind == BoardKind::chessboard) return "";
  return fmt::format("a chessboard of {} inner corners", image_size_text(size));
}

double detail_of(const cv::Mat& luma) {
  cv::Mat small;
  cv::resize(luma, small, {}, 0.5, 0.5, cv::INTER_AREA);
  cv::Mat second;
  cv::Laplacian(small, second, CV_16S);
  return cv::norm(second, cv::NORM_L2SQR) / static_cast<double>(second.total());
}

}  // namespace sigs
