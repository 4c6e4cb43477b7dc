// SPDX-License-Identifier: MIT
#include "labels/formats.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <pugixml.hpp>
#include <string>

#include "base/pose.h"
#include "base/staged_outputs.h"
#include "support/comma_locale.h"
#include "support/death_test.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

// Half a unit of the last digit written, and a little for the reading.
constexpr double kHalfMicro = 0.5000001e-6;
constexpr double kHalfTenthOfMilli = 0.5000001e-4;

IntruderTruth some_intruder() {
  return {.id = 3,
          .name = "airliner",
          .position_m = {899.2345678, -250.1, -20.00000049},
          .world_from_body = rotation_of({rad_of_deg(-3.123456789), rad_of_deg(0.4), rad_of_deg(-179.9999996)}),
          .in_image = true,
          .visible_fraction = 2.0 / 3,
          .visible_box = cv::Rect(301, 0, 41, 13),
          .visible_pixels = 287,
          .amodal_box = Box{300.62341, -1.8833333, 41.375, 13.02},
          .horizon = HorizonSide::above};
}

FrameTruth some_frame() {
  return {.index = 117,
          .time_s = 117 * 1001.0 / 30000,
          .camera_position_m = {39.123456789, -0.0, -150},
          .world_from_camera = rotation_of({rad_of_deg(1.5), rad_of_deg(-2.25), rad_of_deg(30)}),
          .intruders = {some_intruder()}};
}

FootageTruth some_footage() {
  return {.video = "flight.mp4",
          .size_px = {1280, 960},
          .first_frame = 10,
          .last_frame = 12345,
          .frame_rate_num = 30000,
          .frame_rate_den = 1001};
}

pugi::xml_document parsed(const std::string& text) {
  pugi::xml_document document;
  REQUIRE(document.load_string(text.c_str()));
  return document;
}

void check_number(const pugi::xml_node& node, const char* name, double expected, double tolerance) {
  const pugi::xml_attribute attribute = node.attribute(name);
  REQUIRE_MESSAGE(attribute, node.name() << " has no " << name);
  CHECK_MESSAGE(std::abs(attribute.as_double() - expected) <= tolerance,
                node.name() << " " << name << " is " << attribute.value());
}

std::string name_read_back(const std::string& name) {
  FrameTruth truth = some_frame();
  truth.intruders[0].name = name;
  const pugi::xml_document document = parsed(xml_of(truth));
  return document.child("frame").child("intruder").attribute("name").value();
}

std::string file_of(const FootageTruth& footage, const std::vector<FrameTruth>& frames) {
  const TemporaryFolder folder;
  Result<std::unique_ptr<LabelWriter>> writer = open_sigs_xml(folder / "truth.xml", {.footage = footage});
  REQUIRE(writer.has_value());
  for (const FrameTruth& frame : frames) REQUIRE((*writer)->write(frame).has_value());
  REQUIRE((*writer)->finish({}).has_value());
  return *read_text(folder / "truth.xml");
}

}  // namespace

TEST_CASE("a frame read back has the values that were written") {
  const FrameTruth truth = some_frame();
  const pugi::xml_document document = parsed(xml_of(truth));
  const pugi::xml_node frame = document.child("frame");
  CHECK(frame.attribute("index").as_int() == 117);
  check_number(frame, "time_s", truth.time_s, kHalfMicro);
  const pugi::xml_node camera = frame.child("camera");
  check_number(camera, "x_m", 39.123456789, kHalfMicro);
  check_number(camera, "y_m", 0, 0);
  check_number(camera, "z_m", -150, 0);
  check_number(camera, "roll_deg", 1.5, kHalfMicro);
  check_number(camera, "pitch_deg", -2.25, kHalfMicro);
  check_number(camera, "yaw_deg", 30, kHalfMicro);
}

