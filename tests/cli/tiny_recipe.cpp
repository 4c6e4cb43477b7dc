// SPDX-License-Identifier: MIT
#include "cli/tiny_recipe.h"

#include <stdexcept>

#include "base/staged_outputs.h"
#include "support/test_data.h"

namespace sigs::test {

namespace fs = std::filesystem;

namespace {

constexpr const char* kRecipe = R"({
  "sigs_dataset": 1, "name": "tiny", "seed": 0,
  "settings": {"export.labels": ["xml", "coco", "mot", "csv"]},
  "backgrounds": [{"name": "sky", "footage": {"video": "clip.mkv", "calibration": "lens.xml"}}],
  "aircraft": [{"name": "red", "model": {"file": "cube.obj"}},
               {"name": "large", "model": {"file": "cube.obj", "scale": 2}}],
  "videos": [{"name": "{aircraft} {flight}", "aircraft": ["red", "large"],
    "flights": [{"name": "LR", "kind": "left_right", "distance_m": {"uniform": [15, 25]}},
                {"name": "RL", "kind": "right_left", "distance_m": 20},
                {"name": "FN", "kind": "approaching", "from_distance_m": 60, "to_distance_m": 15}]}],
  "splits": {"train": 0.5, "test": 0.5}
})";

}  // namespace

void write_tiny_recipe(const fs::path& file) {
  write_file(file, kRecipe);
}

TinyRecipe::TinyRecipe(int frames) : tiny_(frames) {
  write_tiny_recipe(file("recipe.json"));
}

std::string TinyRecipe::arguments(const std::string& out_name, const std::string& more) const {
  return "dataset " + file("recipe.json").string() + " --out " + out(out_name) + " " + more;
}

Run TinyRecipe::run(const std::string& out_name, const std::string& more) const {
  return run_sigs(arguments(out_name, more));
}

void TinyRecipe::change(const std::string& from, const std::string& to) const {
  std::string text = read_text(file("recipe.json")).value();
  const std::size_t place = text.find(from);
  if (place == std::string::npos) throw std::runtime_error("not in the recipe: " + from);
  write_file(file("recipe.json"), text.replace(place, from.size(), to));
}

}  // namespace sigs::test
