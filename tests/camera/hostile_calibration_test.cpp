// SPDX-License-Identifier: MIT
// Texts that are meant to exhaust stack, time or memory are refused in one line, at once. A hang ends the test by its
// alarm.
#include <doctest/doctest.h>

#include <unistd.h>

#include <fstream>
#include <opencv2/core.hpp>
#include <string>

#include "camera/camera.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

// Ends the program where a text takes minutes: only a hang does.
class HangGuard {
 public:
  HangGuard() { alarm(120); }
  ~HangGuard() { alarm(0); }
  HangGuard(const HangGuard&) = delete;
  HangGuard& operator=(const HangGuard&) = delete;
};

std::string repeated(const std::string& piece, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += piece;
  return text;
}

void check_refused(const std::string& text, const std::string& key_word) {
  const HangGuard guard;
  const TemporaryFolder folder;
  std::ofstream(folder / "hostile.any", std::ios::binary) << text;
  const auto camera = read_calibration(folder / "hostile.any", cv::Size(640, 480));
  REQUIRE_FALSE(camera.has_value());
  const std::string message = camera.error().text();
  CAPTURE(message);
  CHECK(camera.error().kind == ErrorKind::bad_data);
  CHECK(message.find("hostile.any: ") != std::string::npos);
  CHECK(message.find(key_word) != std::string::npos);
  CHECK(message.find('\n') == std::string::npos);
  CHECK(message.size() < 300);
}

constexpr int kDeep = 100'000;
const std::string kLens = "K: [500, 0, 320, 0, 510, 240, 0, 0, 1]\nD: [0, 0, 0, 0]\n";
const std::string kLensOfJson = R"("K": [500, 0, 320, 0, 510, 240, 0, 0, 1], "D": [0, 0, 0, 0])";

}  // namespace

TEST_CASE("a list that contains itself is refused") {
  check_refused("camera_matrix: &a [1, *a]\n" + kLens, "alias");
  check_refused(kLens + "D: &a {data: *a}\n", "alias");
  check_refused("&a {*a : *a}\n", "alias");
}

TEST_CASE("an alias is refused with its line, whatever it expands to") {
  std::string bomb = "a: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string number = std::to_string(i);
    const std::string before = std::to_string(i - 1);
    bomb.append("b").append(number).append(": &a").append(number).append(" [*a").append(before);
    for (int k = 1; k < 10; ++k) bomb.append(", *a").append(before);
    bomb.append("]\n");
  }
  bomb += "camera_matrix: *a11\nD: [0, 0, 0, 0]\n";
  REQUIRE(bomb.size() < 1024);
  check_refused(bomb, "alias");
  check_refused(kLens + "image_size: &s [640, 480]\nagain: *s\n", "line 4");
}

TEST_CASE("brackets, dashes and keys nested too deep are refused in every kind of YAML and JSON") {
  for (const char* const pair : {"[]", "{}"})
    for (const char* const end : {"", "\n"}) {
      const std::string open = std::string(1, pair[0]) + (pair[0] == '{' ? "a: " : "") + end;
      const std::string deep = repeated(open, kDeep);
      const std::string closed = deep + "1" + repeated(std::string(1, pair[1]), kDeep);
      check_refused(kLens + "x: " + closed, "within one another");
      check_refused(kLens + "x: " + deep, "within one another");
      check_refused("%YAML:1.0\n---\n" + kLens + "x: " + closed, "within one another");
      check_refused("%YAML:1.0\n---\n" + kLens + "x: " + deep, "within one another");
    }
  check_refused(kLens + "x:\n" + repeated("- ", kDeep) + "1\n", "within one another");
  check_refused("%YAML:1.0\n---\n" + repeated("- ", kDeep) + "1\n", "within one another");
  check_refused("%YAML:1.0\n---\n" + repeated("a:", kDeep) + "1\n", "not a calibration");  // a text of one line
  for (const std::string open : {"[", R"({"a": )"}) {
    const std::string close = open == "[" ? "]" : "}";
    const std::string deep = repeated(open, kDeep);
    check_refused("{" + kLensOfJson + ", \"x\": " + deep + "1" + repeated(close, kDeep) + "}", "within one another");
    check_refused("{" + kLensOfJson + ", \"x\": " + deep, "within one another");
    check_refused(R"({"fisheye_params": {"camera_matrix": )" + deep + "1" + repeated(close, kDeep) + "}}",
                  "within one another");
  }
}