TEST_CASE("how an intruder stands out is written where it can be seen, the visibility only in haze") {
  FrameTruth truth = some_frame();
  CHECK_FALSE(parsed(xml_of(truth)).child("frame").child("intruder").child("appearance"));
  truth.intruders[0].detectability = Detectability{-0.4123456789, 0.447, 7.25};
  truth.intruders[0].image_formation = {.blur_px = 0.45, .motion_blur_px = 1.5};
  const pugi::xml_document clear = parsed(xml_of(truth));
  const pugi::xml_node appearance = clear.child("frame").child("intruder").child("appearance");
  check_number(appearance, "weber_contrast", -0.4123456789, kHalfMicro);
  check_number(appearance, "rms_contrast", 0.447, kHalfMicro);
  check_number(appearance, "signal_to_noise", 7.25, kHalfMicro);
  check_number(appearance, "blur_px", 0.45, kHalfMicro);
  check_number(appearance, "motion_blur_px", 1.5, kHalfMicro);
  CHECK_FALSE(appearance.attribute("visibility_m"));
  truth.intruders[0].image_formation.visibility_m = 20000;
  const pugi::xml_document hazy = parsed(xml_of(truth));
  check_number(hazy.child("frame").child("intruder").child("appearance"), "visibility_m", 20000, kHalfMicro);
}

TEST_CASE("an intruder read back has the values that were written") {
  const pugi::xml_document document = parsed(xml_of(some_frame()));
  const pugi::xml_node intruder = document.child("frame").child("intruder");
  CHECK(intruder.attribute("id").as_int() == 3);
  CHECK(std::string(intruder.attribute("name").value()) == "airliner");
  CHECK(std::string(intruder.attribute("in_picture").value()) == "true");
  check_number(intruder, "visible_fraction", 2.0 / 3, kHalfMicro);
  CHECK(std::string(intruder.attribute("horizon").value()) == "above");
  CHECK(intruder.child("box").attribute("pixels").as_int() == 287);
  check_number(intruder.child("position"), "x_m", 899.2345678, kHalfMicro);
  check_number(intruder.child("position"), "y_m", -250.1, kHalfMicro);
  check_number(intruder.child("position"), "z_m", -20, kHalfMicro);
  check_number(intruder.child("attitude"), "roll_deg", -3.123456789, kHalfMicro);
  check_number(intruder.child("attitude"), "pitch_deg", 0.4, kHalfMicro);
  check_number(intruder.child("attitude"), "yaw_deg", -180, kHalfMicro);
}

TEST_CASE("boxes read back have the values that were written") {
  const pugi::xml_document document = parsed(xml_of(some_frame()));
  const pugi::xml_node box = document.child("frame").child("intruder").child("box");
  CHECK(cv::Rect(box.attribute("x").as_int(-1), box.attribute("y").as_int(-1), box.attribute("width").as_int(-1),
                 box.attribute("height").as_int(-1)) == cv::Rect(301, 0, 41, 13));
  const pugi::xml_node silhouette = document.child("frame").child("intruder").child("silhouette");
  check_number(silhouette, "x", 300.62341, kHalfTenthOfMilli);
  check_number(silhouette, "y", -1.8833333, kHalfTenthOfMilli);
  check_number(silhouette, "width", 41.375, kHalfTenthOfMilli);
  check_number(silhouette, "height", 13.02, kHalfTenthOfMilli);
}

TEST_CASE("the distance is the length of the position") {
  FrameTruth truth = some_frame();
  truth.intruders[0].position_m = {3e3, -4e3, 12e3};
  const pugi::xml_document document = parsed(xml_of(truth));
  check_number(document.child("frame").child("intruder").child("distance"), "m", 13e3, 0);
}

TEST_CASE("a missing box is left out and not written as zeros") {
  FrameTruth truth = some_frame();
  truth.intruders[0].in_image = false;
  truth.intruders[0].visible_fraction = 0;
  truth.intruders[0].visible_box.reset();
  truth.intruders[0].amodal_box.reset();
  const pugi::xml_document document = parsed(xml_of(truth));
  const pugi::xml_node intruder = document.child("frame").child("intruder");
  CHECK(std::string(intruder.attribute("in_picture").value()) == "false");
  CHECK(std::string(intruder.attribute("visible_fraction").value()) == "0");
  CHECK_FALSE(intruder.child("box"));
  CHECK_FALSE(intruder.child("silhouette"));
  CHECK(intruder.child("position"));
}

TEST_CASE("intruders are in the given order and a frame without any has only its camera") {
  FrameTruth truth = some_frame();
  truth.intruders = {some_intruder(), some_intruder(), some_intruder()};
  for (int i = 0; i < 3; ++i) truth.intruders[static_cast<std::size_t>(i)].id = i;
  const pugi::xml_document document = parsed(xml_of(truth));
  int expected = 0;
  for (const pugi::xml_node& intruder : document.child("frame").children("intruder"))
    CHECK(intruder.attribute("id").as_int() == expected++);
  CHECK(expected == 3);
  truth.intruders.clear();
  const pugi::xml_document alone = parsed(xml_of(truth));
  CHECK(alone.child("frame").child("camera"));
  CHECK_FALSE(alone.child("frame").child("intruder"));
}

