// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <pugixml.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "base/text.h"
#include "export/export_project.h"
#include "export/raw_video.h"
#include "frame/synthetic_scenes.h"
#include "support/files.h"
#include "video/video_writer.h"

// How well an intruder stands out, as the labels say it, against arithmetic on the exported video and the footage. The
// formulas are those of docs/annotation-format.md; nothing of engine/truth is called.
namespace sigs::test {
namespace {

// An even sky with noise and, 60 m ahead, a plate of 4 m x 2 m, lit by ambient light alone: 20 px x 10 px, edges on
// edges of pixels.
struct Sky {
  const char* name;
  int code = 150;       // of luma
  double noise_sd = 0;  // codes
  double paint = 0.25;  // of the plate, 0..1 as displayed
  PixelLayout layout = PixelLayout::yuv420;
  ColorInfo color = {.matrix_stated = true, .range_stated = true};
  AppearanceSettings look{.psf_sigma_px = 0};
  int first_row_of_body = 240;  // the own body covers the rows from here on
};

constexpr int kSkyFrames = 3;
const cv::Size kSkySize(320, 240);
const cv::Rect kPlate(150, 115, 20, 10);
constexpr double kGamma22 = 4;  // ISO/IEC 23091-2

struct Contrasts {
  double weber = 0, rms = 0, signal_to_noise = 0;
};

void write_sky(const Sky& sky, const std::filesystem::path& path) {
  Result<VideoWriter> writer = VideoWriter::open(
      path, {.codec = VideoCodec::ffv1, .size_px = kSkySize, .layout = sky.layout, .color = sky.color});
  REQUIRE(writer.has_value());
  cv::RNG random(71);
  for (int n = 0; n < kSkyFrames; ++n) {
    Frame frame = even_frame(kSkySize, 0, sky.layout);
    frame.color = sky.color;
    frame.time_s = n / 25.0;
    for (int y = 0; y < kSkySize.height; ++y)
      for (int x = 0; x < kSkySize.width; ++x)
        frame.planes[0].at<uchar>(y, x) = cv::saturate_cast<uchar>(sky.code + random.gaussian(sky.noise_sd));
    REQUIRE(writer->write(frame, n).has_value());
  }
  REQUIRE(writer->finish().has_value());
}

cv::Mat body_of(const Sky& sky) {
  cv::Mat body = cv::Mat::zeros(kSkySize, CV_8UC1);
  body.rowRange(sky.first_row_of_body, kSkySize.height).setTo(255);
  return body;
}

// The plate before the sky, exported.
struct Shot {
  Scenario scenario{kSkySize, kSkyFrames};
  RawVideo footage, image, masks;

