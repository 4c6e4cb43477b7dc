// SPDX-License-Identifier: MIT
#include "render/renderer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <tuple>
#include <utility>

#include "base/ensure.h"
#include "base/text.h"
#include "base/transfer.h"
#include "render/draw_list.h"
#include "render/draw_passes.h"
#include "render/egl_context.h"
#include "render/gl_objects.h"
#include "render/gpu_mesh.h"

namespace sigs {

// What only frames in the sun need.
struct SunTools {
  Programs programs;
  ShadowMap shadow;
};

namespace {

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

Result<SunTools> sun_tools() {
  Result<Programs> programs = compiled_programs("#define SUN\n");
  if (!programs) return fail(programs.error());
  Result<ShadowMap> shadow = ShadowMap::create();
  if (!shadow) return fail(shadow.error());
  return SunTools{std::move(*programs), std::move(*shadow)};
}

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

// The view with one pixel for each cell of step by step pixels.
VirtualCamera coarser(const VirtualCamera& view, int step) {
  VirtualCamera coarse = view;
  coarse.focal_px /= step;
  coarse.center_px = (view.center_px + 0.5) / double(step) - 0.5;
  coarse.size_px = {(view.size_px.width + step - 1) / step, (view.size_px.height + step - 1) / step};
  return coarse;
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

struct Renderer::State {
  // What is drawn of a mesh, and how.
  struct Task {
    const Mesh& mesh;
    const Pose<frame::Camera, frame::Body>& camera_from_body;
    const Light& light;
    const VirtualCamera& view;
    const Shutter& shutter;
    const VirtualCamera& shadow_view;  // as fine as the shadows are to be
    const ViewCells* cells = nullptr;  // null: all of the view
    cv::Mat* depth = nullptr;          // to be filled
  };

  EglContext context;
  Programs programs;
  Target target;
  std::optional<SunTools> sun;          // made by the first draw() in the sun
  std::optional<DepthMask> depth_mask;  // made by the first draw() of a large view, or of cells
  BufferPool buffers;
  std::map<const Mesh*, GpuMesh> meshes;
  RenderCounts counts;

  [[nodiscard]] Result<Layer> drawn(const Task& task);
  // Programs with all uniforms set but clip_from_body.
  [[nodiscard]] Result<const Programs*> lit_programs(const Task& task, const GpuMesh& gpu);
  [[nodiscard]] Result<void> draw_piece(const Task& task, const Programs& lit, GpuMesh& gpu, const DrawList& sorted,
                                        const cv::Rect& piece, Layer& layer);
  [[nodiscard]] Result<void> make_depth_mask();
};

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

bool Renderer::is_multisampled() const {
  return state_->target.samples() > 0;
}

int Renderer::max_size_px() const {
  return kLargestView_px;
}

// In the sun the map of the body's shadows is drawn first, whatever part of the body is in the view: what is outside of
// it casts shadows into it.
Result<const Programs*> Renderer::State::lit_programs(const Task& task, const GpuMesh& gpu) {
  const auto& [mesh, light, view] = std::tie(task.mesh, task.light, task.view);
  const ViewFromBody view_from_body = view.view_from_camera * task.camera_from_body;
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
  const SunView from_sun = sun_view_of(mesh, to_sun_in_body(light, task.camera_from_body),
                                       shadow_map_side(mesh, view_from_body, task.shadow_view));
  const Result<PassCounts> drawn = sun->shadow.draw(gpu, from_sun);
  if (!drawn) return fail(drawn.error());
  count(*drawn, counts);
  sun->shadow.bind();
  for (const Program& program : sun->programs.all)
    set_sun_light(program, light, view_from_body, view.view_from_camera, from_sun);
  return &sun->programs;
}

Result<void> Renderer::State::make_depth_mask() {
  if (depth_mask) return {};
  Result<DepthMask> made = DepthMask::create();
  if (!made) return fail(made.error());
  depth_mask.emplace(std::move(*made));
  return {};
}

Result<void> Renderer::State::draw_piece(const Task& task, const Programs& lit, GpuMesh& gpu, const DrawList& sorted,
                                         const cv::Rect& piece, Layer& layer) {
  const ViewFromBody view_from_body = task.view.view_from_camera * task.camera_from_body;
  const bool from_outside = is_eye_outside(view_from_body, task.mesh);
  const glm::mat4 clip(*clip_from_body(view_from_body, task.mesh.radius_m, task.view, piece));
  const std::vector<cv::Rect> wanted = task.cells ? wanted_in(*task.cells, piece) : std::vector<cv::Rect>();
  if (task.cells && wanted.empty()) return {};
  if (const auto begun = target.begin(piece.size()); !begun) return begun;
  const bool depth_first = piece.area() >= kMinPixelsForDepth;
  if (depth_first || task.cells)
    if (const auto made = make_depth_mask(); !made) return made;
  if (task.cells) depth_mask->restrict_to(wanted, piece.size());
  for (const Program& program : lit.all) {
    program.use();
    program.set("clip_from_body", clip);
  }
  if (depth_first) {
    depth_mask->depth_program().use();
    depth_mask->depth_program().set("clip_from_body", clip);
  }
  const auto set_rotor = [&](const Program& program, int material) {
    set_rotor_uniforms(program, *task.mesh.materials[static_cast<std::size_t>(material)].rotor, view_from_body,
                       task.view, piece, task.shutter);
  };
  if (depth_first) draw_depth(gpu, from_outside);
  count(draw_solid(lit, gpu, from_outside), counts);
  count(draw_transparent(lit, gpu, sorted, set_rotor, task.shutter.rotors_cover), counts);
  for (const cv::Rect& part :
       task.cells ? copied_in(*task.cells, piece) : std::vector<cv::Rect>{{{0, 0}, piece.size()}}) {
    const cv::Rect in_view = part + piece.tl();
    target.read(layer.color(in_view), layer.coverage(in_view), part.tl());
    counts.pixels_drawn += part.area();
  }
  if (task.depth) target.read_depth((*task.depth)(piece));
  return {};
}

Result<Layer> Renderer::State::drawn(const Task& task) {
  const ViewFromBody view_from_body = task.view.view_from_camera * task.camera_from_body;
  ENSURE(std::isfinite(task.shutter.time_s) && task.shutter.exposure_s >= 0 && std::isfinite(task.shutter.center_s));
  ensure_sane(view_from_body, task.light, task.view);
  const cv::Size& size = task.view.size_px;
  if (size.empty()) return Layer{};
  if (std::max(size.width, size.height) > kLargestView_px)
    return fail("view", fmt::format("of {} pixels is larger than {}", image_size_text(size, " x "), kLargestView_px));
  const std::unique_lock lock = context.lock_if_shared();
  if (!context.make_current()) return fail("OpenGL", "the context cannot be made current", ErrorKind::unavailable);

  if (task.depth) *task.depth = cv::Mat(size, CV_32FC1, cv::Scalar(1));
  if (task.mesh.indices.empty() ||
      !planes_around(view_from_body.translation_m.x, std::max(double{task.mesh.radius_m}, 1e-6)))
    return blank(size);
  GpuMesh& gpu = uploaded_mesh(meshes, task.mesh);
  const DrawList sorted = gpu.sorted_for(inverse(view_from_body).translation_m);
  set_fixed_state();
  const Result<const Programs*> lit = lit_programs(task, gpu);
  if (!lit) return fail(lit.error());
  Layer layer{cv::Rect({0, 0}, size), buffers.image(size, CV_32FC4), buffers.image(size, CV_32FC1)};
  for (const cv::Rect& piece : pieces_of(size))
    if (const auto done = draw_piece(task, **lit, gpu, sorted, piece, layer); !done) return fail(done.error());
  counts.bytes_uploaded += gpu.take_bytes_uploaded();
  if (const GLenum code = glGetError(); code != GL_NO_ERROR)
    return fail("OpenGL", fmt::format("drawing failed with error {}", code), ErrorKind::unavailable);
  return layer;
}

Result<Layer> Renderer::draw(const Mesh& mesh, const Pose<frame::Camera, frame::Body>& camera_from_body,
                             const Light& light, const VirtualCamera& view, const Shutter& shutter) {
  return state_->drawn({mesh, camera_from_body, light, view, shutter, view});
}

Result<Layer> Renderer::draw_cells(const Mesh& mesh, const Pose<frame::Camera, frame::Body>& camera_from_body,
                                   const Light& light, const VirtualCamera& view, const ViewCells& cells,
                                   const Shutter& shutter) {
  ENSURE(cells.wanted.type() == CV_8UC1 && cells.step >= 1);
  return state_->drawn({mesh, camera_from_body, light, view, shutter, view, &cells});
}

Result<CoarseDrawing> Renderer::draw_coarsely(const Mesh& mesh,
                                              const Pose<frame::Camera, frame::Body>& camera_from_body,
                                              const Light& light, const VirtualCamera& view, int step,
                                              const Shutter& shutter) {
  Shutter of_coarse = shutter;
  of_coarse.s_per_px *= step;
  CoarseDrawing coarse{.view = coarser(view, step), .layer = {}, .at_edges = {}};
  cv::Mat depth;
  Result<Layer> layer = state_->drawn({mesh, camera_from_body, light, coarse.view, of_coarse, view, nullptr, &depth});
  if (!layer) return fail(layer.error());
  coarse.layer = std::move(*layer);
  const ViewFromBody view_from_body = view.view_from_camera * camera_from_body;
  const auto clip = clip_from_body(view_from_body, mesh.radius_m, coarse.view, {{0, 0}, coarse.view.size_px});
  const auto gpu = state_->meshes.find(&mesh);
  coarse.at_edges = clip && gpu != state_->meshes.end()
                        ? gpu->second.feature_edges(mesh).pixels_touched({*clip, inverse(view_from_body).translation_m,
                                                                          is_eye_outside(view_from_body, mesh), depth})
                        : cv::Mat::zeros(coarse.view.size_px, CV_8UC1);
  return coarse;
}

void Renderer::forget(const Mesh& mesh) {
  const std::unique_lock lock = state_->context.lock_if_shared();
  const auto known = state_->meshes.find(&mesh);
  if (known == state_->meshes.end() || !state_->context.make_current()) return;
  known->second.release();
  state_->meshes.erase(known);
}

}  // namespace sigs
