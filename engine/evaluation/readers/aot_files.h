// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

namespace sigs {

// Truth and results in the files of the Airborne Object Tracking challenge
// (https://registry.opendata.aws/airborne-object-tracking), of many flights at once, as its own program reads them.
// Boxes have their origin at the image's upper left corner, not at the middle of its first pixel.

// A box by its middle.
struct AotBox {
  double x_px = 0;
  double y_px = 0;
  double width_px = 0;
  double height_px = 0;
};

// One object in one image, or an image that shows none: id empty, no box.
struct AotObject {
  int flight = 0;  // index of AotTruth::flights
  int frame = 0;
  std::string image;
  std::string id;                 // "Airplane1", "Helicopter2", "Bird1"
  std::optional<double> range_m;  // known for the planned encounters only
  AotBox box;
  double above_horizon = 0;  // 1 above, -1 below, 0 across or not stated
};

// A flight, and what the file's metadata state of it; 0: nothing. The challenge's own rules use none of that.
struct AotFlight {
  std::string name;
  double rate_hz = 0;
  int frames = 0;
  cv::Size size_px;
};

struct AotTruth {
  std::vector<AotFlight> flights;  // by rising name
  std::vector<AotObject> objects;  // by flight and frame
};

// groundtruth.json: {"samples": {FLIGHT: {"entities": [{"img_name", "blob": {"frame", "range_distance_m"}, "id", "bb",
// "labels": {"is_above_horizon"}}]}}}. Boxes ("bb": left, top, width, height) in pixels.
// Errors: cannot_read; bad_data with the entity's place: no samples, a field missing or of another type, a number that
// is not finite, a box without area.
[[nodiscard]] Result<AotTruth> read_aot_truth(const std::filesystem::path& path);

// One reported box.
struct AotReport {
  std::string image;
  AotBox box;
  double score = 0;
  int track = 0;  // a number of its own, below 0, where the file states none
};

// result.json: [{"img_name", "detections": [{"x", "y", "w", "h", "s", "track_id"}]}]; x and y are the middle. Errors as
// above.
[[nodiscard]] Result<std::vector<AotReport>> read_aot_reports(const std::filesystem::path& path);

}  // namespace sigs
