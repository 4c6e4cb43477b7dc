// SPDX-License-Identifier: MIT
#include "editor/document/field_edits.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

using namespace sigs;
using namespace sigs::editor;

namespace {

Project with_intruders(std::size_t count, std::size_t waypoints = 2) {
  Project project;
  project.intruders.resize(count);
  for (IntruderSettings& intruder : project.intruders) intruder.trajectory.waypoints.resize(waypoints);
  return project;
}

// Another value than the present one, within the field's range.
PlainValue another(const Field& field) {
  const PlainValue value = value_of(field);
  if (const auto* const number = std::get_if<double>(&value))
    return *number + 0.5 <= field.maximum ? *number + 0.5 : *number - 0.5;
  if (const auto* const number = std::get_if<int>(&value)) return *number < 16 ? *number + 1 : *number - 1;
  if (std::holds_alternative<std::optional<double>>(value)) return std::optional<double>(0.5);
  if (std::holds_alternative<std::optional<int>>(value)) return std::optional<int>(7);
  if (const auto* const vector = std::get_if<glm::dvec3>(&value)) return *vector + glm::dvec3(1, 2, 3);
  if (std::holds_alternative<std::vector<std::string>>(value)) return std::vector<std::string>{"xml", "other"};
  if (const auto* const chosen = std::get_if<ChosenName>(&value)) return ChosenName{chosen->index == 0 ? 1 : 0};
  return std::string("another");
}

const Field& field_of(const FieldSheet& sheet, std::string_view key) {
  const Field* const field = sheet.find(key);
  REQUIRE(field != nullptr);
  return *field;
}

}  // namespace

TEST_CASE("a value put by its key is read back, and nothing else changes") {
  Project project = with_intruders(2);
  std::vector<std::string> keys;
  for (const Field& field : fields_of(project)) keys.push_back(field.key);
  CHECK(keys.size() > 50);
  for (const std::string& key : keys) {
    CAPTURE(key);
    Project changed = project;
    PlainValue wanted;
    for (const Field& field : fields_of(changed))
      if (field.key == key) wanted = another(field);
    CHECK(put_value(changed, key, wanted));
    for (const Field& field : fields_of(changed)) {
      Project untouched = project;
      for (const Field& before : fields_of(untouched))
        if (before.key == field.key) CHECK((value_of(field) == value_of(before)) == (field.key != key));
      if (field.key == key) CHECK(value_of(field) == wanted);
    }
  }
}

TEST_CASE("putting a value keeps all waypoints where they are") {
  Project project = with_intruders(2, 3);
  project.intruders[1].trajectory.waypoints[2].position_m = {1, 2, 3};
  Project expected = project;
  expected.camera.speed_mps = 30;
  CHECK(put_value(project, "camera.speed_mps", 30.0));
  CHECK(project == expected);
}

TEST_CASE("numbers are brought into the field's range") {
  Project project;
  CHECK(put_value(project, "camera.speed_mps", 5000.0));
  CHECK(project.camera.speed_mps == 1000);
  CHECK(put_value(project, "export.video.crf", -3));
  CHECK(project.output.crf == 0);
  CHECK(put_value(project, "light.color", glm::dvec3(-1, 0.5, 1000)));
  CHECK(project.light.color == glm::dvec3(0, 0.5, 100));
  CHECK(put_value(project, "footage.last_frame", std::optional<int>(-1)));
  CHECK(project.footage.last_frame == 0);
}

TEST_CASE("an optional value can be taken away") {
  Project project;
  project.footage.last_frame = 30;
  CHECK(put_value(project, "footage.last_frame", std::optional<int>()));
  CHECK(!project.footage.last_frame);
}

