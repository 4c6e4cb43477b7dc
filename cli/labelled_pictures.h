// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>

#include "base/result.h"
#include "evaluation/truth.h"
#include "video/frame_source.h"

namespace sigs::cli {

// The pictures that a label file is about: an exported video, or a folder of numbered pictures.
class LabelledPictures {
 public:
  // Beside NAME.xml: NAME.mkv, .mp4, .avi or the folder NAME. Error cannot_read: there is none, or more than one.
  [[nodiscard]] static Result<std::filesystem::path> beside(const std::filesystem::path& labels);

  // Error bad_data where number or size of the pictures are not those of the labels.
  [[nodiscard]] static Result<LabelledPictures> open(const std::filesystem::path& path, const FilmTruth& film);

  // The picture of a frame, by the footage's number; CV_8UC3, BGR.
  [[nodiscard]] Result<cv::Mat> at(int frame);

 private:
  LabelledPictures(std::filesystem::path path, FootageTruth footage) : path_(std::move(path)), footage_(footage) {}

  std::filesystem::path path_;
  FootageTruth footage_;
  std::optional<FrameSource> video_;  // none: path_ is a folder
};

}  // namespace sigs::cli
