// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "flights/body.h"
#include "flights/camera_path.h"
#include "flights/reflection.h"
#include "flights/terrain.h"

namespace sigs::flights {

inline constexpr double kGrain_codes = 2;

// What a flight is made of. A new case is one more entry in cases().
struct Case {
  std::string name;
  std::vector<Part> parts;
  Path path;
  Propeller propeller;
  Roads roads = Roads::winding;
  double cloudiness = 1;
  double bar_share = 0;  // of the image's height that a black bar takes at the top, and another at the bottom
  bool exposure_drifts = false;
  bool small_mover = false;
  double shake = 1;  // factor on the amplitude of the body's shaking
  double grain_codes = kGrain_codes;
  Reflection reflection;
};

// frames: the intended number of frames.
[[nodiscard]] std::vector<Case> cases(int frames);

// Beyond the requirements: the limits of the detection.
[[nodiscard]] std::vector<Case> hard_cases();

// The cases to which the confidence is fitted, beside cases() and hard_cases(): reflections, and bodies behind them.
[[nodiscard]] std::vector<Case> reflecting_cases();

// Cases to which nothing is fitted: bodies of other shapes, other reflections, other seeds. For evaluation alone.
[[nodiscard]] std::vector<Case> unseen_cases();

[[nodiscard]] std::vector<cv::Rect> bars(const Case& scene, cv::Size size_px);

}  // namespace sigs::flights
