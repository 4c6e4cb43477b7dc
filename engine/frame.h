// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "annotation/annotation.h"
#include "base/result.h"
#include "camera/lens_table.h"
#include "compositor/classic.h"
#include "render/renderer.h"
#include "scene/scene.h"
#include "video/frame.h"
#include "work.h"

namespace sigs {

// One intermediate picture of a frame, for looking at: CV_8UC3 BGR or, for masks, CV_8UC1.
struct Stage {
  std::string name;  // "input1", "a", "bent", ...
  cv::Mat picture;
};

struct BenchSettings {
  int samples_per_pixel = 1;  // that OpenGL takes of a view's pixel: 1, 2, 4 or 8, as far as the driver can
  double lens_tolerance_px = LensTable::kTolerance_px;  // of tabulated rays, in the picture; 0: all rays exact
};

// What composing needs beside the scene: OpenGL, made when the first intruder comes into view, and what depends on the
// camera alone. One bench serves one thread, one scene after the other.
class Bench {
 public:
  explicit Bench(const BenchSettings& settings = {}) : settings_(settings) {}

  // Error unavailable where no OpenGL can be had.
  [[nodiscard]] Result<Renderer*> renderer();

  // Made anew where the camera is another one than at the last call. Valid until the next call.
  [[nodiscard]] const DistortMaps& maps_of(const Camera& camera);

  // The camera's rays, kept from one call to the next with the same camera. Valid until a call with another.
  [[nodiscard]] LensTable& lens_of(const Camera& camera);

  // Pictures of the classic method that nobody looks at any more, for the next frame to write over.
  [[nodiscard]] ClassicStages& classic_buffers() { return classic_buffers_; }

  // Call it before a mesh that was drawn goes away, where the bench outlives it.
  void forget(const Mesh& mesh);

  // "" until something was drawn.
  [[nodiscard]] std::string renderer_description() const;

 private:
  BenchSettings settings_;
  std::optional<Renderer> renderer_;
  std::optional<DistortMaps> maps_;
  std::optional<Camera> camera_of_maps_;
  ClassicStages classic_buffers_;
  std::optional<LensTable> lens_;
};

// Seconds that the stops of one frame took.
struct FrameTimes {
  double draw_s = 0;
  double composite_s = 0;  // bend, soften, hide, blend
};

struct ComposedFrame {
  Frame picture;
  // CV_8UC1 of the picture's size: opacity with which intruders were laid on, 255 opaque; at least 1 where a pixel was
  // touched at all, 0 where it was not (its luma has the footage's bits; a chroma sample that it shares with a touched
  // neighbour may have changed). Empty: no pixel was touched.
  cv::Mat mask;
  FrameTruth truth;
  std::vector<Stage> stages;  // where asked for
  FrameTimes times;
  Work work;
};

enum class Stages { leave_out, keep };

// The one door: everything that shows or writes a picture of a scene calls this. Same scene, frame and background give
// the same bytes on every thread.
//   frame       counts the footage's frames from 0
//   background  that frame of the footage, of the scene's size; copied where it is not handed over. Handed over, its
//               samples become the picture's: nobody else may share them
[[nodiscard]] Result<ComposedFrame> compose_frame(const Scene& scene, int frame, const Frame& background, Bench& bench,
                                                  Stages stages = Stages::leave_out);
[[nodiscard]] Result<ComposedFrame> compose_frame(const Scene& scene, int frame, Frame&& background, Bench& bench,
                                                  Stages stages = Stages::leave_out);

}  // namespace sigs
