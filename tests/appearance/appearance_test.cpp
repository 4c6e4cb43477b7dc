// SPDX-License-Identifier: MIT
#include "appearance/appearance.h"

#include <doctest/doctest.h>

#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "appearance/slanted_target.h"
#include "project/json.h"
#include "support/test_data.h"
#include "video/video_writer.h"

using namespace sigs;
using namespace sigs::test;

namespace {

// A lossless clip of these frames.
std::filesystem::path clip_of(const TemporaryFolder& folder, const std::vector<Frame>& frames) {
  const std::filesystem::path path = folder / "clip.mkv";
  Result<VideoWriter> writer =
      VideoWriter::open(path, {.size_px = frames[0].size_px(), .layout = frames[0].layout, .color = frames[0].color});
  REQUIRE(writer);
  for (int n = 0; n < std::ssize(frames); ++n) {
    Frame frame = frames[n];
    frame.time_s = n / 25.0;
    REQUIRE(writer->write(frame, n));
  }
  REQUIRE(writer->finish());
  return path;
}

Appearance appearance_of(const std::vector<Frame>& frames) {
  const TemporaryFolder folder;
  Result<FrameSource> footage = FrameSource::open(clip_of(folder, frames));
  REQUIRE(footage);
  Result<Appearance> found = estimate_appearance(*footage, {}, {}, {});
  REQUIRE(found);
  return *found;
}

Frame even_frame(PixelLayout layout, int code) {
  Frame frame = blank_frame(layout, {320, 240}, {});
  frame.planes[0].setTo(code);
  for (int plane = 1; plane < frame.plane_count(); ++plane) frame.planes[plane].setTo(128);
  return frame;
}

void add_noise_to(Frame& frame, double sd, int seed) {
  cv::Mat noise(frame.size_px(), CV_16SC1);
  cv::RNG(static_cast<std::uint64_t>(seed)).fill(noise, cv::RNG::NORMAL, 0, sd);
  cv::Mat sum;
  frame.planes[0].convertTo(sum, CV_16S);
  sum += noise;
  sum.convertTo(frame.planes[0], CV_8U);
}

// Turned squares, drawn without any blur, as a program draws them.
Frame drawing() {
  Frame frame = even_frame(PixelLayout::yuv420, 60);
  for (int i = 0; i < 6; ++i) {
    cv::Point2f corners[4];
    cv::RotatedRect({55.0F + 105 * static_cast<float>(i % 3), 65.0F + 110 * static_cast<float>(i / 3)}, {60, 60},
                    7.0F + 5 * static_cast<float>(i))
        .points(corners);
    std::vector<cv::Point> polygon(corners, corners + 4);
    cv::fillConvexPoly(frame.planes[0], polygon, 180);
  }
  return frame;
}

// A window of text on a plain page, as a screen shows it: every edge goes from one colour to the other at once. It
// stands still, and then the page moves by a line.
Frame screen(int shift_px) {
  Frame frame = even_frame(PixelLayout::yuv420, 225);
  frame.planes[0].rowRange(0, 24).setTo(60);
  for (int line = 0; line < 12; ++line)
    cv::putText(frame.planes[0], "the quick brown fox jumps", {8, 44 + 16 * line - shift_px}, cv::FONT_HERSHEY_PLAIN,
                1.1, cv::Scalar(25), 1, cv::LINE_8);
  return frame;
}

// Land of soft patches under an even sky, seen by a camera that does not move, without noise.
Frame still_land() {
  Frame frame = even_frame(PixelLayout::yuv420, 150);
  cv::Mat land(120, 320, CV_8UC1);
  cv::RNG(11).fill(land, cv::RNG::UNIFORM, 40, 140);
  cv::GaussianBlur(land, land, {}, 3);
  land.copyTo(frame.planes[0].rowRange(120, 240));
  return frame;
}

// Every estimate is finite; what is not known has a reason, what is known has none.
void check_form(const Appearance& found) {
  for (const AppearanceQuantity& quantity : quantities_of(found)) {
    CAPTURE(quantity.name);
    CHECK(std::isfinite(quantity.estimate.value));
    CHECK(std::isfinite(quantity.estimate.sd));
    CHECK(quantity.estimate.sd >= 0);
    CHECK(quantity.estimate.is_known == quantity.estimate.why.empty());
  }
  for (const Panel& panel : panels_of(found)) CHECK_FALSE(panel.title.empty());
}

}  // namespace

