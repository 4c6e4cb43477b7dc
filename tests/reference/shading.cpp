// SPDX-License-Identifier: MIT
#include "reference/shading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "reference/transfer.h"

namespace sigs::truth {
namespace {

constexpr double kSolid = 0.999F;      // a material's opacity from which it is solid
constexpr double kSeen = 1.0 / 255.0;  // opacity below which light passes
constexpr double kGloss = 0.25;        // share of the specular colour that is used

cv::Mat premultiplied_light(const cv::Mat& rgba) {
  std::array<double, 256> light{};
  for (int i = 0; i < 256; ++i) light[static_cast<std::size_t>(i)] = light_of_code(i / 255.0);
  cv::Mat out(rgba.size(), CV_32FC4);
  for (int y = 0; y < rgba.rows; ++y)
    for (int x = 0; x < rgba.cols; ++x) {
      const cv::Vec4b& texel = rgba.at<cv::Vec4b>(y, x);
      const double opacity = texel[3] / 255.0;
      cv::Vec4f& target = out.at<cv::Vec4f>(y, x);
      for (int c = 0; c < 3; ++c) target[c] = float(light[texel[c]] * opacity);
      target[3] = float(opacity);
    }
  return out;
}

int wrapped(double i, int count) {
  const double rest = i - std::floor(i / count) * count;
  return std::min(static_cast<int>(rest), count - 1);
}

glm::dvec4 texel(const cv::Mat& texture, double column, double row) {
  const cv::Vec4f& t = texture.at<cv::Vec4f>(wrapped(row, texture.rows), wrapped(column, texture.cols));
  return {t[0], t[1], t[2], t[3]};
}

// Texel centres lie at (i + 0.5) / size; v runs up from the last row; the texture repeats.
glm::dvec4 texture_at(const cv::Mat& texture, const glm::dvec2& uv) {
  const double column = uv.x * texture.cols - 0.5;
  const double row = (1 - uv.y) * texture.rows - 0.5;
  const double left = std::floor(column);
  const double top = std::floor(row);
  const double right_share = column - left;
  const glm::dvec4 upper = glm::mix(texel(texture, left, top), texel(texture, left + 1, top), right_share);
  const glm::dvec4 lower = glm::mix(texel(texture, left, top + 1), texel(texture, left + 1, top + 1), right_share);
  return glm::mix(upper, lower, row - top);
}

// Of any length that a double holds.
glm::dvec3 unit_or(const glm::dvec3& v, const glm::dvec3& fallback) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 1e-12)) return fallback;
  return glm::normalize(largest < 1e100 ? v : v / largest);
}

glm::dvec3 light_of(const glm::vec3& code) {
  return {light_of_code(code.x), light_of_code(code.y), light_of_code(code.z)};
}

}  // namespace

bool lets_no_light_through(const Material& material) {
  if (!(material.opacity >= kSolid) || material.rotor) return false;
  if (material.texture.empty()) return true;
  cv::Mat opacity;
  cv::extractChannel(material.texture, opacity, 3);
  return cv::countNonZero(opacity != 255) == 0;
}

Shader::Shader(const Mesh& mesh, const Lighting& lighting) : lighting_(lighting) {
  std::map<const uchar*, cv::Mat> textures;
  for (const Material& m : mesh.materials) {
    cv::Mat& texture = textures[m.texture.data];
    if (texture.empty() && !m.texture.empty()) texture = premultiplied_light(m.texture);
    materials_.push_back({light_of(m.diffuse), m.specular, std::clamp(double{m.shininess}, 1.0, 200.0),
                          m.opacity >= kSolid ? 1.0 : std::max(double{m.opacity}, 0.0), texture, m.rotor});
  }
}

bool Shader::stops_sun(int material, const glm::dvec2& uv) const {
  const ShadedMaterial& paint = materials_[static_cast<std::size_t>(material)];
  if (paint.opacity < 1 || paint.rotor) return false;
  return paint.texture.empty() || texture_at(paint.texture, uv).a >= 0.5;
}

namespace {

// Schlick 1994, between reflectance at straight incidence and at a grazing angle.
double fresnel(double straight, double grazing, double cosine) {
  const double rest = 1 - std::clamp(cosine, 0.0, 1.0);
  return straight + (grazing - straight) * rest * rest * rest * rest * rest;
}

// Unlike the sky, the strip at the horizon 6 degrees either way is of both colours.
glm::dvec3 mirrored(const Lighting& lighting, const glm::dvec3& direction) {
  const double s = std::clamp(5 * glm::dot(direction, lighting.up) + 0.5, 0.0, 1.0);
  return lighting.ground + (lighting.sky - lighting.ground) * (s * s * (3 - 2 * s));
}

}  // namespace

