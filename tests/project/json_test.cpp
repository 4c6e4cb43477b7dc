// SPDX-License-Identifier: MIT

#include <unistd.h>

#include <doctest/doctest.h>
#include <map>

#include "base/input_file.h"
#include "base/staged_outputs.h"
#include "project/fields.h"
#include "project/json.h"
#include "support/test_data.h"

using namespace sigs;

namespace {

constexpr const char* kWhole = R"({
  "sigs": 1,
  "name": "meeting",
  "author": "somebody",
  "footage": {"video": "a.mkv", "first_frame": 3, "last_frame": 90, "calibration": "c.xml", "own_body_mask": "m.png"},
  "camera": {"position_m": [1, 2, -3], "attitude_deg": {"roll": 4, "pitch": 5, "yaw": 6}, "speed_mps": 22.5,
             "serial_number": {"of": {"lens": 7}}},
  "light": {"position_m": [-2000, 1000, -3000], "color": [1, 0.9, 0.8], "ambient": 0.25},
  "intruders": [
    {"name": "first", "color_of_pilot": "blue",
     "model": {"file": "p.obj", "forward": "-x", "up": "+y", "scale": 2, "length_m": 30, "anchor": "bounds"},
     "trajectory": {"spline": "approximating", "timing": "constant_speed", "bank": "level", "bank_limit_deg": 30,
                    "waypoints": [{"frame": 0, "position_m": [900, -250, -170], "note": "start"},
                                  {"position_m": [0.1, 1e7, -165]}]}},
    {"name": "second"}],
  "compositing": {"method": "classic", "blend": "display", "blur_px_per_m": 0.004, "supersampling": 3},
  "export": {"video": {"codec": "h264", "container": "mkv", "crf": 23}, "masks": "png", "labels": [],
             "encounter": ["nmac"]}
})";

Project whole() {
  return parse_project(kWhole, "dir/whole.json").value().project;
}

std::string error_text(const std::string& json) {
  const Result<ReadProject> read = parse_project(json, "x.json");
  REQUIRE_FALSE(read.has_value());
  CHECK(read.error().kind == ErrorKind::bad_project);
  return read.error().text();
}

}  // namespace

TEST_CASE("every key of a project file sets its field") {
  const Project p = whole();
  CHECK(p.name == "meeting");
  CHECK(p.footage.video == "a.mkv");
  CHECK(p.footage.first_frame == 3);
  CHECK(p.footage.last_frame == 90);
  CHECK(p.footage.own_body_mask == "m.png");
  CHECK(p.camera.position_m == glm::dvec3(1, 2, -3));
  CHECK(p.camera.roll_deg == 4);
  CHECK(p.camera.pitch_deg == 5);
  CHECK(p.camera.yaw_deg == 6);
  CHECK(p.camera.speed_mps == 22.5);
  CHECK(p.light.color == glm::dvec3(1, 0.9, 0.8));
  REQUIRE(p.intruders.size() == 2);
  CHECK(p.intruders[0].model.anchor == AnchorChoice::bounds);
  CHECK(p.intruders[0].trajectory.spline == SplineKind::approximating);
  CHECK(p.intruders[0].trajectory.timing == Timing::constant_speed);
  CHECK(p.intruders[0].trajectory.bank == Bank::level);
  REQUIRE(p.intruders[0].trajectory.waypoints.size() == 2);
  CHECK(p.intruders[0].trajectory.waypoints[0].frame == 0.0);
  CHECK_FALSE(p.intruders[0].trajectory.waypoints[1].frame.has_value());
  CHECK(p.intruders[0].trajectory.waypoints[1].position_m == glm::dvec3(0.1, 1e7, -165));
  CHECK(p.intruders[1].name == "second");
  CHECK(p.compositing.method == MethodChoice::classic);
  CHECK(p.output.codec == VideoCodec::h264);
  CHECK(p.output.masks == MasksChoice::png);
  CHECK(p.output.labels.empty());
  CHECK(p.output.encounter == std::vector<std::string>{"nmac"});
}

TEST_CASE(
    "a project that does not name volumes of well clear asks for no truth of encounters, and keeps asking for none") {
  const Project p = parse_project(R"({"sigs": 1, "export": {"labels": ["csv"]}})", "x.json").value().project;
  CHECK(p.output.encounter.empty());
  CHECK(parse_project(text_of(p), "x.json").value().project.output.encounter.empty());
  CHECK(error_text(R"({"sigs": 1, "export": {"encounter": "nmac"}})").find("export.encounter") != std::string::npos);
}

