// SPDX-License-Identifier: MIT
#include "render/renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/ensure.h"
#include "base/transfer.h"
#include "render/egl_context.h"
#include "render/gpu_mesh.h"
#include "render/passes.h"
#include "render/program.h"
#include "render/projection.h"
#include "render/target.h"

namespace sigs {

struct Renderer::State {
  EglContext context;
  Programs programs;
  Target target;
  std::map<const Mesh*, GpuMesh> meshes;
  RenderCounts counts;
};

namespace {

constexpr int kLargestView_px = 16384;
using ViewFromBody = Pose<frame::View, frame::Body>;

bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// p = scaled / scale, with a length whose square fits a float.
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

void set_light(const Program& program, const Light& light, const ViewFromBody& view_from_body,
               const Pose<frame::View, frame::Camera>& view_from_camera) {
  program.use();
  const ScaledPoint lamp = scaled_point(view_from_camera * light.p_in_camera - view_from_body.translation_m);
  const ScaledPoint eye = scaled_point(-view_from_body.translation_m);
  program.set("light_color", glm::vec3(light.color));
  program.set("ambient", static_cast<float>(std::clamp(light.ambient, 0.0, 1.0)));
  program.set("light_scaled", lamp.scaled);
  program.set("light_scale", lamp.scale);
  program.set("eye_scaled", eye.scaled);
  program.set("eye_scale", eye.scale);
  program.set("view_from_body", glm::mat3(glm::mat3_cast(view_from_body.rotation)));
}

// Outside the body with all of it beyond the near plane.
bool sees_from_outside(const ViewFromBody& view_from_body, const Mesh& mesh) {
  return view_from_body.translation_m.x > 1.01 * mesh.radius_m;
}

void set_fixed_state() {
  glEnable(GL_MULTISAMPLE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glFrontFace(GL_CW);  // the window's rows run down the texture, so counter-clockwise triangles turn the other way
}

std::vector<cv::Rect> pieces_of(const cv::Size& size) {
  constexpr int kSide = Target::kLargestPiece_px;
  std::vector<cv::Rect> pieces;
  for (int y = 0; y < size.height; y += kSide)
    for (int x = 0; x < size.width; x += kSide)
      pieces.emplace_back(x, y, std::min(kSide, size.width - x), std::min(kSide, size.height - y));
  return pieces;
}

GpuMesh& uploaded(std::map<const Mesh*, GpuMesh>& meshes, const Mesh& mesh) {
  const auto known = meshes.find(&mesh);
  if (known != meshes.end() && known->second.is_copy_of(mesh)) return known->second;
  if (known != meshes.end()) {
    known->second.release();
    meshes.erase(known);
  }
  return meshes.emplace(&mesh, GpuMesh(mesh)).first->second;
}

Layer blank(const cv::Size& size) {
  return {cv::Rect({0, 0}, size), cv::Mat::zeros(size, CV_32FC4), cv::Mat::zeros(size, CV_32FC1)};
}

void count(const PassCounts& pass, RenderCounts& counts) {
  counts.triangles_drawn += pass.triangles;
  counts.draw_calls += pass.draw_calls;
}

void ensure_sane(const ViewFromBody& view_from_body, const Light& light, const VirtualCamera& view) {
  ENSURE(is_finite(view_from_body.translation_m));
  ENSURE(std::isfinite(glm::dot(view_from_body.rotation, view_from_body.rotation)));
  ENSURE(is_finite(light.p_in_camera) && is_finite(light.color) && std::isfinite(light.ambient));
  ENSURE(std::isfinite(view.focal_px) && view.focal_px > 0);
  ENSURE(std::isfinite(view.center_px.x) && std::isfinite(view.center_px.y));
}

}  // namespace

Result<Renderer> Renderer::create(int samples_per_pixel) {
  ENSURE(samples_per_pixel >= 1 && samples_per_pixel <= 8);
  Result<EglContext> context = EglContext::create();
  if (!context) return fail(context.error());
  Result<Programs> programs = Programs::create();
  if (!programs) return fail(programs.error());
  return Renderer(
      std::unique_ptr<State>(new State{std::move(*context), std::move(*programs), Target(samples_per_pixel), {}, {}}));
}

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

const std::string& Renderer::description() const {
  return state_->context.description();
}

const RenderCounts& Renderer::counts() const {
  return state_->counts;
}

int Renderer::max_size_px() const {
  return kLargestView_px;
}

Result<Layer> Renderer::draw(const Mesh& mesh, const Pose<frame::Camera, frame::Body>& camera_from_body,
                             const Light& light, const VirtualCamera& view) {
  const ViewFromBody view_from_body = view.view_from_camera * camera_from_body;
  ensure_sane(view_from_body, light, view);
  if (view.size_px.empty()) return Layer{};
  if (std::max(view.size_px.width, view.size_px.height) > kLargestView_px)
    return fail("view", "of " + std::to_string(view.size_px.width) + " x " + std::to_string(view.size_px.height) +
                            " pixels is larger than " + std::to_string(kLargestView_px));
  if (!state_->context.make_current())
    return fail("OpenGL", "the context cannot be made current", ErrorKind::unavailable);

  Layer layer = blank(view.size_px);
  if (mesh.indices.empty()) return layer;
  GpuMesh& gpu = uploaded(state_->meshes, mesh);
  const DrawList sorted = gpu.sorted_for(inverse(view_from_body).translation_m);
  const bool from_outside = sees_from_outside(view_from_body, mesh);
  set_fixed_state();
  for (const Program& program : state_->programs.all) set_light(program, light, view_from_body, view.view_from_camera);
  for (const cv::Rect& piece : pieces_of(view.size_px)) {
    const std::optional<glm::dmat4> clip = clip_from_body(view_from_body, mesh.radius_m, view, piece);
    if (!clip) return layer;
    if (const auto begun = state_->target.begin(piece.size()); !begun) return fail(begun.error());
    for (const Program& program : state_->programs.all) {
      program.use();
      program.set("clip_from_body", glm::mat4(*clip));
    }
    count(draw_solid(state_->programs, gpu, from_outside), state_->counts);
    count(draw_transparent(state_->programs, gpu, sorted), state_->counts);
    state_->target.read(layer.color(piece), layer.coverage(piece));
    state_->counts.pixels_drawn += piece.area();
  }
  state_->counts.bytes_uploaded += gpu.take_bytes_uploaded();
  if (const GLenum code = glGetError(); code != GL_NO_ERROR)
    return fail("OpenGL", "drawing failed with error " + std::to_string(code), ErrorKind::unavailable);
  return layer;
}

void Renderer::forget(const Mesh& mesh) {
  const auto known = state_->meshes.find(&mesh);
  if (known == state_->meshes.end() || !state_->context.make_current()) return;
  known->second.release();
  state_->meshes.erase(known);
}

}  // namespace sigs
