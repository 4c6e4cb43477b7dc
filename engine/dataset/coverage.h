// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "base/result.h"
#include "dataset/plan.h"
#include "truth/annotation.h"

namespace sigs {

// What a dataset covers: how many sights (one body in one frame, of which some can be seen) lie in which range of
// distances, sizes and bearings, and on which side of the horizon. Predicted from a plan before a frame is made, or
// counted from the labels of a dataset. Contrast is not among it: it follows from the rendered images alone.

// What a body is before, as the frame shows it (VideoVisibility::behind); looked at for images alone.
enum class BeforeWhat { sky, land, both, unknown };
inline constexpr std::array kBeforeNames{"sky", "land", "both", "unknown"};

// One body in one frame.
struct Sight {
  std::string category;
  bool is_distractor = false;
  double range_m = 0;      // from the camera to the body's reference point
  double size_px = 0;      // longer side of the box of its whole silhouette
  double bearing_deg = 0;  // of the reference point, to the right of the optical axis, in the camera's axes; -180..180
  HorizonSide horizon = HorizonSide::unknown;
  BeforeWhat before = BeforeWhat::unknown;
  int cell = 4;  // of kCellNames: third of the image's width and height with the middle of the silhouette's box
};

// The thirds of the image, row by row. A box whose middle lies outside the image counts in the nearest.
inline constexpr std::array kCellNames{"top left",     "top centre",  "top right",     "middle left", "centre",
                                       "middle right", "bottom left", "bottom centre", "bottom right"};
[[nodiscard]] int cell_of(double x_px, double y_px, cv::Size image_px);

// Limits between the bins of a quantity. Bin 0 is below the first limit, bin i from limit i - 1 (included) to limit i.
inline constexpr std::array kRangeLimits_m{50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0, 5000.0};
inline constexpr std::array kSizeLimits_px{4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0};
inline constexpr std::array kBearingLimits_deg{-60.0, -45.0, -30.0, -15.0, 0.0, 15.0, 30.0, 45.0, 60.0};

// Numbers of sights, in all and by bin.
struct CoverageCounts {
  long long sights = 0;
  std::vector<long long> range = std::vector<long long>(kRangeLimits_m.size() + 1);
  std::vector<long long> size = std::vector<long long>(kSizeLimits_px.size() + 1);
  std::vector<long long> bearing = std::vector<long long>(kBearingLimits_deg.size() + 1);
  std::vector<long long> cell = std::vector<long long>(kCellNames.size());
  std::array<long long, 4> horizon{};  // by HorizonSide: below, on, above, unknown
  std::vector<long long> before = std::vector<long long>(kBeforeNames.size());

  void add(const Sight& sight);
  [[nodiscard]] bool operator==(const CoverageCounts&) const = default;
};

struct Coverage {
  int videos = 0;
  int unopened = 0;  // further videos, of which a file cannot be opened; nothing is known of them
  long long frames = 0;
  CoverageCounts intruders;
  CoverageCounts distractors;
  std::map<std::string, long long> categories;  // sights of each

  void add(const Sight& sight);
  [[nodiscard]] bool operator==(const Coverage&) const = default;
};

// Of planned videos, all frames of each, without rendering (VisibilityEstimator of scene/visibility.h). Sizes are
// within 1 % of the labels'; which frames show a body is estimated where it is at the image's edge, behind the own body
// or other bodies, or smaller than a pixel. Error: interrupted.
[[nodiscard]] Result<Coverage> predicted_coverage(const std::vector<const PlannedVideo*>& videos,
                                                  const std::atomic<bool>* cancel = nullptr);

// Of a dataset that has been made, from the annotation files NAME/NAME.xml of the videos in its index. Bodies with a
// visible box count. Errors: cannot_read; bad_data that names the file: no index, no annotations (export.labels
// without xml), a file with other contents.
[[nodiscard]] Result<Coverage> counted_coverage(const std::filesystem::path& folder,
                                                const std::atomic<bool>* cancel = nullptr);

// As a table for people, as JSON for programs, and as a plot (BGR, 8 bits): five histograms of intruders and
// distractors.
//   title  "predicted", "counted from the labels"
[[nodiscard]] std::string coverage_text(const Coverage& coverage, const std::string& title);
[[nodiscard]] std::string coverage_json(const Coverage& coverage, const std::string& title);
[[nodiscard]] cv::Mat coverage_plot(const Coverage& coverage, const std::string& title);

}  // namespace sigs
