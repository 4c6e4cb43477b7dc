// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <limits>
#include <regex>
#include <string>
#include <vector>

#include "base/pose.h"
#include "base/staged_outputs.h"
#include "docs/markdown.h"
#include "labels/formats.h"
#include "support/process.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

bool has_xmllint() {
  static const bool there = run_together("xmllint --version").status == 0;
  if (!there) say_skipped("xmllint (libxml2-utils) is absent");
  return there;
}

Run checked(const std::string& xml) {
  const TemporaryFolder folder;
  REQUIRE(write_text(folder / "truth.xml", xml, false).has_value());
  return run_together("xmllint --noout --nonet --schema '" + (source_dir() / "docs/sigs-annotations.xsd").string() +
                      "' '" + (folder / "truth.xml").string() + "'");
}

void check_valid(const std::string& xml) {
  const Run finished = checked(xml);
  CHECK_MESSAGE(finished.status == 0, finished.out);
}

// Exit status 3 is "does not validate"; anything else would mean that the schema or the XML itself is broken.
void check_invalid(const std::string& xml, const std::string& why) {
  const Run finished = checked(xml);
  CHECK_MESSAGE(finished.status == 3, why << " gives " << finished.status << "\n" << finished.out);
}

IntruderTruth visible_intruder(int id) {
  return {.id = id,
          .name = "airliner <\"A&B\">",
          .position_m = {899.25, -1e8, -20},
          .world_from_body = rotation_of(id == 0 ? Attitude{.roll_rad = rad_of_deg(180), .yaw_rad = rad_of_deg(-100)}
                                                 : Attitude{.pitch_rad = rad_of_deg(-90)}),
          .in_image = true,
          .visible_fraction = 0.5,
          .visible_box = cv::Rect(0, 7, 41, 13),
          .visible_pixels = 287,
          .amodal_box = Box{-1e6, 0.00004, 2e6, 0},
          .horizon = HorizonSide::on,
          .place = GeodeticPosition{48.125, -11.5, 612.25},
          .detectability = Detectability{-0.5, 0.75, 12},
          .image_formation = {.blur_px = 0.45, .motion_blur_px = 2, .visibility_m = 20000},
          .encounter = EncounterTruth{.range_rate_mps = -61.5,
                                      .closing_speed_mps = 61.5,
                                      .bearing_rad = rad_of_deg(180),
                                      .elevation_rad = rad_of_deg(-90),
                                      .hmd_m = 1e8,
                                      .vmd_m = -1e8,
                                      .time_to_closest_approach_s = 1e15,
                                      .time_to_coaltitude_s = std::numeric_limits<double>::infinity(),
                                      .of_volumes = {{"dwc-en-route", true, 17.25, 100},
                                                     {"nmac", false, std::numeric_limits<double>::infinity(), 0}}},
          .has_contrail = true,
          .has_shadow = true,
          .lights = {{"strobe left", {20.25, 12.5}, 0.125, 3.5}, {"tail", {-0.5, 12}, 1, 0.01}},
          .lights_alone = true,
          .clouds = CloudTruth{.hidden = 0.25, .assumed_distance_m = 1500},
          .is_distractor = true};
}

IntruderTruth invisible_intruder(int id) {
  return {.id = id, .position_m = {-5, 0, 0}};
}

std::string written() {
  const TemporaryFolder folder;
  const FootageTruth footage{.video = "flight.mp4", .size_px = {1280, 960}, .first_frame = 4, .last_frame = 6};
  Result<std::unique_ptr<LabelWriter>> writer = open_sigs_xml(folder / "truth.xml", {.footage = footage});
  REQUIRE(writer.has_value());
  REQUIRE((*writer)->write({.index = 4, .time_s = 0.16, .camera_position_m = {3.2, 0, -150}}).has_value());
  REQUIRE((*writer)->write({.index = 5, .time_s = 0.2, .intruders = {visible_intruder(0)}}).has_value());
  REQUIRE((*writer)
              ->write({.index = 6, .time_s = 0.24, .intruders = {invisible_intruder(0), visible_intruder(1)}})
              .has_value());
  REQUIRE((*writer)->finish({}).has_value());
  return *read_text(folder / "truth.xml");
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  REQUIRE_MESSAGE(place != std::string::npos, from);
  return text.replace(place, from.size(), to);
}

struct Change {
  const char* from;
  const char* to;
};

