// SPDX-License-Identifier: MIT
#include "scene/scene_light.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <string>

#include "base/pose.h"
#include "scene/draft.h"
#include "scene/opened_project.h"
#include "scene/sample_scenes.h"
#include "scene/scene_at.h"

using namespace sigs;
using namespace sigs::test;

namespace {

double utc_s(int year, unsigned month, unsigned day, double hours) {
  const std::chrono::sys_days date = std::chrono::year(year) / std::chrono::month(month) / std::chrono::day(day);
  return 86400.0 * static_cast<double>(date.time_since_epoch().count()) + 3600 * hours;
}

struct KnownSun {
  double utc_s;
  GeodeticPosition place;
  double azimuth_deg;
  double elevation_deg;  // of its middle, without refraction
};

Project in_sun() {
  Project project = sample_project("crossing");
  project.light.kind = LightKind::sun;
  return project;
}

// On the Earth at a moment, with the log's part left out.
Scene scene_under(double utc_s_at_start, const GeodeticPosition& place, double heading_deg) {
  Scene scene = open_scene(sample_project("crossing"), sample_footage()).value();
  scene.light.kind = LightKind::sun;
  scene.earth = LocalFrame(place, rad_of_deg(heading_deg));
  scene.utc_at_frame_0_s = utc_s_at_start;
  return scene;
}

// Azimuth from world X to the right and elevation.
glm::dvec2 angles_deg(const glm::dvec3& to_sun) {
  return {deg_of_rad(std::atan2(to_sun.y, to_sun.x)), deg_of_rad(std::asin(-to_sun.z))};
}

}  // namespace

TEST_CASE("the sun stands where NREL's algorithm and almanacs have it") {
  const KnownSun known[] = {
      // NREL/TP-560-34302 (Reda and Andreas 2008), example of appendix A.5: elevation e0
      {utc_s(2003, 10, 17, 19.5 + 30.0 / 3600), {39.742476, -105.1786, 1830.14}, 194.340241, 39.872046},
      // The same algorithm (uncertainty 0.0003 degrees) as pvlib computes it: Reykjavik, Berlin in summer and winter,
      // Davis at night, Delhi, Nairobi with the sun near the zenith, Christchurch after sunset
      {utc_s(2021, 6, 21, 12), {64.1466, -21.9426, 10}, 149.338091, 46.702268},
      {utc_s(2021, 6, 21, 12), {52.52, 13.405, 34}, 203.723049, 59.285657},
      {utc_s(2021, 12, 21, 9.5), {52.52, 13.405, 34}, 157.982911, 11.293283},
      {utc_s(2021, 12, 21, 9.5), {38.5449, -121.7405, 16}, 56.275318, -66.452193},
      {utc_s(2021, 6, 21, 12), {28.6139, 77.209, 216}, 285.544832, 22.031291},
      {utc_s(2021, 12, 21, 9.5), {-1.2921, 36.8219, 1795}, 179.504172, 67.853069},
      {utc_s(2021, 12, 21, 9.5), {-43.5321, 172.6362, 20}, 220.937996, -11.620362},
  };
  for (const KnownSun& one : known) {
    const SunPosition sun = sun_position(one.utc_s, one.place);
    CAPTURE(one.azimuth_deg);
    CHECK(std::abs(deg_of_rad(sun.elevation_rad) - one.elevation_deg) < 0.01);
    // Along the sky: near the zenith a small step is a large angle of azimuth.
    CHECK(std::abs(deg_of_rad(sun.azimuth_rad) - one.azimuth_deg) * std::cos(sun.elevation_rad) < 0.01);
  }
}

TEST_CASE("the sun of a flight in California stands 67 degrees high in the south") {
  const SunPosition sun = sun_position(utc_s(2017, 4, 17, 19 + 28.0 / 60 + 8.0 / 3600), {33.126, -117.3315, 0});
  CHECK(std::abs(deg_of_rad(sun.elevation_rad) - 67.1) < 0.06);  // known to a tenth
  CHECK(std::abs(deg_of_rad(sun.azimuth_rad) - 166.9) < 0.06);
}

TEST_CASE("at the equinoxes the sun crosses the equator, at the solstices it turns") {
  // Instants of the Astronomical Almanac: 2024-03-20 03:06 and 2024-06-20 20:51, 2030-12-21 20:09 UTC. Seen from a pole
  // the elevation is the declination.
  const auto at_pole_deg = [](double time_s) { return deg_of_rad(sun_position(time_s, {90, 0, 0}).elevation_rad); };
  CHECK(std::abs(at_pole_deg(utc_s(2024, 3, 20, 3.1))) < 0.005);
  CHECK(std::abs(at_pole_deg(utc_s(2024, 6, 20, 20.85)) - 23.438) < 0.005);
  CHECK(std::abs(at_pole_deg(utc_s(2030, 12, 21, 20.15)) + 23.437) < 0.005);
}

TEST_CASE("the sun moves over the sky without a step at midnight, at new year, before 1970 and far from today") {
  for (const double start : {utc_s(1969, 12, 31, 23.9), utc_s(2016, 12, 31, 23.9), utc_s(1900, 1, 1, 0), 1e12, -1e12}) {
    SunPosition last = sun_position(start, {45, 7, 0});
    for (int i = 1; i <= 24; ++i) {
      const SunPosition sun = sun_position(start + 60.0 * i, {45, 7, 0});
      CHECK(std::isfinite(sun.azimuth_rad));
      // At most 15 degrees an hour.
      CHECK(std::abs(sun.elevation_rad - last.elevation_rad) < rad_of_deg(0.2501));
      last = sun;
    }
  }
}

