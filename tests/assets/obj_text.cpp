// SPDX-License-Identifier: MIT
#include "assets/obj_text.h"

#include <fstream>
#include <sstream>

namespace sigs::test {

ObjText read_obj_text(const std::filesystem::path& path) {
  ObjText obj;
  std::ifstream in(path);
  std::string line, material;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string tag;
    words >> tag;
    glm::dvec3 v{0};
    if (tag == "v" || tag == "vn") {
      words >> v.x >> v.y >> v.z;
      (tag == "v" ? obj.positions : obj.normals).push_back(v);
    } else if (tag == "vt") {
      words >> v.x >> v.y;
      obj.uvs.emplace_back(v.x, v.y);
    } else if (tag == "usemtl") {
      words >> material;
    } else if (tag == "mtllib") {
      words >> obj.mtllib;
    } else if (tag == "f") {
      ObjText::Face face{.position = {}, .uv = {}, .normal = {}, .material = material};
      char slash = 0;
      for (int k = 0; k < 3; ++k) words >> face.position[k] >> slash >> face.uv[k] >> slash >> face.normal[k];
      obj.faces.push_back(face);
    }
  }
  return obj;
}

MtlText read_mtl_text(const std::filesystem::path& path) {
  MtlText mtl;
  std::ifstream in(path);
  std::string line, name;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string tag;
    words >> tag;
    if (tag.empty() || tag.starts_with('#')) continue;
    if (tag == "newmtl") words >> name;
    MtlText::Material& material = mtl.materials[name];
    if (tag == "Kd") words >> material.diffuse.r >> material.diffuse.g >> material.diffuse.b;
    if (tag == "Ks") words >> material.specular;
    if (tag == "Ns") words >> material.shininess;
    if (tag == "d") words >> material.opacity;
    if (tag == "map_Kd") words >> material.texture;
  }
  return mtl;
}

}  // namespace sigs::test
