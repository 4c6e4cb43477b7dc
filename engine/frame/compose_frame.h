// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "camera/lens_table.h"
#include "compositor/classic.h"
#include "frame/op_counts.h"
#include "render/renderer.h"
#include "scene/scene.h"
#include "truth/annotation.h"
#include "video/frame.h"

namespace sigs {

// One intermediate image of a frame, for looking at: CV_8UC3 BGR or, for masks, CV_8UC1.
struct Stage {
  std::string name;  // "input1", "a", "bent", ...
  cv::Mat image;
};

struct ComposeSettings {
  int samples_per_pixel = 1;  // that OpenGL takes of a view's pixel: 1, 2, 4 or 8, as far as the driver can
  double lens_tolerance_px = LensTable::kTolerance_px;  // of tabulated rays, in the image; 0: all rays exact
};

// What composing needs beside the scene: OpenGL, made when the first intruder comes into view, and what depends on the
// camera alone. One context serves one thread, one scene after the other.
class ComposeContext {
 public:
  explicit ComposeContext(const ComposeSettings& settings = {}) : settings_(settings) {}

  // Error unavailable where no OpenGL can be had.
  [[nodiscard]] Result<Renderer*> renderer();

  // Made anew where the camera is another one than at the last call. Valid until the next call.
  [[nodiscard]] const DistortMaps& maps_of(const Camera& camera);

  // The camera's rays, kept from one call to the next with the same camera. Valid until a call with another.
  [[nodiscard]] LensTable& lens_of(const Camera& camera);

  // Images of the classic method that nobody looks at any more, for the next frame to write over.
  [[nodiscard]] ClassicStages& classic_buffers() { return classic_buffers_; }

  // Call it before a mesh that was drawn goes away, where the context outlives it.
  void forget(const Mesh& mesh);

  // "" until something was drawn.
  [[nodiscard]] std::string renderer_description() const;

 private:
  ComposeSettings settings_;
  std::optional<Renderer> renderer_;
  std::optional<DistortMaps> maps_;
  std::optional<Camera> camera_of_maps_;
  ClassicStages classic_buffers_;
  std::optional<LensTable> lens_;
};

// Seconds that the stages of one frame took.
struct FrameTimes {
  double draw_s = 0;
  double composite_s = 0;  // warp, blur, occlude, blend
};

struct ComposedFrame {
  Frame image;
  // CV_8UC1 of the image's size: opacity with which intruders were composited, 255 opaque; at least 1 where a pixel was
  // touched at all, 0 where it was not (its luma has the footage's bits; a chroma sample that it shares with a touched
  // neighbour may have changed). Empty: no pixel was touched.
  cv::Mat mask;
  FrameTruth truth;
  std::vector<Stage> stages;  // where asked for
  FrameTimes times;
  OpCounts op_counts;
};

enum class Stages { leave_out, keep };

// The one entry point: everything that shows or writes an image of a scene calls this. Same scene, frame and background
// give the same bytes on every thread.
//   frame       counts the footage's frames from 0
//   background  that frame of the footage, of the scene's size; copied where it is not handed over. Handed over, its
//               samples become the image's: nobody else may share them
[[nodiscard]] Result<ComposedFrame> compose_frame(const Scene& scene, int frame, const Frame& background,
                                                  ComposeContext& context, Stages stages = Stages::leave_out);
[[nodiscard]] Result<ComposedFrame> compose_frame(const Scene& scene, int frame, Frame&& background,
                                                  ComposeContext& context, Stages stages = Stages::leave_out);

}  // namespace sigs
