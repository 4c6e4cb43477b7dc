// SPDX-License-Identifier: MIT
#include "scene/own_body_mask.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>

#include "base/guarded.h"
#include "base/input_file.h"
#include "base/picture_size.h"

namespace sigs {

namespace {

std::string text_of(cv::Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

cv::Mat gray_of(const cv::Mat& picture) {
  if (picture.channels() == 1) return picture;
  cv::Mat gray;
  cv::cvtColor(picture, gray, picture.channels() == 4 ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
  return gray;
}

cv::Mat picture_in(const std::filesystem::path& path) {
  try {
    return cv::imread(path.string(), cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    if (is_out_of_memory()) throw;
    return {};
  }
}

}  // namespace

Result<cv::Mat> read_own_body_mask(const std::filesystem::path& path, cv::Size footage_size_px) {
  if (const Result<void> file = check_input_file(path, "picture"); !file) return fail(file.error());
  const std::optional<cv::Size> stated_px = picture_size_px(path);  // before anything is decoded
  const bool is_other_size = stated_px && *stated_px != footage_size_px;
  const cv::Mat picture = is_other_size ? cv::Mat() : picture_in(path);
  if (is_other_size)
    return fail(path.string(),
                "is " + text_of(*stated_px) + ", the footage is " + text_of(footage_size_px) + "; they must agree");
  if (picture.empty()) return fail(path.string(), "is not a picture that can be read (png, jpeg, bmp, tiff, ...)");
  if (picture.size() != footage_size_px)
    return fail(path.string(),
                "is " + text_of(picture.size()) + ", the footage is " + text_of(footage_size_px) + "; they must agree");
  if (picture.depth() != CV_8U && picture.depth() != CV_16U)
    return fail(path.string(), "has neither 8 nor 16 bits a sample");
  cv::Mat mask;
  gray_of(picture).convertTo(mask, CV_32F, picture.depth() == CV_8U ? 1.0 / 255.0 : 1.0 / 65535.0);
  return mask;
}

}  // namespace sigs
