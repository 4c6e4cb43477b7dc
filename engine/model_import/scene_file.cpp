// SPDX-License-Identifier: MIT
#include "model_import/scene_file.h"

#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "base/image_codecs.h"
#include "base/input_file.h"
#include "base/paths.h"
#include "base/staged_outputs.h"
#include "base/text.h"
#include "mesh/materials.h"

namespace sigs {

namespace {

namespace fs = std::filesystem;

// A name as one word of an OBJ or MTL file.
std::string word_of(const std::string& text, const char* otherwise) {
  std::string word;
  for (const char c : text) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '.';
    word += is_plain ? c : '_';
  }
  return word.empty() ? otherwise : word;
}

// The same, of names that must differ.
std::string unique_word(const std::string& text, const char* otherwise, std::set<std::string>& taken) {
  const std::string word = word_of(text, otherwise);
  std::string unique = word;
  for (int n = 2; !taken.insert(unique).second; ++n) unique = fmt::format("{}-{}", word, n);
  return unique;
}

double display_of_linear(double light) {
  const double l = std::clamp(light, 0.0, 1.0);
  return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055;
}

class SceneReader {
 public:
  SceneReader(const aiScene& scene, const fs::path& file)
      : scene_(scene), file_(file), is_gltf_(file.extension() == ".gltf" || file.extension() == ".glb") {}

  Result<ImportedScene> read() {
    for (unsigned i = 0; i < scene_.mNumMaterials; ++i) add_material(*scene_.mMaterials[i]);
    add_node(*scene_.mRootNode, aiMatrix4x4());
    if (std::all_of(out_.parts.begin(), out_.parts.end(),
                    [](const ImportedPart& part) { return part.triangles.empty(); }))
      return fail(file_.string(), "has no triangles");
    return std::move(out_);
  }

 private:
  void add_material(const aiMaterial& material) {
    aiString name;
    material.Get(AI_MATKEY_NAME, name);
    ImportedMaterial added{.name = unique_word(name.C_Str(), "material", names_)};
    aiColor3D color(0.5F, 0.5F, 0.5F);
    if (material.Get(AI_MATKEY_COLOR_DIFFUSE, color) == AI_SUCCESS ||
        material.Get(AI_MATKEY_BASE_COLOR, color) == AI_SUCCESS)
      added.diffuse = {color.r, color.g, color.b};
    if (is_gltf_)  // which states light, where MTL has display codes
      for (int c = 0; c < 3; ++c) added.diffuse[c] = display_of_linear(added.diffuse[c]);
    aiColor3D specular(0, 0, 0);
    if (material.Get(AI_MATKEY_COLOR_SPECULAR, specular) == AI_SUCCESS)
      added.specular = {specular.r, specular.g, specular.b};
    float number = 0;
    if (material.Get(AI_MATKEY_SHININESS, number) == AI_SUCCESS && number > 0) added.shininess = number;
    if (material.Get(AI_MATKEY_OPACITY, number) == AI_SUCCESS) added.opacity = std::clamp(double(number), 0.0, 1.0);
    aiString image;
    if (material.GetTexture(aiTextureType_DIFFUSE, 0, &image) == AI_SUCCESS ||
        material.GetTexture(aiTextureType_BASE_COLOR, 0, &image) == AI_SUCCESS)
      added.image = image_of(image.C_Str());
    out_.materials.push_back(std::move(added));
  }

  // The name under which an image will be written; empty, and a warning: it is not there.
  std::string image_of(const std::string& path) {
    if (const auto known = images_.find(path); known != images_.end()) return known->second;
    std::string name;
    if (const aiTexture* const embedded = scene_.GetEmbeddedTexture(path.c_str()); embedded != nullptr)
      name = embedded_image(*embedded);
    else
      name = file_image(path);
    if (name.empty())
      out_.warnings.push_back({file_.string(), fmt::format("image {} is not there or none that is read", path)});
    return images_[path] = name;
  }

  std::string embedded_image(const aiTexture& texture) {
    if (texture.mHeight != 0) return "";  // bare samples, which no exporter of these formats writes
    const std::string bytes(reinterpret_cast<const char*>(texture.pcData), texture.mWidth);
    return added_image(fmt::format("texture-{}", out_.images.size() + 1), bytes);
  }

  // Where the file says, or beside the model: paths are often those of the author's machine. Else the first of that
  // name in the folders around it, where liveries lie.
  std::string file_image(const std::string& path) {
    std::string portable = path;
    std::replace(portable.begin(), portable.end(), '\\', '/');
    const fs::path name = fs::path(portable).filename();
    std::vector<fs::path> places{file_.parent_path() / portable, file_.parent_path() / name};
    if (const auto other = around(name); other) places.push_back(*other);
    for (const fs::path& place : places) {
      std::error_code code;
      if (!fs::is_regular_file(place, code)) continue;
      const Result<std::string> bytes = read_text(place);
      if (bytes) return added_image(place.stem().string(), *bytes);
    }
    return "";
  }