const std::vector<Change> kBroken{
    {"version=\"1\">", "version=\"2\">"},
    {" width=\"1280\"", ""},
    {" width=\"1280\"", " width=\"0\""},
    {"frame_rate=\"25/1\"", "frame_rate=\"25\""},
    {"frame_rate=\"25/1\"", "frame_rate=\"25/0\""},
    {"index=\"4\"", "index=\"5\""},
    {"index=\"4\"", "index=\"-4\""},
    {"time_s=\"0.16\"", "time_s=\"nan\""},
    {"time_s=\"0.16\"", "time_s=\"1.6e-1\""},
    {"time_s=\"0.16\"", "time_s=\"0,16\""},
    {"time_s=\"0.16\"", "time_s=\"0.1234567\""},
    {"y_m=\"0\"", "y_m=\"-0\""},
    {"y_m=\"0\"", "y_m=\"inf\""},
    {" z_m=\"-150\"", ""},
    {"z_m=\"-150\"", "z_m=\"-150\" w_m=\"0\""},
    {"roll_deg=\"180\"", "roll_deg=\"180.5\""},
    {"pitch_deg=\"-90\"", "pitch_deg=\"-91\""},
    {"in_picture=\"true\"", "in_picture=\"1\""},
    {"visible_fraction=\"0.5\"", "visible_fraction=\"1.5\""},
    {"visible_fraction=\"0.5\"", "visible_fraction=\"-0.5\""},
    {"horizon=\"on\"", "horizon=\"in\""},
    {"pixels=\"287\"", "pixels=\"0\""},
    {"<distance", "<range"},
    {"<distance m=\"", "<distance m=\"-"},
    {"<box x=\"0\" y=\"7\" width=\"41\"", "<box x=\"0.5\" y=\"7\" width=\"41\""},
    {"<box x=\"0\" y=\"7\" width=\"41\"", "<box x=\"-1\" y=\"7\" width=\"41\""},
    {"<box x=\"0\" y=\"7\" width=\"41\"", "<box x=\"0\" y=\"7\" width=\"0\""},
    {"<silhouette x=\"-1000000\" y=\"0\" width=\"2000000\"", "<silhouette x=\"-1000000\" y=\"0\" width=\"-1\""},
    {"id=\"1\"", "id=\"0\""},
    {" name=\"airliner", " title=\"airliner"},
    {"contrail=\"true\"", "contrail=\"yes\""},
    {"<light name=\"tail\"", "<light title=\"tail\""},
    {"share=\"0.125\"", "share=\"1.125\""},
    {"brightest=\"3.5\"", "brightest=\"-3.5\""},
    {"rms_contrast=\"0.75\"", "rms_contrast=\"-0.75\""},
    {"visibility_m=\"20000\"", "visibility_km=\"20\""},
    {"hidden=\"0.25\"", "hidden=\"1.25\""},
    {"<well_clear ", "<well-clear "},
    {" range_rate_mps=\"-61.5\"", ""},
    {"range_rate_mps=\"-61.5\"", "range_rate_mps=\"-6.15e1\""},
    {"bearing_deg=\"180\"", "bearing_deg=\"270\""},
    {"hmd_m=\"100000000\"", "hmd_m=\"-1\""},
    {"time_to_closest_approach_s=\"1000000000000000\"", "time_to_closest_approach_s=\"inf\""},
    {"volume=\"nmac\"", "volume=\"dwc-en-route\""},
    {"lost=\"true\"", "lost=\"yes\""},
    {" lost=\"true\"", ""},
    {"tau_mod_s=\"17.25\"", "tau_mod_s=\"-17.25\""},
    {"severity=\"100\"", "severity=\"100.5\""},
    {"</sigs>", "<extra/></sigs>"},
    {"</sigs>", "<footage/></sigs>"},
};

}  // namespace

TEST_CASE("a written annotation file is valid by the schema") {
  if (!has_xmllint()) return;
  check_valid(written());
}

TEST_CASE("the example on the annotation format's page is valid by the schema") {
  if (!has_xmllint()) return;
  const std::vector<std::string> examples = blocks(page("annotation-format.md"), "xml");
  REQUIRE(!examples.empty());
  for (const std::string& example : examples) check_valid(example);
}

TEST_CASE("each attribute that is written is described, those of the appearance also for other formats and Python") {
  const std::string text = written();
  const auto check_described = [&](const std::string& names, const std::string& where, const std::string& described) {
    const std::regex attribute(R"re(([a-z_]+)=")re");
    int count = 0;
    for (std::sregex_iterator it(names.begin(), names.end(), attribute), end; it != end; ++it, ++count)
      CHECK_MESSAGE(std::regex_search(described, std::regex("\\b" + it->str(1) + "\\b")), it->str(1)
                                                                                              << " in " << where);
    return count;
  };
  CHECK(check_described(text.substr(text.find("<sigs")), "docs/annotation-format.md", page("annotation-format.md")) >
        100);
  const std::size_t begin = text.find("<appearance ");
  const std::string appearance = text.substr(begin, text.find("/>", begin) - begin);
  CHECK(check_described(appearance, "docs/label-formats.md", page("label-formats.md")) == 6);
  CHECK(check_described(appearance, "python/sigs/truth.py", *read_text(source_dir() / "python/sigs/truth.py")) == 6);
}

// As sigs wrote it before annotations had sides of the horizon, contrasts and encounters.
TEST_CASE("an annotation file of an older sigs is valid by the schema") {
  if (!has_xmllint()) return;
  check_valid(R"(<?xml version="1.0" encoding="UTF-8"?>
<sigs version="1">
  <footage video="flight.mp4" width="1280" height="960" first_frame="5" last_frame="5" frame_rate="25/1" />
  <frame index="5" time_s="0.2">
    <camera x_m="0" y_m="0" z_m="-150" roll_deg="0" pitch_deg="0" yaw_deg="0" />
    <intruder id="0" name="glider" in_picture="true" visible_fraction="1">
      <position x_m="300" y_m="0" z_m="0" />
      <distance m="300" />
      <attitude roll_deg="0" pitch_deg="0" yaw_deg="0" />
      <box x="1" y="2" width="3" height="4" />
      <silhouette x="0.5" y="1.5" width="3" height="4" />
    </intruder>
  </frame>
</sigs>
)");
}

TEST_CASE("the schema refuses what the annotation format does not allow") {
  if (!has_xmllint()) return;
  const std::string good = written();
  for (const auto& [from, to] : kBroken) check_invalid(changed(good, from, to), std::string(from) + " -> " + to);
}

TEST_CASE("the schema refuses elements out of order and a file without its footage") {
  if (!has_xmllint()) return;
  const std::string good = written();
  const std::size_t begin = good.find("      <position");
  const std::size_t middle = good.find("      <distance");
  const std::size_t end = good.find("      <attitude");
  check_invalid(
      good.substr(0, begin) + good.substr(middle, end - middle) + good.substr(begin, middle - begin) + good.substr(end),
      "distance before position");
  const std::size_t footage = good.find("  <footage");
  check_invalid(good.substr(0, footage) + good.substr(good.find("  <frame")), "no footage");
}

}  // namespace sigs::test
