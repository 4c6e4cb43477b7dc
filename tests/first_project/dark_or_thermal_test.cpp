// SPDX-License-Identifier: MIT
// First projects of footage that is not lit by day.
#include <algorithm>
#include <opencv2/core.hpp>

#include "made_project.h"

namespace sigs {

using test::made_and_opened;
using test::note_on;

namespace fs = std::filesystem;

namespace {

// Gray images of a sky that ends at a level skyline above a textured ground, codes of each.
fs::path sky_over_ground(const test::TemporaryFolder& folder, const std::string& name, const cv::Size& size, int sky,
                         int ground) {
  const fs::path images = folder / name;
  fs::create_directory(images);
  cv::RNG random(3);
  cv::Mat1f texture(size);
  random.fill(texture, cv::RNG::NORMAL, 0, 12);
  cv::Mat1f image(size, static_cast<float>(sky));
  const int skyline = size.height * 2 / 3;
  for (int y = skyline; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) image(y, x) = static_cast<float>(ground) + texture(y, x);
  cv::Mat codes;
  image.convertTo(codes, CV_8U);
  for (int n = 0; n < 4; ++n) cv::imwrite((images / fmt::format("{:03}.png", n)).string(), codes);
  return images;
}

}  // namespace

TEST_CASE(
    "gray footage is thermal where its ground is brighter than its sky, or where it is small and shows none; dark "
    "footage is by night") {
  const test::TemporaryFolder folder;
  const auto made_of = [&](const std::string& name, const cv::Size& size, int sky, int ground) {
    const fs::path images = sky_over_ground(folder, name, size, sky, ground);
    return made_and_opened({.video = images, .timing = {.frame_rate_hz = 25}, .out = folder / (name + ".json")});
  };
  const FirstProject warm = made_of("warm", {800, 600}, 70, 180);
  CHECK(warm.project.footage.spectrum == Spectrum::thermal);
  CHECK(warm.project.appearance.thermal.sky == doctest::Approx(70).epsilon(0.02));
  // Its skyline is 100 px below the middle of an image of 800 px that is 70 degrees wide.
  CHECK(*warm.project.camera.pitch_deg == doctest::Approx(9.9).epsilon(0.05));
  CHECK(warm.project.appearance.thermal.halo_px == doctest::Approx(80));  // 32 px in 320: its sky has no halo
  CHECK(warm.project.appearance.sharpening < 0);                          // a glow
  CHECK(note_on(warm, "footage.spectrum").is_guess);
  CHECK(std::none_of(warm.notes.begin(), warm.notes.end(),
                     [](const FirstProjectNote& note) { return note.field.starts_with("light."); }));
  CHECK(made_of("day", {800, 600}, 180, 70).project.footage.spectrum == Spectrum::visible);
  const FirstProject small = made_of("small", {320, 256}, 90, 90);
  CHECK(small.project.footage.spectrum == Spectrum::thermal);
  CHECK(small.project.camera.pitch_deg.value_or(0) > -5);  // rough clouds, or ground: it is not said to look down
  const FirstProject small_day = made_of("small-day", {320, 256}, 180, 70);
  CHECK(small_day.project.footage.spectrum == Spectrum::visible);
  CHECK(note_on(small_day, "footage.spectrum").remedy.find("appearance.thermal.hot") != std::string::npos);
  CHECK(made_of("large", {800, 600}, 90, 90).project.footage.spectrum == Spectrum::visible);
  CHECK(made_of("dim", {800, 600}, 60, 20).project.intruders.front().lights.is_dark());

  // In a palette low heat is what is warm where the ground has less of it than the sky.
  const auto in_colors = [&](const std::string& name, int sky, int ground) {
    const fs::path images = sky_over_ground(folder, name, {320, 256}, sky, ground);
    for (const fs::directory_entry& file : fs::directory_iterator(images)) {
      cv::Mat colors;
      cv::applyColorMap(cv::imread(file.path(), cv::IMREAD_GRAYSCALE), colors, cv::COLORMAP_INFERNO);
      cv::imwrite(file.path(), colors);
    }
    return made_and_opened({.video = images, .timing = {.frame_rate_hz = 25}, .out = folder / (name + ".json")});
  };
  const FirstProject warm_bright = in_colors("inferno", 70, 180), warm_dark = in_colors("inverted", 180, 70);
  CHECK(warm_bright.project.footage.palette == HeatPalette::inferno);
  CHECK(warm_dark.project.footage.palette == HeatPalette::inferno);
  CHECK(warm_bright.project.appearance.thermal.hot == HotChoice::white);
  CHECK(warm_dark.project.appearance.thermal.hot == HotChoice::black);

  const FirstProject night = made_of("night", {800, 600}, 16, 6);
  CHECK(night.project.footage.spectrum == Spectrum::visible);
  CHECK(note_on(night, "light.white_cdpm2").is_guess);
  CHECK(night.project.light.white_cdpm2 == 5);
  CHECK(night.project.camera.exposure_s == doctest::Approx(0.033));  // 25 frames a second leave room for it
  CHECK(night.project.light.color.x < 0.05);                         // as dark as the footage
  CHECK(night.project.intruders.front().lights == usual_lights("airplane"));

  // A log beside the footage with aperture, exposure and sensitivity; 6 m/s to the north.
  const auto log_by_steps_of = [](double latitude_deg) {
    std::string log;
    for (int n = 0; n < 4; ++n)
      log += fmt::format(
          "{}\n00:00:00,{:02}0 --> 00:00:00,{:02}0\n2024-01-01 22:00:00,{:02}0\n[iso : 1600] [shutter : 1/50.0] "
          "[fnum : 280] [latitude: {:.7f}] [longitude: 18.2] [abs_alt: 105.1]\n\n",
          n + 1, 4 * n, 4 * n + 4, 4 * n, 59.1 + latitude_deg * n);
    return log;
  };
  test::write_file(folder / "night.srt", log_by_steps_of(2.2e-6));
  const FirstProject logged =
      made_and_opened({.video = folder / "night", .timing = {.frame_rate_hz = 25}, .out = folder / "logged.json"});
  CHECK(logged.project.light.white_cdpm2 == doctest::Approx(120 * 2.8 * 2.8 / (1600 / 50.0)).epsilon(1e-4));
  CHECK(note_on(logged, "light.white_cdpm2").text.find("by the log") != std::string::npos);
  CHECK(!logged.project.camera.exposure_s);  // as the log says
  // One that hovers gives no path, and the camera's settings all the same.
  test::write_file(folder / "night.srt", log_by_steps_of(0));
  const FirstProject hovering =
      made_and_opened({.video = folder / "night", .timing = {.frame_rate_hz = 25}, .out = folder / "hovering.json"});
  CHECK(hovering.project.camera.track.file.empty());
  CHECK(hovering.project.light.white_cdpm2 == logged.project.light.white_cdpm2);
}

}  // namespace sigs
