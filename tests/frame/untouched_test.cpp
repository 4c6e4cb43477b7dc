// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "export/export_project.h"
#include "export/raw_video.h"
#include "frame/synthetic_scenes.h"

namespace sigs::test {
namespace {

constexpr int kUntouchedFrames = 31;  // 0 to 30

struct Exported {
  ExportReport report;
  RawVideo source;
  RawVideo image;
  RawVideo masks;
};

Exported exported(Scenario& scenario, const std::filesystem::path& clip, MethodChoice method) {
  scenario.project.footage.video = clip.string();
  scenario.project.compositing.method = method;
  scenario.project.output = {.codec = VideoCodec::ffv1, .masks = MasksChoice::video};
  const ExportRequest request{.project = scenario.project,
                              .folder = scenario.path("out"),
                              .frames = FrameRange{0, kUntouchedFrames - 1},
                              .jobs = 2,
                              .overwrite = true};
  const Result<ExportReport> report = export_project(request, {});
  if (!report) FAIL(report.error().text());
  return {*report, raw_video(clip, kUntouchedFrames), raw_video(scenario.path("out/lot.mkv"), kUntouchedFrames),
          raw_video(scenario.path("out/lot.masks.mkv"), kUntouchedFrames)};
}

struct Count {
  long long changed_outside = 0;  // where no mask is
  long long changed_inside = 0;
  long long kept_luma = 0;
  long long kept_chroma = 0;
};

// A luma sample is free where its pixel's mask is 0; a chroma sample where those of all pixels are that it averages: of
// 4:2:0 at the left, three columns and two rows.
bool is_free(const cv::Mat& mask, int x, int y, int step) {
  for (int j = y * step; j < std::min((y + 1) * step, mask.rows); ++j)
    for (int i = std::max(x * step - (step - 1), 0); i < std::min((x + 1) * step, mask.cols); ++i)
      if (mask.at<uchar>(j, i) != 0) return false;
  return true;
}

void count_plane(const cv::Mat& before, const cv::Mat& after, const cv::Mat& mask, int step, Count& count) {
  REQUIRE(before.size() == after.size());
  for (int y = 0; y < before.rows; ++y) {
    if (cv::countNonZero(mask.rowRange(y * step, std::min((y + 1) * step, mask.rows))) == 0) {  // all of it is free
      const int changed = cv::countNonZero(before.row(y) != after.row(y));
      count.changed_outside += changed;
      (step == 1 ? count.kept_luma : count.kept_chroma) += before.cols - changed;
      continue;
    }
    for (int x = 0; x < before.cols; ++x) {
      const bool same = before.at<uchar>(y, x) == after.at<uchar>(y, x);
      if (!is_free(mask, x, y, step))
        count.changed_inside += same ? 0 : 1;
      else if (!same)
        ++count.changed_outside;
      else
        ++(step == 1 ? count.kept_luma : count.kept_chroma);
    }
  }
}

Count count_of(const Exported& clip) {
  Count count;
  REQUIRE(clip.source.images.size() == kUntouchedFrames);
  REQUIRE(clip.image.images.size() == kUntouchedFrames);
  REQUIRE(clip.masks.images.size() == kUntouchedFrames);
  for (std::size_t n = 0; n < kUntouchedFrames; ++n) {
    REQUIRE(clip.source.images[n].planes.size() == 3);
    REQUIRE(clip.image.images[n].planes.size() == 3);
    for (std::size_t plane = 0; plane < 3; ++plane)
      count_plane(clip.source.images[n].planes[plane], clip.image.images[n].planes[plane],
                  clip.masks.images[n].planes[0], plane == 0 ? 1 : 2, count);
  }
  return count;
}

void check_tags(const Exported& clip) {
  CHECK(clip.image.is_full_range == clip.source.is_full_range);
  CHECK(clip.image.matrix == clip.source.matrix);
  CHECK(clip.image.primaries == clip.source.primaries);
  CHECK(clip.image.transfer == clip.source.transfer);
}

// Matroska counts in milliseconds.
void check_times(const Exported& clip) {
  const double begin_s = clip.source.images.front().time_s - clip.image.images.front().time_s;
  for (std::size_t n = 0; n < clip.source.images.size(); ++n)
    CHECK(std::abs(clip.source.images[n].time_s - begin_s - clip.image.images[n].time_s) < 0.0011);
}

// An aircraft that crosses the image, blurred with distance.
void fly_across(Scenario& scenario) {
  write_obj(scenario.path("aircraft.obj"), aircraft(), 1);
  scenario.project.compositing.blur_px_per_m = kPaperBlur_px_per_m * 10;  // 1.6 px at 80 m
  IntruderSettings& intruder = scenario.add("aircraft.obj", {});
  intruder.trajectory.waypoints = {{.frame = 0, .position_m = {70, -45, -160}},
                                   {.frame = 15, .position_m = {80, 0, -148}},
                                   {.frame = 30, .position_m = {90, 70, -150}}};
}

struct Clip {
  const char* file;
  cv::Size size_px;
  MethodChoice method;
};
const Clip kClips[] = {{"video/air_karma_gopro_coast.mp4", {854, 480}, MethodChoice::direct},
                       {"video/ground_udacity_road_540p.mp4", {960, 540}, MethodChoice::direct},
                       {"video/air_karma_gopro_coast.mp4", {854, 480}, MethodChoice::classic},
                       {"video/ground_udacity_road_540p.mp4", {960, 540}, MethodChoice::plain}};

// A lens that distorts, for images of the clip's size.
void distort(Scenario& scenario, cv::Size size_px) {
  write_calibration(scenario.path("lens.xml"),
                    {450, 0, size_px.width / 2.0 + 3, 0, 452, size_px.height / 2.0 - 5, 0, 0, 1},
                    {-0.12, 0.02, 0.0005, -0.001, 0}, size_px);
  scenario.project.footage.calibration = "lens.xml";
}

}  // namespace

TEST_CASE("samples of a real clip that no intruder covers are kept bit for bit") {
  if (!has_real_data()) return;
  for (const Clip& clip : kClips) {
    CAPTURE(clip.file);
    CAPTURE(static_cast<int>(clip.method));
    Scenario scenario(clip.size_px);
    distort(scenario, clip.size_px);
    fly_across(scenario);
    const Exported result = exported(scenario, real_data() / clip.file, clip.method);
    const Count count = count_of(result);
    CHECK(count.changed_outside == 0);
    CHECK(count.changed_inside > 1000);
    CHECK(count.kept_luma > 0.8 * kUntouchedFrames * clip.size_px.area());
    CHECK(count.kept_chroma > 0.8 * kUntouchedFrames * clip.size_px.area() / 2);
    CHECK(!result.report.renderer_description.empty());
    check_tags(result);
    check_times(result);
  }
}

TEST_CASE("a real clip that no intruder enters is kept bit for bit and nothing is rendered") {
  if (!has_real_data()) return;
  for (const Clip& clip : kClips) {
    CAPTURE(clip.file);
    CAPTURE(static_cast<int>(clip.method));
    Scenario scenario(clip.size_px);
    distort(scenario, clip.size_px);
    write_obj(scenario.path("aircraft.obj"), aircraft(), 1);
    scenario.add("aircraft.obj", {-300, 20, -140});  // behind the camera
    scenario.add("aircraft.obj", {100, 900, -150});  // far to the right of the image
    const Exported result = exported(scenario, real_data() / clip.file, clip.method);
    const Count count = count_of(result);
    CHECK(count.changed_outside == 0);
    CHECK(count.changed_inside == 0);
    CHECK(count.kept_luma == static_cast<long long>(kUntouchedFrames) * clip.size_px.area());
    CHECK(result.report.renderer_description == "");
    check_tags(result);
  }
}

}  // namespace sigs::test
