// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "cli/program.h"
#include "cli/tiny_project.h"

namespace sigs::test {

// Writes a recipe of six videos; the tiny project's files are to lie in the same folder.
void write_tiny_recipe(const std::filesystem::path& file);

// A recipe of six videos of the tiny project's clip: one of two cubes on one of three paths.
class TinyRecipe {
 public:
  explicit TinyRecipe(int frames = 8);

  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return tiny_.file(name); }
  [[nodiscard]] std::string out(const std::string& name) const { return tiny_.file(name).string(); }

  // What follows `sigs dataset RECIPE --out OUT `.
  [[nodiscard]] std::string arguments(const std::string& out, const std::string& more = "") const;
  [[nodiscard]] Run run(const std::string& out, const std::string& more = "") const;

  // Replaces a piece of the recipe, which must be there.
  void change(const std::string& from, const std::string& to) const;

 private:
  TinyProject tiny_;
};

}  // namespace sigs::test
