// SPDX-License-Identifier: MIT
#include "base/image.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

#include "base/ensure.h"

namespace sigs {

namespace {

struct Span {
  int first = 0;
  int past = 0;
};

// Clamped before the conversion to int: a box may be 1e9 px away.
Span touched(double first_edge, double length, int margin_px, int low, int high) {
  const double first = std::floor(first_edge + 0.5) - margin_px;
  const double past = std::ceil(first_edge + length + 0.5) + margin_px;
  return {static_cast<int>(std::clamp(first, double(low), double(high))),
          static_cast<int>(std::clamp(past, double(low), double(high)))};
}

}  // namespace

cv::Rect pixels_touched(const Box& box, int margin_px, const cv::Rect& bounds) {
  ENSURE(std::isfinite(box.x) && std::isfinite(box.y) && std::isfinite(box.width) && std::isfinite(box.height));
  const Span x = touched(box.x, box.width, margin_px, bounds.x, bounds.x + bounds.width);
  const Span y = touched(box.y, box.height, margin_px, bounds.y, bounds.y + bounds.height);
  if (x.past <= x.first || y.past <= y.first) return {};
  return {x.first, y.first, x.past - x.first, y.past - y.first};
}

cv::Mat part_round(const cv::Mat& image, const cv::Rect& rect) {
  if ((rect & cv::Rect({0, 0}, image.size())) == rect) return image(rect);
  ENSURE(rect.y >= 0 && rect.y + rect.height <= image.rows);
  cv::Mat part(rect.size(), image.type());
  for (int x = 0; x < rect.width;) {
    const int from = column_round(rect.x + x, image.cols);
    const int count = std::min(rect.width - x, image.cols - from);
    image(cv::Rect(from, rect.y, count, rect.height)).copyTo(part(cv::Rect(x, 0, count, rect.height)));
    x += count;
  }
  return part;
}

namespace {

using namespace std::string_view_literals;

// Numbers of a binary file by their place; what lies beyond its end is 0 and remembered.
class Bytes {
 public:
  explicit Bytes(const std::filesystem::path& path) : in_(path, std::ios::binary) {}

  [[nodiscard]] bool is_short() const { return is_short_; }

  std::string text(std::uint64_t at, std::size_t count) {
    std::string bytes(count, '\0');
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(at));
    in_.read(bytes.data(), static_cast<std::streamsize>(count));
    if (!in_) is_short_ = true;
    return bytes;
  }
  std::uint32_t big_endian(std::uint64_t at, std::size_t count) {
    std::uint32_t number = 0;
    for (const char byte : text(at, count)) number = number << 8 | static_cast<unsigned char>(byte);
    return number;
  }
  std::uint32_t little_endian(std::uint64_t at, std::size_t count) {
    const std::string bytes = text(at, count);
    std::uint32_t number = 0;
    for (auto byte = bytes.rbegin(); byte != bytes.rend(); ++byte)
      number = number << 8 | static_cast<unsigned char>(*byte);
    return number;
  }

 private:
  std::ifstream in_;
  bool is_short_ = false;
};

std::optional<cv::Size> size_of(std::int64_t width, std::int64_t height) {
  constexpr std::int64_t kMax = std::numeric_limits<int>::max();
  if (width < 1 || height < 1 || width > kMax || height > kMax) return std::nullopt;
  return cv::Size(static_cast<int>(width), static_cast<int>(height));
}

// ITU-T T.81, B.1: markers with their lengths, up to the first start of a frame.
std::optional<cv::Size> jpeg_size(Bytes& bytes) {
  for (std::uint64_t at = 2; !bytes.is_short();) {
    if (bytes.big_endian(at, 1) != 0xFF) return std::nullopt;
    const std::uint32_t marker = bytes.big_endian(at + 1, 1);
    const bool is_frame = marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (is_frame) return size_of(bytes.big_endian(at + 7, 2), bytes.big_endian(at + 5, 2));
    if (marker == 0xFF)
      at += 1;  // fill
    else if (marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8))
      at += 2;  // markers alone
    else
      at += 2 + bytes.big_endian(at + 2, 2);
  }
  return std::nullopt;
}

