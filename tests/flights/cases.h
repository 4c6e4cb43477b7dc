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
  double shake = 1;  // factor on how far the body trembles
  double grain_codes = kGrain_codes;
  Reflection reflection;
};

// frames: how many are meant to be looked at.
[[nodiscard]] std::vector<Case> cases(int frames);

// Harder than can be asked for: where finding the body ends.
[[nodiscard]] std::vector<Case> hard_cases();

// What the confidence is set by, beside cases() and hard_cases(): reflections, and bodies seen through them.
[[nodiscard]] std::vector<Case> reflecting_cases();

// What nothing is set by: bodies of other shapes, other reflections, other seeds. For the honest figure alone.
[[nodiscard]] std::vector<Case> unseen_cases();

[[nodiscard]] std::vector<cv::Rect> bars(const Case& scene, cv::Size size_px);

}  // namespace sigs::flights
