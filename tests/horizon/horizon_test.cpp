// SPDX-License-Identifier: MIT
#include "horizon/horizon.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

namespace sigs::test {

namespace {

constexpr double kDegree = 0.017453292519943295;
constexpr int kSky = 170;
constexpr int kSea = 120;

Camera view_camera(LensModel model) {
  LensParameters lens{.model = model, .fx = 420, .fy = 420, .cx = 319.5, .cy = 179.5};
  if (model == LensModel::kannala_brandt) lens.coefficients = {0, 0, 0, 0};
  return {.lens = *Lens::make(lens), .size_px = {640, 360}};
}

// Of a camera of this roll (right side down) and pitch (nose up): turned about its Y, then about its X.
glm::dquat level_from_camera(double roll_deg, double pitch_deg) {
  return glm::angleAxis(pitch_deg * kDegree, glm::dvec3(0, 1, 0)) *
         glm::angleAxis(roll_deg * kDegree, glm::dvec3(1, 0, 0));
}

// An image of a world that is given by the luma in each direction (X ahead, Z down), with noise of 1.5 codes.
cv::Mat image_of(const Camera& camera, const glm::dquat& level_from_camera,
                 const std::function<double(const glm::dvec3&)>& luma_in) {
  cv::Mat image(camera.size_px, CV_32F);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const auto ray = camera.lens.ray({x, y});
      image.at<float>(y, x) = ray ? static_cast<float>(luma_in(level_from_camera * *ray)) : 0.0F;
    }
  cv::GaussianBlur(image, image, {3, 3}, 0.6);
  cv::Mat noise(image.size(), CV_32F);
  cv::RNG(7).fill(noise, cv::RNG::NORMAL, 0, 1.5);
  image += noise;
  cv::Mat out;
  image.convertTo(out, CV_8U);
  return out;
}

double sea_and_sky(const glm::dvec3& ray) {
  return ray.z > 0 ? kSea : kSky - 20 * ray.z;
}

// Random grey all over, in patches of some degrees.
double rough_ground(const glm::dvec3& ray) {
  const auto wave = [&](double a, double b, double c) { return std::sin(a * ray.y + b * ray.z + c * ray.x); };
  return 110 + 18 * wave(61, 23, 7) + 18 * wave(-37, 59, 3) + 12 * wave(113, -71, 19) + 12 * wave(17, 131, 41);
}

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) / kDegree;
}

glm::dvec3 up_in_camera(const glm::dquat& level_from_camera) {
  return glm::conjugate(level_from_camera) * glm::dvec3(0, 0, -1);
}

// Flat ground under haze: by Koschmieder the contrast at the angle t below the level is exp(-a / t) of all of it.
std::function<double(const glm::dvec3&)> hazy_ground(double a_rad) {
  return [a_rad](const glm::dvec3& ray) {
    const double below_rad = std::asin(ray.z);
    return below_rad > 0 ? kSky - 70 * std::exp(-a_rad / below_rad) : static_cast<double>(kSky);
  };
}

// A skyline between the level and twice `mean_rad`.
std::function<double(const glm::dvec3&)> wavy_hills(double mean_rad, double waves_a_radian) {
  return [=](const glm::dvec3& ray) {
    const double top_rad = mean_rad * (1 + std::sin(waves_a_radian * std::atan2(ray.y, ray.x)));
    return std::asin(-ray.z) < top_rad ? kSea : kSky;
  };
}

std::optional<Level> level_by(const HorizonLine& line) {
  const std::vector<HorizonLine> lines(6, line);
  return level_of(lines, std::vector(static_cast<std::size_t>(line.frame) + 1, glm::dquat(1, 0, 0, 0)));
}

}  // namespace

TEST_CASE("haze lowers the edge by half of height over visual range, and the line says so") {
  const Camera camera = view_camera(LensModel::kannala_brandt);
  const glm::dquat turn = level_from_camera(2, 1);
  for (const double a_rad : {0.008, 0.014, 0.02}) {
    const auto line = horizon_in(image_of(camera, turn, hazy_ground(a_rad)), 1, camera, {}, 0);
    CAPTURE(a_rad);
    REQUIRE(line);
    const double off_rad = degrees_between(line->up, up_in_camera(turn)) * kDegree;
    // 1.5 rows: filters over some rows move the steepest place of a profile that has a tail on one side.
    CHECK(std::abs(off_rad - a_rad / 2) < 0.0036);
    // Of the contrast exp(-a / 0.1) is in sight, 0.82 for the thickest haze; a width of some rows is known to one.
    CHECK(line->haze_rad == doctest::Approx(a_rad / 2).epsilon(0.35));
    const auto level = level_by(*line);
    REQUIRE(level);
    CHECK(level->sd_rad > line->haze_rad);
    CHECK(off_rad < 2 * level->sd_rad);
  }
  const auto clear = horizon_in(image_of(camera, turn, sea_and_sky), 1, camera, {}, 0);
  REQUIRE(clear);
  CHECK(clear->haze_rad < 0.0012);  // half a row: the lens' blur
  CHECK(clear->hills_rad < 0.0012);
}

