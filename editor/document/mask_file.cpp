// SPDX-License-Identifier: MIT
#include "editor/document/mask_file.h"

#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "base/staged_outputs.h"

namespace sigs::editor {

Result<void> write_mask(const cv::Mat& mask, const std::filesystem::path& path, bool overwrite) {
  std::vector<uchar> bytes;
  try {
    cv::imencode(".png", mask, bytes);
  } catch (const cv::Exception&) {
    return fail(path.string(), "the mask cannot be written as a PNG", ErrorKind::write_failed);
  }
  return write_text(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, overwrite);
}

Result<cv::Mat> read_mask(const std::filesystem::path& path) {
  const Result<std::string> bytes = read_text(path);
  if (!bytes) return fail(bytes.error());
  cv::Mat mask;
  try {
    mask = cv::imdecode(cv::Mat(1, static_cast<int>(bytes->size()), CV_8UC1, const_cast<char*>(bytes->data())),
                        cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    mask = cv::Mat();
  }
  if (mask.type() != CV_8UC1 || mask.empty()) return fail(path.string(), "is not a mask that was kept here");
  return mask;
}

}  // namespace sigs::editor