  explicit Shot(const Sky& sky) {
    write_sky(sky, scenario.path("footage.mkv"));
    write_obj(scenario.path("plate.obj"), {{{0, -2, -1}, {0.1, 2, 1}, glm::dvec3(sky.paint)}}, 1);
    scenario.add("plate.obj", {60, 0, -150});
    scenario.project.light.ambient = 1;
    scenario.project.appearance = sky.look;
    scenario.project.output = {.codec = VideoCodec::ffv1, .masks = MasksChoice::video, .labels = {"xml", "csv"}};
    if (sky.first_row_of_body < kSkySize.height) {
      cv::imwrite(scenario.path("body.png").string(), body_of(sky));
      scenario.project.footage.own_body_mask = "body.png";
    }
    const ExportRequest request{.project = scenario.project, .folder = scenario.path("out"), .jobs = 1};
    const Result<ExportReport> report = export_project(request, {});
    if (!report) FAIL(report.error().text());
    footage = raw_video(scenario.path("footage.mkv"), kSkyFrames);
    image = raw_video(scenario.path("out/lot.mkv"), kSkyFrames);
    masks = raw_video(scenario.path("out/lot.masks.mkv"), kSkyFrames);
    REQUIRE(image.images.size() == kSkyFrames);
  }
};

double light_of_gray(const Sky& sky, double code) {
  const bool is_full = sky.color.range == ColorRange::full;
  const double shown = std::max(is_full ? code / 255 : (code - 16) / 219, 0.0);
  if (sky.color.transfer == kGamma22) return std::pow(shown, 2.2);
  return shown <= 0.04045 ? shown / 12.92 : std::pow((shown + 0.055) / 1.055, 2.4);
}

struct Moments {
  double mean_code = 0, sd_code = 0, mean_light = 0, mean_square_light = 0;
};

// Over the pixels of a rectangle where `leave_out` is 0.
Moments moments_of(const Sky& sky, const cv::Mat& luma, const cv::Rect& rect, const cv::Mat& leave_out) {
  std::vector<double> codes;
  for (int y = rect.y; y < rect.y + rect.height; ++y)
    for (int x = rect.x; x < rect.x + rect.width; ++x)
      if (leave_out.at<uchar>(y, x) == 0) codes.push_back(luma.at<uchar>(y, x));
  const double count = static_cast<double>(codes.size());
  REQUIRE(count > 0);
  Moments moments;
  for (const double code : codes) {
    const double light = light_of_gray(sky, code);
    moments.mean_code += code / count;
    moments.mean_light += light / count;
    moments.mean_square_light += light * light / count;
  }
  for (const double code : codes) moments.sd_code += std::pow(code - moments.mean_code, 2) / count;
  moments.sd_code = std::sqrt(moments.sd_code);
  return moments;
}

// From the exported image's pixels of the plate and the footage's around it: half of 20 px on each side.
Contrasts contrasts_of(const Sky& sky, const Shot& shot, std::size_t frame, const cv::Rect& box) {
  constexpr int kMargin_px = 10;
  const cv::Rect around(box.x - kMargin_px, box.y - kMargin_px, box.width + 2 * kMargin_px,
                        box.height + 2 * kMargin_px);
  const cv::Mat body = body_of(sky);
  const Moments seen = moments_of(sky, shot.image.images[frame].planes[0], box, body);
  const Moments behind = moments_of(sky, shot.footage.images[frame].planes[0], around, body);
  const double light = behind.mean_light;
  return {(seen.mean_light - light) / light,
          std::sqrt(seen.mean_square_light - 2 * light * seen.mean_light + light * light) / light,
          std::abs(seen.mean_code - behind.mean_code) / std::max(behind.sd_code, std::sqrt(1.0 / 12))};
}

struct Labelled {
  cv::Rect box;
  int pixels = 0;
  Contrasts contrasts;
};

Labelled in_xml(const Shot& shot, std::size_t frame) {
  pugi::xml_document document;
  REQUIRE(document.load_file(shot.scenario.path("out/lot.xml").c_str()));
  const pugi::xml_node intruder =
      document.child("sigs").find_child_by_attribute("frame", "index", std::to_string(frame).c_str()).child("intruder");
  const pugi::xml_node box = intruder.child("box"), look = intruder.child("appearance");
  REQUIRE(box);
  REQUIRE(look);
  const auto number = [](const pugi::xml_node& node, const char* name) { return node.attribute(name).as_int(); };
  return {{number(box, "x"), number(box, "y"), number(box, "width"), number(box, "height")},
          number(box, "pixels"),
          {look.attribute("weber_contrast").as_double(), look.attribute("rms_contrast").as_double(),
           look.attribute("signal_to_noise").as_double()}};
}

Contrasts in_csv(const Shot& shot, std::size_t frame) {
  std::istringstream file(text_of(shot.scenario.path("out/lot.csv")));
  std::string header, row;
  std::getline(file, header);
  for (std::size_t n = 0; n <= frame; ++n) REQUIRE(std::getline(file, row));
  const std::vector<std::string_view> names = csv_fields(header), fields = csv_fields(row);
  const auto number = [&](std::string_view name) {
    const auto column = std::find(names.begin(), names.end(), name) - names.begin();
    REQUIRE(static_cast<std::size_t>(column) < fields.size());
    return std::stod(std::string(fields[static_cast<std::size_t>(column)]));
  };
  return {number("weber_contrast"), number("rms_contrast"), number("signal_to_noise")};
}

void check_same(const Contrasts& label, const Contrasts& truth) {
  CHECK(std::abs(label.weber - truth.weber) < 1e-5 * (1 + std::abs(truth.weber)));
  CHECK(std::abs(label.rms - truth.rms) < 1e-5 * (1 + truth.rms));
  CHECK(std::abs(label.signal_to_noise - truth.signal_to_noise) < 1e-5 * (1 + truth.signal_to_noise));
}

// The labels of all frames against their pixels. Gives back those of the last frame.
Labelled checked(const Sky& sky) {
  CAPTURE(sky.name);
  const Shot shot(sky);
  const cv::Rect shown = kPlate & cv::Rect(0, 0, kSkySize.width, sky.first_row_of_body);
  Labelled label;
  for (std::size_t n = 0; n < kSkyFrames; ++n) {
    label = in_xml(shot, n);
    CHECK(label.box == shown);
    CHECK(label.pixels == shown.area());
    CHECK(box_of(shot.masks.images[n].planes[0] > 127) == shown);
    check_same(label.contrasts, contrasts_of(sky, shot, n, shown));
    check_same(in_csv(shot, n), contrasts_of(sky, shot, n, shown));
  }
  return label;
}

// Everything that footage's look changes.
AppearanceSettings every_stage() {
  AppearanceSettings look{.psf_sigma_px = 0.7, .sharpening = 0.8};
  look.black = 0.02;
  look.chroma_blur_px = 1.2;
  look.haze.visibility_m = 400;
  look.grain = {.sd_dark = 2, .sd_bright = 3, .sd_chroma = 1, .correlation_length_px = 0.6};
  return look;
}

}  // namespace

TEST_CASE("contrast and signal to noise of the labels are those of the exported pixels") {
  const ColorInfo full{.range = ColorRange::full, .transfer = 4, .matrix_stated = true, .range_stated = true};
  checked({.name = "dark before a noisy sky", .noise_sd = 4});
  checked({.name = "brighter than its sky", .code = 60, .noise_sd = 2, .paint = 0.8});
  checked({.name = "full range, gamma 2.2", .noise_sd = 3, .layout = PixelLayout::yuv444, .color = full});
  checked({.name = "without colour", .noise_sd = 3, .layout = PixelLayout::gray});
  checked({.name = "half behind the own body", .noise_sd = 4, .first_row_of_body = 121});
  checked({.name = "with all stages of the footage's look", .noise_sd = 3, .look = every_stage()});
}

TEST_CASE("a plate of known paint before an even sky has the contrast of the two lights") {
  // 16 + 219 * 0.25 = 70.75, which is written as 71.
  const Sky sky{.name = "even"};
  const double plate = light_of_gray(sky, 71), behind = light_of_gray(sky, 150);
  const Contrasts found = checked(sky).contrasts;
  CHECK(found.weber == doctest::Approx((plate - behind) / behind).epsilon(1e-5));
  CHECK(found.rms == doctest::Approx((behind - plate) / behind).epsilon(1e-5));
  CHECK(found.signal_to_noise == doctest::Approx((150 - 71) * std::sqrt(12.0)).epsilon(1e-5));
}

TEST_CASE("noise of a known deviation divides the signal") {
  for (const double sd : {2.0, 4.0, 8.0}) {
    const Contrasts found = checked({.name = "noisy", .noise_sd = sd}).contrasts;
    // 1200 pixels tell a deviation to 2 %; codes are rounded, which adds 1/12 to the variance.
    CHECK(found.signal_to_noise == doctest::Approx((150 - 71) / std::sqrt(sd * sd + 1.0 / 12)).epsilon(0.06));
  }
}

TEST_CASE("haze takes from the contrast what it leaves of the light") {
  // At 60 m in a visibility of 180 m e^-1 of the plate's light is left; the rest is the sky's own.
  Sky sky{.name = "haze"};
  sky.look.haze.visibility_m = 180;
  const double clear = checked({.name = "clear"}).contrasts.weber;
  CHECK(checked(sky).contrasts.weber == doctest::Approx(clear * std::exp(-1)).epsilon(0.02));
}

}  // namespace sigs::test
