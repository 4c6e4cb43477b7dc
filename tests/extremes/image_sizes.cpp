// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "export/export_project.h"
#include "extremes/validity.h"
#include "video/frame_source.h"
#include "video/video_writer.h"

namespace sigs::test {
namespace {

constexpr std::array<MethodChoice, 3> kMethods{MethodChoice::direct, MethodChoice::classic, MethodChoice::plain};

// A wall before the camera, 90 px wide and high.
void add_wall(Scenario& scenario) {
  add_plate(scenario, 18, kEye_m + glm::dvec3(60, 0, 0));
}

Result<ExportReport> exported(const Scenario& scenario) {
  return export_project({.project = scenario.project, .folder = scenario.path("out")}, {});
}

// Own body everywhere in this shade.
void hide_behind(Scenario& scenario, uchar shade) {
  cv::imwrite(scenario.path("own-body.png").string(), cv::Mat(scenario.size_px(), CV_8UC1, cv::Scalar(shade)));
  scenario.project.footage.own_body_mask = "own-body.png";
}

}  // namespace

TEST_CASE("images one pixel wide or high or both are composed in every layout by every method") {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(1, 48), cv::Size(64, 1), cv::Size(2, 3), cv::Size(3, 48)})
    for (const PixelLayout layout :
         {PixelLayout::gray, PixelLayout::yuv420, PixelLayout::yuv422, PixelLayout::yuv444, PixelLayout::rgb})
      for (const MethodChoice method : kMethods) {
        INFO(size.width << "x" << size.height << ", layout " << static_cast<int>(layout) << ", method "
                        << static_cast<int>(method));
        if (method != MethodChoice::direct && layout != PixelLayout::yuv420) continue;
        Scenario scenario(size);
        scenario.project.compositing.method = method;
        add_wall(scenario);
        const ValidFrame valid = valid_frame(scenario.opened(), 1, grainy_frame(size, 1, layout));
        CHECK(cv::countNonZero(valid.composed.mask == 255) == size.area());
        CHECK(valid.composed.truth.intruders[0].visible_box == cv::Rect({0, 0}, size));
      }
}

TEST_CASE("an image one pixel wide takes a warped lens and any blur") {
  for (const double sigma_px : {0.0, 0.3, 5.0, 500.0}) {
    CAPTURE(sigma_px);
    Scenario scenario({1, 48});
    set_lens(scenario, {40, 0, 0, 0, 40, 23.5, 0, 0, 1}, {-0.3, 0.1, 0.01, 0.01});
    add_aircraft(scenario, kEye_m + glm::dvec3(60, 0, 0));
    scenario.project.compositing.blur_px_per_m = sigma_px / 60;
    const ValidFrame valid = valid_frame(scenario.opened(), 1, grainy_frame(scenario.size_px(), 1));
    CHECK(valid.composed.truth.intruders[0].in_image);
  }
}

TEST_CASE("footage one pixel wide is read and composed, and what cannot be written is said before anything is") {
  Scenario scenario({1, 48}, 1);
  cv::imwrite(scenario.path("footage.png").string(), cv::Mat(scenario.size_px(), CV_8UC3, cv::Scalar(40, 90, 150)));
  scenario.project.footage.video = "footage.png";
  add_wall(scenario);
  const Result<FrameSource> source = FrameSource::open(scenario.path("footage.png"));
  if (!source) FAIL(source.error().text());
  CHECK(source->info().size_px == scenario.size_px());
  const Result<ExportReport> report = exported(scenario);
  REQUIRE(!report.has_value());
  CHECK(report.error().text().find("1x48") != std::string::npos);
  CHECK(!std::filesystem::exists(scenario.path("out") / "lot.mkv"));
}

