// SPDX-License-Identifier: MIT
#include "flights/flights.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>

#include "flights/cases.h"
#include "flights/scenery.h"
#include "flights/sensor.h"
#include "flights/shapes.h"

namespace sigs::flights {
namespace {

const FlightSettings kSmall{.size_px = {320, 240}, .frames = 60};

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

double intersection_over_union(const cv::Mat& a, const cv::Mat& b) {
  return double(cv::countNonZero(a & b)) / cv::countNonZero(a | b);
}

// How much of a world behind it the body hides, on average over many frames: the remaining light of a white one, less
// that before a black one. CV_32FC1, 0..1.
cv::Mat mean_cover(const Body& body, int frames, std::uint32_t seed) {
  cv::Mat sum = cv::Mat::zeros(body.size_px, CV_32FC1);
  for (int n = 0; n < frames; ++n) {
    Shake shake = shake_at(n, body.size_px, seed);
    shake.light = 0;  // the body's own colour would clip
    shake.gloss_codes = 0;
    cv::Mat white(body.size_px, CV_8UC3, cv::Scalar::all(255)), channel;
    draw_over(white, body, shake);
    cv::extractChannel(white, channel, 0);
    cv::accumulate(255 - channel, sum);
  }
  return sum / (255.0 * frames);
}

cv::Mat grey(const cv::Mat& bgr) {
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  grey.convertTo(grey, CV_32F);
  return grey;
}

// Pixels of `from` to pixels of `to` for what lies on the ground: H = K_to (R - t n^T / d) K_from^-1 (Hartley and
// Zisserman, eq. 13.2), here in homogeneous ground places: pixel = P (x, y, 1), so H = P_to P_from^-1.
cv::Matx33d pixel_of_ground(const View& view) {
  const double f = view.focal_px, cx = 0.5 * (view.size_px.width - 1), cy = 0.5 * (view.size_px.height - 1);
  const cv::Matx33d pixel_of_camera(cx, f, 0, cy, 0, f, 1, 0, 0);  // axes forward, right, down
  const cv::Vec3d c = view.position_m;
  const cv::Matx33d offset(1, 0, -c[0], 0, 1, -c[1], 0, 0, -c[2]);
  return pixel_of_camera * view.world_from_camera.t() * offset;
}

}  // namespace

TEST_CASE("every case has its own name, a truth of its size, and images of it") {
  const std::vector<Flight> flights = all(kSmall);
  std::set<std::string> seen;
  REQUIRE(flights.size() == names().size());
  for (std::size_t i = 0; i < flights.size(); ++i) {
    const Flight& flight = flights[i];
    CAPTURE(flight.name);
    CHECK(flight.name == names()[i]);
    CHECK(seen.insert(flight.name).second);
    CHECK(flight.own_body.type() == CV_8UC1);
    CHECK(flight.own_body.size() == kSmall.size_px);
    CHECK(cv::countNonZero(flight.own_body) ==
          cv::countNonZero(flight.own_body == 255));  // nothing between own body and world
    CHECK((cv::countNonZero(flight.own_body) == 0) == (flight.name == "none"));
    CHECK(flight.bgr(3).type() == CV_8UC3);
    CHECK(flight.bgr(3).size() == kSmall.size_px);
  }
}

TEST_CASE("the harder flights have other names, and shake as those state") {
  const std::vector<std::string> known = names();
  for (const Flight& flight : hard(kSmall)) {
    CHECK(std::ranges::find(known, flight.name) == known.end());
    CHECK(flight.bgr(3).size() == kSmall.size_px);
    CHECK(cv::countNonZero(flight.own_body) > 0);
  }
  const std::vector<Case> cases = hard_cases();
  const auto strongest = std::ranges::find(cases, "trembles by 2 to 8 px", &Case::name);
  REQUIRE(strongest != cases.end());
  CHECK(strongest->shake * 0.5 == doctest::Approx(2));
  CHECK(strongest->shake * 2 == doctest::Approx(8));
  CHECK(strongest->shake * 2 < Body::kMargin_px);  // no gap at the image's border
}

TEST_CASE("a frame is the same whatever was requested before, from any copy of the flight") {
  for (const char* name : {"propeller", "exposure drift", "straight road below"}) {
    const Flight one = by_name(name, kSmall), other = by_name(name, kSmall);
    const cv::Mat first = one.bgr(17);
    CHECK(cv::norm(one.bgr(18), first, cv::NORM_INF) > 0);
    CHECK(same(other.bgr(17), first));
    CHECK(same(one.bgr(17), first));
  }
}

TEST_CASE("a body's mean position is that of the truth") {
  const cv::Size size_px(640, 480);
  for (const Part& part : {tail_boom(), nose(), wing_tip_left(), wing_tip_right(), windscreen(), belly()}) {
    const Body body = body_of({part}, size_px, 5);
    const cv::Mat cover = mean_cover(body, 150, 5);
    // After 150 random shifts some half a pixel of the outline's shaking remains.
    CHECK(intersection_over_union(cover > 0.5, body.truth) > 0.97);
    cv::Mat inner, outer;
    cv::erode(body.truth, inner, cv::Mat(), {-1, -1}, 5, cv::BORDER_REPLICATE);
    cv::dilate(body.truth, outer, cv::Mat(), {-1, -1}, 6);
    double minimum = 0;
    if (cv::countNonZero(inner) > 0) {
      cv::minMaxLoc(cover, &minimum, nullptr, nullptr, nullptr, inner);
      CHECK(minimum > 0.98);  // 255 premultiplied is rounded down now and then
    }
    cv::Mat beyond = cover.clone();
    beyond.setTo(0, outer);
    CHECK(cv::countNonZero(beyond) == 0);
  }
}

TEST_CASE("the world is visible outside of the truth and not within") {
  // Two flights over different terrain with one body: what differs between them is world.
  const cv::Size size_px(320, 240);
  const Body body = body_of({nose(), wing_tip_left()}, size_px, 5);
  const Terrain ours = terrain(1024, Roads::winding, 3), theirs = terrain(1024, Roads::winding, 4);
  cv::Mat differs = cv::Mat::zeros(size_px, CV_8UC1);
  for (int n = 0; n < 60; ++n) {
    const View view = view_at({.pitch_deg = -45, .first_pitch_deg = -45, .seed = 2}, size_px, 5 * n);
    cv::Mat a = scenery(ours, view, 1), b = scenery(theirs, view, 1);
    for (cv::Mat* image : {&a, &b}) draw_over(*image, body, Shake{});
    cv::Mat apart;
    cv::extractChannel(cv::abs(a - b), apart, 1);
    differs |= apart > 12;
  }
  CHECK(intersection_over_union(~differs, body.truth) > 0.97);
}

TEST_CASE("the ground moves as a plane in front of a pinhole camera") {
  const cv::Size size_px(640, 480);
  const Terrain land = terrain(2048, Roads::winding, 3);
  for (const int n : {0, 40, 200}) {
    const View from = view_at({.seed = 3}, size_px, n), to = view_at({.seed = 3}, size_px, n + 20);
    const cv::Matx33d move = pixel_of_ground(to) * pixel_of_ground(from).inv();
    cv::Mat moved, valid;
    cv::warpPerspective(grey(scenery(land, from, 0)), moved, move, size_px);
    cv::warpPerspective(cv::Mat(size_px, CV_8UC1, cv::Scalar(255)), valid, move, size_px);
    const cv::Rect near(20, 300, 600, 170);  // well below the horizon, where the haze is thin
    cv::Mat ours = moved(near).clone(), theirs = grey(scenery(land, to, 0))(near).clone(), still;
    still = grey(scenery(land, from, 0))(near).clone();
    for (cv::Mat* image : {&ours, &theirs, &still}) image->setTo(100, valid(near) < 255);
    // The nearer look shows a little more detail; an image that does not move is far off.
    const double moved_rms = cv::norm(ours, theirs) / std::sqrt(near.area());
    const double still_rms = cv::norm(still, theirs) / std::sqrt(near.area());
    CAPTURE(n);
    CHECK(moved_rms < 3);
    CHECK(still_rms > 3 * moved_rms);
  }
}

TEST_CASE("the horizon has the position that follows from the attitude") {
  const cv::Size size_px(640, 480);
  const Terrain land = terrain(1024, Roads::winding, 3);
  for (const int n : {0, 30, 77, 150}) {
    const View view = view_at({.seed = 7}, size_px, n);
    const cv::Mat seen = scenery(land, view, 0);
    for (const int x : {10, 320, 630}) {
      // Where the ray is level: a linear equation in y.
      const cv::Matx33d& r = view.world_from_camera;
      const double across = (x - 319.5) / view.focal_px;
      const double y = 239.5 - view.focal_px * (r(2, 0) + r(2, 1) * across) / r(2, 2);
      int last_sky = std::max(0, static_cast<int>(y) - 30);  // low sky is above 225 in blue, far ground 210
      while (last_sky + 1 < size_px.height && seen.at<cv::Vec3b>(last_sky + 1, x)[0] > 220) ++last_sky;
      CHECK(std::abs(last_sky + 0.5 - y) < 1.5);  // half a pixel, and one within which both are mixed
    }
  }
}

TEST_CASE("the body shakes by half a pixel to two, with a mean of zero") {
  cv::Point2d sum;
  for (int n = 0; n < 2000; ++n) {
    const cv::Point2d shift = shake_at(n, {640, 480}, 3).shift_px;
    CHECK(std::hypot(shift.x, shift.y) >= 0.5 - 1e-9);
    CHECK(std::hypot(shift.x, shift.y) <= 2 + 1e-9);
    sum += shift;
  }
  CHECK(std::hypot(sum.x, sum.y) / 2000 < 0.1);  // sigma of the mean is 0.93 / sqrt(2000) = 0.02 a direction
}

TEST_CASE("noise has the stated strength, and differs between frames") {
  const Grain grain(kGrain_codes);
  cv::Mat before;
  for (int n = 0; n < 3; ++n) {
    cv::Mat image(240, 320, CV_8UC3, cv::Scalar::all(120));
    grain.add_to(image, n);
    cv::Scalar mean, sigma;
    cv::meanStdDev(image.reshape(1), mean, sigma);
    CHECK(std::abs(mean[0] - 120) < 0.05);    // sigma / sqrt(230400) = 0.004
    CHECK(std::abs(sigma[0] - 2.02) < 0.05);  // rounding to codes adds 1/12 to the square
    if (n > 0) CHECK(cv::norm(image, before, cv::NORM_L1) / 230400.0 == doctest::Approx(2.28).epsilon(0.05));
    before = image;
  }
}

TEST_CASE("the frames of a still flight differ by noise and the moving object alone") {
  for (const char* name : {"still", "still, one mover"}) {
    const Flight flight = by_name(name, kSmall);
    CHECK_FALSE(flight.is_decidable);
    cv::Mat apart;
    cv::absdiff(flight.bgr(5), flight.bgr(45), apart);
    const int loud = cv::countNonZero(apart.reshape(1) > 16);  // 5.6 sigma of the difference
    CHECK((loud > 40) == (flight.name == "still, one mover"));
    CHECK(loud < 1000);
  }
}

TEST_CASE("letterbox bars are black in every frame and masked in the truth") {
  const Flight flight = by_name("letterbox", kSmall);
  const int bar = cvRound(0.11 * 240);
  for (const cv::Rect& where : {cv::Rect(0, 0, 320, bar), cv::Rect(0, 240 - bar, 320, bar)}) {
    CHECK(cv::countNonZero(flight.own_body(where)) == where.area());
    for (int n = 0; n < 9; ++n) CHECK(cv::countNonZero(flight.bgr(n)(where).clone().reshape(1)) == 0);
  }
}

TEST_CASE("the exposure drifts over its whole range") {
  double minimum = 9, maximum = 0;
  for (int n = 0; n < 600; ++n) {
    minimum = std::min(minimum, drifting_gain(n));
    maximum = std::max(maximum, drifting_gain(n));
  }
  CHECK(minimum == doctest::Approx(0.72).epsilon(0.03));
  CHECK(maximum == doctest::Approx(1.296).epsilon(0.03));
}

TEST_CASE("plain sky first shows sky for the first half and ground in the second") {
  const Flight flight = by_name("plain sky first", {.size_px = {320, 240}, .frames = 120});
  const auto roughness = [&](int n) {
    cv::Mat edges;
    cv::Laplacian(grey(flight.bgr(n))(cv::Rect(0, 130, 120, 100)), edges, CV_32F);
    return cv::norm(edges) / std::sqrt(edges.total());
  };
  CHECK(roughness(0) < 8);  // grain: 2 codes times sqrt(20) times what grey leaves of it
  CHECK(roughness(59) < 8);
  CHECK(roughness(100) > 2 * roughness(0));
}

}  // namespace sigs::flights
