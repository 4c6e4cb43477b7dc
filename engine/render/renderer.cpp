// SPDX-License-Identifier: MIT
#include "render/renderer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <mutex>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "base/ensure.h"
#include "base/pose.h"
#include "base/result.h"
#include "base/text.h"
#include "base/transfer.h"
#include "camera/virtual_camera.h"
#include "render/draw_list.h"
#include "render/egl_context.h"
#include "render/gl_objects.h"
#include "render/gpu_mesh.h"
#include "render/light.h"

namespace sigs {

// The shaders for each kind of surface and one kind of light, so that none does what it does not need.
struct Programs {
  enum Kind { kPlain, kTextured, kLayered, kRotor };  // assets/shaders/intruder.frag

  std::vector<Program> all;  // kRotor from the first model with rotors on
};

// What only frames in the sun need.
struct SunTools {
  Programs programs;
  ShadowMap shadow;
};

namespace {

// --- Projection.

struct Planes {
  double near_m;
  double far_m;
};

std::optional<Planes> planes_around(double distance_m, double radius_m) {
  const double margin_m = 1e-3 * radius_m;  // so that rounding never clips the outermost vertex
  const double far_m = distance_m + radius_m + margin_m;
  // Around the eye the near plane is as close as 24 bits of depth allow without flicker.
  const double closest_m = std::min(0.05, 1e-3 * radius_m);
  if (!(far_m > closest_m)) return std::nullopt;
  return Planes{std::max(distance_m - radius_m - margin_m, closest_m), far_m};
}

glm::dmat4 clip_from_view(const VirtualCamera& view, const cv::Rect& piece, const Planes& planes) {
  const double width = piece.width;
  const double height = piece.height;
  const double depth_m = planes.far_m - planes.near_m;
  // window = center + 0.5 - piece + focal * (y, z) / x, and clip / w = 2 * window / size - 1, with w = x.
  glm::dmat4 rows(0.0);
  rows[0] = {2 * (view.center_px.x + 0.5 - piece.x) / width - 1, 2 * view.focal_px / width, 0, 0};
  rows[1] = {2 * (view.center_px.y + 0.5 - piece.y) / height - 1, 0, 2 * view.focal_px / height, 0};
  rows[2] = {(planes.far_m + planes.near_m) / depth_m, 0, 0, -2 * planes.far_m * planes.near_m / depth_m};
  rows[3] = {1, 0, 0, 0};
  return glm::transpose(rows);
}

// The matrix from body coordinates to OpenGL's clip coordinates for a piece of a view, all in double: large distances
// cancel here, before anything becomes float. Row 0 of the piece is row 0 of OpenGL's window, so the rows need not be
// reversed when they are read; pixel (i, j) of base/image.h is sampled around window coordinate (i + 0.5, j + 0.5).
// Near and far planes enclose the sphere of radius_m around the body's origin, in front of the eye. None where the
// whole sphere lies behind the eye.
std::optional<glm::dmat4> clip_from_body(const Pose<frame::View, frame::Body>& view_from_body, double radius_m,
                                         const VirtualCamera& view, const cv::Rect& piece) {
  const std::optional<Planes> planes = planes_around(view_from_body.translation_m.x, std::max(radius_m, 1e-6));
  if (!planes) return std::nullopt;
  glm::dmat4 view_from_body_matrix = glm::mat4_cast(view_from_body.rotation);
  view_from_body_matrix[3] = glm::dvec4(view_from_body.translation_m, 1);
  return clip_from_view(view, piece, *planes) * view_from_body_matrix;
}

// --- Draw passes.

constexpr float kOpaque = 254.5F / 255.0F;  // a cutout's texel at or above is solid
constexpr float kAnyOpacity = 1e9F;

Programs::Kind kind_of(const Run& run) {
  if (run.rotor != kNoRotor) return Programs::kRotor;
  if (run.texture == kNoTexture) return Programs::kPlain;
  return run.surface == Surface::solid ? Programs::kTextured : Programs::kLayered;
}

//   set_rotor  gives the program in use what it needs of the rotor of a material
template <class SetRotor>
PassCounts draw_runs(const Programs& programs, const GpuMesh& gpu, const std::vector<Run>& runs, bool is_solid_pass,
                     bool from_outside, const SetRotor& set_rotor) {
  PassCounts counts;
  for (const Run& run : runs) {
    const Programs::Kind kind = kind_of(run);
    const Program& program = programs.all[kind];
    program.use();
    if (kind == Programs::kLayered) {
      const bool is_cutout = run.surface == Surface::cutout;
      program.set("lowest_opacity", is_cutout && is_solid_pass ? kOpaque : kVisibleOpacity);
      program.set("highest_opacity", is_cutout && !is_solid_pass ? kOpaque : kAnyOpacity);
    }
    if (kind == Programs::kRotor) set_rotor(program, run.rotor);
    gpu.bind_texture(run.texture);
    leave_out(from_outside ? run.hidden : CullFace::none);
    gpu.draw(run);
    counts.triangles += run.count / 3;
    ++counts.draw_calls;
  }
  return counts;
}

// Error unavailable as that of Program::create().
//   light  lines that select the kind of light
Result<Programs> compiled_programs(const std::string& light) {
  Result<Program> plain = Program::create(light);
  if (!plain) return fail(plain.error());
  Result<Program> textured = Program::create(light + "#define IMAGE\n");
  if (!textured) return fail(textured.error());
  Result<Program> layered = Program::create(light + "#define IMAGE\n#define LAYERED\n");
  if (!layered) return fail(layered.error());
  Programs programs;
  for (Result<Program>* each : {&plain, &textured, &layered}) programs.all.push_back(std::move(**each));
  return programs;
}

// Adds the program for rotors where the mesh has some. Error unavailable as that of Program::create().
Result<void> add_rotor_program(Programs& programs, const Mesh& mesh, const std::string& light) {
  if (programs.all.size() > Programs::kRotor || !has_rotors(mesh)) return {};
  Result<Program> rotor = Program::create(light + "#define ROTOR\n");
  if (!rotor) return fail(rotor.error());
  programs.all.push_back(std::move(*rotor));
  return {};
}

// Puts the depth of solid parts into the depth buffer, so that draw_solid() shades nothing that is behind them. The
// program in use draws depth alone.
void draw_depth(const GpuMesh& gpu, bool from_outside) {
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  for (const Run& run : gpu.bind_solid()) {
    if (run.surface != Surface::solid) continue;
    leave_out(from_outside ? run.hidden : CullFace::none);
    gpu.draw(run);
  }
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

// Draws solid parts and the opaque texels of cutouts, with the depth buffer.
//   from_outside  nothing of the body is at or behind the eye: faces that point inward need not be drawn
PassCounts draw_solid(const Programs& programs, GpuMesh& gpu, bool from_outside) {
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  const std::vector<Run>& runs = gpu.bind_solid();
  return draw_runs(programs, gpu, runs, true, from_outside, [](const Program&, int) {});
}

// Draws glass and the other texels of cutouts, blended in the order of the list.
template <class SetRotor>
PassCounts draw_transparent(const Programs& programs, const GpuMesh& gpu, const DrawList& sorted,
                            const SetRotor& set_rotor) {
  if (sorted.runs.empty()) return {};
  glEnablei(GL_BLEND, 0);
  glDisablei(GL_BLEND, 1);  // coverage is replaced, not blended: glass counts as covering
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  gpu.bind_sorted(sorted);
  return draw_runs(programs, gpu, sorted.runs, false, false, set_rotor);
}

Result<SunTools> sun_tools() {
  Result<Programs> programs = compiled_programs("#define SUN\n");
  if (!programs) return fail(programs.error());
  Result<ShadowMap> shadow = ShadowMap::create();
  if (!shadow) return fail(shadow.error());
  return SunTools{std::move(*programs), std::move(*shadow)};
}

}  // namespace

struct Renderer::State {
  EglContext context;
  Programs programs;
  Target target;
  std::optional<SunTools> sun;   // made by the first draw() in the sun
  std::optional<Program> depth;  // made by the first draw() of a large view
  BufferPool buffers;
  std::map<const Mesh*, GpuMesh> meshes;
  RenderCounts counts;

