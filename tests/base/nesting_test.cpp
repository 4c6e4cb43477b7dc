// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <algorithm>
#include <opencv2/core.hpp>
#include <random>
#include <string>

#include "base/nesting.h"

namespace sigs::test {
namespace {

int depth_of(const cv::FileNode& node) {
  if (!node.isSeq() && !node.isMap()) return 0;
  int deepest = 0;
  for (const cv::FileNode& inner : node) deepest = std::max(deepest, depth_of(inner));
  return deepest + 1;
}

// How deep OpenCV went into a text: the nodes that it made, -1 where it accepted none of it. It may never return for
// a text that begins with anything but a key.
int opencv_depth(const std::string& text) {
  try {
    const cv::FileStorage storage(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    return storage.isOpened() ? depth_of(storage.root()) : -1;
  } catch (const std::exception&) {
    return -1;
  }
}

using Random = std::mt19937;

std::string pick(Random& random, std::initializer_list<const char*> choices) {
  return *(choices.begin() + random() % choices.size());
}

// Tokens that mislead a parser that counts brackets.
std::string word(Random& random) {
  return pick(random,
              {"1", "-2.5", "x", "a]b", "\"[[\"", "'{'", "\"]\"", "'it''s ]'", "\"\\\"]\"", "a[b", "x # ]", "}"});
}

std::string flow_value(Random& random, int depth);

std::string flow_list(Random& random, int depth) {
  std::string text("[");
  for (std::size_t i = random() % 3; i > 0; --i)
    text += flow_value(random, depth) + pick(random, {", ", ",", " ,\n   "});
  return text + flow_value(random, depth) + pick(random, {"]", " ]", " # ]\n   ]"});
}

std::string flow_map(Random& random, int depth) {
  std::string text = "{";
  for (std::size_t i = random() % 3; i > 0; --i)
    text += pick(random, {"a", "b]", "c}", "\"d", "e["}) + ":" + flow_value(random, depth) + ",";
  return text + " z: " + flow_value(random, depth) + "}";
}

std::string flow_value(Random& random, int depth) {
  if (depth == 0 || random() % 4 == 0) return word(random);
  return random() % 2 == 0 ? flow_list(random, depth - 1) : flow_map(random, depth - 1);
}

std::string block(Random& random, int depth, int indent) {
  std::string text;
  const bool is_list = random() % 2 == 0;
  for (std::size_t i = 1 + random() % 3; i > 0; --i) {
    text += std::string(static_cast<std::size_t>(indent), ' ');
    text += is_list ? "-" : pick(random, {"k", "\"q]", "l{"}) + std::to_string(i) + ":";
    if (depth > 0 && random() % 2 == 0)
      text.append("\n").append(block(random, depth - 1, indent + 1 + static_cast<int>(random() % 3)));
    else
      text.append(" ").append(flow_value(random, depth)).append("\n");
  }
  return text;
}

}  // namespace

TEST_CASE("no YAML that OpenCV reads is nested deeper than computed") {
  Random random(12);
  int read = 0;
  int deepest = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string text = "%YAML:1.0\n---\n" + block(random, static_cast<int>(random() % 6), 0);
    if (i % 2 == 1)  // damaged at one place
      text[14 + random() % (text.size() - 14)] = "[]{}\"':,-# \n"[random() % 12];
    const int depth = opencv_depth(text);
    if (depth < 0) continue;
    ++read;
    deepest = std::max(deepest, depth);
    CHECK_MESSAGE(opencv_yaml_depth(text) >= depth, text);
  }
  CHECK(read > 2'000);
  CHECK(deepest >= 6);
}

TEST_CASE("a file that OpenCV writes is nested as deep as computed or a level less") {
  for (int depth = 1; depth < 30; ++depth)
    for (const int style : {0, int(cv::FileNode::FLOW)}) {
      cv::FileStorage out(".yml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
      for (int i = 0; i < depth; ++i) {
        if (i % 2 == 0) out << "inner";
        out.startWriteStruct(i % 2 == 0 ? "inner" : "",
                             i % 2 == 0 ? cv::FileNode::SEQ | style : cv::FileNode::MAP | style);
      }
      for (int i = 0; i < depth; ++i) out.endWriteStruct();
      const std::string text = out.releaseAndGetString();
      const int known = opencv_depth(text);
      if (known < 0) continue;
      CHECK_MESSAGE(opencv_yaml_depth(text) >= known, text);
      CHECK_MESSAGE(opencv_yaml_depth(text) <= known + 2, text);
    }
}

TEST_CASE("matrices and lists of a usual calibration are a few levels deep") {
  std::string text = "%YAML:1.0\n---\ncalibration_time: \"Tue 07 Aug 2018 [11:38:23\"\n";
  for (int i = 0; i < 1000; ++i)
    text += "view" + std::to_string(i) + ": !!opencv-matrix\n   rows: 1\n   cols: 2\n   dt: d\n   data: [ 1., 2. ]\n";
  text += "points:\n   - [ [1, 2], [3, 4] ]\n   -\n      - { x: 1, y: [2] }\n";
  CHECK(opencv_yaml_depth(text) >= 3);
  CHECK(opencv_yaml_depth(text) <= 6);
}

TEST_CASE("tags, comments and empty elements are distinguished") {
  CHECK(xml_depth("<?xml version=\"1.0\"?><!DOCTYPE a><a><b/><c d=\"e\"/><f></f></a>") == 2);
  CHECK(xml_depth("<a><!-- <b><c> > --><d/></a>") == 2);
  CHECK(xml_depth("<a><b><c>") == 3);
  CHECK(xml_depth("") == 0);
  CHECK(xml_depth("<") == 1);
  CHECK(xml_depth("</a></a><a>") <= 1);
}

TEST_CASE("brackets in quotes do not nest") {
  CHECK(json_depth(R"({"a": [1, "[[[", "\"[["]})") == 2);
  CHECK(json_depth("[[[") == 3);
  CHECK(json_depth("") == 0);
}

}  // namespace sigs::test