TEST_CASE("writing and reading again changes nothing") {
  const std::string once = text_of(whole());
  const std::string twice = text_of(parse_project(once, "dir/whole.json").value().project);
  CHECK(once == twice);
}

TEST_CASE("unknown keys give warnings with their whole name and are kept on save") {
  const ReadProject read = parse_project(kWhole, "w.json").value();
  std::vector<std::string> texts;
  for (const Warning& warning : read.warnings) texts.push_back(warning.where);
  CHECK(texts == std::vector<std::string>{"w.json: author", "w.json: camera.serial_number.of.lens",
                                          "w.json: intruders[0].trajectory.waypoints[0].note",
                                          "w.json: intruders[0].color_of_pilot"});
  const std::string saved = text_of(read.project);
  for (const char* const kept : {"somebody", "\"lens\": 7", "\"note\": \"start\"", "color_of_pilot"})
    CHECK_MESSAGE(saved.find(kept) != std::string::npos, kept);
}

TEST_CASE("a key that is there twice gives a warning with its whole name, and the last one counts") {
  const Result<ReadProject> read = parse_project(
      R"({"sigs": 1, "camera": {"speed_mps": 99}, "camera": {"speed_mps": 1, "position_m": [0, 0, 0], "speed_mps": 7},
          "intruders": [{"name": "a", "model": {"gloss": 1, "gloss": 0}}]})",
      "w.json");
  REQUIRE(read);
  std::vector<std::string> texts;
  for (const Warning& warning : read->warnings) texts.push_back(warning.text());
  CHECK(texts == std::vector<std::string>{"w.json: camera: is there twice; the last one counts",
                                          "w.json: camera.speed_mps: is there twice; the last one counts",
                                          "w.json: intruders.model.gloss: is there twice; the last one counts"});
  CHECK(read->project.camera.speed_mps == 7);
}

TEST_CASE("for an unknown key a similar known one is suggested") {
  const Result<ReadProject> read = parse_project(R"({"sigs": 1, "footage": {"vidoe": "a.mkv"}, "intruder": [],
      "cammera": {"position_m": [0, 0, 0]}, "colour_of_hangar": 1,
      "intruders": [{"modle": {"file": "a.obj"}, "trajectory": {"waypoint": [],
                     "waypoints": [{"position_m": [1, 2, 3], "fram": 3}]}}]})",
                                                 "x.json");
  REQUIRE(read);
  std::map<std::string, std::string> said;
  for (const Warning& warning : read->warnings) said[warning.where] = warning.what;
  CHECK(said.at("x.json: footage.vidoe").find("did you mean footage.video?") != std::string::npos);
  CHECK(said.at("x.json: intruder").find("did you mean intruders?") != std::string::npos);
  CHECK(said.at("x.json: cammera.position_m").find("did you mean camera.position_m?") != std::string::npos);
  CHECK(said.at("x.json: intruders[0].modle.file").find("did you mean model.file?") != std::string::npos);
  CHECK(said.at("x.json: intruders[0].trajectory.waypoint").find("trajectory.waypoints?") != std::string::npos);
  CHECK(said.at("x.json: intruders[0].trajectory.waypoints[0].fram").find("did you mean frame?") != std::string::npos);
  CHECK(said.at("x.json: colour_of_hangar").find("did you mean") == std::string::npos);
}

TEST_CASE("unknown keys of an intruder go with it when others are removed") {
  Project p = whole();
  std::swap(p.intruders[0], p.intruders[1]);
  const Project back = parse_project(text_of(p), "w.json").value().project;
  CHECK(back.intruders[0].unknown_json.empty());
  CHECK(back.intruders[1].unknown_json.find("color_of_pilot") != std::string::npos);
}