TEST_CASE("a value not finite or of another type, or an unknown key, leaves the project unchanged") {
  Project project = with_intruders(1);
  const Project before = project;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(!put_value(project, "camera.speed_mps", nan));
  CHECK(!put_value(project, "camera.speed_mps", infinity));
  CHECK(!put_value(project, "camera.position_m", glm::dvec3(0, nan, 0)));
  CHECK(!put_value(project, "intruders[0].trajectory.waypoints[0].frame", std::optional<double>(infinity)));
  CHECK(!put_value(project, "camera.speed_mps", 3));
  CHECK(!put_value(project, "camera.speed_mps", std::string("3")));
  CHECK(!put_value(project, "compositing.method", ChosenName{3}));
  CHECK(!put_value(project, "compositing.method", ChosenName{-1}));
  CHECK(!put_value(project, "camera.speed", 3.0));
  CHECK(!put_value(project, "intruders[1].model.scale", 3.0));
  CHECK(!put_value(project, "intruders[0].trajectory.waypoints[2].position_m", glm::dvec3(1)));
  CHECK(!put_value(project, "", 3.0));
  CHECK(project == before);
}

TEST_CASE("a new project has nothing to reset, and each changed field has its default to go back to") {
  const FieldSheet fresh(with_intruders(2));
  for (const Field& field : fresh.fields()) CHECK_MESSAGE(!fresh.can_be_reset(field), field.key);

  Project changed = with_intruders(2);
  for (const Field& field : fresh.fields()) put_value(changed, field.key, another(field));
  const FieldSheet sheet(changed);
  Project again = changed;
  for (const Field& field : sheet.fields()) {
    const bool has_no_default = field.is_path && field.required;
    CHECK_MESSAGE(sheet.can_be_reset(field) == !has_no_default, field.key);
    put_value(again, field.key, sheet.default_of(field));
  }
  CHECK(again == with_intruders(2));
}

TEST_CASE("a sheet holds every field but the waypoints'") {
  Project project = with_intruders(2, 3);
  const FieldSheet sheet(project);
  std::size_t of_waypoints = 0;
  const std::vector<Field> all = fields_of(project);
  for (const Field& field : all) {
    const bool is_waypoint = field.key.find("waypoints[") != std::string::npos;
    if (is_waypoint) ++of_waypoints;
    CHECK((sheet.find(field.key) == nullptr) == is_waypoint);
  }
  CHECK(of_waypoints == 2 * 3 * 3);  // frame, position and heading of each
  CHECK(sheet.fields().size() + of_waypoints == all.size());
}

TEST_CASE("a sheet does not refer to the project from which it was made") {
  Project project;
  const FieldSheet sheet(project);
  project.camera.speed_mps = 70;
  CHECK(value_of(field_of(sheet, "camera.speed_mps")) == PlainValue(0.0));
}

TEST_CASE("labels are the last part of a key, in words and without its unit") {
  CHECK(label_of("camera.speed_mps") == "Speed");
  CHECK(label_of("camera.attitude_deg.roll") == "Roll");
  CHECK(label_of("footage.own_body_mask") == "Own-body mask");
  CHECK(label_of("intruders[3].trajectory.bank_limit_deg") == "Bank limit");
  CHECK(label_of("intruders[0].model.length_m") == "Length");
  CHECK(label_of("own_body.soft_edge_px") == "Soft edge");
  CHECK(label_of("own_body.stable.min_area_percent") == "Min area");
  CHECK(label_of("name") == "Project");
  CHECK(label_of("intruders[0].name") == "Name");
  CHECK(label_of("intruders[2].model.file") == "Model");
  CHECK(label_of("").empty());
}

TEST_CASE("a search finds all its words in key, label or help") {
  const FieldSheet sheet{Project()};
  const Field& blur = field_of(sheet, "compositing.blur_px_per_m");
  CHECK(matches(blur, ""));
  CHECK(matches(blur, "BLUR"));
  CHECK(matches(blur, "gaussian compos"));
  CHECK(matches(blur, "  sigma  "));
  CHECK(!matches(blur, "blur codec"));
}

TEST_CASE("numbers are written as short as they are") {
  CHECK(number_text(0) == "0");
  CHECK(number_text(-0.0) == "0");
  CHECK(number_text(22) == "22");
  CHECK(number_text(-150.5, "m") == "-150.5 m");
  CHECK(number_text(0.002, "px/m") == "0.002 px/m");
  CHECK(number_text(45, "deg") == "45°");
  CHECK(number_text(12, "frame") == "12");
  CHECK(number_text(1e7, "m") == "10000000 m");
}

