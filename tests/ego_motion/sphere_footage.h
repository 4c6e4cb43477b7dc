// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "camera/camera.h"

namespace sigs::test {

// 25 frames a second of a world at infinity, which is random grey on a sphere, seen through the lens of a camera that
// turns. Frame times are n / 25; the codec loses nothing.
//   world_from_camera  of each frame
//   seeds              of the world that each frame shows; below 0: with a bright, plain sky above the horizon
[[nodiscard]] std::filesystem::path sphere_footage(const std::filesystem::path& folder, const Camera& camera,
                                                   std::span<const glm::dquat> world_from_camera,
                                                   std::span<const int> seeds);

// Turns in closed form: a slow pan with shake about all axes.
[[nodiscard]] std::vector<glm::dquat> shaken_pan(int frames);

// 320x240, 250 px a radian in the middle.
[[nodiscard]] Camera sphere_camera(LensModel model);

}  // namespace sigs::test
