// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "base/staged_outputs.h"
#include "export/export_project.h"
#include "frame/synthetic_scenes.h"
#include "support/files.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Texts = std::map<std::string, std::string>;

constexpr int kPassFrames = 60;
constexpr double kInterval_s = 0.04;
constexpr double kRounded = 0.51e-6;  // half a unit of the last of six digits, and what a double adds
const cv::Size kPassSize(96, 64);

void fly(IntruderSettings& intruder, const std::vector<std::pair<double, glm::dvec3>>& waypoints) {
  intruder.trajectory.waypoints.clear();
  for (const auto& [frame, position_m] : waypoints)
    intruder.trajectory.waypoints.push_back({.frame = frame, .position_m = position_m});
}

// Straight towards the camera through the limits of nmac; straight from afar through the modified tau of dwc-en-route,
// descending through its ZTHR; on a curve past the camera, climbing away; hovering.
void prepare_pass(Scenario& scenario) {
  write_footage(scenario.path("footage.mkv"), kPassSize, kPassFrames, PixelLayout::yuv420);
  write_obj(scenario.path("aircraft.obj"), aircraft(), 1);
  fly(scenario.add("aircraft.obj", {}), {{0, {260, 40, -175}}, {60, {90, 10, -155}}});
  fly(scenario.add("aircraft.obj", {}), {{0, {3800, -700, -310}}, {60, {2400, -450, -250}}});
  fly(scenario.add("aircraft.obj", {}),
      {{0, {150, -40, -150}}, {20, {110, 10, -155}}, {45, {60, 20, -165}}, {60, {20, -15, -180}}});
  scenario.add("aircraft.obj", {200, 60, -150});
  CameraSettings& camera = scenario.project.camera;
  camera.speed_mps = 25;
  camera.roll_deg = 8;
  camera.pitch_deg = -6;
  camera.yaw_deg = 25;
  scenario.project.output.masks = MasksChoice::none;
  scenario.project.output.labels = {"xml", "csv"};
  scenario.project.output.encounter = {"dwc-en-route", "nmac"};
}

ExportRequest pass_request(const Scenario& scenario) {
  return {.project = scenario.project, .folder = scenario.path("out"), .jobs = 2};
}

pugi::xml_document xml_at(const fs::path& path) {
  pugi::xml_document document;
  REQUIRE(document.load_file(path.c_str()));
  return document;
}

// Rows of a table without quotes, by column.
std::vector<Texts> csv_at(const fs::path& path) {
  const auto parts = [](const std::string& line) {
    std::vector<std::string> values{""};
    for (const char c : line)
      if (c == ',')
        values.emplace_back();
      else if (c != '\r')
        values.back() += c;
    return values;
  };
  std::istringstream lines(text_of(path));
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = parts(line);
  std::vector<Texts> rows;
  while (std::getline(lines, line)) {
    const std::vector<std::string> values = parts(line);
    REQUIRE(values.size() == names.size());
    rows.emplace_back();
    for (std::size_t i = 0; i < names.size(); ++i) rows.back()[names[i]] = values[i];
  }
  return rows;
}

// The numbers of an element and its well_clear elements under the columns' names.
Texts numbers_of(const pugi::xml_node& encounter) {
  Texts texts;
  for (const pugi::xml_attribute& attribute : encounter.attributes()) texts[attribute.name()] = attribute.value();
  for (const pugi::xml_node& volume : encounter.children("well_clear")) {
    std::string name = volume.attribute("volume").value();
    std::replace(name.begin(), name.end(), '-', '_');
    for (const char* const key : {"lost", "tau_mod_s", "severity"})
      if (volume.attribute(key)) texts[name + "_" + key] = volume.attribute(key).value();
  }
  return texts;
}

