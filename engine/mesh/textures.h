// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <string>

namespace sigs {

// The file that a model names, as the model's author may have meant it: written on Windows (back slashes, another case)
// or with a path of his own machine (then the file beside the model counts). Empty: there is none.
[[nodiscard]] std::filesystem::path found_file(const std::filesystem::path& folder, std::string written);

// Empty where the texture can be read; else why not: "is 16000x16000; at most ...". Looks at the
// header alone, so that no memory is taken for what is too large (docs/limits.md).
[[nodiscard]] std::string texture_problem(const std::filesystem::path& path);

// Images by path, each read once: materials that name the same file share its pixels.
class TextureCache {
 public:
  // CV_8UC4, RGBA; empty where the file cannot be read as a texture or texture_problem().
  [[nodiscard]] cv::Mat texture(const std::filesystem::path& path);

 private:
  std::map<std::filesystem::path, cv::Mat> textures_;
};

// A copy of the texture whose opacity is multiplied by the brightness of a map_d texture.
[[nodiscard]] cv::Mat with_opacity_map(const cv::Mat& texture, const cv::Mat& opacity_map);

}  // namespace sigs
