// SPDX-License-Identifier: MIT
#include "mesh/textures.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "base/guarded.h"
#include "base/image_size.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

fs::path any_case(const fs::path& path) {
  std::error_code code;
  const std::string wanted = lower_case(path.filename().string());
  for (fs::directory_iterator entry(path.parent_path(), code); !code && entry != fs::directory_iterator();
       entry.increment(code))
    if (lower_case(entry->path().filename().string()) == wanted) return entry->path();
  return {};
}

bool is_file(const fs::path& path) {
  std::error_code code;
  return fs::is_regular_file(path, code);
}

// 16-bit textures hold 257 steps for each of 8 bits; floating-point ones run from 0 to 1.
cv::Mat as_8_bit(const cv::Mat& texture) {
  cv::Mat result = texture;
  if (texture.depth() == CV_16U) texture.convertTo(result, CV_8U, 1.0 / 257.0);
  if (texture.depth() == CV_32F || texture.depth() == CV_64F) texture.convertTo(result, CV_8U, 255.0);
  return result;
}

cv::Mat as_rgba(const cv::Mat& texture) {
  cv::Mat rgba;
  if (texture.depth() != CV_8U) return rgba;
  if (texture.channels() == 1) cv::cvtColor(texture, rgba, cv::COLOR_GRAY2RGBA);
  if (texture.channels() == 2) {
    const std::vector<int> from_to{0, 0, 0, 1, 0, 2, 1, 3};
    rgba.create(texture.size(), CV_8UC4);
    cv::mixChannels({texture}, {rgba}, from_to);
  }
  if (texture.channels() == 3) cv::cvtColor(texture, rgba, cv::COLOR_BGR2RGBA);
  if (texture.channels() == 4) cv::cvtColor(texture, rgba, cv::COLOR_BGRA2RGBA);
  return rgba;
}

constexpr int kMaxSide_px = 16384;                  // what OpenGL takes nearly everywhere
constexpr std::int64_t kMaxPixels = 8192LL * 8192;  // a quarter of a gigabyte in RGBA

cv::Mat read_image(const fs::path& path) {
  if (!texture_problem(path).empty()) return {};
  try {
    const cv::Mat texture = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
    return texture.empty() ? cv::Mat() : as_rgba(as_8_bit(texture));
  } catch (const cv::Exception&) {
    if (is_out_of_memory()) throw;  // a model without its texture would be a wrong texture
    return {};
  }
}

}  // namespace

fs::path found_file(const fs::path& folder, std::string written) {
  std::replace(written.begin(), written.end(), '\\', '/');
  const fs::path named = folder / written;
  if (written.empty()) return {};
  for (const fs::path& candidate :
       {named, any_case(named), folder / named.filename(), any_case(folder / named.filename())})
    if (is_file(candidate)) return candidate;
  return {};
}

std::string texture_problem(const fs::path& path) {
  const std::optional<cv::Size> size = image_size_px(path);
  if (!size) return "cannot be read (png, jpeg, bmp, tiff, webp, pnm)";
  const bool is_large =
      std::max(size->width, size->height) > kMaxSide_px || std::int64_t{size->width} * size->height > kMaxPixels;
  if (!is_large) return "";
  return "is " + std::to_string(size->width) + "x" + std::to_string(size->height) +
         "; at most 8192x8192 pixels are read, and 16384 a side";
}

cv::Mat TextureCache::texture(const fs::path& path) {
  const auto [entry, is_first] = textures_.try_emplace(path);
  if (is_first) entry->second = read_image(path);
  return entry->second;
}

cv::Mat with_opacity_map(const cv::Mat& texture, const cv::Mat& opacity_map) {
  cv::Mat gray;
  cv::cvtColor(opacity_map, gray, cv::COLOR_RGBA2GRAY);
  cv::resize(gray, gray, texture.size(), 0, 0, cv::INTER_AREA);
  std::vector<cv::Mat> planes;
  cv::split(texture, planes);
  cv::multiply(planes[3], gray, planes[3], 1.0 / 255.0);
  cv::Mat result;
  cv::merge(planes, result);
  return result;
}

}  // namespace sigs
