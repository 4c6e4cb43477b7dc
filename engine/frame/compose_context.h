// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "base/result.h"
#include "camera/lens_table.h"
#include "compositor/classic.h"
#include "render/renderer.h"

namespace sigs {

struct ComposeSettings {
  // Samples that OpenGL takes of each pixel of a virtual camera: 1, 2, 4 or 8, as far as the driver can.
  int samples_per_pixel = 1;
  // Largest error of the tabulated rays of the lens, in pixels of the image. 0: every ray is computed exactly.
  double lens_tolerance_px = LensTable::kTolerance_px;
};

// What a thread keeps from frame to frame: the OpenGL renderer, created when the first intruder comes into view, and
// tables that depend on the camera alone. A context serves one thread at a time and any number of scenes, one after the
// other.
class ComposeContext {
 public:
  explicit ComposeContext(const ComposeSettings& settings = {}) : settings_(settings) {}

  // Error `unavailable` where the machine has no OpenGL.
  [[nodiscard]] Result<Renderer*> renderer();

  // Maps by which the classic method distorts whole images. They are computed anew when the camera differs from that
  // of the last call. Valid until the next call.
  [[nodiscard]] const DistortMaps& maps_of(const Camera& camera);

  // The rays of the camera's pixels, as far as they have been asked for. Valid until a call with another camera.
  [[nodiscard]] LensTable& lens_of(const Camera& camera);

  // Buffers of the classic method's images, kept from one frame to the next so that they are allocated once.
  [[nodiscard]] ClassicStages& classic_buffers() { return classic_buffers_; }

  // Frees what OpenGL holds of a mesh. To be called before a mesh is destroyed that this context has rendered.
  void forget(const Mesh& mesh);

  // Vendor and version of OpenGL. Empty until something has been rendered.
  [[nodiscard]] std::string renderer_description() const;

 private:
  ComposeSettings settings_;
  std::optional<Renderer> renderer_;
  std::optional<DistortMaps> maps_;
  std::optional<Camera> camera_of_maps_;
  ClassicStages classic_buffers_;
  std::optional<LensTable> lens_;
};

}  // namespace sigs