TEST_CASE("rotors are read, written again, and keep what is unknown of them") {
  const std::string text =
      R"({"sigs": 1, "intruders": [{"model": {"file": "a.obj", "rotors": [{"part": "prop", "blades": 3, "rpm": -2400,
          "axis": [1, 0, 0], "pitch_deg": 20}, {"part": "tail"}]}}]})";
  const ReadProject read = parse_project(text, "p.json").value();
  REQUIRE(read.project.intruders[0].model.rotors.size() == 2);
  const RotorSettings& rotor = read.project.intruders[0].model.rotors[0];
  CHECK(rotor.part == "prop");
  CHECK(rotor.blades == 3);
  CHECK(rotor.rpm == -2400);
  CHECK(rotor.axis == glm::dvec3(1, 0, 0));
  CHECK_FALSE(read.project.intruders[0].model.rotors[1].rpm);
  REQUIRE(read.warnings.size() == 1);
  CHECK(read.warnings[0].text().starts_with("p.json: intruders[0].model.rotors[0].pitch_deg: unknown key"));
  const ReadProject again = parse_project(text_of(read.project), "p.json").value();
  CHECK(again.project == read.project);
  CHECK(text_of(again.project).find("pitch_deg") != std::string::npos);
  CHECK(error_text(R"({"sigs": 1, "intruders": [{"model": {"rotors": {}}}]})") ==
        "x.json: intruders[0].model.rotors: expected a list [ ... ]");
  CHECK(error_text(R"({"sigs": 1, "intruders": [{"model": {"rotors": [{"rpm": "fast"}]}}]})")
            .starts_with("x.json: intruders[0].model.rotors[0].rpm: "));
}

TEST_CASE("what a file leaves out has its default and null stands for none") {
  const Project p = parse_project(R"({"sigs": 1, "footage": {"last_frame": null}})", "x.json").value().project;
  CHECK(p.camera.position_m == glm::dvec3(0, 0, -150));
  CHECK_FALSE(p.footage.last_frame.has_value());
  CHECK(p.compositing.supersampling == 3);
  CHECK(p.output.labels == std::vector<std::string>{"xml"});
}

TEST_CASE("a wrong value is reported with file, field and value") {
  CHECK(error_text(R"({"sigs": 1, "camera": {"speed_mps": "fast"}})") ==
        "x.json: camera.speed_mps: expected a number, found \"fast\"");
  CHECK(error_text(R"({"sigs": 1, "camera": {"position_m": [1, 2]}})") ==
        "x.json: camera.position_m: expected three numbers [x, y, z], found [1,2]");
  CHECK(error_text(R"({"sigs": 1, "intruders": [{"trajectory": {"waypoints": [{"position_m": [1, null, 2]}]}}]})") ==
        "x.json: intruders[0].trajectory.waypoints[0].position_m: expected three numbers [x, y, z], found [1,null,2]");
  CHECK(error_text(R"({"sigs": 1, "compositing": {"method": "magic"}})") ==
        "x.json: compositing.method: expected one of direct, classic, plain, found \"magic\"");
  CHECK(error_text(R"({"sigs": 1, "footage": {"first_frame": 1.5}})") ==
        "x.json: footage.first_frame: expected a whole number, found 1.5");
}

TEST_CASE("sections and lists of the wrong kind are named") {
  CHECK(error_text(R"({"sigs": 1, "camera": 5})") == "x.json: camera: expected { ... }");
  CHECK(error_text(R"({"sigs": 1, "intruders": 5})") == "x.json: intruders: expected a list [ ... ]");
  CHECK(error_text(R"({"sigs": 1, "intruders": [7]})") == "x.json: intruders[0]: expected { ... }");
  CHECK(error_text(R"({"sigs": 1, "intruders": [{"trajectory": {"waypoints": {}}}]})") ==
        "x.json: intruders[0].trajectory.waypoints: expected a list [ ... ]");
  CHECK(error_text(R"({"sigs": 1, "intruders": [{"trajectory": {"waypoints": [3]}}]})")
            .starts_with("x.json: intruders[0].trajectory.waypoints[0]"));
}

TEST_CASE("text that is not a project is reported with its line") {
  CHECK(error_text("{\n  \"sigs\": 1,\n  oops\n}").find("line 3") != std::string::npos);
  CHECK(error_text("[1, 2]").find("not a SIGS project") != std::string::npos);
  CHECK(error_text("{}").find("begins with \"sigs\": 1") != std::string::npos);
  CHECK(error_text(R"({"sigs": 2})").find("version 2 is not known") != std::string::npos);
  CHECK(error_text(R"({"sigs": 1, "camera": {"speed_mps": NaN}})").find("is not JSON") != std::string::npos);
  CHECK(error_text(R"({"sigs": 1, "camera": {"speed_mps": 1e999}})").find("too large") != std::string::npos);
  CHECK_FALSE(error_text("").empty());
}

TEST_CASE("a missing project file cannot be read") {
  const Result<ReadProject> read = read_project("no/such/project.json");
  REQUIRE_FALSE(read.has_value());
  CHECK(read.error().kind == ErrorKind::cannot_read);
}

