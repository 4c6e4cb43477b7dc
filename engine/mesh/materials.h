// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "mesh/mesh.h"

namespace sigs {

// The other files that a model reads: textures, and the list of all files of a model.

// The file that a model names, as its author may have meant it: written on Windows (back slashes, other case) or with a
// path of the author's own machine, in which case the file of that name beside the model counts.
//   folder   where relative names start
//   written  the name as the OBJ or MTL file has it
// Empty: there is no such file.
[[nodiscard]] std::filesystem::path found_file(const std::filesystem::path& folder, std::string written);

// Says why an image file cannot be read as a texture, "is 16000x16000; at most ..."; empty where it can. Reads its
// header only, so that too large an image takes no memory (docs/limits.md).
[[nodiscard]] std::string texture_problem(const std::filesystem::path& path);

// The two formats of textures that OpenCV does not read: SGI (.rgb, .rgba, .bw, .sgi; older aircraft of FlightGear) and
// Truevision Targa (.tga). FFmpeg decodes them.

// The size that the header of such a file states; none: it is of another format. Targa begins with no mark: what no
// other header could be is taken for it.
//   bytes  the file's first 18 at least
[[nodiscard]] std::optional<cv::Size> texture_size_px(std::string_view bytes);

// The image of such a file, as cv::imdecode with IMREAD_UNCHANGED gives it: CV_8UC1, CV_8UC3 (BGR) or CV_8UC4 (BGRA),
// first row on top. Empty: of another format, or damaged.
[[nodiscard]] cv::Mat decoded_texture(std::string_view bytes);

// Textures by path. Each file is read once: materials that name the same file share its pixels.
class TextureCache {
 public:
  // CV_8UC4, RGBA; empty where the file cannot be read or has a texture_problem().
  [[nodiscard]] cv::Mat texture(const std::filesystem::path& path);

 private:
  std::map<std::filesystem::path, cv::Mat> textures_;
};

// A copy of the texture with its opacity multiplied by the brightness of a map_d texture, which is scaled to its size.
// Both CV_8UC4, RGBA.
[[nodiscard]] cv::Mat with_opacity_map(const cv::Mat& texture, const cv::Mat& opacity_map);

// Transforms texture coordinates: uv_in_texture = uv * scale + offset (the options -s and -o of map_Kd).
struct TexturePlacement {
  glm::vec2 scale{1, 1};
  glm::vec2 offset{0, 0};
};

struct MaterialSet {
  std::vector<Material> materials;           // one for each name asked for, in that order; rotors in the file's units
  std::vector<TexturePlacement> placements;  // likewise
  std::vector<Warning> warnings;
};

// The materials of the given names, read from MTL files. A material, MTL file or texture that is missing becomes grey,
// with a warning.
//   names      as the OBJ file's usemtl lines have them
//   libraries  what the OBJ file's mtllib lines name; one of them may name several files
//   obj_path   relative names start in its folder
//
// Opacity is `d` (or 1 - `Tr`) where the material has it; else the fourth number of `Kd`, which OpenSceneGraph writes
// as opacity (0 marks what is not to be seen, such as the mouse's hot spots in FlightGear's aircraft); else 1. Where
// that would make the whole model transparent, the numbers cannot mean opacity, and everything is solid.
[[nodiscard]] MaterialSet read_materials(const std::vector<std::string>& names,
                                         const std::vector<std::string>& libraries,
                                         const std::filesystem::path& obj_path);

// Below this opacity (half a step of 8 bits) a surface is invisible.
inline constexpr float kInvisible = 0.5F / 255.0F;

}  // namespace sigs
