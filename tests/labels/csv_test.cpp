// SPDX-License-Identifier: MIT
#include "labels/formats.h"

#include <doctest/doctest.h>

#include <map>
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

namespace fs = std::filesystem;

using CsvRow = std::vector<std::string>;

// RFC 4180, letter by letter.
std::vector<CsvRow> csv_rows(const std::string& text) {
  std::vector<CsvRow> rows{{""}};
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"')
      rows.back().back() += text[++i];
    else if (c == '"')
      quoted = !quoted;
    else if (!quoted && c == ',')
      rows.back().emplace_back();
    else if (!quoted && c == '\r' && text.at(i + 1) == '\n')
      ++i, rows.push_back({""});
    else
      rows.back().back() += c;
  }
  REQUIRE(rows.back() == CsvRow{""});
  rows.pop_back();
  return rows;
}

std::vector<std::map<std::string, std::string>> table_of(const fs::path& path) {
  const std::vector<CsvRow> rows = csv_rows(text_of(path));
  std::vector<std::map<std::string, std::string>> table;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    REQUIRE(rows[i].size() == rows[0].size());
    table.emplace_back();
    for (std::size_t k = 0; k < rows[0].size(); ++k) table.back()[rows[0][k]] = rows[i][k];
  }
  return table;
}

FrameTruth full_frame() {
  FrameTruth frame = frame_of(117, {full_truth(0), invisible_intruder(1)});
  frame.camera_position_m = {39.123456789, -0.0, -150};
  frame.world_from_camera = rotation_of({rad_of_deg(1.5), rad_of_deg(-2.25), rad_of_deg(30)});
  return frame;
}

}  // namespace

TEST_CASE("every number of the XML file is in the CSV file, character by character") {
  const TemporaryFolder folder;
  LabelSequence clip = synthetic_sequence(117, 117, {"airplane", "drone"});
  clip.volumes = {"dwc-en-route", "nmac"};
  write_labels("xml", folder / "l.xml", clip, {full_frame()});
  write_labels("csv", folder / "l.csv", clip, {full_frame()});
  pugi::xml_document document;
  REQUIRE(document.load_file((folder / "l.xml").c_str()));
  const pugi::xml_node frame = document.child("sigs").child("frame");
  const auto table = table_of(folder / "l.csv");
  REQUIRE(table.size() == 2);
  std::size_t i = 0;
  int compared = 0;
  for (const pugi::xml_node& intruder : frame.children("intruder")) {
    auto row = table[i++];
    const auto compare = [&](const pugi::xml_node& node, const char* attribute, const std::string& column) {
      REQUIRE_MESSAGE(row.count(column) == 1, column);
      CHECK_MESSAGE(row[column] == node.attribute(attribute).value(), column);
      ++compared;
    };
    compare(frame, "index", "frame");
    compare(frame, "time_s", "time_s");
    for (const char* name : {"x_m", "y_m", "z_m", "roll_deg", "pitch_deg", "yaw_deg"})
      compare(frame.child("camera"), name, std::string("camera_") + name);
    for (const char* name : {"id", "name", "in_picture", "visible_fraction", "horizon"}) compare(intruder, name, name);
    for (const char* name : {"x_m", "y_m", "z_m"}) compare(intruder.child("position"), name, name);
    for (const char* name : {"roll_deg", "pitch_deg", "yaw_deg"}) compare(intruder.child("attitude"), name, name);
    compare(intruder.child("distance"), "m", "distance_m");
    compare(intruder.child("box"), "pixels", "visible_pixels");
    for (const std::string name : {"x", "y", "width", "height"}) {
      compare(intruder.child("box"), name.c_str(), "box_" + name + "_px");
      compare(intruder.child("silhouette"), name.c_str(), "silhouette_" + name + "_px");
    }
    for (const char* name :
         {"weber_contrast", "rms_contrast", "signal_to_noise", "blur_px", "motion_blur_px", "visibility_m"})
      compare(intruder.child("appearance"), name, name);
    const pugi::xml_node encounter = intruder.child("encounter");
    for (const char* name : {"range_rate_mps", "closing_speed_mps", "bearing_deg", "elevation_deg", "hmd_m", "vmd_m",
                             "time_to_closest_approach_s", "time_to_coaltitude_s"})
      compare(encounter, name, name);
    for (const auto& [volume, column] : {std::pair("dwc-en-route", "dwc_en_route_"), std::pair("nmac", "nmac_")})
      for (const std::string name : {"lost", "tau_mod_s", "severity"})
        compare(encounter.find_child_by_attribute("well_clear", "volume", volume), name.c_str(), column + name);
  }
  CHECK(compared == 2 * 49);
}

