// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "base/image.h"
#include "base/pose.h"
#include "base/result.h"
#include "camera/camera.h"
#include "mesh/mesh.h"
#include "project/project.h"
#include "scene/model.h"
#include "scene/scene.h"
#include "telemetry/track.h"

namespace sigs {

// Attitude in the world of the aircraft that carries the camera, at one frame of the footage.
struct AttitudeAtFrame {
  double frame = 0;  // from 0; may be fractional
  Attitude attitude;
};

// Reads an attitude file (docs/frames-and-units.md): text with the header line frame,roll_deg,pitch_deg,yaw_deg, then
// one line of four numbers (decimal point, angles from -360 to 360 degrees) for each frame, by rising frame. A byte
// order mark and blank lines are skipped. The result is never empty. Errors name file and line: cannot_read; bad_data.
[[nodiscard]] Result<std::vector<AttitudeAtFrame>> read_attitude_file(const std::filesystem::path& path);

// Reads a mask of the UAV's own body: an image that read_image_file() (base/image_codecs.h) reads, 8 or 16 bits a
// sample, of the footage's size, white where the own body is; soft edges are kept, of a colour image the luma is taken.
// Returns CV_32FC1, 0..1. Errors: cannot_read; bad_data (not an image, another depth, or another size: both sizes are
// named).
[[nodiscard]] Result<cv::Mat> read_own_body_mask(const std::filesystem::path& path, cv::Size footage_size_px);

// A line of a file with boxes of aircraft that footage shows (footage.real_aircraft).
struct RealAircraftBox {
  int frame = 0;      // of the footage, from 0
  std::string label;  // of the aircraft, or of its kind: nothing keeps it from being in several lines of a frame
  Box box;
  std::string line;  // as it stands in the file, without a line feed

  [[nodiscard]] bool operator==(const RealAircraftBox&) const = default;
};

// The first line of such a file, and the lines below it in their order.
struct RealAircraftFile {
  std::string header;
  std::vector<RealAircraftBox> boxes;
};
inline constexpr const char* kRealAircraftHeader = "frame,label,x,y,w,h";

// Reads CSV with a header line (kRealAircraftHeader), then one line for each box; frames from 0, x and y in pixels of
// which the first one has the centre (1, 1), as in the published boxes of the Svanstrom data set
// (doi:10.5281/zenodo.5500576). Columns beyond these are kept in the line. Errors: cannot_read; bad_data (file and
// line) for what is no number, a frame beyond 10 million.
[[nodiscard]] Result<RealAircraftFile> read_real_aircraft(const std::filesystem::path& csv);

// The box as a line of such a file, which has 4 decimals: the result has the box that is read from that line.
//   label  without comma and line feed
[[nodiscard]] RealAircraftBox real_aircraft_box(int frame, std::string label, const Box& box);

// The boxes of read_real_aircraft(). One without area is left out. Errors as there; bad_data too where there is no
// box at all, unless the file is kRealAircraftHeader alone.
[[nodiscard]] Result<BoxesByFrame> read_boxes_by_frame(const std::filesystem::path& csv);

// A cache of the files that scenes are made from: a scene that is opened again after an edit reads only what has
// changed. A file is read again when its size or its time of change differs; an OBJ file is read with its materials and
// textures. Errors are those of the functions that read; they are cached too, except cannot_read, as permissions can
// change without a trace. The cache keeps what scenes use, and of each kind the 8 last used of the rest. It may
// be used from any thread; one waits while another reads.
class SceneFiles {
 public:
  SceneFiles();
  SceneFiles(SceneFiles&&) noexcept;
  SceneFiles& operator=(SceneFiles&&) noexcept;
  ~SceneFiles();

  // The same file, axes and surfaces give the same object for as long as it is in use.
  //   heat  none: it looks as its materials say; else as a thermal camera sees it
  [[nodiscard]] Result<std::shared_ptr<const Model>> model(const std::filesystem::path& file, const ModelAxes& axes,
                                                           const ModelSurfaces& surfaces = {},
                                                           const std::optional<HeatLevels>& heat = std::nullopt);

  // read_calibration (camera/camera.h) for footage. model: none: taken from the file.
  [[nodiscard]] Result<Camera> camera(const std::filesystem::path& calibration, const FootageShape& footage,
                                      std::optional<LensModel> model = std::nullopt);

  // Size and times of a project's footage, where it is not that of the scene (open_footage, shape_of).
  [[nodiscard]] Result<FootageShape> footage_shape(const Project& project);

  // read_attitude_file
  [[nodiscard]] Result<std::vector<AttitudeAtFrame>> attitudes(const std::filesystem::path& file);

  // read_track (telemetry/track.h). The same file gives the same object for as long as it is in use.
  [[nodiscard]] Result<std::shared_ptr<const Track>> track(const std::filesystem::path& file);

  // read_own_body_mask. The samples are shared with the cache: not to be written to.
  [[nodiscard]] Result<cv::Mat> own_body_mask(const std::filesystem::path& file, cv::Size footage_size_px);

  // read_boxes_by_frame
  [[nodiscard]] Result<BoxesByFrame> boxes(const std::filesystem::path& csv);

  // The placeholder of a model (cross_mesh). The same length gives the same object. length_m > 0.
  [[nodiscard]] std::shared_ptr<const Model> cross(double length_m);

 private:
  struct Caches;
  std::unique_ptr<Caches> caches_;
};

}  // namespace sigs