  // The first file of the name, in whatever case, by path, at most three folders below the one above the model's.
  [[nodiscard]] std::optional<fs::path> around(const fs::path& name) const {
    std::optional<fs::path> first;
    std::error_code code;
    const fs::path above = fs::absolute(file_, code).parent_path().parent_path();
    for (fs::recursive_directory_iterator it(above, fs::directory_options::skip_permission_denied, code), end;
         !code && it != end; it.increment(code)) {
      if (it.depth() >= 3) it.disable_recursion_pending();
      if (lower_case(it->path().filename().string()) == lower_case(name.string()) && (!first || it->path() < *first))
        first = it->path();
    }
    return first;
  }

  // PNG and JPEG as they are, what else is read as PNG.
  std::string added_image(const std::string& stem, const std::string& bytes) {
    const bool is_png = bytes.starts_with("\x89PNG"), is_jpeg = bytes.starts_with("\xFF\xD8");
    std::string written = bytes;
    if (!is_png && !is_jpeg) {
      const std::vector<uchar> encoded(bytes.begin(), bytes.end());
      cv::Mat image = encoded.empty() ? cv::Mat() : image_codecs::imdecode(encoded, cv::IMREAD_UNCHANGED);
      if (const auto size_px = texture_size_px(bytes); image.empty() && size_px && check_image_size(*size_px))
        image = decoded_texture(bytes);
      std::vector<uchar> png;
      if (image.empty() || !image_codecs::imencode(".png", image, png)) return "";
      written.assign(png.begin(), png.end());
    }
    const std::string name = unique_word(stem, "texture", image_names_) + (is_jpeg ? ".jpg" : ".png");
    out_.images.push_back({name, std::move(written)});
    return name;
  }

  void add_node(const aiNode& node, const aiMatrix4x4& parent) {
    const aiMatrix4x4 whole = parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) add_mesh(*scene_.mMeshes[node.mMeshes[i]], node, whole);
    for (unsigned i = 0; i < node.mNumChildren; ++i) add_node(*node.mChildren[i], whole);
  }

  void add_mesh(const aiMesh& mesh, const aiNode& node, const aiMatrix4x4& whole) {
    aiMatrix3x3 turn(whole);
    const bool is_mirrored = turn.Determinant() < 0;
    turn.Inverse().Transpose();  // of normals
    const auto corner = [&](unsigned index) {
      const aiVector3D p = whole * mesh.mVertices[index];
      ImportedVertex vertex{.position = {p.x, p.y, p.z}};
      if (mesh.HasNormals()) {
        const aiVector3D n = turn * mesh.mNormals[index];
        const double length = std::sqrt(double(n.x) * n.x + double(n.y) * n.y + double(n.z) * n.z);
        if (length > 0) vertex.normal = glm::dvec3(n.x, n.y, n.z) / length;
      }
      if (mesh.HasTextureCoords(0)) vertex.uv = {mesh.mTextureCoords[0][index].x, mesh.mTextureCoords[0][index].y};
      return vertex;
    };
    ImportedPart part{.name = std::string(node.mName.C_Str()) + " " + mesh.mName.C_Str(),
                      .material = static_cast<int>(mesh.mMaterialIndex)};
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;
      std::array<ImportedVertex, 3> triangle{corner(face.mIndices[0]), corner(face.mIndices[1]),
                                             corner(face.mIndices[2])};
      if (is_mirrored) std::swap(triangle[1], triangle[2]);
      part.triangles.push_back(triangle);
    }
    if (!part.triangles.empty()) out_.parts.push_back(std::move(part));
  }

  const aiScene& scene_;
  fs::path file_;
  bool is_gltf_;
  ImportedScene out_;
  std::set<std::string> names_, image_names_;
  std::map<std::string, std::string> images_;
};

// Formats whose units assimp turns into metres, or which have no other.
bool states_unit(const std::string& extension) {
  for (const char* const known : {".gltf", ".glb", ".dae", ".fbx"})
    if (extension == known) return true;
  return false;
}

}  // namespace

Result<ImportedScene> read_scene_file(const fs::path& file) {
  if (const Result<void> there = check_input_file(file, "model"); !there) return fail(there.error());
  Assimp::Importer importer;
  const std::string extension = lower_case(file.extension().string());
  unsigned steps = aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_FindInvalidData;
  if (extension == ".fbx") steps |= aiProcess_GlobalScale;
  const aiScene* const scene = importer.ReadFile(file.string(), steps);
  if (scene == nullptr || scene->mRootNode == nullptr)
    return fail(file.string(), "is no model that can be read: " + line_text(importer.GetErrorString()));
  Result<ImportedScene> read = SceneReader(*scene, file).read();
  if (read) read->unit_is_known = states_unit(extension);
  return read;
}

}  // namespace sigs