// The same of a step in the summary: what is in the columns of these names.
Texts numbers_of(const Json& step, const Texts& names) {
  Texts texts;
  for (const auto& [name, text] : names)
    if (name != "time_s" && step.contains(name) && !step[name].is_null()) texts[name] = step[name].dump();
  for (const auto& [volume, values] : step["volumes"].items()) {
    std::string name = volume;
    std::replace(name.begin(), name.end(), '-', '_');
    for (const char* const key : {"lost", "tau_mod_s", "severity"})
      if (!values[key].is_null()) texts[name + "_" + key] = values[key].dump();
  }
  return texts;
}

// Where camera and intruder are in the world, by the annotation alone: yaw, pitch and roll as frames-and-units.md says.
struct Places {
  glm::dvec3 own_m;
  glm::dvec3 intruder_m;
};

Places places_in(const pugi::xml_node& frame, int intruder) {
  const pugi::xml_node camera = frame.child("camera");
  const auto vector = [](const pugi::xml_node& node) {
    return glm::dvec3(node.attribute("x_m").as_double(), node.attribute("y_m").as_double(),
                      node.attribute("z_m").as_double());
  };
  const auto angle = [&](const char* name) {
    return camera.attribute(name).as_double() * 3.14159265358979323846 / 180;
  };
  const double roll = angle("roll_deg"), pitch = angle("pitch_deg"), yaw = angle("yaw_deg");
  glm::dvec3 p =
      vector(frame.find_child_by_attribute("intruder", "id", std::to_string(intruder).c_str()).child("position"));
  p = {p.x, std::cos(roll) * p.y - std::sin(roll) * p.z, std::sin(roll) * p.y + std::cos(roll) * p.z};
  p = {std::cos(pitch) * p.x + std::sin(pitch) * p.z, p.y, -std::sin(pitch) * p.x + std::cos(pitch) * p.z};
  p = {std::cos(yaw) * p.x - std::sin(yaw) * p.y, std::sin(yaw) * p.x + std::cos(yaw) * p.y, p.z};
  return {vector(camera), vector(camera) + p};
}

// All quantities from places alone: velocities are differences of the frames before and after.
struct ByDifferences {
  double range_m, range_rate_mps, bearing_deg, elevation_deg, closest_s, hmd_m, vmd_m, coaltitude_s;
  double horizontal_m, vertical_m, speed_mps, along_mps;

  ByDifferences(const Places& before, const Places& now, const Places& after) {
    const glm::dvec3 own = (after.own_m - before.own_m) / (2 * kInterval_s);
    const glm::dvec3 s = now.intruder_m - now.own_m;
    const glm::dvec3 v = (after.intruder_m - before.intruder_m) / (2 * kInterval_s) - own;
    range_m = std::sqrt(s.x * s.x + s.y * s.y + s.z * s.z);
    range_rate_mps = (s.x * v.x + s.y * v.y + s.z * v.z) / range_m;
    bearing_deg = std::atan2(own.x * s.y - own.y * s.x, own.x * s.x + own.y * s.y) * 180 / 3.14159265358979323846;
    elevation_deg = std::asin(-s.z / range_m) * 180 / 3.14159265358979323846;
    speed_mps = std::sqrt(v.x * v.x + v.y * v.y);
    along_mps = s.x * v.x + s.y * v.y;
    closest_s = std::max(0.0, -along_mps / (speed_mps * speed_mps));
    hmd_m = std::hypot(s.x + closest_s * v.x, s.y + closest_s * v.y);
    vmd_m = -(s.z + closest_s * v.z);
    // At one height but for the rounding of six digits: the hovering one.
    const bool is_level = std::abs(s.z) < 1e-5;
    coaltitude_s = is_level ? 0 : s.z * v.z < 0 ? -s.z / v.z : INFINITY;
    horizontal_m = std::hypot(s.x, s.y);
    vertical_m = -s.z;
  }

  [[nodiscard]] double tau_mod_s(double dmod_m) const {
    if (horizontal_m <= dmod_m) return 0;
    return along_mps < 0 ? (dmod_m * dmod_m - horizontal_m * horizontal_m) / along_mps : INFINITY;
  }
  // How far within the conditions it is: positive where well clear is lost.
  [[nodiscard]] double depth(double dmod_m, double tau_s, double zthr_m) const {
    const bool closes = along_mps < 0 && hmd_m <= dmod_m;
    const double horizontally = std::max(dmod_m - horizontal_m, closes ? tau_s - tau_mod_s(dmod_m) : -INFINITY);
    return std::min(horizontally, zthr_m - std::abs(vertical_m));
  }
};

