// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "base/pose.h"
#include "labels/label_text.h"
#include "labels/label_writing.h"
#include "labels/labels.h"
#include "support/files.h"
#include "support/process.h"
#include "support/test_data.h"

namespace sigs::test {

using namespace labels;

namespace {

FrameTruth logged_frame(int index) {
  FrameTruth frame = frame_of(index, {visible_intruder(0, {10, 20, 30, 40})});
  frame.camera_position_m = {12.5, -3, -150};
  frame.world_from_camera = rotation_of({rad_of_deg(1.5), rad_of_deg(-2.25), rad_of_deg(30)});
  frame.camera = {.position_source = "PX4 ULog: \"gps\", raw",
                  .attitude_source = "PX4 ULog: vehicle_attitude",
                  .attitude_sd_rad = glm::dvec3(rad_of_deg(0.25), rad_of_deg(0.5), rad_of_deg(1)),
                  .place = GeodeticPosition{33.1253688123, -117.3310670456, 15.711}};
  frame.intruders[0].place = GeodeticPosition{-33.5, 179.999999999, 1200};
  frame.intruders[0].lights = {{"left", {20.5, 7}, 1, 0.25}};
  frame.intruders[0].lights_alone = frame.intruders[0].has_shadow = frame.intruders[0].has_contrail = true;
  frame.intruders[0].clouds = CloudTruth{.hidden = 0.25, .assumed_distance_m = 1500};
  return frame;
}

const LabelSequence& one_frame() {
  static const LabelSequence clip = synthetic_sequence(117, 117, {"airplane"});
  return clip;
}

}  // namespace

TEST_CASE("XML says where the camera's pose comes from, how sure it is and where on the Earth, by the schema") {
  const TemporaryFolder folder;
  write_labels("xml", folder / "l.xml", one_frame(), {logged_frame(117)});
  pugi::xml_document document;
  REQUIRE(document.load_file((folder / "l.xml").c_str()));
  const pugi::xml_node frame = document.child("sigs").child("frame");
  const pugi::xml_node camera = frame.child("camera");
  CHECK(std::string(camera.attribute("position_source").value()) == "PX4 ULog: \"gps\", raw");
  CHECK(std::string(camera.attribute("attitude_source").value()) == "PX4 ULog: vehicle_attitude");
  CHECK(std::string(camera.attribute("sd_x_deg").value()) == "0.25");
  CHECK(std::string(camera.attribute("sd_z_deg").value()) == "1");
  CHECK(std::string(camera.child("place").attribute("latitude_deg").value()) == "33.125368812");
  CHECK(std::string(frame.child("intruder").child("place").attribute("longitude_deg").value()) == "179.999999999");
  const std::string schema = (source_dir() / "docs/sigs-annotations.xsd").string();
  CHECK(
      run_together("xmllint --noout --nonet --schema '" + schema + "' '" + (folder / "l.xml").string() + "'").status ==
      0);
}

TEST_CASE("a deviation that is infinite or not a number is written as 180 degrees") {
  const TemporaryFolder folder;
  FrameTruth frame = logged_frame(117);
  const double unknown = std::numeric_limits<double>::infinity();
  frame.camera.attitude_sd_rad = glm::dvec3(unknown, std::nan(""), 100);
  write_labels("xml", folder / "l.xml", one_frame(), {frame});
  pugi::xml_document document;
  REQUIRE(document.load_file((folder / "l.xml").c_str()));
  const pugi::xml_node camera = document.child("sigs").child("frame").child("camera");
  for (const char* const name : {"sd_x_deg", "sd_y_deg", "sd_z_deg"})
    CHECK(std::string(camera.attribute(name).value()) == "180");
}

TEST_CASE("without a log the files say nothing of a source") {
  const TemporaryFolder folder;
  const FrameTruth plain = frame_of(117, {visible_intruder(0, {10, 20, 30, 40})});
  write_labels("xml", folder / "l.xml", one_frame(), {plain});
  write_labels("aot", folder / "l.aot.json", one_frame(), {plain});
  write_labels("kitti", folder / "kitti", one_frame(), {plain});
  CHECK(text_of(folder / "l.xml").find("source") == std::string::npos);
  CHECK(text_of(folder / "l.xml").find("place") == std::string::npos);
  CHECK(text_of(folder / "l.aot.json").find("camera") == std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder / "kitti" / "poses"));
}

TEST_CASE("AOT's entities have the camera's pose, source, deviation and place") {
  const TemporaryFolder folder;
  FrameTruth empty = logged_frame(118);
  empty.intruders.clear();
  write_labels("aot", folder / "l.json", synthetic_sequence(117, 118, {"airplane"}), {logged_frame(117), empty});
  const auto json = nlohmann::json::parse(text_of(folder / "l.json"));
  for (const auto& entity : json.at("samples").begin()->at("entities")) {
    const auto& camera = entity.at("blob").at("camera");
    CHECK(camera.at("position_m").dump() == "[12.5,-3,-150]");
    CHECK(camera.at("attitude_deg").dump() == "[1.5,-2.25,30]");
    CHECK(camera.at("position_source").get<std::string>() == "PX4 ULog: \"gps\", raw");
    CHECK(camera.at("attitude_sd_deg").dump() == "[0.25,0.5,1]");
    CHECK(camera.at("place").at(0).get<double>() == doctest::Approx(33.125368812).epsilon(1e-12));
  }
}

TEST_CASE("KITTI's poses take points of the camera's optical axes to those of a level camera at the origin") {
  const TemporaryFolder folder;
  write_labels("kitti", folder / "k", one_frame(), {logged_frame(117)});
  const std::string name = word_name(one_frame().name);
  std::istringstream row(text_of(folder / "k" / "poses" / (name + ".txt")));
  std::vector<double> m(12);
  for (double& number : m) REQUIRE_FALSE((row >> number).fail());
  // A point 100 m ahead, 7 m right and 3 m down, by the world's axes: x right = Y, y down = Z, z forward = X.
  const glm::dvec3 in_camera(100, 7, 3);
  const FrameTruth frame = logged_frame(117);
  const glm::dvec3 in_world = frame.world_from_camera * in_camera + frame.camera_position_m;
  const glm::dvec3 optical(7, 3, 100);
  const glm::dvec3 expected(in_world.y, in_world.z, in_world.x);
  for (int r = 0; r < 3; ++r) {
    const auto at = static_cast<std::size_t>(4 * r);
    const double found = m[at] * optical.x + m[at + 1] * optical.y + m[at + 2] * optical.z + m[at + 3];
    CHECK(std::abs(found - expected[r]) < 1e-5);
  }
  const std::string csv = text_of(folder / "k" / "poses" / (name + ".csv"));
  CHECK(csv.find("\"PX4 ULog: \"\"gps\"\", raw\"") != std::string::npos);
}

}  // namespace sigs::test
