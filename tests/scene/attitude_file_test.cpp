// SPDX-License-Identifier: MIT
#include "scene/scene_files.h"

#include <doctest/doctest.h>

#include <clocale>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "support/test_data.h"

using namespace sigs;

namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180;
const std::string kHeader = "frame,roll_deg,pitch_deg,yaw_deg\n";

Result<std::vector<AttitudeAtFrame>> read(const std::string& text) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "gyro log \xC3\xA9.csv";
  std::ofstream(file, std::ios::binary) << text;
  return read_attitude_file(file);
}

std::string error_of(const std::string& text) {
  const Result<std::vector<AttitudeAtFrame>> attitudes = read(text);
  if (attitudes) return "no error";
  const std::string whole = attitudes.error().text();
  const std::size_t name = whole.find(".csv: ");
  REQUIRE(name != std::string::npos);
  CHECK(whole.find('\n') == std::string::npos);
  return whole.substr(name + 6);
}

}  // namespace

TEST_CASE("each line gives a frame its angles, written in degrees") {
  const auto attitudes = read(kHeader + "0,1,-2,3\n4,0.5,1e-3,-359.5\n");
  REQUIRE(attitudes.has_value());
  REQUIRE(attitudes->size() == 2);
  CHECK(attitudes->at(0).frame == 0);
  CHECK(attitudes->at(0).attitude.roll_rad == doctest::Approx(1 * kRadPerDeg));
  CHECK(attitudes->at(0).attitude.pitch_rad == doctest::Approx(-2 * kRadPerDeg));
  CHECK(attitudes->at(0).attitude.yaw_rad == doctest::Approx(3 * kRadPerDeg));
  CHECK(attitudes->at(1).frame == 4);
  CHECK(attitudes->at(1).attitude.pitch_rad == doctest::Approx(1e-3 * kRadPerDeg));
  CHECK(attitudes->at(1).attitude.yaw_rad == doctest::Approx(-359.5 * kRadPerDeg));
}

TEST_CASE("a file from another system reads the same") {
  for (const std::string& text :
       {"\xEF\xBB\xBF" + kHeader + "-1.5,1,2,3\n7,4,5,6\n",  // a byte order mark
        std::string("frame,roll_deg,pitch_deg,yaw_deg\r\n-1.5,1,2,3\r\n7,4,5,6\r\n"),
        kHeader + "\n-1.5,1,2,3\n\n7,4,5,6",  // empty lines, none at the end
        std::string(" frame , roll_deg,\tpitch_deg,yaw_deg\n -1.5 ,1, 2,3 \n7,4,\t5,6\n\n")}) {
    CAPTURE(text);
    const auto attitudes = read(text);
    REQUIRE(attitudes.has_value());
    REQUIRE(attitudes->size() == 2);
    CHECK(attitudes->at(0).frame == -1.5);
    CHECK(attitudes->at(0).attitude.pitch_rad == doctest::Approx(2 * kRadPerDeg));
    CHECK(attitudes->at(1).frame == 7);
    CHECK(attitudes->at(1).attitude.yaw_rad == doctest::Approx(6 * kRadPerDeg));
  }
}

TEST_CASE("errors are reported with line and column") {
  CHECK(error_of("") == "line 1: expected the header frame,roll_deg,pitch_deg,yaw_deg");
  CHECK(error_of("0,1,2,3\n").starts_with("line 1: expected the header"));
  CHECK(error_of("frame,roll,pitch,yaw\n0,1,2,3\n").starts_with("line 1: expected the header"));
  CHECK(error_of("frame,roll_deg,pitch_deg\n0,1,2\n").starts_with("line 1: expected the header"));
  CHECK(error_of("frame,roll_deg,pitch_deg,yaw_deg,more\n0,1,2,3,4\n").starts_with("line 1: expected the header"));
  CHECK(error_of(kHeader) == "has no line below its header; expected one for each frame");
  CHECK(error_of(kHeader + "0,1,2,3\n1,1,2\n") == "line 3: expected 4 numbers between commas, found 3");
  CHECK(error_of(kHeader + "0,0,1,0,2,0,3\n") == "line 2: expected 4 numbers between commas, found 7");
  for (const char* const none : {"", "x", "1x", "1 2", "nan", "-inf", "1e999", "0x10", "+-1", "1\"", "\"1\""}) {
    CAPTURE(none);
    const std::string cell = none;
    CHECK(error_of(kHeader + "0,1,2,3\n\n1," + cell + ",0,0\n") == "line 4: roll_deg: is not a number such as -0.25");
    CHECK(error_of(kHeader + cell + ",1,2,3\n") == "line 2: frame: is not a number such as -0.25");
  }
  CHECK(error_of(kHeader + "0,0,360.5,0\n") == "line 2: pitch_deg: must lie between -360 and 360 degrees");
  CHECK(error_of(kHeader + "0,0,0,-1e300\n") == "line 2: yaw_deg: must lie between -360 and 360 degrees");
  CHECK(error_of(kHeader + "2e9,0,0,0\n") == "line 2: frame: must lie between -1e9 and 1e9");
  const std::string rise = ": frame: is not after the frame of the line before; frames must rise";
  CHECK(error_of(kHeader + "0,0,0,0\n1,0,0,0\n1,0,0,0\n") == "line 4" + rise);
  CHECK(error_of(kHeader + "3,0,0,0\n2.5,0,0,0\n") == "line 3" + rise);
}

TEST_CASE("numbers have a decimal point in every locale") {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* const locale : {"de_DE.UTF-8", "fr_FR.UTF-8", "C"}) {
    std::setlocale(LC_ALL, locale);
    const auto attitudes = read(kHeader + "0,0.25,0,0\n");
    REQUIRE(attitudes.has_value());
    CHECK(attitudes->at(0).attitude.roll_rad == doctest::Approx(0.25 * kRadPerDeg));
  }
  std::setlocale(LC_ALL, before.c_str());
}

TEST_CASE("a missing file and a folder cannot be read") {
  const test::TemporaryFolder folder;
  CHECK(read_attitude_file(folder / "none.csv").error().kind == ErrorKind::cannot_read);
  CHECK(read_attitude_file(folder.path()).error().kind == ErrorKind::cannot_read);
}
