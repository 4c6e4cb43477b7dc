// SPDX-License-Identifier: MIT
#include "mesh/textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/image.h"
#include "base/image_codecs.h"
#include "base/input_file.h"
#include "base/staged_outputs.h"
#include "base/text.h"
#include "base/threads.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

fs::path any_case(const fs::path& path) {
  std::error_code code;
  const std::string wanted = lower_case(path.filename().string());
  for (fs::directory_iterator entry(path.parent_path(), code); !code && entry != fs::directory_iterator();
       entry.increment(code))
    if (lower_case(entry->path().filename().string()) == wanted) return entry->path();
  return {};
}

bool is_file(const fs::path& path) {
  return check_input_file(path).has_value();
}

// One step of 8 bits is 257 steps of 16 bits; floating-point textures run from 0 to 1.
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

constexpr int kMaxSide_px = 16384;                  // supported by OpenGL nearly everywhere
constexpr std::int64_t kMaxPixels = 8192LL * 8192;  // a quarter of a gigabyte in RGBA

cv::Mat read_image(const fs::path& path) {
  if (!texture_problem(path).empty()) return {};
  try {
    const cv::Mat texture = image_codecs::imread(path.string(), cv::IMREAD_UNCHANGED);
    return texture.empty() ? cv::Mat() : as_rgba(as_8_bit(texture));
  } catch (const cv::Exception&) {
    if (is_out_of_memory()) throw;  // a model without its texture would be wrong
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
  return fmt::format("is {}; at most 8192x8192 pixels are read, and 16384 a side", image_size_text(*size));
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

namespace {

// The files that the rest of a line may name. Options and other names may come first, so each word, and everything from
// each word on, is tried.
std::vector<fs::path> files_named(std::string_view rest, const fs::path& folder) {
  std::vector<fs::path> files;
  for (std::string_view end = trimmed(rest); !end.empty(); end = trimmed(end)) {
    const std::string_view whole = end;
    const std::string_view word = next_token(end);
    for (const std::string_view name : {whole, word})
      if (const fs::path file = found_file(folder, std::string(name)); !file.empty()) files.push_back(file);
  }
  return files;
}

bool names_texture(std::string_view key) {
  return key.starts_with("map_") || key == "bump" || key == "disp" || key == "decal" || key == "refl" || key == "norm";
}

// The files named in those lines of a text file whose first word is_asked_for() accepts.
template <class IsAskedFor>
Result<std::vector<fs::path>> files_named_in(const fs::path& file, const IsAskedFor& is_asked_for) {
  const Result<std::string> text = read_text(file);
  if (!text) return fail(text.error());
  std::vector<fs::path> files;
  std::string_view rest = *text;
  while (!rest.empty()) {
    std::string_view line = next_line(rest);
    if (!is_asked_for(next_token(line))) continue;
    const std::vector<fs::path> named = files_named(line, file.parent_path());
    files.insert(files.end(), named.begin(), named.end());
  }
  return files;
}

bool names_library(std::string_view key) {
  return key == "mtllib";
}

}  // namespace

Result<std::vector<fs::path>> files_of_model(const fs::path& file) {
  const Result<std::vector<fs::path>> libraries = files_named_in(file, names_library);
  if (!libraries) return fail(libraries.error());
  std::vector<fs::path> files{file};
  for (const fs::path& library : *libraries) {
    files.push_back(library);
    const Result<std::vector<fs::path>> images = files_named_in(library, names_texture);
    if (images) files.insert(files.end(), images->begin(), images->end());
  }
  return files;
}

}  // namespace sigs