TEST_CASE("low hills raise the line by their mean height, which the relief of the skyline tells") {
  const Camera camera = view_camera(LensModel::kannala_brandt);
  const glm::dquat turn = level_from_camera(2, 1);
  for (const double mean_rad : {0.001, 0.0015, 0.002}) {
    const auto line = horizon_in(image_of(camera, turn, wavy_hills(mean_rad, 30)), 1, camera, {}, 0);
    CAPTURE(mean_rad);
    REQUIRE(line);
    CHECK(std::abs(degrees_between(line->up, up_in_camera(turn)) * kDegree - mean_rad) < 0.0008);  // a third of a row
    // A sine's deviation is its amplitude over sqrt(2); a third of a row of noise is added by the edges.
    CHECK(std::abs(line->hills_rad - mean_rad * std::sqrt(1.5)) < 0.0008);
    CHECK(level_by(*line).value().sd_rad > std::hypot(line->hills_rad, 0.3 * kDegree));  // and the dip
  }
}

TEST_CASE("a sea's horizon is found to 0.1 degrees, whatever the roll, the pitch and the lens") {
  for (const LensModel model : {LensModel::brown_conrady, LensModel::kannala_brandt})
    for (const auto& [bank_deg, pitch_deg] : {std::pair(0.0, 0.0), {2.3, 1.0}, {-25.0, -8.0}, {40.0, 5.0}}) {
      const double roll_deg = bank_deg;
      const Camera camera = view_camera(model);
      const glm::dquat turn = level_from_camera(roll_deg, pitch_deg);
      const auto line = horizon_in(image_of(camera, turn, sea_and_sky), 1, camera, {}, 3);
      CAPTURE(roll_deg);
      REQUIRE(line);
      CHECK(line->frame == 3);
      // A row of 420 px a radian is 0.14 degrees; edges are found to parts of it.
      CHECK(degrees_between(line->up, up_in_camera(turn)) < 0.1);
      CHECK(line->sd_rad < 0.1 * kDegree);
    }
}

TEST_CASE("a calm sea, smooth as the sky, has a horizon where it is tilted too; a cloud's straight edge is none") {
  // Calm water mirrors the sky: in direction a below the level it is a share of what is seen at a above it.
  const auto sky = [](double up_rad) { return 200 - 90 * up_rad; };
  const auto calm_sea = [&](const glm::dvec3& ray) {
    const double down_rad = std::asin(ray.z);
    return down_rad > 0 ? 0.92 * sky(down_rad) - 60 * down_rad : sky(-down_rad);
  };
  // A layer of cloud with a straight lower edge, clear sky below it, down to the image's border.
  const auto cloud = [&](const glm::dvec3& ray) {
    const double up_rad = 0.6 + std::asin(-ray.z);
    return sky(up_rad) + (ray.z < 0 ? 14 : 0);
  };
  const Camera camera = view_camera(LensModel::brown_conrady);
  for (const double roll_deg : {-25.0, -8.0, 0.0, 8.0, 25.0}) {
    CAPTURE(roll_deg);
    const glm::dquat attitude = level_from_camera(roll_deg, 2);
    const auto line = horizon_in(image_of(camera, attitude, calm_sea), 1, camera, {}, 0);
    REQUIRE(line);
    CHECK(degrees_between(line->up, up_in_camera(attitude)) < 0.2);  // as for a rough sea, at twice the noise
    CHECK_FALSE(horizon_in(image_of(camera, attitude, cloud), 1, camera, {}, 0));
  }
}

TEST_CASE("hills over more than half of the width do not hide the rest of the horizon") {
  const Camera camera = view_camera(LensModel::kannala_brandt);
  const glm::dquat turn = level_from_camera(3, 1);
  const auto luma = [](const glm::dvec3& ray) {
    const double azimuth = std::atan2(ray.y, ray.x);
    const double top = azimuth > -0.1 ? 0.05 + 0.03 * std::sin(9 * azimuth) + 0.01 * std::sin(40 * azimuth) : 0;
    if (-ray.z < top && azimuth > -0.1) return rough_ground(ray);
    return sea_and_sky(ray);
  };
  const auto line = horizon_in(image_of(camera, turn, luma), 1, camera, {}, 0);
  REQUIRE(line);
  CHECK(degrees_between(line->up, up_in_camera(turn)) < 0.3);  // the visible part spans 37 degrees of 87
}

