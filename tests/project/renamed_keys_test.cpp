// SPDX-License-Identifier: MIT
#include "project/json.h"

#include <doctest/doctest.h>
#include <algorithm>

#include "project/fields.h"

using namespace sigs;

namespace {

bool is_field(std::string_view key) {
  Project project;
  const std::vector<Field> fields = fields_of(project);
  return std::any_of(fields.begin(), fields.end(), [&](const Field& field) { return field.key == key; });
}

}  // namespace

TEST_CASE("each renamed key has a field under its new name and none under the old one") {
  CHECK(renamed_keys().size() >= 10);
  for (const RenamedKey& renamed : renamed_keys()) {
    CAPTURE(renamed.old_key);
    CHECK(is_field(renamed.key));
    CHECK_FALSE(is_field(renamed.old_key));
    CHECK(current_key(std::string(renamed.old_key)) == renamed.key);
    CHECK(current_key(std::string(renamed.key)) == renamed.key);
  }
  CHECK(current_key("camera.speed_mps") == "camera.speed_mps");
  CHECK(current_key("no.such.key") == "no.such.key");
  CHECK(current_key("").empty());
}

TEST_CASE("a project with old names is read, with a warning that names the new one, and saved with the new ones") {
  const Result<ReadProject> read = parse_project(R"({"sigs": 1,
    "own_body": {"stable": {"least_moving_percent": 7}},
    "appearance": {"point_spread_px": 0.7, "grain": {"spread_px": 0.9, "persistence": 0.3, "seed": 4},
                   "codec": {"carried_frames": 5}},
    "export": {"label_least_pixels": 3}})",
                                                 "old.json");
  REQUIRE(read.has_value());
  CHECK(read->project.own_body.stable.min_moving_percent == 7);
  CHECK(read->project.appearance.psf_sigma_px == 0.7);
  CHECK(read->project.appearance.grain.correlation_length_px == 0.9);
  CHECK(read->project.appearance.grain.temporal_correlation == 0.3);
  CHECK(read->project.appearance.grain.seed == 4);
  CHECK(read->project.appearance.codec.predicted_frames == 5);
  CHECK(read->project.output.label_min_pixels == 3);
  REQUIRE(read->warnings.size() == 6);
  CHECK(read->warnings[1].text() ==
        "old.json: appearance.point_spread_px: is called psf_sigma_px today; read as that, and saved so");
  const std::string saved = text_of(read->project);
  CHECK(saved.find("\"psf_sigma_px\": 0.7") != std::string::npos);
  for (const RenamedKey& renamed : renamed_keys()) {
    const std::string name = std::string(renamed.old_key.substr(renamed.old_key.rfind('.') + 1));
    CHECK_MESSAGE(saved.find("\"" + name + "\"") == std::string::npos, name);
  }
}

TEST_CASE("where an old name and today's both stand, today's counts and the old one is an unknown key") {
  const Result<ReadProject> read =
      parse_project(R"({"sigs": 1, "appearance": {"point_spread_px": 0.7, "psf_sigma_px": 0.2}})", "both.json");
  REQUIRE(read.has_value());
  CHECK(read->project.appearance.psf_sigma_px == 0.2);
  REQUIRE(read->warnings.size() == 1);
  CHECK(read->warnings[0].text().starts_with("both.json: appearance.point_spread_px: unknown key, kept"));
}

TEST_CASE("sections that are no objects are refused as ever, whatever name they hide") {
  for (const char* const text : {R"({"sigs": 1, "appearance": 5})", R"({"sigs": 1, "appearance": {"grain": [1]}})"})
    CHECK_FALSE(parse_project(text, "x.json").has_value());
}

TEST_CASE("a setting may be given by its old name") {
  Project project;
  REQUIRE(set_field(project, "appearance.grain.persistence=0.25"));
  CHECK(project.appearance.grain.temporal_correlation == 0.25);
  CHECK_FALSE(set_field(project, "appearance.grain.persistance=0.25"));
}
