// SPDX-License-Identifier: MIT
#include "labels/run_length.h"

#include "base/ensure.h"

namespace sigs {

namespace {

void append_varint(std::string& text, std::int64_t number) {
  constexpr std::int64_t kFiveBits = 0x1F;
  constexpr std::int64_t kSign = 0x10;
  constexpr std::int64_t kMore = 0x20;
  bool more = true;
  while (more) {
    const std::int64_t digit = number & kFiveBits;
    number >>= 5;
    more = number != ((digit & kSign) != 0 ? -1 : 0);
    text += static_cast<char>('0' + (digit | (more ? kMore : 0)));
  }
}

}  // namespace

std::vector<std::uint32_t> column_runs(const cv::Mat& mask, const cv::Rect& box, cv::Size image) {
  ENSURE(mask.type() == CV_8UC1 && mask.size() == box.size());
  ENSURE((box & cv::Rect({0, 0}, image)) == box);
  const auto height = static_cast<std::uint32_t>(image.height);
  std::vector<std::uint32_t> runs;
  std::uint32_t end = 0;  // pixels that the runs hold
  for (int i = 0; i < box.width; ++i)
    for (int j = 0; j < box.height; ++j) {
      if (mask.at<unsigned char>(j, i) == 0) continue;
      const std::uint32_t at = static_cast<std::uint32_t>(box.x + i) * height + static_cast<std::uint32_t>(box.y + j);
      if (runs.empty() || at != end) {
        runs.push_back(at - end);
        runs.push_back(0);
      }
      ++runs.back();
      end = at + 1;
    }
  const std::uint32_t all = static_cast<std::uint32_t>(image.width) * height;
  if (end < all || runs.empty()) runs.push_back(all - end);
  return runs;
}

std::string coco_counts(std::span<const std::uint32_t> runs) {
  std::string text;
  for (std::size_t i = 0; i < runs.size(); ++i)
    append_varint(text, std::int64_t{runs[i]} - (i > 2 ? std::int64_t{runs[i - 2]} : 0));
  return text;
}

}  // namespace sigs