TEST_CASE("without a horizon none is found: blank, rough, an upright edge, a road through rough ground") {
  const Camera camera = view_camera(LensModel::kannala_brandt);
  const glm::dquat level = level_from_camera(0, 0);
  const auto found = [&](const std::function<double(const glm::dvec3&)>& luma) {
    return horizon_in(image_of(camera, level, luma), 1, camera, {}, 0).has_value();
  };
  CHECK_FALSE(found([](const glm::dvec3&) { return 128.0; }));
  CHECK_FALSE(found(rough_ground));
  CHECK_FALSE(found([](const glm::dvec3& ray) { return ray.y < 0.02 * ray.z ? 170.0 : 120.0; }));
  CHECK_FALSE(
      found([](const glm::dvec3& ray) { return std::abs(ray.z - 0.1 * ray.y) < 0.01 ? 200.0 : rough_ground(ray); }));
}

TEST_CASE("a road in footage that looks down is no horizon: above it is ground") {
  const Camera camera = view_camera(LensModel::kannala_brandt);
  // Bright ground beside a dark road that crosses the image straight, smooth enough for the edge to be sharp.
  for (const double tilt : {0.0, 0.1, -0.3})
    for (const double strength : {0.3, 1.0}) {
      CAPTURE(tilt);
      const auto luma = [&](const glm::dvec3& ray) {
        const double off = ray.y * tilt - ray.x / std::max(ray.z, 0.1);
        return std::abs(off) < 0.1 ? 60.0 : 60 + strength * rough_ground(ray) + (1 - strength) * 110;
      };
      CHECK_FALSE(horizon_in(image_of(camera, level_from_camera(0, -90), luma), 1, camera, {}, 0));
    }
}

TEST_CASE("a roof against the sky is no horizon: beside it there is sky below its edge") {
  const Camera camera = view_camera(LensModel::brown_conrady);
  for (const double slope : {0.15, -0.25}) {
    const auto luma = [&](const glm::dvec3& ray) {
      const double right = ray.y / ray.x, down = ray.z / ray.x;
      const bool is_roof = right > -0.1 && right < 0.6 && down > 0.05 + slope * right;
      return is_roof ? 60.0 : sea_and_sky({ray.x, ray.y, -std::abs(ray.z)});
    };
    CHECK_FALSE(horizon_in(image_of(camera, level_from_camera(0, 0), luma), 1, camera, {}, 0));
  }
}

TEST_CASE("a bonnet below a street is no horizon; the street's end is the skyline") {
  const Camera camera = view_camera(LensModel::brown_conrady);
  const auto luma = [](const glm::dvec3& ray) {
    const double down = ray.z / ray.x;
    if (down > 0.3) return 70.0;  // the bonnet, straight
    const double roofs = -0.05 - 0.03 * std::sin(23 * ray.y) * std::sin(7 * ray.y);
    return down > roofs ? 20 + rough_ground(ray) : 200.0;
  };
  const cv::Mat image = image_of(camera, level_from_camera(0, 4), luma);
  CHECK_FALSE(horizon_in(image, 1, camera, {}, 0));
  const auto pitch_rad = skyline_pitch_rad(sky_map_of(image), 1, camera);
  REQUIRE(pitch_rad);
  // The roofs stand 0.05 above the level on average, which pitches the camera down; the scene turns with it here.
  CHECK(*pitch_rad / kDegree == doctest::Approx(4 - 0.05 / kDegree).epsilon(0.4));
}

TEST_CASE("a bright wing along the upper border is no brighter sky, and sky begins below it") {
  const Camera camera = view_camera(LensModel::brown_conrady);
  const auto world = [](const glm::dvec3& ray) { return ray.z > 0 ? rough_ground(ray) : 150 + 20 * ray.z; };
  cv::Mat image = image_of(camera, level_from_camera(0, 5), world);
  const SkyMap free = sky_map_of(image);
  const cv::Rect wing(0, 0, image.cols * 2 / 3, 41);
  cv::Mat own_body = cv::Mat::zeros(image.size(), CV_8UC1);
  image(wing).setTo(230);
  own_body(wing).setTo(255);
  const SkyMap map = sky_map_of(image, own_body);
  CHECK(map.columns == 1);
  int differ = 0;
  for (int y = 13; y < map.sky.rows; ++y)
    for (int x = 0; x < map.sky.cols; ++x) differ += map.sky(y, x) != free.sky(y, x) ? 1 : 0;
  CHECK(differ < 0.01 * static_cast<double>(map.sky.total()));
  CHECK(cv::countNonZero(map.sky(cv::Rect(0, 0, wing.width / SkyMap::kCell_px, wing.height / SkyMap::kCell_px))) == 0);
}

