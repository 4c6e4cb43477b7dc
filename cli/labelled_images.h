// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "base/result.h"
#include "evaluation/readers/clip_truth.h"
#include "video/frame_source.h"

namespace sigs::cli {

// How the images of a folder are called: frame_000123.png by the footage's number, as SIGS writes them; or anything, in
// order of the numbers at the end of their names.
enum class ImageNames { by_frame, in_order };

// The images that labels belong to: an exported video, or a folder of images.
class LabelledImages {
 public:
  // Beside NAME.xml: NAME.mkv, .mp4, .avi or the folder NAME. Error cannot_read: there is none, or more than one.
  [[nodiscard]] static Result<std::filesystem::path> beside(const std::filesystem::path& labels);

  // Error bad_data where number or size of the images are not those of the labels. A size that the labels do not state
  // is not compared.
  [[nodiscard]] static Result<LabelledImages> open(const std::filesystem::path& path, const ClipTruth& clip,
                                                   ImageNames names = ImageNames::by_frame);

  // The image of a frame, by the footage's number; CV_8UC3, BGR.
  [[nodiscard]] Result<cv::Mat> at(int frame);

 private:
  LabelledImages(std::filesystem::path path, FootageTruth footage) : path_(std::move(path)), footage_(footage) {}

  std::filesystem::path path_;
  FootageTruth footage_;
  std::vector<std::filesystem::path> files_;  // of a folder, one for each frame
  std::optional<FrameSource> video_;          // none: path_ is a folder
};

}  // namespace sigs::cli
