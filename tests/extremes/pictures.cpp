// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "export.h"
#include "extremes/sound.h"
#include "video/frame_source.h"
#include "video/video_writer.h"

namespace sigs::test {
namespace {

constexpr std::array<MethodChoice, 3> kMethods{MethodChoice::direct, MethodChoice::classic, MethodChoice::plain};

// A wall before the camera, 90 px wide and high.
void add_wall(Lot& lot) {
  add_plate(lot, 18, kEye_m + glm::dvec3(60, 0, 0));
}

Result<ExportReport> exported(const Lot& lot) {
  return export_project({.project = lot.project, .folder = lot.path("out")}, {});
}

// Own body everywhere in this shade.
void hide_behind(Lot& lot, uchar shade) {
  cv::imwrite(lot.path("own-body.png").string(), cv::Mat(lot.size_px(), CV_8UC1, cv::Scalar(shade)));
  lot.project.footage.own_body_mask = "own-body.png";
}

}  // namespace

TEST_CASE("pictures one pixel wide or high or both are composed in every layout by every method") {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(1, 48), cv::Size(64, 1), cv::Size(2, 3), cv::Size(3, 48)})
    for (const PixelLayout layout :
         {PixelLayout::gray, PixelLayout::yuv420, PixelLayout::yuv422, PixelLayout::yuv444, PixelLayout::rgb})
      for (const MethodChoice method : kMethods) {
        INFO(size.width << "x" << size.height << ", layout " << static_cast<int>(layout) << ", method "
                        << static_cast<int>(method));
        if (method != MethodChoice::direct && layout != PixelLayout::yuv420) continue;
        Lot lot(size);
        lot.project.compositing.method = method;
        add_wall(lot);
        const SoundFrame sound = sound_frame(lot.opened(), 1, grainy_frame(size, 1, layout));
        CHECK(cv::countNonZero(sound.composed.mask == 255) == size.area());
        CHECK(sound.composed.truth.intruders[0].box == cv::Rect({0, 0}, size));
      }
}

TEST_CASE("a picture one pixel wide takes a bent lens and any blur") {
  for (const double sigma_px : {0.0, 0.3, 5.0, 500.0}) {
    CAPTURE(sigma_px);
    Lot lot({1, 48});
    set_lens(lot, {40, 0, 0, 0, 40, 23.5, 0, 0, 1}, {-0.3, 0.1, 0.01, 0.01});
    add_aircraft(lot, kEye_m + glm::dvec3(60, 0, 0));
    lot.project.compositing.blur_px_per_m = sigma_px / 60;
    const SoundFrame sound = sound_frame(lot.opened(), 1, grainy_frame(lot.size_px(), 1));
    CHECK(sound.composed.truth.intruders[0].in_picture);
  }
}

TEST_CASE("footage one pixel wide is read and composed, and what cannot be written is said before anything is") {
  Lot lot({1, 48}, 1);
  cv::imwrite(lot.path("footage.png").string(), cv::Mat(lot.size_px(), CV_8UC3, cv::Scalar(40, 90, 150)));
  lot.project.footage.video = "footage.png";
  add_wall(lot);
  const Result<FrameSource> source = FrameSource::open(lot.path("footage.png"));
  if (!source) FAIL(source.error().text());
  CHECK(source->info().size_px == lot.size_px());
  const Result<ExportReport> report = exported(lot);
  REQUIRE(!report.has_value());
  CHECK(report.error().text().find("1x48") != std::string::npos);
  CHECK(!std::filesystem::exists(lot.path("out") / "lot.mkv"));
}

TEST_CASE("a picture of 8192 by 4320 is composed where the intruder is and nowhere else") {
  const cv::Size size(8192, 4320);
  Lot lot(size);
  set_lens(lot, {8000, 0, 4095.5, 0, 8000, 2159.5, 0, 0, 1}, {-0.1, 0.01, 0, 0});
  // Through r (1 + k1 r^2 + k2 r^4), near the lower right corner.
  const glm::dvec2 slope(0.45, 0.25);
  add_plate(lot, 6, kEye_m + 1000.0 * glm::dvec3(1, slope.x, slope.y));
  const SoundFrame sound = sound_frame(lot.opened(), 1, even_frame(size, 100));
  const double squared = dot(slope, slope);
  const glm::dvec2 pixel = glm::dvec2(4095.5, 2159.5) + 8000.0 * slope * (1 - 0.1 * squared + 0.01 * squared * squared);
  const IntruderTruth& truth = sound.composed.truth.intruders[0];
  REQUIRE(truth.silhouette);
  CHECK(truth.silhouette->x + truth.silhouette->width / 2 == doctest::Approx(pixel.x).epsilon(1e-4));
  CHECK(truth.silhouette->y + truth.silhouette->height / 2 == doctest::Approx(pixel.y).epsilon(1e-4));
  REQUIRE(truth.box);
  CHECK(truth.box->contains({static_cast<int>(pixel.x), static_cast<int>(pixel.y)}));
  CHECK(truth.box->area() < 50 * 50);
  CHECK(truth.visible_fraction == doctest::Approx(1).epsilon(0.01));
  const cv::Rect touched = box_of(sound.composed.mask);
  CHECK((touched & cv::Rect(truth.box->x - 3, truth.box->y - 3, truth.box->width + 6, truth.box->height + 6)) ==
        touched);
}

TEST_CASE("footage of 8192 by 4320 goes through a whole export") {
  const cv::Size size(8192, 4320);
  Lot lot(size, 1);
  Result<VideoWriter> writer =
      VideoWriter::open(lot.path("footage.mkv"), {.codec = VideoCodec::mjpeg, .size_px = size});
  REQUIRE(writer.has_value());
  const Frame background = even_frame(size, 100);
  REQUIRE(writer->write(background, 0).has_value());
  REQUIRE(writer->finish().has_value());
  add_plate(lot, 6, kEye_m + glm::dvec3(30, 0, 0));
  lot.project.output = {.codec = CodecChoice::mjpeg, .masks = MasksChoice::none};
  const Result<ExportReport> report = exported(lot);
  if (!report) FAIL(report.error().text());
  CHECK(report->frames == 1);
  Result<FrameSource> written = FrameSource::open(lot.path("out") / "lot.avi");
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
      Lot lot;
      lot.project.compositing = {.method = method, .blur_px_per_m = blur_px_per_m};
      add_aircraft(lot, kEye_m + glm::dvec3(60, 0, 0));
      const Frame background = grainy_frame(lot.size_px(), 1);
      const SoundFrame open = sound_frame(lot.opened(), 1, background);
      hide_behind(lot, 0);
      const SoundFrame black = sound_frame(lot.opened(), 1, background);
      hide_behind(lot, 255);
      const SoundFrame white = sound_frame(lot.opened(), 1, background);
      CHECK(same_planes(black.composed.picture, open.composed.picture));
      CHECK(black.composed.truth.intruders[0].visible_fraction == open.composed.truth.intruders[0].visible_fraction);
      CHECK(same_planes(white.composed.picture, background));
      const IntruderTruth& hidden = white.composed.truth.intruders[0];
      CHECK(hidden.in_picture);
      CHECK(hidden.visible_fraction == 0);
      CHECK(!hidden.box);
    }
}

}  // namespace sigs::test
