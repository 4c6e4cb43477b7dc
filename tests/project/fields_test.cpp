// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>

#include "project/fields.h"
#include "project/json.h"

using namespace sigs;

namespace {

Project with_one_intruder() {
  Project p;
  p.intruders.resize(1);
  p.intruders[0].trajectory.waypoints.resize(2);
  return p;
}

std::string refusal(const std::string& assignment) {
  Project p = with_one_intruder();
  const Result<void> set = set_field(p, assignment);
  REQUIRE_FALSE(set.has_value());
  CHECK(set.error().kind == ErrorKind::usage);
  return set.error().text();
}

}  // namespace

TEST_CASE("numbers and vectors and names and texts are set by their key") {
  Project p = with_one_intruder();
  REQUIRE(set_field(p, "camera.speed_mps=30").has_value());
  REQUIRE(set_field(p, "light.position_m=[0, 0, -500]").has_value());
  REQUIRE(set_field(p, "export.video.codec=h264").has_value());
  REQUIRE(set_field(p, "footage.video=a=b.mkv").has_value());
  REQUIRE(set_field(p, "name=42").has_value());
  REQUIRE(set_field(p, "footage.last_frame=null").has_value());
  REQUIRE(set_field(p, "export.labels=[\"xml\"]").has_value());
  REQUIRE(set_field(p, "export.encounter=[\"small-uas\", \"nmac\"]").has_value());
  REQUIRE(set_field(p, "intruders[0].trajectory.waypoints[1].position_m=[1,2,3]").has_value());
  CHECK(p.camera.speed_mps == 30);
  CHECK(p.light.position_m == glm::dvec3(0, 0, -500));
  CHECK(p.output.codec == VideoCodec::h264);
  CHECK(p.footage.video == "a=b.mkv");
  CHECK(p.name == "42");
  CHECK(p.output.encounter == std::vector<std::string>{"small-uas", "nmac"});
  CHECK(p.intruders[0].trajectory.waypoints[1].position_m == glm::dvec3(1, 2, 3));
}

TEST_CASE("null is no name: a text stays or is refused, and quotes make it a word") {
  Project p;
  p.name = "flight";
  (void)set_field(p, "name=null");
  CHECK(p.name != "null");
}

TEST_CASE("null clears a path") {
  Project p = with_one_intruder();
  p.footage.own_body_mask = "mask.png";
  REQUIRE(set_field(p, "footage.own_body_mask=null").has_value());
  CHECK(p.footage.own_body_mask.empty());
}

TEST_CASE("for a misspelt key the most similar one is suggested") {
  CHECK(refusal("camera.sped_mps=30").find("did you mean camera.speed_mps?") != std::string::npos);
  CHECK(refusal("intruders[7].name=x").find("intruders[0].name") != std::string::npos);
}

TEST_CASE("an assignment without key or sign or with a wrong type is refused") {
  CHECK(refusal("camera.speed_mps").find("expected key=value") != std::string::npos);
  CHECK(refusal("=5").find("expected key=value") != std::string::npos);
  CHECK(refusal("camera.speed_mps=fast").find("expected a number, found \"fast\"") != std::string::npos);
  CHECK(refusal("camera.speed_mps=").find("expected a number") != std::string::npos);
  CHECK(refusal("export.encounter=nmac").find("expected a list of texts") != std::string::npos);
  CHECK(refusal("camera.speed_mps=\xff").find("expected a number") != std::string::npos);
  CHECK(refusal("export.labels=" + std::string(50'000, '[') + std::string(50'000, ']')).find("expected a list") !=
        std::string::npos);
}

TEST_CASE("a text that is not UTF-8 can be set, and the project still written") {
  Project p = with_one_intruder();
  REQUIRE(set_field(p, "footage.video=caf\xe9.mkv").has_value());
  CHECK(p.footage.video == "caf\xe9.mkv");
  CHECK(text_of(p).find("caf\xEF\xBF\xBD.mkv") != std::string::npos);
}
