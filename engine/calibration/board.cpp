// SPDX-License-Identifier: MIT
#include "calibration/board.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <opencv2/aruco/dictionary.hpp>
#include <utility>

#include "base/text.h"

namespace sigs {

namespace {

using Named = std::pair<const char*, int>;
constexpr std::array<Named, 17> kDictionaries{{{"DICT_4X4_50", cv::aruco::DICT_4X4_50},
                                               {"DICT_4X4_100", cv::aruco::DICT_4X4_100},
                                               {"DICT_4X4_250", cv::aruco::DICT_4X4_250},
                                               {"DICT_4X4_1000", cv::aruco::DICT_4X4_1000},
                                               {"DICT_5X5_50", cv::aruco::DICT_5X5_50},
                                               {"DICT_5X5_100", cv::aruco::DICT_5X5_100},
                                               {"DICT_5X5_250", cv::aruco::DICT_5X5_250},
                                               {"DICT_5X5_1000", cv::aruco::DICT_5X5_1000},
                                               {"DICT_6X6_50", cv::aruco::DICT_6X6_50},
                                               {"DICT_6X6_100", cv::aruco::DICT_6X6_100},
                                               {"DICT_6X6_250", cv::aruco::DICT_6X6_250},
                                               {"DICT_6X6_1000", cv::aruco::DICT_6X6_1000},
                                               {"DICT_7X7_50", cv::aruco::DICT_7X7_50},
                                               {"DICT_7X7_100", cv::aruco::DICT_7X7_100},
                                               {"DICT_7X7_250", cv::aruco::DICT_7X7_250},
                                               {"DICT_7X7_1000", cv::aruco::DICT_7X7_1000},
                                               {"DICT_ARUCO_ORIGINAL", cv::aruco::DICT_ARUCO_ORIGINAL}}};

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
  std::string names;
  for (const Named& known : kDictionaries) {
    if (name == known.first) return known.second;
    names.append(names.empty() ? "" : ", ").append(known.first);
  }
  return fail("--dictionary", fmt::format("there is no {}; there are {}", name, names), ErrorKind::usage);
}

std::string dictionary_name(int dictionary) {
  for (const Named& known : kDictionaries)
    if (dictionary == known.second) return known.first;
  return std::to_string(dictionary);
}

}  // namespace sigs