  // Programs with all uniforms set but clip_from_body.
  [[nodiscard]] Result<const Programs*> lit_programs(const Mesh& mesh, const GpuMesh& gpu,
                                                     const Pose<frame::Camera, frame::Body>& camera_from_body,
                                                     const Light& light, const VirtualCamera& view);
  [[nodiscard]] Result<void> draw_depth_first(const GpuMesh& gpu, const glm::mat4& clip_from_body, bool from_outside);
};

namespace {

constexpr int kLargestView_px = 16384;
// Of a piece: below, drawing solid triangles twice takes longer than shading what is hidden.
constexpr int kMinPixelsForDepth = 250'000;
using ViewFromBody = Pose<frame::View, frame::Body>;

bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Whether the eye is outside the body and all of the body lies beyond the near plane.
bool is_eye_outside(const ViewFromBody& view_from_body, const Mesh& mesh) {
  return view_from_body.translation_m.x > 1.01 * mesh.radius_m;
}

void set_fixed_state() {
  glEnable(GL_MULTISAMPLE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glFrontFace(GL_CW);  // rows of the window run downward, which reverses the winding of triangles
}

std::vector<cv::Rect> pieces_of(const cv::Size& size) {
  constexpr int kSide = Target::kLargestPiece_px;
  std::vector<cv::Rect> pieces;
  for (int y = 0; y < size.height; y += kSide)
    for (int x = 0; x < size.width; x += kSide)
      pieces.emplace_back(x, y, std::min(kSide, size.width - x), std::min(kSide, size.height - y));
  return pieces;
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
  ENSURE(is_finite(light.to_sun) && is_finite(light.up) && std::isfinite(light.exposure));
  ENSURE(is_finite(light.sky_color) && is_finite(light.ground_color));
  ENSURE(std::isfinite(view.focal_px) && view.focal_px > 0);
  ENSURE(std::isfinite(view.center_px.x) && std::isfinite(view.center_px.y));
}

}  // namespace

Result<Renderer> Renderer::create(int samples_per_pixel) {
  ENSURE(samples_per_pixel >= 1 && samples_per_pixel <= 8);
  const std::unique_lock lock = EglContext::lock_drawing();
  Result<EglContext> context = EglContext::create();
  if (!context) return fail(context.error());
  Result<Programs> programs = compiled_programs("");
  if (!programs) return fail(programs.error());
  return Renderer(std::unique_ptr<State>(
      new State{std::move(*context), std::move(*programs), Target(samples_per_pixel), {}, {}, {}, {}, {}}));
}

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&& other) noexcept {
  const std::unique_lock lock = EglContext::lock_drawing();
  state_ = std::move(other.state_);
  return *this;
}
Renderer::~Renderer() {
  if (!state_) return;
  const std::unique_lock lock = EglContext::lock_drawing();
  state_.reset();
}

const std::string& Renderer::description() const {
  return state_->context.description();
}

const RenderCounts& Renderer::counts() const {
  return state_->counts;
}

int Renderer::max_size_px() const {
  return kLargestView_px;
}

// In the sun the map of the body's shadows is drawn first, whatever part of the body is in the view: what is outside of
// it casts shadows into it.
Result<const Programs*> Renderer::State::lit_programs(const Mesh& mesh, const GpuMesh& gpu,
                                                      const Pose<frame::Camera, frame::Body>& camera_from_body,
                                                      const Light& light, const VirtualCamera& view) {
  const ViewFromBody view_from_body = view.view_from_camera * camera_from_body;
  if (light.kind == Light::Kind::point) {
    if (const auto added = add_rotor_program(programs, mesh, ""); !added) return fail(added.error());
    for (const Program& program : programs.all) set_point_light(program, light, view_from_body, view.view_from_camera);
    return &programs;
  }
  if (!sun) {
    Result<SunTools> made = sun_tools();
    if (!made) return fail(made.error());
    sun.emplace(std::move(*made));
  }
  if (const auto added = add_rotor_program(sun->programs, mesh, "#define SUN\n"); !added) return fail(added.error());
  const SunView from_sun =
      sun_view_of(mesh, to_sun_in_body(light, camera_from_body), shadow_map_side(mesh, view_from_body, view));
  const Result<PassCounts> drawn = sun->shadow.draw(gpu, from_sun);
  if (!drawn) return fail(drawn.error());
  count(*drawn, counts);
  sun->shadow.bind();
  for (const Program& program : sun->programs.all)
    set_sun_light(program, light, view_from_body, view.view_from_camera, from_sun);
  return &sun->programs;
}

Result<void> Renderer::State::draw_depth_first(const GpuMesh& gpu, const glm::mat4& clip_from_body, bool from_outside) {
  if (!depth) {
    Result<Program> made = Program::create("#define DEPTH\n");
    if (!made) return fail(made.error());
    depth.emplace(std::move(*made));
  }
  depth->use();
  depth->set("clip_from_body", clip_from_body);
  draw_depth(gpu, from_outside);
  return {};
}

Result<Layer> Renderer::draw(const Mesh& mesh, const Pose<frame::Camera, frame::Body>& camera_from_body,
                             const Light& light, const VirtualCamera& view, const Shutter& shutter) {
  const ViewFromBody view_from_body = view.view_from_camera * camera_from_body;
  ENSURE(std::isfinite(shutter.time_s) && shutter.exposure_s >= 0 && std::isfinite(shutter.center_s));
  ensure_sane(view_from_body, light, view);
  if (view.size_px.empty()) return Layer{};
  if (std::max(view.size_px.width, view.size_px.height) > kLargestView_px)
    return fail("view",
                fmt::format("of {} pixels is larger than {}", image_size_text(view.size_px, " x "), kLargestView_px));
  const std::unique_lock lock = state_->context.lock_if_shared();
  if (!state_->context.make_current())
    return fail("OpenGL", "the context cannot be made current", ErrorKind::unavailable);

  if (mesh.indices.empty()) return blank(view.size_px);
  GpuMesh& gpu = uploaded_mesh(state_->meshes, mesh);
  const DrawList sorted = gpu.sorted_for(inverse(view_from_body).translation_m);
  const bool from_outside = is_eye_outside(view_from_body, mesh);
  set_fixed_state();
  const Result<const Programs*> programs = state_->lit_programs(mesh, gpu, camera_from_body, light, view);
  if (!programs) return fail(programs.error());
  Layer layer{cv::Rect({0, 0}, view.size_px), state_->buffers.image(view.size_px, CV_32FC4),
              state_->buffers.image(view.size_px, CV_32FC1)};
  for (const cv::Rect& piece : pieces_of(view.size_px)) {
    const std::optional<glm::dmat4> clip = clip_from_body(view_from_body, mesh.radius_m, view, piece);
    if (!clip) return blank(view.size_px);
    if (const auto begun = state_->target.begin(piece.size()); !begun) return fail(begun.error());
    for (const Program& program : (*programs)->all) {
      program.use();
      program.set("clip_from_body", glm::mat4(*clip));
    }
    if (piece.area() >= kMinPixelsForDepth)
      if (const auto drawn = state_->draw_depth_first(gpu, *clip, from_outside); !drawn) return fail(drawn.error());
    count(draw_solid(**programs, gpu, from_outside), state_->counts);
    const auto set_rotor = [&](const Program& program, int material) {
      set_rotor_uniforms(program, *mesh.materials[static_cast<std::size_t>(material)].rotor, view_from_body, view,
                         piece, shutter);
    };
    count(draw_transparent(**programs, gpu, sorted, set_rotor), state_->counts);
    state_->target.read(layer.color(piece), layer.coverage(piece));
    state_->counts.pixels_drawn += piece.area();
  }
  state_->counts.bytes_uploaded += gpu.take_bytes_uploaded();
  if (const GLenum code = glGetError(); code != GL_NO_ERROR)
    return fail("OpenGL", fmt::format("drawing failed with error {}", code), ErrorKind::unavailable);
  return layer;
}

void Renderer::forget(const Mesh& mesh) {
  const std::unique_lock lock = state_->context.lock_if_shared();
  const auto known = state_->meshes.find(&mesh);
  if (known == state_->meshes.end() || !state_->context.make_current()) return;
  known->second.release();
  state_->meshes.erase(known);
}

}  // namespace sigs