// ImGui takes the format, to which a percent sign alone is the beginning of a number.
TEST_CASE("a number's format prints its unit, percents too") {
  for (const char* unit : {"", "m", "%", "px"}) {
    char text[64];
    std::snprintf(text, sizeof text, number_format(2.5, unit).c_str(), 2.5);
    CHECK(text == number_text(2.5, unit));
  }
  CHECK(number_text(2.5, "%") == "2.5 %");
}

TEST_CASE("coordinates keep their hundredths however far away they are") {
  for (const double magnitude : {1.0, 10.0, 999.0, 123456.0, 9999999.0, 87654321.0})
    for (const double sign : {-1.0, 1.0}) {
      const double value = sign * (magnitude + 0.25);
      CHECK(std::abs(std::strtod(number_text(value).c_str(), nullptr) - value) <= 0.005);
    }
}

TEST_CASE("ranges and values are shown with their unit") {
  const FieldSheet sheet(with_intruders(1));
  CHECK(range_text(field_of(sheet, "camera.speed_mps")) == "-1000 to 1000 m/s");
  CHECK(range_text(field_of(sheet, "camera.attitude_deg.pitch")) == "-90 to 90°");
  CHECK(range_text(field_of(sheet, "light.position_m")) == "-1e+12 to 1e+12 m");
  CHECK(range_text(field_of(sheet, "name")).empty());
  const auto now = [&](std::string_view key) {
    return value_text(field_of(sheet, key), value_of(field_of(sheet, key)));
  };
  CHECK(now("camera.position_m") == "0, 0, -150 m");
  CHECK(now("footage.last_frame") == "none");
  CHECK(now("footage.first_frame") == "0");
  CHECK(now("footage.video") == "none");
  CHECK(now("intruders[0].trajectory.timing") == "frames");
  CHECK(now("export.labels") == "xml");
  CHECK(value_text(field_of(sheet, "intruders[0].trajectory.timing"), ChosenName{1}) == "constant speed");
  CHECK(value_text(field_of(sheet, "intruders[0].trajectory.timing"), ChosenName{9}).empty());
}

TEST_CASE("advice is given where a file has to be chosen, and only there") {
  Project project;
  project.footage.own_body_mask = "gone.png";
  project.camera.speed_mps = 9999;
  const FieldSheet sheet(project);
  for (const Problem& problem : validate(project)) {
    const Field* const field = sheet.find(problem.field);
    REQUIRE(field != nullptr);
    CHECK_MESSAGE(advice(problem, field).empty() == !field->is_path, problem.field);
  }
  CHECK(advice({"intruders[0].trajectory.waypoints", "is empty"}, nullptr).empty());
}

TEST_CASE("a zero with a special meaning is shown as a word") {
  Project project;
  for (const Field& field : fields_of(project)) {
    if (field.key == "own_body.paper.canny_low") {
      CHECK(value_text(field, 0.0) == "auto");
      CHECK(value_text(field, 2.0) == "2");
    }
    if (field.key == "own_body.paper.closing_px") CHECK(value_text(field, 0) == "auto");
    if (field.key == "own_body.settled_percent") CHECK(value_text(field, 0.0) == "never");
    if (field.key == "camera.speed_mps") CHECK(value_text(field, 0.0) == "0 m/s");
  }
}

TEST_CASE("from one pair of model axes to any other each step is valid") {
  Project project;
  project.intruders.resize(1);
  ModelSettings& model = project.intruders[0].model;
  const std::string key = "intruders[0].model.";
  const std::vector<std::string> names{"+x", "-x", "+y", "-y", "+z", "-z"};
  const auto is_valid = [&] { return model.forward[1] != model.up[1]; };
  for (const std::string& forward : names)
    for (const std::string& up : names)
      for (const std::string& next : names) {
        if (forward[1] == up[1]) continue;
        for (const char* const changed : {"forward", "up"}) {
          model.forward = forward;
          model.up = up;
          CHECK(put_value(project, key + changed, next));
          CHECK(is_valid());
          CHECK((std::string(changed) == "up" ? model.up : model.forward) == next);
        }
      }
  model.forward = "+x";
  model.up = "+z";
  CHECK(put_value(project, key + "forward", std::string("-z")));
  CHECK(model.up == "+x");
  CHECK(put_value(project, key + "up", std::string("banana")));  // the check of the project tells of it
  CHECK(model.forward == "-z");
}
