// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "camera/lens.h"
#include "scene/scene.h"
#include "video/frame.h"

namespace sigs::accuracy {

inline const cv::Size kImageSize_px{1280, 960};
inline constexpr int kFrame = 1;  // of the scenes below: the intruder is on its way through `pixel`

// The intruder and its view.
struct Recipe {
  std::string name;     // in tables: "near"
  std::string title;    // in plots: "near: 400 px"
  double size_px = 60;  // longer side of the silhouette's box
  std::string aircraft = "light-aircraft";
  LensParameters lens;
  glm::dvec2 pixel{520, 390};               // pixel of the reference point
  glm::dvec3 flies_along{-0.8, 0.55, 0.1};  // in the world: towards the camera, to the right, a little down
  std::optional<double> sigma_px;           // of the blur; none: the project's default
  bool has_own_body = false;
  bool in_sun = false;  // which throws shadows; otherwise the point light
};

// The lens of the sample clip, and three with other distortion.
[[nodiscard]] LensParameters sample_lens();
[[nodiscard]] LensParameters fisheye_170_lens();  // 170 degrees across the image's width
[[nodiscard]] LensParameters tangential_lens();
[[nodiscard]] LensParameters pincushion_lens();

// The scenes of docs/research/accuracy.md.
[[nodiscard]] std::vector<Recipe> recipes();

// The recipe as a project in the folder, from the sample assets, opened; placed so that it is as large as wanted.
[[nodiscard]] Scene made_scene(const Recipe& recipe, const std::filesystem::path& folder);

// A smooth sky over smooth ground with a little grain, in PixelLayout::rgb: chroma that pixels share would add an error
// of the footage's own to every method.
[[nodiscard]] Frame background(cv::Size size_px);

}  // namespace sigs::accuracy