TEST_CASE("closing brackets in keys, strings and comments do not hide the depth") {
  check_refused("%YAML:1.0\n---\nx: " + repeated("{ a}: ", kDeep), "line 3");
  check_refused("%YAML:1.0\n---\nx: " + repeated("[ \"]\", ", kDeep), "within one another");
  check_refused("%YAML:1.0\n---\nx: " + repeated("[ # ]\n", kDeep), "within one another");
  check_refused("<?xml version=\"1.0\"?><opencv_storage>" + repeated("<a><!-- </a> -->", kDeep), "within one another");
}

TEST_CASE("tags nested too deep are refused") {
  const std::string head = "<?xml version=\"1.0\"?>\n<opencv_storage>\n";
  const std::string deep = repeated("<a>", kDeep);
  check_refused(head + deep + "1" + repeated("</a>", kDeep) + "</opencv_storage>\n", "within one another");
  check_refused(head + deep, "within one another");
  check_refused(repeated("<a>", kDeep), "within one another");
}

TEST_CASE("indentation of a thousand levels is refused") {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
  check_refused(kLens + text, "within one another");
  check_refused("%YAML:1.0\n---\n" + kLens + text, "within one another");
}

TEST_CASE("a calibration of many megabytes is refused for its size") {
  check_refused(kLens + "note: " + std::string(std::size_t{20} << 20, 'x') + "\n", "MiB");
}

TEST_CASE("two hundred thousand unknown keys are ignored") {
  const HangGuard guard;
  const TemporaryFolder folder;
  std::string yaml = kLens;
  std::string json = "{" + kLensOfJson;
  std::string xml = "<?xml version=\"1.0\"?>\n<opencv_storage>\n<K>500 0 320 0 510 240 0 0 1</K><D>0 0 0 0</D>\n";
  for (int i = 0; i < 200'000; ++i) {
    const std::string key = std::string("k").append(std::to_string(i));
    yaml.append(key).append(": 1\n");
    json.append(", \"").append(key).append("\": 1");
    xml.append("<").append(key).append(">1</").append(key).append(">\n");
  }
  for (const std::string& text : {"%YAML:1.0\n---\n" + yaml, yaml, json + "}", xml + "</opencv_storage>\n"}) {
    std::ofstream(folder / "many.any", std::ios::binary) << text;
    const auto camera = read_calibration(folder / "many.any", cv::Size(640, 480));
    REQUIRE_MESSAGE(camera.has_value(), camera.error().text());
    CHECK(camera->lens.parameters().fy == 510);
  }
}

TEST_CASE("YAML on which OpenCV's storage hangs is refused, and what follows the first document is not read") {
  check_refused("%YAML:1.0\n---\n[q]2:\n  - }\n", "line");
  const HangGuard guard;
  const TemporaryFolder folder;
  std::ofstream(folder / "two.yml") << "%YAML:1.0\n---\n" << kLens << "...\n---\n[q]2:\n";
  CHECK(read_calibration(folder / "two.yml", cv::Size(640, 480)).has_value());
}

TEST_CASE("anchors without aliases are ignored") {
  const TemporaryFolder folder;
  std::ofstream(folder / "anchor.yaml") << "K: &k [500, 0, 320, 0, 510, 240, 0, 0, 1]\nD: &d [0, 0, 0, 0]\n";
  CHECK(read_calibration(folder / "anchor.yaml", cv::Size(640, 480)).has_value());
}

}  // namespace sigs::test
