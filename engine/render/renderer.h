// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/image.h"
#include "base/pose.h"
#include "base/result.h"
#include "camera/virtual_camera.h"
#include "mesh/mesh.h"
#include "render/light.h"

namespace sigs {

// How rotors are drawn: when the shutter is open, in which they turn. The rows of a rolling shutter are exposed one
// after the other, so the time changes over a view.
struct Shutter {
  // A guess for footage that does not tell: between a bright day (1/1000 s and less) and a dull one (1/200 s).
  static constexpr double kAssumedExposure_s = 1.0 / 500;

  double time_s = 0;                       // the middle of the exposure, of the whole image's middle row
  double exposure_s = kAssumedExposure_s;  // 0 or more
  double center_s = 0;                     // how much later the view's centre is exposed
  glm::dvec2 s_per_px{0, 0};               // how much later each pixel to the right and down
  bool rotors_cover = true;                // false: the layer's coverage is that of the body without them
};

// Counts of a renderer's operations since its creation.
struct RenderCounts {
  std::int64_t pixels_drawn = 0;     // of all views
  std::int64_t triangles_drawn = 0;  // to be shaded, once for each piece of a large view, and for shadows
  std::int64_t bytes_uploaded = 0;   // vertices, triangles and textures; uniforms are not counted
  std::int64_t draw_calls = 0;
};

// A view with one pixel for each cell of step by step pixels of another one.
struct CoarseDrawing {
  VirtualCamera view;
  Layer layer;
  cv::Mat at_edges;  // CV_8UC1, 255 at pixels that an edge of the mesh touches (FeatureEdges) and beside them, else 0
};

// Cells of step by step pixels of a view, from its upper left corner on; those at the lower and right border may extend
// beyond it.
struct ViewCells {
  cv::Mat wanted;  // CV_8UC1, one each; 0: not wanted
  int step = 1;
};

// The wanted cells within a piece of the view, as rectangles that do not overlap; in pixels of the piece.
[[nodiscard]] std::vector<cv::Rect> wanted_in(const ViewCells& cells, const cv::Rect& piece);

// Rectangles that contain all wanted cells within a piece, few of them, so that each can be copied by a call of its
// own; in pixels of the piece, without overlap.
[[nodiscard]] std::vector<cv::Rect> copied_in(const ViewCells& cells, const cv::Rect& piece);

// Renders meshes off screen with OpenGL through EGL. A renderer may be used only by the thread that created it.
class Renderer {
 public:
  // Creates a context on EGL's surfaceless platform, else on the first EGL device that works. Error unavailable where
  // there is none; it says what was tried.
  //   samples_per_pixel  1 (no multisampling), 2, 4 or 8, as far as the driver can
  [[nodiscard]] static Result<Renderer> create(int samples_per_pixel = 4);

  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  // Platform, renderer and version: "surfaceless, llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5"
  [[nodiscard]] const std::string& description() const;

  // Whether more than one sample is taken of each pixel.
  [[nodiscard]] bool is_multisampled() const;

  // Largest width or height of a view that draw() accepts, px.
  [[nodiscard]] int max_size_px() const;

  // The counts since its creation, over all calls of draw().
  [[nodiscard]] const RenderCounts& counts() const;

  // Renders the mesh as a layer that covers the whole view (layer.rect = {0, 0, size}): premultiplied, linear light,
  // several samples for each pixel. Solid parts come first, then glass from far to near. In the sun the body casts
  // shadows on itself; docs/formulas.md has the formulas of both lights.
  // The mesh is uploaded at its first use and stays on the GPU until forget(). It is recognized by its address, so
  // meshes must neither move nor be destroyed before. A mesh that has changed is uploaded again; the change is
  // recognized by some thousand of its vertices and texels. Depth and position are computed relative to the camera, so
  // nothing jitters far from the world's origin. All numbers must be finite. A view of no size gives an empty layer.
  // Errors: bad_data where the view is larger than max_size_px(); unavailable where the driver fails.
  //   camera_from_body  pose of the mesh's body axes in the camera frame, metres
  //   light             in the camera frame
  //   view              the virtual camera: its rotation in the camera frame, focal length, centre and size in pixels
  //   shutter           for models with rotors
  [[nodiscard]] Result<Layer> draw(const Mesh& mesh, const Pose<frame::Camera, frame::Body>& camera_from_body,
                                   const Light& light, const VirtualCamera& view, const Shutter& shutter = {});

  // The same for some cells of the view alone. What the layer has elsewhere is undefined. Pixels have the values that
  // drawing the whole view gives them.
  [[nodiscard]] Result<Layer> draw_cells(const Mesh& mesh, const Pose<frame::Camera, frame::Body>& camera_from_body,
                                         const Light& light, const VirtualCamera& view, const ViewCells& cells,
                                         const Shutter& shutter = {});

  // The view with one pixel a cell, in the same light and with the same shadows. Only for renderers without
  // multisampling.
  //   shutter  of the view itself
  [[nodiscard]] Result<CoarseDrawing> draw_coarsely(const Mesh& mesh,
                                                    const Pose<frame::Camera, frame::Body>& camera_from_body,
                                                    const Light& light, const VirtualCamera& view, int step,
                                                    const Shutter& shutter = {});

  // Frees what was uploaded of a mesh. Does nothing where the mesh was never drawn.
  void forget(const Mesh& mesh);

 private:
  struct State;
  explicit Renderer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace sigs