TEST_CASE("an image of 8192 by 4320 is composed where the intruder is and nowhere else") {
  const cv::Size size(8192, 4320);
  Scenario scenario(size);
  set_lens(scenario, {8000, 0, 4095.5, 0, 8000, 2159.5, 0, 0, 1}, {-0.1, 0.01, 0, 0});
  // Through r (1 + k1 r^2 + k2 r^4), near the lower right corner.
  const glm::dvec2 slope(0.45, 0.25);
  add_plate(scenario, 6, kEye_m + 1000.0 * glm::dvec3(1, slope.x, slope.y));
  const ValidFrame valid = valid_frame(scenario.opened(), 1, even_frame(size, 100));
  const double squared = dot(slope, slope);
  const glm::dvec2 pixel = glm::dvec2(4095.5, 2159.5) + 8000.0 * slope * (1 - 0.1 * squared + 0.01 * squared * squared);
  const IntruderTruth& truth = valid.composed.truth.intruders[0];
  REQUIRE(truth.amodal_box);
  CHECK(truth.amodal_box->x + truth.amodal_box->width / 2 == doctest::Approx(pixel.x).epsilon(1e-4));
  CHECK(truth.amodal_box->y + truth.amodal_box->height / 2 == doctest::Approx(pixel.y).epsilon(1e-4));
  REQUIRE(truth.visible_box);
  CHECK(truth.visible_box->contains({static_cast<int>(pixel.x), static_cast<int>(pixel.y)}));
  CHECK(truth.visible_box->area() < 50 * 50);
  CHECK(truth.visible_fraction == doctest::Approx(1).epsilon(0.01));
  const cv::Rect touched = box_of(valid.composed.mask);
  CHECK((touched & cv::Rect(truth.visible_box->x - 3, truth.visible_box->y - 3, truth.visible_box->width + 6,
                            truth.visible_box->height + 6)) == touched);
}

TEST_CASE("footage of 8192 by 4320 goes through a whole export") {
  const cv::Size size(8192, 4320);
  Scenario scenario(size, 1);
  Result<VideoWriter> writer =
      VideoWriter::open(scenario.path("footage.mkv"), {.codec = VideoCodec::mjpeg, .size_px = size});
  REQUIRE(writer.has_value());
  const Frame background = even_frame(size, 100);
  REQUIRE(writer->write(background, 0).has_value());
  REQUIRE(writer->finish().has_value());
  add_plate(scenario, 6, kEye_m + glm::dvec3(30, 0, 0));
  scenario.project.output = {.codec = VideoCodec::mjpeg, .masks = MasksChoice::none};
  const Result<ExportReport> report = exported(scenario);
  if (!report) FAIL(report.error().text());
  CHECK(report->frames == 1);
  Result<FrameSource> written = FrameSource::open(scenario.path("out") / "lot.avi");
  REQUIRE(written.has_value());
  CHECK(written->info().size_px == size);
  const Result<Frame> frame = written->read(0);
  REQUIRE(frame.has_value());
  cv::Mat changed;
  cv::compare(frame->planes[0], 110, changed, cv::CMP_GT);  // JPEG's own ripples around the plate are smaller
  CHECK(box_of(changed).width == doctest::Approx(60).epsilon(0.05));
  CHECK(box_of(changed).height == doctest::Approx(60).epsilon(0.05));
}

TEST_CASE("an own body nowhere hides nothing and one everywhere hides all, bit for bit") {
  for (const MethodChoice method : kMethods)
    for (const double blur_px_per_m : {0.0, 0.05, 5.0}) {
      INFO("method " << static_cast<int>(method) << ", blur " << blur_px_per_m);
      Scenario scenario;
      scenario.project.compositing = {.method = method, .blur_px_per_m = blur_px_per_m};
      add_aircraft(scenario, kEye_m + glm::dvec3(60, 0, 0));
      const Frame background = grainy_frame(scenario.size_px(), 1);
      const ValidFrame open = valid_frame(scenario.opened(), 1, background);
      hide_behind(scenario, 0);
      const ValidFrame black = valid_frame(scenario.opened(), 1, background);
      hide_behind(scenario, 255);
      const ValidFrame white = valid_frame(scenario.opened(), 1, background);
      CHECK(same_planes(black.composed.image, open.composed.image));
      CHECK(black.composed.truth.intruders[0].visible_fraction == open.composed.truth.intruders[0].visible_fraction);
      CHECK(same_planes(white.composed.image, background));
      const IntruderTruth& hidden = white.composed.truth.intruders[0];
      CHECK(hidden.in_image);
      CHECK(hidden.visible_fraction == 0);
      CHECK(!hidden.visible_box);
    }
}

}  // namespace sigs::test
