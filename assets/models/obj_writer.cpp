// SPDX-License-Identifier: MIT
#include <cstdio>
#include <fstream>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "model.h"
#include "paint.h"

namespace sigs::models {

namespace {

// Numbers every distinct line once, in order of appearance, as OBJ requires for vertices.
class NumberedLines {
 public:
  int number_of(const std::string& line) {
    const auto [place, fresh] = numbers_.try_emplace(line, static_cast<int>(numbers_.size()) + 1);
    if (fresh) text_ += line + '\n';
    return place->second;
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::map<std::string, int> numbers_;
  std::string text_;
};

// Fixed decimals, and no minus sign before a zero.
std::string fixed_line(const char* tag, const std::vector<double>& numbers, int decimals) {
  std::string line = tag;
  for (const double number : numbers) {
    char text[32];
    std::snprintf(text, sizeof text, " %.*f", decimals, number);
    line +=
        std::string(text) == std::string(" -0.") + std::string(decimals, '0') ? std::string(text).erase(1, 1) : text;
  }
  return line;
}

std::string mtl_text(const Model& model, const Livery& livery) {
  std::ostringstream out;
  out << "# " << model.name << (livery.name.empty() ? "" : "-") << livery.name
      << ": made by generate_models, MIT licence\n";
  for (const MaterialSpec& m : livery.materials) {
    // A texture is the reflectance itself.
    const Colour diffuse = m.texture.empty() ? display_colour(m.reflectance) : Colour(1);
    out << "\nnewmtl " << m.name << '\n' << fixed_line("Kd", {diffuse.r, diffuse.g, diffuse.b}, 3) << '\n';
    out << fixed_line("Ks", {m.specular, m.specular, m.specular}, 3) << '\n' << fixed_line("Ns", {m.shininess}, 1);
    out << '\n' << fixed_line("d", {m.opacity}, 3) << '\n';
    if (!m.texture.empty()) out << "map_Kd " << m.texture << '\n';
    out << m.rotor;
  }
  return out.str();
}

class ObjText {
 public:
  void add(const Patch& patch) {
    const auto normals = smooth_normals(patch);
    for (std::size_t f = 0; f < patch.faces.size(); ++f) faces_[patch.faces[f].material] += face(patch, f, normals[f]);
  }

  [[nodiscard]] std::string text(const Model& model) const {
    std::string all = "# " + model.name + ": made by generate_models, MIT licence\n" +
                      "# metres; +x out of the nose, +y left wing, +z up; origin at the centre of gravity\n" +
                      "mtllib " + model.name + ".mtl\n" + positions_.text() + uvs_.text() + normals_.text();
    for (const MaterialSpec& m : model.liveries.front().materials)
      if (faces_.contains(m.name)) all += "usemtl " + m.name + '\n' + faces_.at(m.name);
    return all;
  }

 private:
  std::string face(const Patch& patch, std::size_t f, const std::array<glm::dvec3, 3>& normal) {
    std::string line = "f";
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 p = patch.position_m[patch.faces[f].corner[k]], n = normal[k];
      const glm::dvec2 uv = patch.uv[patch.faces[f].corner[k]];
      line += ' ' + std::to_string(positions_.number_of(fixed_line("v", {p.x, p.y, p.z}, 4)));
      line += '/' + std::to_string(uvs_.number_of(fixed_line("vt", {uv.x, uv.y}, 4)));
      line += '/' + std::to_string(normals_.number_of(fixed_line("vn", {n.x, n.y, n.z}, 4)));
    }
    return line + '\n';
  }

  NumberedLines positions_, uvs_, normals_;
  std::map<std::string, std::string> faces_;
};

bool write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) std::fprintf(stderr, "%s: cannot be written\n", path.c_str());
  return out.good();
}

bool write_picture(const std::filesystem::path& path, const cv::Mat& bgr) {
  try {
    if (cv::imwrite(path.string(), bgr, {cv::IMWRITE_PNG_COMPRESSION, 9})) return true;
  } catch (const cv::Exception&) {
    // OpenCV throws for some failures and returns false for others; both are treated alike.
  }
  std::fprintf(stderr, "%s: cannot be written\n", path.c_str());
  return false;
}

bool write_livery(const Model& model, const Livery& livery, const std::filesystem::path& folder) {
  bool good = write(folder / (model.name + ".mtl"), mtl_text(model, livery));
  for (const Texture& texture : livery.textures) good = write_picture(folder / texture.file, texture.bgr) && good;
  return good;
}

bool write_link(const std::filesystem::path& link, const std::filesystem::path& target) {
  std::error_code code;
  std::filesystem::remove(link, code);
  std::filesystem::create_symlink(target, link, code);
  if (code) std::fprintf(stderr, "%s: cannot be linked: %s\n", link.c_str(), code.message().c_str());
  return !code;
}

}  // namespace

bool write_model(const Model& model, const std::filesystem::path& folder) {
  ObjText obj;
  for (const Patch& patch : model.patches) obj.add(patch);
  const std::string obj_name = model.name + ".obj";
  bool good = true;
  for (const Livery& livery : model.liveries) {
    const std::string name = model.name + (livery.name.empty() ? "" : "-" + livery.name);
    std::error_code code;
    std::filesystem::create_directories(folder / name, code);
    good = (livery.name.empty() ? write(folder / name / obj_name, obj.text(model))
                                : write_link(folder / name / (name + ".obj"), "../" + model.name + "/" + obj_name)) &&
           write_livery(model, livery, folder / name) && good;
  }
  return good;
}

}  // namespace sigs::models