TEST_CASE("sky, ground and their border are distinguished in an image that shows one alone or both") {
  const Camera camera = view_camera(LensModel::brown_conrady);
  const auto seen = [&](double pitch_deg, const std::function<double(const glm::dvec3&)>& luma) {
    return sky_map_of(image_of(camera, level_from_camera(0, pitch_deg), luma));
  };
  const auto world = [](const glm::dvec3& ray) { return ray.z > 0 ? rough_ground(ray) : 190 + 20 * ray.z; };
  CHECK(seen(50, world).share > 0.99);
  CHECK(seen(-70, world).share < 0.08);
  const SkyMap both = seen(5, world);
  CHECK(both.columns == 1);
  // The level is 420 tan(5 degrees) = 37 px below the middle row of 360.
  CHECK(both.share == doctest::Approx((180 + 37) / 360.0).epsilon(0.03));
}

TEST_CASE("a horizon hidden by the own body over most of the width is none") {
  const Camera camera = view_camera(LensModel::kannala_brandt);
  cv::Mat body(camera.size_px, CV_8UC1, cv::Scalar(0));
  body(cv::Rect(130, 0, 510, 360)).setTo(255);
  const glm::dquat level = level_from_camera(0, 0);
  CHECK_FALSE(horizon_in(image_of(camera, level, sea_and_sky), 1, camera, body, 0));
}

TEST_CASE("lines that stay in the world are its level; lines that move by parallax are not") {
  std::vector<HorizonLine> still;
  std::vector<HorizonLine> moving;
  std::vector<glm::dquat> turns;
  for (int k = 0; k < 20; ++k) {
    turns.push_back(level_from_camera(k, 0.5 * k));
    still.push_back({.frame = k, .up = up_in_camera(turns.back()), .sd_rad = 0.001});
    moving.push_back(
        {.frame = k,
         .up = glm::conjugate(turns.back()) * glm::angleAxis(0.01 * k, glm::dvec3(0, 1, 0)) * glm::dvec3(0, 0, -1),
         .sd_rad = 0.001});
  }
  const auto level = level_of(still, turns);
  REQUIRE(level);
  CHECK(degrees_between(level->up_in_start, {0, 0, -1}) < 1e-6);
  CHECK(level->sd_rad > 0.3 * kDegree);  // the horizon dips by an amount that is not known
  CHECK_FALSE(level_of(moving, turns));
  CHECK_FALSE(level_of(std::span(still).first(4), turns));
  CHECK_FALSE(level_of({}, turns));
}

TEST_CASE(
    "clouds of a thermal image do not hide where its warm ground begins; without such ground nothing is claimed") {
  const Camera camera = view_camera(LensModel::brown_conrady);
  const auto image_with = [&](double pitch_deg, double ground) {
    return image_of(camera, level_from_camera(0, pitch_deg), [&](const glm::dvec3& ray) {
      const double clouds = 0.45 * (rough_ground(ray) - 110);
      return ray.z > 0 ? ground + 0.3 * (rough_ground(ray) - 110) : 60 + clouds;
    });
  };
  for (const double pitch_deg : {-12.0, 0.0, 9.0, 17.0}) {
    CAPTURE(pitch_deg);
    const cv::Mat image = image_with(pitch_deg, 150);
    const SkyMap sky = sky_above_warm_ground(image);
    CHECK(sky.columns > 0.95);
    const auto pitch_rad = skyline_pitch_rad(sky, 1, camera);
    REQUIRE(pitch_rad);
    CHECK(std::abs(*pitch_rad / kDegree - pitch_deg) < 0.6);  // a cell is 4 px, 0.55 degrees
    CHECK(std::abs(sky.share - 0.5 - std::tan(pitch_deg * kDegree) * 420 / 360) < 0.012);
    cv::Mat upside_down;
    cv::flip(image, upside_down, 0);
    CHECK(sky_above_warm_ground(upside_down).empty());
  }
  CHECK(sky_above_warm_ground(image_with(5, 80)).empty());    // hardly warmer
  CHECK(sky_above_warm_ground(image_with(40, 150)).empty());  // nothing but sky
  CHECK(sky_above_warm_ground(cv::Mat(20, 3, CV_8UC1, cv::Scalar(9))).empty());
  CHECK(sky_above_warm_ground(cv::Mat(12, 200, CV_8UC1, cv::Scalar(9))).empty());
}

}  // namespace sigs::test
