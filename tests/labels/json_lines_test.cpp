// SPDX-License-Identifier: MIT
#include "labels/formats.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <map>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <string>

#include "base/pose.h"
#include "labels/label_writing.h"
#include "support/comma_locale.h"
#include "support/files.h"
#include "support/test_data.h"

namespace sigs::test {

using namespace labels;

namespace {

using Values = std::map<std::string, std::string>;

// Full truth, the second with what not every format has.
IntruderTruth everything(int id, const std::string& name) {
  IntruderTruth truth = full_truth(id);
  truth.name = name;
  truth.is_distractor = truth.has_contrail = truth.has_shadow = truth.lights_alone = id == 1;
  if (id == 1) truth.clouds = CloudTruth{.hidden = 0.123456789, .assumed_distance_m = 1500};
  if (id == 1)
    truth.lights = {{"left", {20.12345678, 7}, 1, 0.25}, {"strobe left", {20.12345678, 7}, 0.3333333333, 12}};
  return truth;
}

FrameTruth whole_frame(const std::string& name) {
  FrameTruth frame = frame_of(117, {everything(0, name), everything(1, name), invisible_intruder(2)});
  frame.substituted = true;
  frame.camera_position_m = {39.123456789, -0.0, -150};
  frame.world_from_camera = rotation_of({rad_of_deg(1.5), rad_of_deg(-2.25), rad_of_deg(30)});
  frame.camera = {.position_source = "a log",
                  .attitude_source = name,
                  .attitude_sd_rad = glm::dvec3(0.001, 0.002, 0.1),
                  .place = GeodeticPosition{-33.9, 151.2, 100}};
  return frame;
}

// Attributes of an element and of those in it, by their path. Elements of one name are numbered.
void collect(const pugi::xml_node& node, const std::string& path, Values& values) {
  for (const pugi::xml_attribute attribute : node.attributes()) values[path + attribute.name()] = attribute.value();
  std::map<std::string, int> numbers;
  for (const pugi::xml_node child : node.children()) {
    const std::string name = child.name();
    const bool is_listed = name == "intruder" || name == "well_clear" || name == "light";
    const std::string number = is_listed ? std::to_string(numbers[name]++) + "." : "";
    collect(child, path + name + "." + number, values);
  }
}

// The text of each value as it stands in the line, so that digits are compared. Lists have the singular's name.
void collect(const nlohmann::json& json, const std::string& path, Values& values) {
  for (const auto& [key, value] : json.items()) {
    if (value.is_array())
      for (std::size_t i = 0; i < value.size(); ++i)
        collect(value[i],
                path + (key.ends_with('s') ? key.substr(0, key.size() - 1) : key) + "." + std::to_string(i) + ".",
                values);
    else if (value.is_object())
      collect(value, path + key + ".", values);
    else
      values[path + key] = value.is_string() ? value.get<std::string>() : value.dump();
  }
}

LabelSequence three_intruders() {
  LabelSequence clip = synthetic_sequence(117, 117, {"airplane", "drone", "bird"});
  clip.volumes = {"dwc-en-route", "nmac"};
  return clip;
}

double as_number(const std::string& text) {
  return std::stod(text);
}

}  // namespace

TEST_CASE("a line of JSON has every attribute of the XML file's frame, and nothing else but three") {
  const CommaLocale comma;
  for (const std::string& name : special_names()) {
    const TemporaryFolder folder;
    write_labels("xml", folder / "l.xml", three_intruders(), {whole_frame(name)});
    write_labels("jsonl", folder / "l.jsonl", three_intruders(), {whole_frame(name)});
    pugi::xml_document document;
    REQUIRE(document.load_file((folder / "l.xml").c_str()));
    Values xml;
    collect(document.child("sigs").child("frame"), "", xml);
    const std::vector<std::string> lines = lines_of(folder / "l.jsonl");
    REQUIRE(lines.size() == 1);
    Values json;
    collect(nlohmann::json::parse(lines.front()), "", json);
    CHECK(json.erase("width") + json.erase("height") == 2);
    for (const char* const id : {"0", "1", "2"}) CHECK(json.erase(std::string("intruder.") + id + ".category") == 1);
    // The camera's position and attitude are attributes of one element there, <distance m> is distance_m here.
    Values expected;
    for (const auto& [path, value] : xml) {
      std::string key = path;
      if (key.starts_with("camera.") && key.find('.', 7) == std::string::npos) {
        const std::string last = key.substr(7);
        if (last == "x_m" || last == "y_m" || last == "z_m") key = "camera.position." + last;
        if (last == "roll_deg" || last == "pitch_deg" || last == "yaw_deg") key = "camera.attitude." + last;
      }
      if (key.ends_with("distance.m")) key.replace(key.size() - 10, 10, "distance_m");
      expected[key] = value;
    }
    CHECK(expected.size() > 90);
    for (const auto& [field, value] : expected) {
      const std::string& key = field;
      REQUIRE_MESSAGE(json.contains(key), key);
      const bool is_number = value.find_first_not_of("0123456789.-") == std::string::npos && value != name;
      if (is_number)
        CHECK_MESSAGE(as_number(json[key]) == as_number(value), key);
      else
        CHECK_MESSAGE(json[key] == value, key);
      json.erase(key);
    }
    CHECK(json.empty());
  }
}

TEST_CASE("the digits of a line's numbers are those of the XML file") {
  const std::string line = json_line_of(whole_frame("x"), three_intruders());
  for (const char* const piece :
       {"\"x_m\":899.234568,", "\"z_m\":-20}", "\"yaw_deg\":-180}", "\"visible_fraction\":0.666667,", "\"x\":300.6234,",
        "\"latitude_deg\":48.123456789,", "\"vmd_m\":-100000000,", "\"y_m\":0,"})
    CHECK_MESSAGE(line.find(piece) != std::string::npos, piece);
  CHECK(line.find("coaltitude") == std::string::npos);
  CHECK(line.back() == '\n');
  CHECK(line.find('\n') == line.size() - 1);
}

TEST_CASE("a stream has each line at once, and the lines of the file") {
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  JsonLinesStream stream(OutputStream::of_descriptor(ends[1], "pipe").value(), three_intruders());
  ::close(ends[1]);
  const TemporaryFolder folder;
  FrameTruth second = whole_frame("b");
  second.index = 118;
  write_labels("jsonl", folder / "l.jsonl", three_intruders(), {whole_frame("a"), second});
  const std::vector<std::string> lines = lines_of(folder / "l.jsonl");
  REQUIRE(lines.size() == 2);
  std::vector<FrameTruth> frames{whole_frame("a"), second};
  for (std::size_t i = 0; i < 2; ++i) {
    REQUIRE(stream.write(frames[i]));
    std::string bytes(8000, '\0');
    bytes.resize(static_cast<std::size_t>(::read(ends[0], bytes.data(), bytes.size())));
    CHECK(bytes == lines[i] + "\n");
  }
  REQUIRE(stream.finish({}));
  char byte = 0;
  CHECK(::read(ends[0], &byte, 1) == 0);
  ::close(ends[0]);
}

}  // namespace sigs::test
