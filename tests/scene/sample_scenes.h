// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <cstring>
#include <opencv2/core.hpp>
#include <string>

#include "project/json.h"
#include "scene/scene.h"
#include "support/test_data.h"

namespace sigs::test {

inline constexpr std::array<const char*, 3> kSampleProjects{"crossing", "head-on", "two-intruders"};

[[nodiscard]] inline Project sample_project(const std::string& name) {
  Result<ReadProject> read = read_project(source_dir() / "projects" / name / (name + ".json"));
  REQUIRE_MESSAGE(read.has_value(), name);
  return std::move(read->project);
}

// The properties of the sample video, without opening it.
[[nodiscard]] inline FootageShape sample_footage() {
  FootageShape footage{.size_px = {1280, 960}, .frame_interval_s = 0.04};
  for (int frame = 0; frame < 200; ++frame) footage.times_s.push_back(frame / 25.0);
  return footage;
}

[[nodiscard]] inline bool same_bits(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  for (int y = 0; y < a.rows; ++y)
    if (std::memcmp(a.ptr(y), b.ptr(y), static_cast<std::size_t>(a.cols) * a.elemSize()) != 0) return false;
  return true;
}

}  // namespace sigs::test
