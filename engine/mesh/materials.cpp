// SPDX-License-Identifier: MIT
#include "mesh/materials.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <fstream>
#include <map>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/image.h"
#include "base/image_codecs.h"
#include "base/input_file.h"
#include "base/paths.h"
#include "base/staged_outputs.h"
#include "base/text.h"
#include "base/threads.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

fs::path any_case(const fs::path& path) {
  const std::string wanted = lower_case(path.filename().string());
  const Result<std::vector<fs::path>> there = folder_contents(path.parent_path());
  if (!there) return {};
  for (const fs::path& one : *there)
    if (lower_case(one.filename().string()) == wanted) return one;
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

// Those that OpenCV reads by their mark, the others by their first bytes.
std::optional<cv::Size> size_of_texture_px(const fs::path& path) {
  if (const std::optional<cv::Size> size_px = image_size_px(path)) return size_px;
  std::array<char, 32> head{};
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), head.size());
  return texture_size_px({head.data(), static_cast<std::size_t>(file.gcount())});
}

cv::Mat read_image(const fs::path& path) {
  if (!texture_problem(path).empty()) return {};
  try {
    cv::Mat texture;
    if (image_size_px(path))
      texture = image_codecs::imread(path.string(), cv::IMREAD_UNCHANGED);
    else if (const Result<std::string> bytes = read_text(path))
      texture = decoded_texture(*bytes);
    return texture.empty() ? cv::Mat() : as_rgba(as_8_bit(texture));
  } catch (const cv::Exception&) {
    if (is_out_of_memory()) throw;  // a model without its texture would be wrong
    return {};
  }
}

// What tinyobj does not report of a material.
struct MaterialHints {
  bool has_diffuse = false;
  bool has_dissolve = false;
  std::optional<float> fourth_of_diffuse;
  RotorStatements rotor;
};

struct MtlMaterial {
  tinyobj::material_t material;
  MaterialHints hints;
  fs::path folder;  // paths of textures start here
};

using MtlMaterials = std::map<std::string, MtlMaterial>;

std::optional<float> fourth_number(std::string_view numbers) {
  for (int i = 0; i < 3; ++i) static_cast<void>(next_token(numbers));
  return parsed_number<float>(next_token(numbers));
}

std::map<std::string, MaterialHints> hints_of(std::string_view text) {
  std::map<std::string, MaterialHints> hints_of_name;
  MaterialHints* current = nullptr;
  while (!text.empty()) {
    std::string_view line = next_line(text);
    const std::string_view key = next_token(line);
    if (key == "newmtl") current = &hints_of_name[std::string(trimmed(line))];
    if (current == nullptr) continue;
    if (key == "d" || key == "Tr") current->has_dissolve = true;
    if (key.starts_with("rotor_")) current->rotor.emplace(key, trimmed(line));
    if (key != "Kd") continue;
    current->has_diffuse = true;
    current->fourth_of_diffuse = fourth_number(line);
  }
  return hints_of_name;
}

// Adds its materials to those that are known. What cannot be parsed has none. Errors of read_text().
Result<void> read_library(const fs::path& path, MtlMaterials& found) {
  const Result<std::string> text = read_text(path, kMaterialsLimit_bytes);
  if (!text) return fail(text.error());
  std::map<std::string, int> index_of_name;
  std::vector<tinyobj::material_t> materials;
  try {
    std::istringstream stream(*text);
    std::string warning;
    std::string error;
    tinyobj::LoadMtl(&index_of_name, &materials, &stream, &warning, &error);
  } catch (const std::exception&) {
    if (is_out_of_memory()) throw;  // a model without its materials would be wrong
    return {};
  }
  std::map<std::string, MaterialHints> hints_of_name = hints_of(*text);
  for (const tinyobj::material_t& material : materials) {
    const std::string name(trimmed(material.name));
    found.emplace(name, MtlMaterial{material, hints_of_name[name], path.parent_path()});
  }
  return {};
}

// The files that an mtllib line names: one whose name may contain blanks, or several.
std::vector<std::string> names_in(const std::string& line, const fs::path& folder) {
  if (!found_file(folder, line).empty()) return {line};
  std::vector<std::string> names;
  std::string_view rest = line;
  for (std::string_view name = next_token(rest); !name.empty(); name = next_token(rest)) names.emplace_back(name);
  return names;
}

MtlMaterials read_libraries(const std::vector<std::string>& libraries, const fs::path& obj_path,
                            std::vector<Warning>& warnings) {
  MtlMaterials found;
  for (const std::string& line : libraries)
    for (const std::string& name : names_in(line, obj_path.parent_path())) {
      const fs::path path = found_file(obj_path.parent_path(), name);
      const Result<void> read = path.empty() ? fail(name, "is missing") : read_library(path, found);
      if (!read)
        warnings.push_back({obj_path.filename().string(),
                            fmt::format("{} {}; what it describes is drawn grey", name, read.error().what)});
    }
  return found;
}

