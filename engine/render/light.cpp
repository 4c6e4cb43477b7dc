// SPDX-License-Identifier: MIT
#include "render/light.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sigs {
namespace {

constexpr int kMargin_texels = 2;
constexpr int kSmallestSide_texels = 128;
constexpr int kLargestSide_texels = 2048;
constexpr int kStep_texels = 64;
// Drawn pixels, of which three or more make a pixel of the image. A texel of one drawn pixel takes 20 % more time and
// brings nothing that rounding does not hide; of two, the error near sunset grows by a third.
constexpr double kTexel_px = 1.25;

// Axes as those of a view that looks along the light: X away from the sun, Y and Z across. Rows: sun from body.
glm::dmat3 sun_from_body_axes(const glm::dvec3& to_sun) {
  const glm::dvec3 away = -to_sun;
  // The body's axis that the light is least along.
  const glm::dvec3 size = glm::abs(away);
  const glm::dvec3 helper = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                            : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                 : glm::dvec3(0, 0, 1);
  const glm::dvec3 right = glm::normalize(glm::cross(helper, away));
  return glm::transpose(glm::dmat3(away, right, glm::cross(away, right)));
}

struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};
};

Bounds bounds_of(const Mesh& mesh, const glm::dmat3& turned) {
  Bounds bounds;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner((i & 1) != 0 ? mesh.high_m.x : mesh.low_m.x, (i & 2) != 0 ? mesh.high_m.y : mesh.low_m.y,
                            (i & 4) != 0 ? mesh.high_m.z : mesh.low_m.z);
    bounds.low = glm::min(bounds.low, turned * corner);
    bounds.high = glm::max(bounds.high, turned * corner);
  }
  return bounds;
}

glm::dmat4 from_rows(const glm::dvec4& a, const glm::dvec4& b, const glm::dvec4& c, const glm::dvec4& d) {
  return glm::transpose(glm::dmat4(a, b, c, d));
}

using ViewFromBody = Pose<frame::View, frame::Body>;

// A point p = scaled / scale, where the square of the length of `scaled` fits a float.
struct ScaledPoint {
  glm::vec3 scaled;
  float scale;
};

ScaledPoint scaled_point(const glm::dvec3& p) {
  constexpr double kFar_m = 1e6;
  const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  const double scale = largest > kFar_m ? kFar_m / largest : 1.0;
  return {p * scale, static_cast<float>(scale)};
}

// What lights of both kinds need.
void set_common(const Program& program, const glm::dvec3& color, const ViewFromBody& view_from_body) {
  program.use();
  const ScaledPoint eye = scaled_point(-view_from_body.translation_m);
  program.set("light_color", glm::vec3(color));
  program.set("eye_scaled", eye.scaled);
  program.set("eye_scale", eye.scale);
  program.set("view_from_body", glm::mat3(glm::mat3_cast(view_from_body.rotation)));
}

// Of any length that a double holds; straight up in the image where it has none.
glm::dvec3 unit(const glm::dvec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return largest > 0 ? glm::normalize(v / largest) : glm::dvec3(0, 0, -1);
}

}  // namespace

SunView sun_view_of(const Mesh& mesh, const glm::dvec3& to_sun_in_body, int side_texels) {
  const glm::dmat3 sun_from_body = sun_from_body_axes(to_sun_in_body);
  const Bounds bounds = bounds_of(mesh, sun_from_body);
  const glm::dvec3 extent_m = bounds.high - bounds.low;
  const double texel_m = std::max({extent_m.y, extent_m.z, 1e-9}) / (side_texels - 2 * kMargin_texels);
  const auto texels_of = [&](double length_m) {
    return static_cast<int>(std::ceil(length_m / texel_m - 1e-9)) + 2 * kMargin_texels;
  };
  SunView sun{.size_texels = {texels_of(extent_m.y), texels_of(extent_m.z)},
              .depth_texels = extent_m.x / texel_m + 2 * kMargin_texels};
  const glm::dmat3 rows = glm::transpose(sun_from_body) / texel_m;  // column i: row i of the turn
  const glm::dvec3 shift = -bounds.low / texel_m + double{kMargin_texels};
  const glm::dvec4 depth(rows[0], shift.x);
  const glm::dvec4 x(rows[1], shift.y);
  const glm::dvec4 y(rows[2], shift.z);
  const glm::dvec4 one(0, 0, 0, 1);
  sun.texels_from_body = from_rows(x, y, depth, one);
  sun.clip_from_body = from_rows(x * (2.0 / sun.size_texels.width) - one, y * (2.0 / sun.size_texels.height) - one,
                                 depth * (2.0 / sun.depth_texels) - one, one);
  return sun;
}

