// SPDX-License-Identifier: MIT
#include "mesh/materials.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <charconv>
#include <exception>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>

#include "base/input_file.h"
#include "base/text.h"
#include "base/threads.h"
#include "mesh/textures.h"

namespace sigs {

namespace fs = std::filesystem;

namespace {

// What tinyobj does not report of a material.
struct OpacityHints {
  bool has_diffuse = false;
  bool has_dissolve = false;
  std::optional<float> fourth_of_diffuse;
};

struct MtlMaterial {
  tinyobj::material_t material;
  OpacityHints hints;
  fs::path folder;  // paths of textures start here
};

using MtlMaterials = std::map<std::string, MtlMaterial>;

std::optional<float> fourth_number(std::string_view numbers) {
  for (int i = 0; i < 3; ++i) static_cast<void>(next_token(numbers));
  const std::string_view token = next_token(numbers);
  float value = 0;
  const auto [end, code] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (code != std::errc{} || end != token.data() + token.size()) return std::nullopt;
  return value;
}

std::map<std::string, OpacityHints> opacity_hints_of(std::string_view text) {
  std::map<std::string, OpacityHints> hints_of_name;
  OpacityHints* current = nullptr;
  while (!text.empty()) {
    std::string_view line = next_line(text);
    const std::string_view key = next_token(line);
    if (key == "newmtl") current = &hints_of_name[std::string(trimmed(line))];
    if (current == nullptr) continue;
    if (key == "d" || key == "Tr") current->has_dissolve = true;
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
  std::map<std::string, OpacityHints> hints_of_name = opacity_hints_of(*text);
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
    return result;
  }

 private:
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
