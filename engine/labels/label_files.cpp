// SPDX-License-Identifier: MIT
#include "labels/label_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <opencv2/imgproc.hpp>
#include <system_error>
#include <tuple>
#include <utility>

#include "base/ensure.h"
#include "labels/labels.h"

namespace sigs {

namespace fs = std::filesystem;

TextFile::TextFile(fs::path path, std::ofstream out) : path_(std::move(path)), out_(std::move(out)) {}

Result<TextFile> TextFile::create(fs::path path) {
  std::ofstream out(path, std::ios::binary);
  if (!out)
    return fail(path.string(), std::string("cannot be created: ") + std::strerror(errno), ErrorKind::cannot_create);
  return TextFile(std::move(path), std::move(out));
}

Result<void> TextFile::put(std::string_view text) {
  out_.write(text.data(), static_cast<std::streamsize>(text.size()));
  if (!out_)
    return fail(path_.string(), std::string("could not be written: ") + std::strerror(errno), ErrorKind::write_failed);
  return {};
}

Result<void> TextFile::close() {
  out_.close();
  if (!out_) return fail(path_.string(), "could not be written to its end", ErrorKind::write_failed);
  return {};
}

Result<void> write_text_file(const fs::path& path, std::string_view text) {
  Result<TextFile> file = TextFile::create(path);
  if (!file) return fail(file.error());
  if (const Result<void> put = file->put(text); !put) return put;
  return file->close();
}

Result<void> make_inner_folder(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) return fail(folder.string(), "cannot be created: " + code.message(), ErrorKind::cannot_create);
  return {};
}

Result<void> link_or_copy(const fs::path& from, const fs::path& to) {
  std::error_code code;
  fs::create_hard_link(from, to, code);
  if (!code) return {};
  // Another file system, one without hard links, or too many names for one file. Any other cause makes the copy fail
  // too.
  fs::copy_file(from, to, fs::copy_options::none, code);
  if (code)
    return fail(to.string(), fmt::format("could not be made of {}: {}", from.string(), code.message()),
                ErrorKind::write_failed);
  return {};
}

Result<void> link_images(const fs::path& images, const std::vector<fs::path>& names, const fs::path& folder) {
  if (images.empty()) return {};
  if (const Result<void> created = make_inner_folder(folder); !created) return created;
  for (const fs::path& name : names)
    if (const Result<void> linked = link_or_copy(images / name, folder / name); !linked) return linked;
  return {};
}

Result<void> link_numbered_images(const fs::path& images, const FootageTruth& footage, const fs::path& folder,
                                  ImageNumbers numbers) {
  if (images.empty()) return {};
  if (const Result<void> created = make_inner_folder(folder); !created) return created;
  for (int frame = footage.first_frame; frame <= footage.last_frame; ++frame) {
    const int number = frame - footage.first_frame + numbers.first;
    const fs::path name = folder / fmt::format("{:0{}}{}", number, numbers.digits, numbers.extension);
    if (const Result<void> linked = link_or_copy(images / image_name(frame, numbers.extension), name); !linked)
      return linked;
  }
  return {};
}

namespace {

constexpr double kMinFilledShare = 0.75;  // of a box; less is split
constexpr int kMinSideDivisor = 16;       // of the image's longer side

bool has_body(const cv::Mat& part) {
  return cv::countNonZero(part) > 0;
}

// The smallest box around the body within box.
cv::Rect shrunk(const cv::Mat& body, cv::Rect box) {
  while (box.height > 0 && !has_body(body(box).row(0))) box = {box.x, box.y + 1, box.width, box.height - 1};
  while (box.height > 0 && !has_body(body(box).row(box.height - 1))) --box.height;
  while (!box.empty() && !has_body(body(box).col(0))) box = {box.x + 1, box.y, box.width - 1, box.height};
  while (!box.empty() && !has_body(body(box).col(box.width - 1))) --box.width;
  return box;
}

// Adds boxes that cover the body within a box. body: CV_8UC1, not 0 where the body is.
void add_covering_boxes(const cv::Mat& body, const cv::Rect& within, std::vector<cv::Rect>& boxes) {
  const cv::Rect box = shrunk(body, within);
  if (box.empty()) return;
  const double filled = cv::countNonZero(body(box)) / static_cast<double>(box.area());
  const int min_part_px = std::max(2, std::max(body.cols, body.rows) / kMinSideDivisor);
  if (filled >= kMinFilledShare || std::max(box.width, box.height) <= min_part_px) return boxes.push_back(box);
  cv::Rect low = box;
  cv::Rect high = box;
  if (box.width >= box.height) {
    low.width = box.width / 2;
    high.x += low.width;
    high.width -= low.width;
  } else {
    low.height = box.height / 2;
    high.y += low.height;
    high.height -= low.height;
  }
  add_covering_boxes(body, low, boxes);
  add_covering_boxes(body, high, boxes);
}

// Appends a number as coco_counts() describes it.
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

std::vector<OwnBodyPart> own_body_parts(const cv::Mat& own_body) {
  constexpr double kMinHidden = 0.5;
  constexpr double kMinPart = 1e-4;  // of the image
  std::vector<OwnBodyPart> parts;
  if (own_body.empty()) return parts;
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centres;
  const int found = cv::connectedComponentsWithStats(own_body >= kMinHidden, labels, stats, centres);
  const double min_pixels = kMinPart * static_cast<double>(own_body.total());
  for (int i = 1; i < found; ++i) {
    const cv::Rect box(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                       stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
    const int pixels = stats.at<int>(i, cv::CC_STAT_AREA);
    if (pixels >= min_pixels) parts.push_back({.box = box, .mask = labels(box) == i, .pixels = pixels});
  }
  std::sort(parts.begin(), parts.end(), [](const OwnBodyPart& a, const OwnBodyPart& b) {
    return std::tuple(-a.pixels, a.box.y, a.box.x) < std::tuple(-b.pixels, b.box.y, b.box.x);
  });
  return parts;
}

std::vector<cv::Rect> own_body_boxes(const cv::Mat& mask) {
  std::vector<cv::Rect> boxes;
  if (mask.empty()) return boxes;
  const cv::Mat body = mask >= 0.5;
  add_covering_boxes(body, {0, 0, body.cols, body.rows}, boxes);
  return boxes;
}

std::vector<std::uint32_t> column_runs(const cv::Mat& mask, const cv::Rect& box, cv::Size image) {
  ENSURE(mask.type() == CV_8UC1 && mask.size() == box.size());
  ENSURE((box & cv::Rect({0, 0}, image)) == box);
  const auto height = static_cast<std::uint32_t>(image.height);
  std::vector<std::uint32_t> runs;
  std::uint32_t end = 0;  // number of pixels in the runs so far
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