// Of a difference over two intervals: by rounding, and a sixth of the squared interval times the third derivative,
// whose greatest value is taken from four places in a row and, as these average it, somewhat enlarged.
double velocity_error(const std::vector<pugi::xml_node>& frames, int intruder) {
  double third_mps3 = 0;
  for (std::size_t i = 3; i < frames.size(); ++i) {
    const auto place = [&](std::size_t back) { return places_in(frames[i - back], intruder).intruder_m; };
    const glm::dvec3 third = (place(0) - 3.0 * place(1) + 3.0 * place(2) - place(3)) / std::pow(kInterval_s, 3);
    third_mps3 = std::max(third_mps3, std::sqrt(third.x * third.x + third.y * third.y + third.z * third.z));
  }
  return 5e-5 + 1.1 * third_mps3 * kInterval_s * kInterval_s / 6;
}

double number(const Texts& texts, const std::string& name) {
  const auto found = texts.find(name);
  return found == texts.end() ? INFINITY : std::stod(found->second);
}

// All numbers of one text in the other, equal to half a unit of the sixth digit.
void check_same_numbers(const Texts& rounded, const Texts& exact) {
  REQUIRE(rounded.size() == exact.size());
  for (const auto& [field, text] : rounded) {
    const std::string& name = field;
    CAPTURE(name);
    REQUIRE(exact.contains(name));
    if (text == "true" || text == "false")
      CHECK(exact.at(name) == text);
    else
      CHECK(std::abs(std::stod(text) - std::stod(exact.at(name))) <= kRounded);
  }
}

