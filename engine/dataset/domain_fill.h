// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/json.h"
#include "base/random.h"
#include "base/result.h"
#include "camera/camera.h"
#include "dataset/domain_coverage.h"
#include "dataset/recipe.h"
#include "truth/annotation.h"

namespace sigs {

// A recipe with further videos, for what a dataset lacks of a design domain.

struct DomainFill {
  std::string recipe;                 // its text: the recipe with its videos, and further groups of one video each
  int videos = 0;                     // how many were added
  std::vector<std::string> unfilled;  // lines: bins and pairs of bins that stay empty, and why
};

// The recipe with videos for the empty bins and pairs of bins of the coverage. For each of them flights of the kind
// image_position are computed whose range or size, bearing, elevation, aspect, closing speed and side of the horizon
// lie in the bins, with backgrounds, aircraft and groups (light, appearance, camera, footage and tags) that have the
// words; all are planned, and those that cover most are kept, one after the other. The videos that the recipe has
// already stay as they are, so that `sigs dataset FILE --resume` adds to the dataset. The same input gives the same
// text.
//   coverage  of the recipe's videos, predicted or counted
//   settings  KEY=VALUE beside the recipe, as read_recipe() took them
//   file      where the text is to be written: its paths start there
// Errors: those of plan_of(); interrupted.
[[nodiscard]] Result<DomainFill> filled_recipe(const Recipe& recipe, DomainCoverage coverage,
                                               const std::vector<std::string>& settings,
                                               const std::filesystem::path& file,
                                               const std::atomic<bool>* cancel = nullptr);

// --- Its parts.

// What a flight should show at one time. Numbers that are not named are free.
struct DomainWish {
  std::map<DomainNumber, Span> numbers;
  std::optional<HorizonSide> horizon;
};

// A flight of the kind image_position, as a recipe has it, that shows what is wished in the middle of its video, as far
// as geometry tells: to be checked by planning it. None: none was found, because the place has no pixel, or no speed of
// the aircraft gives that aspect at that closing speed before this camera.
//
// With p the ray to the intruder, u the camera's speed along p, a the aspect and s the intruder's speed, its velocity
// is s (-cos(a) p + sin(a) q), q level and at right angles to p, and the closing speed is s cos(a) + u.
[[nodiscard]] std::optional<Json> wished_flight(const DomainWish& wish, const Background& background,
                                                const Camera& lens, const Aircraft& aircraft, Random& random);

// Changes the relative paths in the JSON of a recipe, which start in its folder, so that they name the same files from
// another one: of backgrounds, aircraft, flights and settings. What has another form than a recipe stays as it is.
//   from, to  the recipe's file, and the one that it is to be written to
void move_recipe_paths(Json& recipe, const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace sigs