TEST_CASE("of footage with nothing to measure on each quantity says why it is not known") {
  Frame noisy_sky = even_frame(PixelLayout::yuv420, 150);
  Frame next_sky = noisy_sky;
  next_sky.planes[0] = noisy_sky.planes[0].clone();
  add_noise_to(noisy_sky, 2, 1);
  add_noise_to(next_sky, 2, 2);
  const struct {
    const char* name;
    std::vector<Frame> frames;
    bool noise_is_known;
  } kCases[] = {{"blank sky", {even_frame(PixelLayout::yuv420, 150), even_frame(PixelLayout::yuv420, 150)}, false},
                {"over-exposed", {even_frame(PixelLayout::yuv420, 235), even_frame(PixelLayout::yuv420, 235)}, false},
                {"black", {even_frame(PixelLayout::yuv420, 16)}, false},
                {"gray", {even_frame(PixelLayout::gray, 90), even_frame(PixelLayout::gray, 90)}, false},
                {"rgb", {even_frame(PixelLayout::rgb, 90)}, false},
                {"drawing", {drawing(), drawing()}, false},
                {"screen", {screen(0), screen(0), screen(16)}, false},
                {"still camera", {still_land(), still_land(), still_land()}, false},
                {"noisy sky", {noisy_sky, next_sky}, true}};
  for (const auto& one : kCases) {
    CAPTURE(one.name);
    const Appearance found = appearance_of(one.frames);
    check_form(found);
    CHECK_FALSE(found.point_spread.sigma_px.is_known);
    CHECK(found.point_spread.sigma_px.value == kDefaultPointSpread_px);
    CHECK_FALSE(found.point_spread.sharpening.is_known);
    CHECK(found.point_spread.sharpening.value == kDefaultSharpening);
    CHECK_FALSE(found.point_spread.chroma_blur_px.is_known);
    CHECK(found.noise.sd_dark.is_known == one.noise_is_known);
    CHECK(found.noise.temporal_correlation.is_known == one.noise_is_known);
  }
}

TEST_CASE("an over-exposed sky gives no light, no white and no haze, and the settings keep standard values") {
  const Appearance found = appearance_of(std::vector<Frame>(3, even_frame(PixelLayout::yuv420, 235)));
  const SurroundingsEstimate& around = found.surroundings;
  CHECK_FALSE(around.tone.white.is_known);
  CHECK(around.tone.white.why.find("over-exposed") != std::string::npos);
  CHECK_FALSE(around.light.sky_color[0].is_known);
  CHECK(around.light.exposure.why.find("over-exposed") != std::string::npos);
  CHECK_FALSE(around.haze.visibility_m.is_known);
  CHECK_FALSE(around.sun.azimuth_rad.is_known);
  CHECK(found.noise.sd_dark.why.find("clipped") != std::string::npos);
  Project project;
  const Project before = project;
  apply(found, project);
  CHECK(project.light == before.light);  // it stays where nothing is known
  CHECK(project.appearance.haze == before.appearance.haze);
  CHECK(project.appearance.grain.sd_dark == 0);
  CHECK(project.appearance.psf_sigma_px == kDefaultPointSpread_px);
}