int shadow_map_side(const Mesh& mesh, const Pose<frame::View, frame::Body>& view_from_body, const VirtualCamera& view) {
  const double radius_m = std::max(double{mesh.radius_m}, 1e-9);
  const double distance_m = std::max(glm::length(view_from_body.translation_m), radius_m);
  const double drawn_px = 2 * radius_m * view.focal_px / distance_m;
  const double steps = std::min(std::ceil(drawn_px / kTexel_px / kStep_texels), 1e3);
  return std::clamp(static_cast<int>(steps) * kStep_texels, kSmallestSide_texels, kLargestSide_texels);
}

Result<ShadowMap> ShadowMap::create() {
  Result<Program> solid = Program::create("#define DEPTH\n");
  if (!solid) return fail(solid.error());
  Result<Program> cutout = Program::create("#define DEPTH\n#define IMAGE\n");
  if (!cutout) return fail(cutout.error());
  return ShadowMap(std::move(*solid), std::move(*cutout));
}

ShadowMap::ShadowMap(Program solid, Program cutout) : solid_(std::move(solid)), cutout_(std::move(cutout)) {}

Result<void> ShadowMap::grow(const cv::Size& size) {
  if (size.width <= size_.width && size.height <= size_.height) return {};
  if (framebuffer_ == 0) {
    glGenFramebuffers(1, &framebuffer_);
    glGenTextures(1, &depth_);
  }
  size_ = {std::max(size.width, size_.width), std::max(size.height, size_.height)};
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, depth_);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, size_.width, size_.height, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
               nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_, 0);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return {};
  size_ = {0, 0};
  return fail("OpenGL", "cannot draw to a texture of depths, which shadows need", ErrorKind::unavailable);
}

Result<PassCounts> ShadowMap::draw(const GpuMesh& gpu, const SunView& sun) {
  if (drawn_ && drawn_->fingerprint == gpu.fingerprint() && drawn_->sun == sun) return PassCounts{};
  drawn_.reset();
  if (const Result<void> grown = grow(sun.size_texels); !grown) return fail(grown.error());
  PassCounts counts;
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, sun.size_texels.width, sun.size_texels.height);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, sun.size_texels.width, sun.size_texels.height);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glClearDepth(1);
  glClear(GL_DEPTH_BUFFER_BIT);
  for (const Program* program : {&solid_, &cutout_}) {
    program->use();
    program->set("clip_from_body", glm::mat4(sun.clip_from_body));
  }
  for (const Run& run : gpu.bind_solid()) {
    const bool is_cutout = run.surface == Surface::cutout;
    (is_cutout ? cutout_ : solid_).use();
    if (is_cutout) gpu.bind_texture(run.texture);
    leave_out(run.hidden);  // the sun is outside of every body
    gpu.draw(run);
    counts.triangles += run.count / 3;
    ++counts.draw_calls;
  }
  drawn_ = {gpu.fingerprint(), sun};
  return counts;
}

void ShadowMap::bind() const {
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, depth_);
}

void set_point_light(const Program& program, const Light& light, const ViewFromBody& view_from_body,
                     const Pose<frame::View, frame::Camera>& view_from_camera) {
  set_common(program, light.color, view_from_body);
  const ScaledPoint lamp = scaled_point(view_from_camera * light.p_in_camera - view_from_body.translation_m);
  program.set("ambient", static_cast<float>(std::clamp(light.ambient, 0.0, 1.0)));
  program.set("light_scaled", lamp.scaled);
  program.set("light_scale", lamp.scale);
}

void set_sun_light(const Program& program, const Light& light, const ViewFromBody& view_from_body,
                   const Pose<frame::View, frame::Camera>& view_from_camera, const SunView& sun) {
  set_common(program, light.color * light.exposure, view_from_body);
  program.set("to_sun", glm::vec3(view_from_camera.rotation * unit(light.to_sun)));
  program.set("up", glm::vec3(view_from_camera.rotation * unit(light.up)));
  program.set("sky_color", glm::vec3(light.sky_color * light.exposure));
  program.set("ground_color", glm::vec3(light.ground_color * light.exposure));
  const glm::dmat4 body_from_surface = glm::mat4_cast(glm::conjugate(view_from_body.rotation));
  program.set("texels_from_surface", glm::mat4(sun.texels_from_body * body_from_surface));
  program.set("sun_depth_range", static_cast<float>(sun.depth_texels));
  program.set("sun_depth", 1);
}

glm::dvec3 to_sun_in_body(const Light& light, const Pose<frame::Camera, frame::Body>& camera_from_body) {
  return glm::conjugate(camera_from_body.rotation) * unit(light.to_sun);
}

}  // namespace sigs