std::vector<std::string> names_below(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code code;
  for (fs::directory_iterator it(folder, code), end; !code && it != end; it.increment(code))
    names.push_back(it->path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

TEST_CASE("labels of each frame have the quantities of the encounter's summary, in XML and in CSV") {
  Scenario scenario(kPassSize, kPassFrames);
  prepare_pass(scenario);
  const Result<ExportReport> report = export_project(pass_request(scenario), {});
  REQUIRE_MESSAGE(report, report.error().text());
  CHECK(std::find(report->written.begin(), report->written.end(), scenario.path("out/lot.encounter.json")) !=
        report->written.end());
  const pugi::xml_document xml = xml_at(scenario.path("out/lot.xml"));
  const Json summary = json_of(scenario.path("out/lot.encounter.json"));
  const std::vector<Texts> csv = csv_at(scenario.path("out/lot.csv"));
  REQUIRE(summary["encounters"].size() == 4);
  std::size_t row = 0;
  std::size_t step = 0;
  for (const pugi::xml_node& frame : xml.child("sigs").children("frame")) {
    for (const pugi::xml_node& intruder : frame.children("intruder")) {
      const Texts in_xml = numbers_of(intruder.child("encounter"));
      const Json& one = summary["encounters"][intruder.attribute("id").as_uint()];
      check_same_numbers(in_xml, numbers_of(one["steps"][step], csv.at(row)));
      for (const auto& field : csv.at(row))
        if (in_xml.contains(field.first)) CHECK_MESSAGE(field.second == in_xml.at(field.first), field.first);
      CHECK(csv.at(row).contains("nmac_severity"));
      CHECK(csv.at(row).at("time_to_coaltitude_s").empty() == !in_xml.contains("time_to_coaltitude_s"));
      CHECK(csv.at(row).at("nmac_tau_mod_s").empty() == !in_xml.contains("nmac_tau_mod_s"));
      ++row;
    }
    ++step;
  }
  CHECK(row == csv.size());
  CHECK(step == kPassFrames);
  for (const Json& one : summary["encounters"]) CHECK(one["steps"].size() == kPassFrames);
}

TEST_CASE("the labelled encounter is what the labelled places say by their differences") {
  Scenario scenario(kPassSize, kPassFrames);
  prepare_pass(scenario);
  REQUIRE(export_project(pass_request(scenario), {}));
  const pugi::xml_document xml = xml_at(scenario.path("out/lot.xml"));
  std::vector<pugi::xml_node> frames;
  for (const pugi::xml_node& frame : xml.child("sigs").children("frame")) frames.push_back(frame);
  REQUIRE(frames.size() == kPassFrames);
  std::map<std::string, int> changes;
  for (int id = 0; id < 4; ++id) {
    const double velocity_error_mps = velocity_error(frames, id);
    Texts last;
    for (std::size_t i = 1; i + 1 < frames.size(); ++i) {
      CAPTURE(id);
      CAPTURE(i);
      const pugi::xml_node intruder = frames[i].find_child_by_attribute("intruder", "id", std::to_string(id).c_str());
      const Texts labelled = numbers_of(intruder.child("encounter"));
      const ByDifferences expected(places_in(frames[i - 1], id), places_in(frames[i], id),
                                   places_in(frames[i + 1], id));
      const auto near = [&](const char* name, double value, double tolerance) {
        CHECK_MESSAGE(std::abs(number(labelled, name) - value) <= tolerance + 2e-5,
                      name << " is " << number(labelled, name) << ", by differences " << value);
      };
      const double relative = velocity_error_mps / expected.speed_mps;
      near("range_rate_mps", expected.range_rate_mps, velocity_error_mps);
      near("closing_speed_mps", -expected.range_rate_mps, velocity_error_mps);
      near("bearing_deg", expected.bearing_deg, 0);
      near("elevation_deg", expected.elevation_deg, 0);
      const double closest_error_s = 3 * relative * expected.range_m / expected.speed_mps;
      near("time_to_closest_approach_s", expected.closest_s, closest_error_s);
      near("hmd_m", expected.hmd_m, 3 * relative * expected.range_m);
      near("vmd_m", expected.vmd_m, 3 * relative * expected.range_m + velocity_error_mps * expected.closest_s);
      CHECK(std::isinf(number(labelled, "time_to_coaltitude_s")) == std::isinf(expected.coaltitude_s));
      if (std::isfinite(expected.coaltitude_s) && id != 2)
        CHECK(number(labelled, "time_to_coaltitude_s") == doctest::Approx(expected.coaltitude_s).epsilon(1e-4));
      for (const auto& [volume, dmod_m, tau_s, zthr_m] :
           {std::tuple("dwc_en_route", 1219.2, 35.0, 137.16), std::tuple("nmac", 152.4, 0.0, 30.48)}) {
        const std::string name = volume;
        const double depth = expected.depth(dmod_m, tau_s, zthr_m);
        const std::string lost = labelled.at(name + "_lost");
        if (std::abs(depth) > 0.01) CHECK_MESSAGE((lost == "true") == (depth > 0), name);
        CHECK((number(labelled, name + "_severity") > 0) == (lost == "true"));
        const double tau_mod_s = expected.tau_mod_s(dmod_m);
        const double labelled_s = number(labelled, name + "_tau_mod_s");
        CHECK(std::isinf(labelled_s) == std::isinf(tau_mod_s));
        if (std::isfinite(tau_mod_s))
          CHECK_MESSAGE(std::abs(labelled_s - tau_mod_s) <= 1e-4 + 4 * relative * tau_mod_s, name);
        if (!last.empty() && last.at(std::string(name) + "_lost") != lost) ++changes[name];
      }
      last = labelled;
    }
  }
  // The flights cross limits of both volumes, else the conditions were not looked at.
  CHECK(changes["dwc_en_route"] > 0);
  CHECK(changes["nmac"] > 0);
}

TEST_CASE("without volumes nothing of encounters is written") {
  Scenario scenario(kPassSize, 3);
  prepare_pass(scenario);
  scenario.project.output.encounter.clear();
  const Result<ExportReport> report = export_project(
      {.project = scenario.project, .folder = scenario.path("out"), .frames = FrameRange{0, 2}, .jobs = 1}, {});
  REQUIRE_MESSAGE(report, report.error().text());
  CHECK(names_below(scenario.path("out")) == std::vector<std::string>{"lot.csv", "lot.mkv", "lot.xml"});
  for (const char* const name : {"out/lot.csv", "out/lot.xml"}) {
    CHECK(text_of(scenario.path(name)).find("closing") == std::string::npos);
    CHECK(text_of(scenario.path(name)).find("encounter") == std::string::npos);
  }
}

TEST_CASE("a part of the frames has its own summary, one frame and no intruder too") {
  Scenario scenario(kPassSize, kPassFrames);
  prepare_pass(scenario);
  scenario.project.output.labels.clear();
  const auto summary_of = [&](int first, int last) {
    const Result<ExportReport> report = export_project({.project = scenario.project,
                                                        .folder = scenario.path("out"),
                                                        .frames = FrameRange{first, last},
                                                        .jobs = 1,
                                                        .overwrite = true},
                                                       {});
    REQUIRE_MESSAGE(report, report.error().text());
    return json_of(scenario.path("out/lot.encounter.json"));
  };
  const Json part = summary_of(10, 14);
  CHECK(part["sigs_encounter"] == 1);
  CHECK(part["source"] == "lot");
  CHECK(part["encounters"][0]["first_s"].get<double>() == doctest::Approx(0.4));
  CHECK(part["encounters"][0]["last_s"].get<double>() == doctest::Approx(0.56));
  CHECK(part["encounters"][0]["steps"].size() == 5);
  const Json one = summary_of(59, 59);
  CHECK(one["encounters"][2]["steps"].size() == 1);
  CHECK(one["encounters"][2]["nearest"]["range_m"] == one["encounters"][2]["steps"][0]["range_m"]);
  scenario.project.intruders.clear();
  CHECK(summary_of(0, 1)["encounters"].empty());
}

TEST_CASE("the summary of an encounter is replaced only where that was asked for, and never half-made") {
  Scenario scenario(kPassSize, kPassFrames);
  prepare_pass(scenario);
  const fs::path summary = scenario.path("out/lot.encounter.json");
  write_file_and_folders(summary, "mine");
  const Result<ExportReport> refused = export_project(pass_request(scenario), {});
  REQUIRE_FALSE(refused);
  CHECK(refused.error().text().find("lot.encounter.json") != std::string::npos);
  CHECK(names_below(scenario.path("out")) == std::vector<std::string>{"lot.encounter.json"});

  ExportRequest replacing = pass_request(scenario);
  replacing.overwrite = true;
  std::atomic<bool> cancel = false;
  const Result<ExportReport> cancelled =
      export_project(replacing, {.progress = [&](int done, int) { cancel = done >= 5; }, .cancel = &cancel});
  REQUIRE_FALSE(cancelled);
  CHECK(cancelled.error().kind == ErrorKind::interrupted);
  CHECK(names_below(scenario.path("out")) == std::vector<std::string>{"lot.encounter.json"});
  CHECK(text_of(summary) == "mine");
  REQUIRE(export_project(replacing, {}));
  CHECK(json_of(summary)["encounters"].size() == 4);
}

TEST_CASE("a file that the project reads is not overwritten by the summary of its encounters") {
  Scenario scenario(kPassSize, kPassFrames);
  prepare_pass(scenario);
  fs::create_directories(scenario.path("out"));
  fs::rename(scenario.path("pinhole.xml"), scenario.path("out/lot.encounter.json"));
  scenario.project.footage.calibration = "out/lot.encounter.json";
  ExportRequest request = pass_request(scenario);
  request.overwrite = true;
  CHECK_FALSE(export_project(request, {}));
  CHECK(names_below(scenario.path("out")) == std::vector<std::string>{"lot.encounter.json"});
}

}  // namespace sigs::test