TEST_CASE("of a camera that stands still lasting noise cannot be told from texture, which is said") {
  std::vector<Frame> frames;
  cv::Mat grain(240, 320, CV_16SC1);
  cv::RNG(5).fill(grain, cv::RNG::NORMAL, 0, 2);  // the same in each frame, as of a sensor's pattern
  for (int n = 0; n < 4; ++n) {
    Frame frame = still_land();
    cv::Mat sum;
    frame.planes[0].convertTo(sum, CV_16S);
    sum += grain;
    sum.convertTo(frame.planes[0], CV_8U);
    cv::rectangle(frame.planes[0], {20, 150, 120, 60}, 45, cv::FILLED);  // strong, and where it was
    cv::rectangle(frame.planes[0], {60, 170, 40, 20}, 200, 2);
    frames.push_back(frame);
  }
  const Appearance found = appearance_of(frames);
  check_form(found);
  CHECK_FALSE(found.noise.temporal_correlation.is_known);
  CHECK(found.noise.temporal_correlation.value == 0);
  CHECK_FALSE(found.point_spread.sigma_px.is_known);
}

TEST_CASE("frames that are too small for any estimate are no error") {
  for (const cv::Size size : {cv::Size(4, 4), cv::Size(7, 40), cv::Size(33, 17)}) {
    Frame frame = blank_frame(PixelLayout::yuv444, size, {});
    cv::RNG(4).fill(frame.planes[0], cv::RNG::UNIFORM, 0, 256);
    check_form(appearance_of({frame, frame, frame}));
  }
}

TEST_CASE("a target seen through a camera sets the project's appearance") {
  std::vector<Frame> frames;
  for (int n = 0; n < 4; ++n)
    frames.push_back(
        slanted_target({.sigma_px = 0.9, .noise = 1.5, .chroma_sigma = 1.1, .turn_deg = 1.3 * n, .seed = n}));
  const Appearance found = appearance_of(frames);
  check_form(found);
  CHECK(found.frames_used == 3);  // each with the frame after it
  Project project;
  project.compositing.blur_px_per_m = 0.002;
  project.appearance.grain.seed = 7;
  apply(found, project);
  CHECK(std::abs(project.appearance.psf_sigma_px - 0.9) < 0.03 * 0.9);
  CHECK(project.appearance.sharpening == 0);
  CHECK(std::abs(project.appearance.chroma_blur_px - 1.1) < 0.17);
  CHECK(std::abs(project.appearance.grain.sd_dark - 1.5) < 0.15);
  CHECK(project.appearance.grain.seed == 7);
  CHECK(project.compositing.blur_px_per_m == 0);
  CHECK(project.appearance.codec.match == CodecMatchChoice::none);  // FFV1 takes nothing away
  for (const std::string& key : applied_settings(found)) {
    CAPTURE(key);
    const std::string last = key.substr(key.rfind('.') + 1);
    CHECK(text_of(project).find("\"" + last + "\"") != std::string::npos);
  }
}

TEST_CASE("frames that the footage does not have are refused, and any others are used") {
  const TemporaryFolder folder;
  Result<FrameSource> footage =
      FrameSource::open(clip_of(folder, std::vector<Frame>(5, even_frame(PixelLayout::yuv420, 100))));
  REQUIRE(footage);
  CHECK(estimate_appearance(*footage, {.first = 5}, {}, {}).error().kind == ErrorKind::usage);
  CHECK(estimate_appearance(*footage, {.first = 3, .last = 2}, {}, {}).error().kind == ErrorKind::usage);
  CHECK(estimate_appearance(*footage, {.first = 4}, {}, {})->frames_used == 1);
  CHECK(estimate_appearance(*footage, {.every = 2}, {}, {})->frames_used == 3);
  CHECK(estimate_appearance(*footage, {.first = 1, .last = 100, .every = 1000000}, {}, {})->frames_used == 1);
}

TEST_CASE("the page of plots has two panels to a row, also without a point to draw") {
  const Panel empty{.title = "nothing", .remark = "not known: blank sky"};
  const Panel one{.title = "one", .series = {{"a", {1}, {2}}, {"b", {1, 2, NAN}, {1e300, 3, INFINITY}, true}}};
  CHECK(panel_page({}).empty());
  const cv::Mat page = panel_page(std::vector<Panel>{empty, one, one});
  CHECK(page.size() == cv::Size(1200, 720));
  CHECK(cv::countNonZero(page.reshape(1) != 255) > 1000);
}
