// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>

#include "base/result.h"
#include "evaluation/clip_truth.h"
#include "video/frame_source.h"

namespace sigs::cli {

// The images that a label file is about: an exported video, or a folder of numbered images.
class LabelledImages {
 public:
  // Beside NAME.xml: NAME.mkv, .mp4, .avi or the folder NAME. Error cannot_read: there is none, or more than one.
  [[nodiscard]] static Result<std::filesystem::path> beside(const std::filesystem::path& labels);

  // Error bad_data where number or size of the images are not those of the labels.
  [[nodiscard]] static Result<LabelledImages> open(const std::filesystem::path& path, const ClipTruth& clip);

  // The image of a frame, by the footage's number; CV_8UC3, BGR.
  [[nodiscard]] Result<cv::Mat> at(int frame);

 private:
  LabelledImages(std::filesystem::path path, FootageTruth footage) : path_(std::move(path)), footage_(footage) {}

  std::filesystem::path path_;
  FootageTruth footage_;
  std::optional<FrameSource> video_;  // none: path_ is a folder
};

}  // namespace sigs::cli