// The first directory's entries 256 and 257; each a 16-bit or 32-bit number (TIFF 6.0, section 2).
std::optional<cv::Size> tiff_size(Bytes& bytes, bool is_little) {
  const auto number = [&](std::uint64_t at, std::size_t count) {
    return is_little ? bytes.little_endian(at, count) : bytes.big_endian(at, count);
  };
  const std::uint32_t directory = number(4, 4);
  std::array<std::int64_t, 2> sides{};
  for (std::uint32_t i = 0; i < number(directory, 2) && !bytes.is_short(); ++i) {
    const std::uint64_t entry = directory + 2 + std::uint64_t{12} * i;
    const std::uint32_t tag = number(entry, 2);
    if (tag == 256 || tag == 257) sides[tag - 256] = number(entry + 8, number(entry + 2, 2) == 3 ? 2 : 4);
  }
  return size_of(sides[0], sides[1]);
}

std::optional<cv::Size> webp_size(Bytes& bytes) {
  const std::string kind = bytes.text(12, 4);
  if (kind == "VP8X") return size_of(1 + bytes.little_endian(24, 3), 1 + bytes.little_endian(27, 3));
  if (kind == "VP8 ") return size_of(bytes.little_endian(26, 2) & 0x3FFF, bytes.little_endian(28, 2) & 0x3FFF);
  if (kind != "VP8L") return std::nullopt;
  const std::uint32_t bits = bytes.little_endian(21, 4);
  return size_of(1 + (bits & 0x3FFF), 1 + (bits >> 14 & 0x3FFF));
}

// "P6 # a comment \n 640 480 255"
std::optional<cv::Size> pnm_size(std::string_view text) {
  std::array<std::int64_t, 2> sides{};
  for (std::int64_t& side : sides) {
    while (!text.empty() && (text.front() < '0' || text.front() > '9'))
      text.remove_prefix(text.front() == '#' ? std::min(text.find('\n'), text.size()) : 1);
    for (; !text.empty() && text.front() >= '0' && text.front() <= '9' && side < (std::int64_t{1} << 32);
         text.remove_prefix(1))
      side = side * 10 + (text.front() - '0');
  }
  return size_of(sides[0], sides[1]);
}

std::optional<cv::Size> stated_size(Bytes& bytes) {
  const std::string head = bytes.text(0, 12);
  const auto begins = [&](std::string_view with) { return head.starts_with(with); };
  if (begins("\x89PNG\r\n\x1A\n"sv)) return size_of(bytes.big_endian(16, 4), bytes.big_endian(20, 4));
  if (begins("\xFF\xD8"sv)) return jpeg_size(bytes);
  if (begins("II*\0"sv) || begins("MM\0*"sv)) return tiff_size(bytes, begins("II"sv));
  if (begins("RIFF"sv) && head.substr(8) == "WEBP") return webp_size(bytes);
  if (begins("BM"sv))  // rows may be written from the top: then the height is negative
    return size_of(static_cast<std::int32_t>(bytes.little_endian(18, 4)),
                   std::llabs(static_cast<std::int32_t>(bytes.little_endian(22, 4))));
  return std::nullopt;
}

}  // namespace

std::optional<cv::Size> image_size_px(const std::filesystem::path& path) {
  Bytes bytes(path);
  constexpr std::size_t kHead = 1024;
  if (const std::string kind = bytes.text(0, 2);
      !bytes.is_short() && kind[0] == 'P' && kind[1] >= '1' && kind[1] <= '7')
    return pnm_size(bytes.text(0, kHead).substr(2));
  const std::optional<cv::Size> size = stated_size(bytes);
  return bytes.is_short() ? std::nullopt : size;
}

}  // namespace sigs
