// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "camera/lens_table.h"
#include "compositor/classic.h"
#include "render/renderer.h"
#include "truth/annotation.h"
#include "video/frame.h"
#include "video/heat_palette.h"

namespace sigs {

// One intermediate image of a frame, for inspection: CV_8UC3 BGR or, for masks, CV_8UC1. The name is also that of the
// file that `sigs frame --stages` writes: "input1", "a", "warped", ...; with several intruders "1_warped" for the one
// with id 1.
struct Stage {
  std::string name;
  cv::Mat image;
};

// Whether the intermediate images of a frame are kept.
enum class Stages { leave_out, keep };

// Operations that composing a frame took, counted where they happen. Unlike seconds they are the same on every machine.
struct OpCounts {
  std::int64_t lens_evaluations = 0;  // of the lens model: directions to pixels and pixels to directions
  std::int64_t pixels_drawn = 0;      // by OpenGL, of all virtual cameras
  std::int64_t triangles_drawn = 0;
  std::int64_t bytes_uploaded = 0;         // to OpenGL: meshes and textures
  std::int64_t pixels_warped = 0;          // of layers, sampled through the lens
  std::int64_t pixels_blurred = 0;         // of layers; with the classic method of whole images too
  std::int64_t pixels_blended = 0;         // of the frame, rewritten
  std::int64_t pixels_converted = 0;       // of whole images, between code values and BGR
  std::int64_t pixels_motion_blurred = 0;  // of layers, times the shifts that each is the sum of
  std::int64_t samples_filtered = 0;       // of the frame's planes: sharpening, chroma blur
  std::int64_t samples_of_noise = 0;       // grain
  std::int64_t pixels_coded = 0;           // by the codec match

  [[nodiscard]] bool operator==(const OpCounts&) const = default;

  OpCounts& operator+=(const OpCounts& more) {
    lens_evaluations += more.lens_evaluations;
    pixels_drawn += more.pixels_drawn;
    triangles_drawn += more.triangles_drawn;
    bytes_uploaded += more.bytes_uploaded;
    pixels_warped += more.pixels_warped;
    pixels_blurred += more.pixels_blurred;
    pixels_blended += more.pixels_blended;
    pixels_converted += more.pixels_converted;
    pixels_motion_blurred += more.pixels_motion_blurred;
    samples_filtered += more.samples_filtered;
    samples_of_noise += more.samples_of_noise;
    pixels_coded += more.pixels_coded;
    return *this;
  }
};

// Seconds that the two parts of composing took.
struct FrameTimes {
  double draw_s = 0;       // OpenGL, with reading its images back
  double composite_s = 0;  // warp, blur, occlude, blend, measure
};

// A frame of the footage with the intruders in it, and the truth about them.
struct ComposedFrame {
  Frame image;
  // Opacity with which the intruders were composited: CV_8UC1 of the image's size, 255 opaque. At least 1 where a pixel
  // was rewritten at all; 0 where its luma has the bits of the footage (a chroma sample shared with a rewritten
  // neighbour may differ). Where sharpening, chroma blur or grain go beyond the opacity, 1. Empty where no pixel
  // was rewritten.
  cv::Mat mask;
  FrameTruth truth;
  std::vector<Stage> stages;  // empty unless asked for
  // By how many codes of 8 bits an intruder's body, without its lights, changes luma in the mean, weighted by its
  // coverage; by id, of those that have lights in the image.
  std::map<int, double> body_changes;
  FrameTimes times;
  OpCounts op_counts;
};

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

  // The colours of a palette, which is not gray. Valid until a call with another one.
  [[nodiscard]] const HeatColors& colors_of(HeatPalette palette);

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
  std::optional<HeatColors> colors_;
};

}  // namespace sigs
