// SPDX-License-Identifier: MIT
// How the camera of a first project turns, and the lens that its turns show.
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "base/pose.h"
#include "camera/camera.h"
#include "made_project.h"
#include "telemetry/track.h"

namespace sigs {

using test::made_and_opened;
using test::noisy_images;
using test::note_on;

namespace fs = std::filesystem;

namespace {

cv::Mat1f rough_ground(cv::Size size, std::uint64_t seed) {
  cv::RNG random(seed);
  cv::Mat1f ground(size);
  random.fill(ground, cv::RNG::NORMAL, 128, 400);
  cv::GaussianBlur(ground, ground, {}, 2.5);
  return ground;
}

// Images of a pinhole camera that looks around before a far ground: 50 of 320x240.
fs::path panned_images(const test::TemporaryFolder& folder, double focal_px) {
  const fs::path images = folder / "panned";
  fs::create_directory(images);
  const cv::Mat1f ground = rough_ground({800, 400}, 5);
  const cv::Matx33d pixel_of_ray(focal_px, 0, 159.5, 0, focal_px, 119.5, 0, 0, 1);
  const cv::Matx33d ray_of_ground = cv::Matx33d(focal_px, 0, 399.5, 0, focal_px, 199.5, 0, 0, 1).inv();
  for (int n = 0; n < 50; ++n) {
    cv::Mat turn, image;
    cv::Rodrigues(cv::Vec3d(0.03 * std::sin(0.2 * n), 0.2 * std::sin(0.13 * n), 0.02 * std::sin(0.3 * n)), turn);
    cv::warpPerspective(ground, image, pixel_of_ray * cv::Matx33d(turn) * ray_of_ground, {320, 240}, cv::INTER_CUBIC);
    image.convertTo(image, CV_8U);
    cv::imwrite((images / fmt::format("{:03}.png", n)).string(), image);
  }
  return images;
}

// Images of far, rough ground that has moved to the right by so many pixels in each.
//   cut  from this frame on they show another ground
fs::path moved_images(const test::TemporaryFolder& folder, const std::string& name, const std::vector<double>& moves_px,
                      std::size_t cut = 1000) {
  const fs::path images = folder / name;
  fs::create_directory(images);
  cv::Mat1f grounds[2];
  for (std::uint64_t seed = 5; cv::Mat1f & ground : grounds) ground = rough_ground({400, 260}, seed++);
  for (std::size_t n = 0; n < moves_px.size(); ++n) {
    cv::Mat image;
    const cv::Matx23d move(1, 0, moves_px[n] - 40, 0, 1, -10);
    cv::warpAffine(grounds[n < cut ? 0 : 1], image, move, {320, 240}, cv::INTER_CUBIC);
    image.convertTo(image, CV_8U);
    cv::imwrite((images / fmt::format("{:03}.png", n)).string(), image);
  }
  return images;
}

}  // namespace

TEST_CASE("the camera of a first project turns as the images show it; one that stands still or is lost is left alone") {
  const test::TemporaryFolder folder;
  const double fov_deg = 40, focal_px = 160 / std::tan(rad_of_deg(fov_deg) / 2);
  std::vector<double> shaken, still;
  for (int n = 0; n < 50; ++n) {
    shaken.push_back(5 * std::sin(0.7 * n) + 0.2 * n);
    still.push_back(0.1 * std::sin(0.7 * n));
  }
  FirstProjectOptions options{
      .timing = {.frame_rate_hz = 25}, .horizontal_fov_deg = fov_deg, .out = folder / "p.json", .overwrite = true};
  options.video = moved_images(folder, "shaken", shaken);
  const FirstProject turned = made_and_opened(options);
  CHECK(turned.project.camera.track.file == "p.attitude.csv");
  CHECK_FALSE(note_on(turned, "camera.track.file").is_guess);
  const Result<Track> track = read_track(folder / "p.attitude.csv", {});
  REQUIRE(track);
  REQUIRE(track->ned_from_camera.values.size() == shaken.size());
  for (std::size_t n = 0; n < shaken.size(); ++n) {
    // What moves to the right shows a camera that turns to the left. A third of a pixel is left to the features.
    const double yaw_rad = attitude_of(track->ned_from_camera.values[n]).yaw_rad;
    CHECK(focal_px * std::tan(yaw_rad) == doctest::Approx(shaken.front() - shaken[n]).epsilon(0.33).scale(1));
  }
  options.video = moved_images(folder, "still", still);
  const FirstProject kept = made_and_opened(options);
  CHECK(kept.project.camera.track.file.empty());
  CHECK(note_on(kept, "camera.track.file").text.find("stands still") != std::string::npos);
  for (double& move_px : still) move_px *= 10;
  options.video = moved_images(folder, "cut", still, 25);  // by how much it turned there is not to be seen
  const FirstProject cut = made_and_opened(options);
  CHECK(cut.project.camera.track.file.empty());
  CHECK(note_on(cut, "camera.track.file").text.find("jerk or a cut at frame 25") != std::string::npos);
  options.video = noisy_images(folder, 8);  // nothing that could be followed
  const FirstProject lost = made_and_opened(options);
  CHECK(lost.project.camera.track.file.empty());
  CHECK(note_on(lost, "camera.track.file").is_guess);
  options.video = folder / "shaken";
  options.plain = true;
  CHECK(made_and_opened(options).project.camera.track.file.empty());
}

TEST_CASE("where nothing states the field of view, but the camera pans, it is that of which the images turn") {
  const test::TemporaryFolder folder;
  const double focal_px = 160 / std::tan(rad_of_deg(25) / 2);
  FirstProjectOptions options{.video = panned_images(folder, focal_px),
                              .timing = {.frame_rate_hz = 25},
                              .out = folder / "p.json",
                              .overwrite = true};
  const FirstProject made = made_and_opened(options);
  const auto written_px = [&] {
    const Result<Camera> camera = read_calibration(folder / "p.calibration.xml", cv::Size(320, 240));
    REQUIRE(camera);
    return camera->lens.parameters().fx;
  };
  CHECK(written_px() == doctest::Approx(focal_px).epsilon(0.1));  // a pan of 0.2 rad tells it within some percent
  CHECK(note_on(made, "footage.calibration").text.find("by how the images turn") != std::string::npos);
  // The attitudes are those of that lens: the pan spans 0.4 rad.
  const Result<Track> track = read_track(folder / made.project.camera.track.file);
  REQUIRE(track);
  double min_rad = 0, largest_rad = 0;
  for (const glm::dquat& attitude : track->ned_from_camera.values) {
    min_rad = std::min(min_rad, attitude_of(attitude).yaw_rad);
    largest_rad = std::max(largest_rad, attitude_of(attitude).yaw_rad);
  }
  CHECK(largest_rad - min_rad == doctest::Approx(0.4).epsilon(0.1));
  // What the user states stays.
  options.horizontal_fov_deg = 70;
  made_and_opened(options);
  CHECK(written_px() == doctest::Approx(160 / std::tan(rad_of_deg(35))));
}

}  // namespace sigs