float opacity_of(const MtlMaterial& source) {
  const float written =
      source.hints.has_dissolve ? source.material.dissolve : source.hints.fourth_of_diffuse.value_or(1.0F);
  return written >= 0 ? std::min(written, 1.0F) : 0.0F;
}

glm::vec3 color_of(const float (&numbers)[3]) {
  return glm::clamp(glm::vec3(numbers[0], numbers[1], numbers[2]), 0.0F, 1.0F);
}

class MaterialReader {
 public:
  MaterialReader(const fs::path& obj_path, std::vector<Warning>& warnings)
      : obj_name_(obj_path.filename().string()), warnings_(warnings) {}

  Material material_of(const MtlMaterial& source) {
    Material result{.name = source.material.name,
                    .specular = color_of(source.material.specular),
                    .shininess = source.material.shininess,
                    .opacity = opacity_of(source)};
    result.texture = texture_of(source, source.material.diffuse_texname);
    const bool is_grey =
        result.texture.empty() && (!source.hints.has_diffuse || !source.material.diffuse_texname.empty());
    if (!is_grey) result.diffuse = source.hints.has_diffuse ? color_of(source.material.diffuse) : glm::vec3(1.0F);
    apply_opacity_map(result, source);
    if (!source.hints.rotor.empty()) add_rotor(result, source.hints.rotor);
    return result;
  }

 private:
  void add_rotor(Material& material, const RotorStatements& statements) {
    const Result<Rotor> rotor = read_rotor(statements);
    if (rotor)
      material.rotor = *rotor;
    else
      warnings_.push_back({obj_name_, fmt::format("material {}: {} {}; its blades do not turn", material.name,
                                                  rotor.error().where, rotor.error().what)});
  }

  cv::Mat texture_of(const MtlMaterial& source, const std::string& written) {
    if (written.empty()) return {};
    const fs::path path = found_file(source.folder, std::string(trimmed(written)));
    const cv::Mat texture = path.empty() ? cv::Mat() : texture_cache_.texture(path);
    if (texture.empty() && !is_known(written)) {
      reported_.push_back(written);
      const std::string wrong = path.empty() ? "is missing" : texture_problem(path);
      warnings_.push_back(
          {obj_name_, fmt::format("texture {} {}; drawn grey", written, wrong.empty() ? "cannot be read" : wrong)});
    }
    return texture;
  }

  // Some exporters name the colour texture here, too, and mean its own opacity, which the texture has already.
  void apply_opacity_map(Material& material, const MtlMaterial& source) {
    const std::string& written = source.material.alpha_texname;
    if (written.empty() || written == source.material.diffuse_texname) return;
    const cv::Mat opacity_map = texture_of(source, written);
    if (opacity_map.empty()) return;
    if (material.texture.empty()) material.texture = cv::Mat(opacity_map.size(), CV_8UC4, cv::Scalar::all(255));
    material.texture = with_opacity_map(material.texture, opacity_map);
  }

  bool is_known(const std::string& written) const {
    return std::find(reported_.begin(), reported_.end(), written) != reported_.end();
  }

  std::string obj_name_;
  std::vector<Warning>& warnings_;
  std::vector<std::string> reported_;
  TextureCache texture_cache_;
};

TexturePlacement placement_of(const tinyobj::texture_option_t& option) {
  return {{option.scale[0], option.scale[1]}, {option.origin_offset[0], option.origin_offset[1]}};
}

void keep_something_visible(MaterialSet& set, const std::string& obj_name) {
  const bool all_invisible = std::all_of(set.materials.begin(), set.materials.end(),
                                         [](const Material& material) { return material.opacity < kInvisible; });
  if (!all_invisible || set.materials.empty()) return;
  for (Material& material : set.materials) material.opacity = 1;
  set.warnings.push_back({obj_name, "every material is wholly transparent; drawn solid"});
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
  const std::optional<cv::Size> size = size_of_texture_px(path);
  if (!size) return "cannot be read (png, jpeg, bmp, tiff, webp, pnm, tga, sgi)";
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

MaterialSet read_materials(const std::vector<std::string>& names, const std::vector<std::string>& libraries,
                           const fs::path& obj_path) {
  MaterialSet set;
  const MtlMaterials found = read_libraries(libraries, obj_path, set.warnings);
  const bool has_library = !found.empty();
  MaterialReader reader(obj_path, set.warnings);
  for (const std::string& name : names) {
    const auto source = found.find(name);
    if (source != found.end()) {
      set.materials.push_back(reader.material_of(source->second));
      set.placements.push_back(placement_of(source->second.material.diffuse_texopt));
      continue;
    }
    if (has_library && !name.empty())
      set.warnings.push_back({obj_path.filename().string(), fmt::format("material {} is in no MTL; drawn grey", name)});
    set.materials.push_back({.name = name});
    set.placements.emplace_back();
  }
  keep_something_visible(set, obj_path.filename().string());
  return set;
}

}  // namespace sigs