glm::dvec4 Shader::in_sun(const SurfacePoint& point, const ShadedMaterial& paint, const glm::dvec4& texture) const {
  constexpr double kPi = std::numbers::pi;
  const Lighting& l = lighting_;
  const bool is_glass = paint.opacity < 1;
  const glm::dvec3 to_eye = unit_or(l.eye_m - point.p_m, {0, 0, -1});
  glm::dvec3 n = unit_or(point.normal, point.facet);
  if (glm::dot(n, point.facet) < 0) n = -n;

  glm::dvec3 straight = paint.specular * kGloss;
  if (is_glass) straight = glm::min(straight, glm::dvec3(0.04));
  const double grazing = std::min(1.0, 50 * std::max({straight.x, straight.y, straight.z}));

  // Irradiance of the sun over pi, so that 1 makes a white surface white.
  const double cosine = point.is_in_shadow ? 0 : std::max(0.0, glm::dot(n, l.to_sun));
  const glm::dvec3 half = unit_or(l.to_sun + to_eye, n);
  const double lobe = (paint.shininess + 8) / (8 * kPi) * std::pow(std::max(0.0, glm::dot(n, half)), paint.shininess);
  const double half_angle = (1 + glm::dot(n, l.up)) / 2;
  glm::dvec3 matt(0), gloss(0);
  double mirror = 0;
  for (int c = 0; c < 3; ++c) {
    const double albedo = paint.diffuse[c] * texture[c];
    const double from_sky = l.sky[c] * half_angle + l.ground[c] * (1 - half_angle);
    matt[c] = albedo * from_sky + (1 - straight[c]) * albedo / kPi * (l.color[c] * kPi * cosine);
    gloss[c] = fresnel(straight[c], grazing, glm::dot(l.to_sun, half)) * lobe * (l.color[c] * kPi * cosine);
    if (is_glass) mirror += fresnel(straight[c], grazing, glm::dot(n, to_eye)) / 3;
  }
  const glm::dvec3 seen = 2 * glm::dot(n, to_eye) * n - to_eye;
  const glm::dvec3 from_surface = gloss + mirror * mirrored(l, seen);
  return {(1 - mirror) * paint.opacity * matt + texture.a * from_surface,
          texture.a * (1 - (1 - mirror) * (1 - paint.opacity))};
}

namespace {

// Whether a blade is at a place of the body.
bool is_blade_there(const Rotor& rotor, const glm::dvec3& p_m, double time_s) {
  constexpr double kTurn = 2 * std::numbers::pi;
  const glm::dvec3 from_hub = p_m - rotor.hub_m;
  const double x = glm::dot(from_hub, rotor.across);
  const double y = glm::dot(from_hub, glm::cross(rotor.axis, rotor.across));
  const double radius = std::hypot(x, y);
  if (radius < rotor.root_m || radius > rotor.tip_m) return false;
  const double along = (radius - rotor.root_m) / (rotor.tip_m - rotor.root_m);
  const double chord_m = rotor.root_chord_m + along * (rotor.tip_chord_m - rotor.root_chord_m);
  const double turned = std::atan2(y, x) - rotor.phase_rad - kTurn * rotor.rpm / 60 * time_s;
  return 2 * radius * std::abs(std::remainder(turned, kTurn / rotor.blade_count)) < chord_m;
}

double share_of_instants(const Rotor& rotor, const glm::dvec3& p_m, const Lighting& lighting) {
  constexpr int kInstants = 64;
  int hits = 0;
  for (int i = 0; i < kInstants; ++i)
    hits +=
        is_blade_there(rotor, p_m, lighting.time_s + lighting.blades_seen_s * ((i + 0.5) / kInstants - 0.5)) ? 1 : 0;
  return double(hits) / kInstants;
}

}  // namespace

glm::dvec4 Shader::shade(const SurfacePoint& point) const {
  const ShadedMaterial& paint = materials_[static_cast<std::size_t>(point.material)];
  if (!paint.rotor) return shade(point, paint);
  ShadedMaterial blades = paint;
  blades.opacity = share_of_instants(*paint.rotor, point.p_m, lighting_);
  return shade(point, blades);
}

glm::dvec4 Shader::shade(const SurfacePoint& point, const ShadedMaterial& paint) const {
  const glm::dvec4 texture = paint.texture.empty() ? glm::dvec4(1) : texture_at(paint.texture, point.uv);
  const double opacity = texture.a * paint.opacity;
  if (opacity < kSeen) return glm::dvec4(0);

  if (lighting_.is_sun) return in_sun(point, paint, texture);
  const glm::dvec3 to_eye = unit_or(lighting_.eye_m - point.p_m, {0, 0, -1});
  const glm::dvec3 outside = unit_or(point.normal, point.is_front ? to_eye : -to_eye);
  const glm::dvec3 n = point.is_front ? outside : -outside;
  const glm::dvec3 to_lamp = unit_or(lighting_.lamp_m - point.p_m, n);
  const glm::dvec3 between = unit_or(to_lamp + to_eye, n);
  const double facing = std::max(glm::dot(n, to_lamp), 0.0);
  const double direct = 1 - lighting_.ambient;
  const double highlight = std::pow(std::max(glm::dot(n, between), 0.0), paint.shininess);
  const double gloss = facing > 0 ? kGloss * direct * highlight : 0.0;
  const glm::dvec3 matt = paint.diffuse * glm::dvec3(texture) * (lighting_.ambient + direct * facing);
  return {lighting_.color * paint.opacity * (matt + paint.specular * (gloss * texture.a)), opacity};
}

}  // namespace sigs::truth