TEST_CASE("refraction lifts the sun by half a degree at the horizon and not at the zenith") {
  // Meeus, chapter 16: 28.98' at a true altitude of 0 (0.4845 degrees), 9.88' of an apparent 5 degrees.
  CHECK(std::abs(deg_of_rad(refraction_rad(0)) * 60 - 28.98) < 0.1);
  CHECK(std::abs(deg_of_rad(refraction_rad(rad_of_deg(5 - 9.88 / 60))) * 60 - 9.88) < 0.1);
  CHECK(refraction_rad(rad_of_deg(90)) < rad_of_deg(0.001));
  for (double elevation_deg = -90; elevation_deg <= 90; elevation_deg += 0.5) {
    CHECK(refraction_rad(rad_of_deg(elevation_deg)) >= 0);
    CHECK(refraction_rad(rad_of_deg(elevation_deg)) < rad_of_deg(0.7));
  }
}

TEST_CASE("azimuth and elevation of the project place the sun against world X") {
  Project project = in_sun();
  project.light.sun = {90, 30};
  project.camera.yaw_deg = 90;
  const Scene scene = open_scene(project, sample_footage()).value();
  const SceneMoment moment = scene_at(scene, 0);
  // To the right of world X, where the camera looks.
  CHECK(glm::distance(moment.to_sun_in_camera, glm::dvec3(std::sqrt(0.75), 0, -0.5)) < 1e-12);
  CHECK(glm::distance(moment.up_in_camera, glm::dvec3(0, 0, -1)) < 1e-12);
  CHECK(moment.sun_visible_share == 1);
}

TEST_CASE("time and place put the sun against the world's heading, and it moves from frame to frame") {
  const double noon_s = utc_s(2021, 6, 21, 12);
  const Scene scene = scene_under(noon_s, {52.52, 13.405, 34}, 200);
  const glm::dvec2 at_start = angles_deg(sunlight_at(scene, 0).to_sun);
  CHECK(std::abs(at_start.x - 3.723) < 0.01);
  CHECK(std::abs(at_start.y - 59.2956) < 0.01);  // with refraction, by NREL's algorithm
  // An hour later it stands where sun_position() of that hour says, some 20 degrees on.
  const glm::dvec2 later = angles_deg(sunlight_at(scene, 3600).to_sun);
  CHECK(later.x - at_start.x > 15);
  CHECK(later.x - at_start.x < 35);
}

TEST_CASE("of an elevation alone that the project states, the azimuth follows from time and place") {
  Scene scene = scene_under(utc_s(2021, 6, 21, 12), {52.52, 13.405, 34}, 200);
  scene.light.sun_elevation_rad = rad_of_deg(20);
  const glm::dvec2 angles = angles_deg(sunlight_at(scene, 0).to_sun);
  CHECK(std::abs(angles.x - 3.723) < 0.01);
  CHECK(std::abs(angles.y - 20) < 1e-9);
}

TEST_CASE("a sun below the horizon gives no light of its own, one on it half") {
  Project project = in_sun();
  const auto share = [&](double elevation_deg) {
    project.light.sun = {10, elevation_deg};
    return scene_at(open_scene(project, sample_footage()).value(), 0).sun_visible_share;
  };
  CHECK(share(0.3) == 1);
  CHECK(share(0) == doctest::Approx(0.5));
  CHECK(share(-0.3) == 0);
  CHECK(share(-90) == 0);
  CHECK(share(90) == 1);
  CHECK(share(0.1) > share(-0.1));
}

TEST_CASE("a sun that nobody placed is an error that names the field and what to do") {
  Project project = in_sun();
  const Result<Scene> nothing = open_scene(project, sample_footage());
  REQUIRE_FALSE(nothing.has_value());
  CHECK(nothing.error().text().find("light.sun.azimuth_deg") != std::string::npos);
  CHECK(nothing.error().text().find("camera.track") != std::string::npos);
  project.light.sun.azimuth_deg = 10;
  const Result<Scene> half = open_scene(project, sample_footage());
  REQUIRE_FALSE(half.has_value());
  CHECK(half.error().text().find("light.sun.elevation_deg") != std::string::npos);
  project.footage.spectrum = Spectrum::thermal;  // its light has no effect
  CHECK(open_scene(project, sample_footage()).has_value());
  project.footage.spectrum = Spectrum::visible;
  project.light.kind = LightKind::point;
  CHECK(open_scene(project, sample_footage()).has_value());
}

TEST_CASE("a draft shows a sun that nobody placed above the horizon, and names the problem") {
  SceneFiles files;
  const DraftScene draft = draft_scene(in_sun(), sample_footage(), files);
  REQUIRE(draft.problems.size() == 1);
  CHECK(draft.problems.front().field == "light.sun.azimuth_deg");
  const Sunlight sun = sunlight_at(draft.scene, 0);
  CHECK(sun.visible_share == 1);
  CHECK(glm::length(sun.to_sun) == doctest::Approx(1));
  CHECK(-sun.to_sun.z > 0.5);
}