TEST_CASE("names with XML's special characters are read back") {
  for (const std::string name : {"a & b", "<intruder/>", "say \"hello\"", "it's", "]]>", "&amp;", "a > b < c", ""})
    CHECK(name_read_back(name) == name);
}

TEST_CASE("names in other scripts are read back") {
  for (const std::string name : {"Flugzeug \xC3\xBC", "\xE9\xA3\x9B\xE8\xA1\x8C\xE6\xA9\x9F", "\xF0\x9F\x9B\xA9"})
    CHECK(name_read_back(name) == name);
}

TEST_CASE("a file names its footage and holds the frames in order") {
  FrameTruth second = some_frame();
  second.index = 118;
  FootageTruth footage = some_footage();
  footage.video = "sea & \"sky\" \xC3\xBC.mp4";
  const std::string text = file_of(footage, {some_frame(), second});
  CHECK(text.starts_with("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"));
  const pugi::xml_document document = parsed(text);
  const pugi::xml_node sigs = document.child("sigs");
  CHECK(std::string(sigs.attribute("version").value()) == "1");
  const pugi::xml_node head = sigs.first_child();
  CHECK(std::string(head.name()) == "footage");
  CHECK(std::string(head.attribute("video").value()) == footage.video);
  CHECK(head.attribute("width").as_int() == 1280);
  CHECK(head.attribute("height").as_int() == 960);
  CHECK(head.attribute("first_frame").as_int() == 10);
  CHECK(head.attribute("last_frame").as_int() == 12345);
  CHECK(std::string(head.attribute("frame_rate").value()) == "30000/1001");
  CHECK(head.next_sibling("frame").attribute("index").as_int() == 117);
  CHECK(sigs.last_child().attribute("index").as_int() == 118);
}

TEST_CASE("a file does not depend on the locale") {
  const std::string expected = file_of(some_footage(), {some_frame()});
  const CommaLocale comma;
  const std::string found = file_of(some_footage(), {some_frame()});
  CHECK(found == expected);
  CHECK(expected.find("last_frame=\"12345\"") != std::string::npos);
}

TEST_CASE("a number that is not finite stops the program before it is written") {
  constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
  const auto write = [](const auto& spoil) {
    return aborts([&spoil] {
      FrameTruth truth = some_frame();
      spoil(truth);
      static_cast<void>(xml_of(truth));
    });
  };
  CHECK_FALSE(write([](FrameTruth&) {}));
  CHECK(write([](FrameTruth& truth) { truth.time_s = kNotANumber; }));
  CHECK(write([](FrameTruth& truth) { truth.camera_position_m.y = kNotANumber; }));
  CHECK(write([](FrameTruth& truth) { truth.world_from_camera.x = kNotANumber; }));
  CHECK(write([](FrameTruth& truth) { truth.intruders[0].position_m.z = kNotANumber; }));
  CHECK(write([](FrameTruth& truth) { truth.intruders[0].world_from_body.y = kNotANumber; }));
  CHECK(write([](FrameTruth& truth) { truth.intruders[0].visible_fraction = kNotANumber; }));
  CHECK(write([](FrameTruth& truth) { truth.intruders[0].amodal_box->width = kNotANumber; }));
}

TEST_CASE("a missing folder is an error that names the file") {
  const TemporaryFolder folder;
  const Result<std::unique_ptr<LabelWriter>> writer =
      open_sigs_xml(folder / "missing" / "truth.xml", {.footage = some_footage()});
  REQUIRE_FALSE(writer.has_value());
  CHECK(writer.error().kind == ErrorKind::cannot_create);
  CHECK(writer.error().where == (folder / "missing" / "truth.xml").string());
}

TEST_CASE("a full disk is an error") {
  if (!std::filesystem::exists("/dev/full")) return;
  Result<std::unique_ptr<LabelWriter>> writer = open_sigs_xml("/dev/full", {.footage = some_footage()});
  if (writer.has_value()) {
    const Result<void> finished = (*writer)->finish({});
    REQUIRE_FALSE(finished.has_value());
    CHECK(finished.error().kind == ErrorKind::write_failed);
  } else {
    CHECK(writer.error().kind == ErrorKind::write_failed);
  }
}

}  // namespace sigs::test
