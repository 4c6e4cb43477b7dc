// SPDX-License-Identifier: MIT
#include "editor/views/own_body/own_body_images.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "base/ensure.h"
#include "editor/views/readable.h"

namespace sigs::editor {

namespace {

// Blue, green, red.
const cv::Vec3d kWorld(170, 110, 40);
const cv::Vec3d kUnknown(70, 70, 70);
const cv::Vec3d kBody(230, 110, 225);

cv::Vec3b color_of(double confidence) {
  const double side = 2 * confidence - 1;
  return cv::Vec3b(kUnknown + std::abs(side) * ((side < 0 ? kWorld : kBody) - kUnknown));
}

std::string frames_text(int frames) {
  return std::to_string(frames) + (frames == 1 ? " frame" : " frames");
}

}  // namespace

cv::Mat confidence_image(const cv::Mat& confidence) {
  ENSURE(confidence.empty() || confidence.type() == CV_16UC1);
  static const std::vector<cv::Vec3b> kColors = [] {
    std::vector<cv::Vec3b> colors(256);
    for (std::size_t i = 0; i < colors.size(); ++i) colors[i] = color_of(static_cast<double>(i) / 255);
    return colors;
  }();
  cv::Mat image(confidence.size(), CV_8UC3);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      // 65535 is 255 times 257.
      const auto index = static_cast<std::size_t>((confidence.at<ushort>(y, x) + 128) / 257);
      image.at<cv::Vec3b>(y, x) = kColors[index];
    }
  return image;
}

std::vector<StageTile> stage_tiles(const OwnBody& found) {
  std::vector<StageTile> tiles;
  for (const DetectionStage& stage : found.stages)
    if (!stage.image.empty())
      tiles.push_back({std::to_string(tiles.size() + 1) + "  " + stage.title, stage.name, stage.image});
  return tiles;
}

std::string share_text(double share) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), share < 0.1 ? "%.2g" : "%.3g", share * 100);
  return std::string(text.data()) + " % of the image";
}

std::string result_text(const OwnBody& found) {
  const std::string frames = frames_text(found.frames_used) + (found.converged ? ", converged early" : "");
  return (found.share > 0 ? "Found in " : "No own body in ") + frames;
}

std::vector<std::string> doubts_about(const OwnBody& found, double seconds) {
  std::vector<std::string> doubts;
  for (const Warning& warning : found.warnings) doubts.push_back(warning.text());
  if (found.share > kLargeShare)
    doubts.push_back(share_text(found.share) + ", more than half, is masked: is that the aircraft, or the world?");
  if (seconds < kEnoughFootage_s) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "Only %.2g s of footage", seconds);
    doubts.push_back(std::string(text.data()) +
                     " were looked through: what hardly moved meanwhile may be taken for own body. Look closely.");
  }
  return doubts;
}

std::string progress_text(const DetectionState& state) {
  if (state.is_stopping) return "stopping...";
  if (state.total <= 0) return "opening the footage...";
  std::string text = std::to_string(state.done) + " of " + frames_text(state.total);
  if (state.left_s) text += ", " + clock_text(*state.left_s) + " left";
  return text;
}

}  // namespace sigs::editor
