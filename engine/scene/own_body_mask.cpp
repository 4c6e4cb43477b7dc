// SPDX-License-Identifier: MIT
#include "scene/own_body_mask.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>

#include "base/image.h"
#include "base/input_file.h"
#include "base/threads.h"

namespace sigs {

namespace {

std::string text_of(cv::Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

cv::Mat gray_of(const cv::Mat& image) {
  if (image.channels() == 1) return image;
  cv::Mat gray;
  cv::cvtColor(image, gray, image.channels() == 4 ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
  return gray;
}

cv::Mat image_in(const std::filesystem::path& path) {
  try {
    return cv::imread(path.string(), cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    if (is_out_of_memory()) throw;
    return {};
  }
}

}  // namespace

Result<cv::Mat> read_own_body_mask(const std::filesystem::path& path, cv::Size footage_size_px) {
  if (const Result<void> file = check_input_file(path, "image"); !file) return fail(file.error());
  const std::optional<cv::Size> stated_px = image_size_px(path);  // before anything is decoded
  const bool is_other_size = stated_px && *stated_px != footage_size_px;
  const cv::Mat image = is_other_size ? cv::Mat() : image_in(path);
  if (is_other_size)
    return fail(path.string(),
                "is " + text_of(*stated_px) + ", the footage is " + text_of(footage_size_px) + "; they must agree");
  if (image.empty()) return fail(path.string(), "is not an image that can be read (png, jpeg, bmp, tiff, ...)");
  if (image.size() != footage_size_px)
    return fail(path.string(),
                "is " + text_of(image.size()) + ", the footage is " + text_of(footage_size_px) + "; they must agree");
  if (image.depth() != CV_8U && image.depth() != CV_16U)
    return fail(path.string(), "has neither 8 nor 16 bits a sample");
  cv::Mat mask;
  gray_of(image).convertTo(mask, CV_32F, image.depth() == CV_8U ? 1.0 / 255.0 : 1.0 / 65535.0);
  return mask;
}

}  // namespace sigs