TEST_CASE("a written project file reads back from disk") {
  const test::TemporaryFolder folder;
  REQUIRE(write_project(whole(), folder / "p.json", false).has_value());
  CHECK(text_of(read_project(folder / "p.json").value().project) == text_of(whole()));
}

TEST_CASE("each field has a help text and a unique key") {
  Project p = whole();
  std::vector<std::string> keys;
  for (const Field& field : fields_of(p)) {
    CHECK_MESSAGE(!field.help.empty(), field.key);
    CHECK_MESSAGE(std::find(keys.begin(), keys.end(), field.key) == keys.end(), field.key);
    keys.push_back(field.key);
  }
}

TEST_CASE("paths are relative to the project file's folder and absolute ones stay") {
  const Project p = whole();
  CHECK(resolved(p, "a.mkv") == "dir/a.mkv");
  CHECK(resolved(p, "/x/a.mkv") == "/x/a.mkv");
  CHECK(resolved(p, "").empty());
}

TEST_CASE("deeply nested brackets are refused before they exhaust the stack") {
  const auto nested = [](int depth) {
    return R"({"sigs": 1, "about": ")" + std::string(500, '[') + R"(\" [", "more": )" + std::string(depth, '[') +
           std::string(depth, ']') + "}";
  };
  CHECK(parse_project(nested(kMaxNesting - 1), "p.json").has_value());
  for (const int depth : {kMaxNesting, 300'000}) {
    const Result<ReadProject> read = parse_project(nested(depth), "p.json");
    REQUIRE_FALSE(read);
    CHECK(read.error().kind == ErrorKind::bad_project);
    CHECK(read.error().text() == "p.json: has more than 100 brackets within one another");
  }
}

TEST_CASE("a project with hundreds of thousands of unknown keys is read and written in order") {
  alarm(120);  // a hang, not a measurement: time that grows with the square takes longer
  constexpr int kMany = 300'000;
  std::string text = R"({"sigs": 1, "name": "many", "camera": {)";
  for (int i = 0; i < kMany; ++i) text.append("\"in").append(std::to_string(i)).append("\": {},");
  text += R"("speed_mps": 7})";
  for (int i = 0; i < kMany; ++i) text.append(", \"k").append(std::to_string(i)).append("\": [1]");
  const Result<ReadProject> read = parse_project(text + "}", "p.json");
  REQUIRE_MESSAGE(read.has_value(), read.error().text());
  CHECK(read->project.camera.speed_mps == 7);
  CHECK(read->warnings.size() > 50);
  CHECK(read->warnings.size() < 200);
  CHECK(read->warnings[0].text() == "p.json: k0: unknown key, kept but not used");
  const std::string written = text_of(read->project);
  const std::size_t first = written.find("\"k0\"");
  CHECK(first != std::string::npos);
  CHECK(written.find("\"k299999\"") > first);
  CHECK(text_of(parse_project(written, "p.json")->project) == written);
  alarm(0);
}

TEST_CASE("a waypoint or an intruder more than are read is refused, however they are spread") {
  const auto listed_times = [](const std::string& item, std::size_t count) {
    std::string list = "[" + item;
    for (std::size_t i = 1; i < count; ++i) list.append(",").append(item);
    return list + "]";
  };
  const auto intruder = [&](std::size_t waypoints) {
    return R"({"trajectory": {"waypoints": )" + listed_times(R"({"position_m": [1, 2, 3]})", waypoints) + "}}";
  };
  const auto error_of = [](const std::string& intruders) {
    const Result<ReadProject> read = parse_project(R"({"sigs": 1, "intruders": )" + intruders + "}", "p.json");
    return read ? std::string() : read.error().text();
  };
  CHECK(error_of("[" + intruder(kMaxWaypoints + 1) + "]").find("at most 250000 are read") != std::string::npos);
  const std::string spread = error_of("[" + intruder(kMaxWaypoints / 2) + "," + intruder(kMaxWaypoints / 2 + 1) + "]");
  CHECK(spread.starts_with("p.json: intruders[1].trajectory.waypoints"));
  CHECK(error_of(listed_times("{}", kMaxIntruders + 1)).starts_with("p.json: intruders: has 10001 entries"));
}

TEST_CASE("of several values under one key the last counts") {
  CHECK(parse_project(R"({"sigs": 1, "name": "a", "name": "b"})", "p.json")->project.name == "b");
}