TEST_CASE("times that do not come have empty fields in CSV, and no attribute in XML; all others are there") {
  const TemporaryFolder folder;
  LabelSequence clip = synthetic_sequence(117, 117, {"airplane", "drone"});
  clip.volumes = {"dwc-en-route", "nmac"};
  write_labels("csv", folder / "l.csv", clip, {full_frame()});
  auto row = table_of(folder / "l.csv").at(0);
  for (const char* const name : {"time_to_coaltitude_s", "nmac_tau_mod_s"}) CHECK(row.at(name).empty());
  CHECK(row.at("bearing_deg") == "-12.5");
  CHECK(row.at("vmd_m") == "-100000000");
  CHECK(row.at("time_to_closest_approach_s") == "1000000000000000");
  CHECK(row.at("dwc_en_route_lost") == "true");
  CHECK(row.at("dwc_en_route_tau_mod_s") == "17.25");
  CHECK(row.at("dwc_en_route_severity") == "42.123457");
  CHECK(row.at("nmac_lost") == "false");
  CHECK(row.at("nmac_severity") == "0");
  // The other intruder of the frame has no encounter: every column is there, and empty.
  CHECK(table_of(folder / "l.csv").at(1).at("range_rate_mps").empty());
  CHECK(table_of(folder / "l.csv").at(1).at("nmac_severity").empty());
  clip.volumes.clear();
  write_labels("csv", folder / "none.csv", clip, {full_frame()});
  CHECK_FALSE(table_of(folder / "none.csv").at(0).contains("range_rate_mps"));
  write_labels("xml", folder / "l.xml", clip, {full_frame()});
  pugi::xml_document document;
  REQUIRE(document.load_file((folder / "l.xml").c_str()));
  const pugi::xml_node encounter = document.child("sigs").child("frame").child("intruder").child("encounter");
  CHECK(encounter.attribute("hmd_m"));
  CHECK_FALSE(encounter.attribute("time_to_coaltitude_s"));
  CHECK(encounter.first_child().attribute("tau_mod_s"));
  CHECK_FALSE(encounter.last_child().attribute("tau_mod_s"));
}

TEST_CASE("a CSV row is complete in itself: it names its clip") {
  const TemporaryFolder folder;
  LabelSequence clip = synthetic_sequence(117, 117, {"airplane", "drone"});
  clip.name = "my clip";
  clip.footage.frame_rate_num = 30000;
  clip.footage.frame_rate_den = 1001;
  write_labels("csv", folder / "l.csv", clip, {full_frame()});
  auto row = table_of(folder / "l.csv").at(1);
  CHECK(row["sequence"] == "my clip");
  CHECK(row["video"] == "flight.mp4");
  CHECK(row["picture_width_px"] == "640");
  CHECK(row["picture_height_px"] == "480");
  CHECK(row["frame_rate"] == "30000/1001");
  CHECK(row["category"] == "drone");
}

TEST_CASE("missing boxes are empty fields, and thresholds leave nothing out") {
  const TemporaryFolder folder;
  LabelSequence clip = synthetic_sequence(0, 1, {"airplane"});
  clip.thresholds = {.min_pixels = 1000, .min_visible_fraction = 1};
  write_labels("csv", folder / "l.csv", clip,
               {frame_of(0, {invisible_intruder(0)}), frame_of(1, {visible_intruder(0, {1, 1, 1, 1})})});
  auto table = table_of(folder / "l.csv");
  REQUIRE(table.size() == 2);
  for (const char* name : {"box_x_px", "box_y_px", "box_width_px", "box_height_px", "visible_pixels", "silhouette_x_px",
                           "silhouette_height_px"})
    CHECK_MESSAGE(table[0][name] == "", name);
  CHECK(table[0]["in_picture"] == "false");
  CHECK(table[1]["box_width_px"] == "1");
  CHECK(table[1]["visible_pixels"] == "1");
}

TEST_CASE("names with CSV's special characters are read back") {
  for (const std::string name : {"a,b", "say \"hello\"", "two\nlines", "cr\r\nlf", "\"", ",", "", "M\xC3\xBCller;x"}) {
    const TemporaryFolder folder;
    FrameTruth frame = frame_of(0, {visible_intruder(0, {1, 1, 1, 1})});
    frame.intruders[0].name = name;
    write_labels("csv", folder / "l.csv", synthetic_sequence(0, 0, {"airplane"}), {frame});
    CHECK(table_of(folder / "l.csv").at(0)["name"] == name);
  }
}

TEST_CASE("a clip without intruders is a CSV header alone") {
  const TemporaryFolder folder;
  write_labels("csv", folder / "l.csv", synthetic_sequence(0, 1, {}), {frame_of(0, {}), frame_of(1, {})});
  CHECK(csv_rows(text_of(folder / "l.csv")).size() == 1);
}

TEST_CASE("CSV labels do not depend on the locale") {
  const TemporaryFolder folder;
  const LabelSequence clip = synthetic_sequence(117, 117, {"airplane", "drone"});
  write_labels("csv", folder / "a.csv", clip, {full_frame()});
  const CommaLocale comma;
  write_labels("csv", folder / "b.csv", clip, {full_frame()});
  CHECK(text_of(folder / "a.csv") == text_of(folder / "b.csv"));
}

}  // namespace sigs::test
