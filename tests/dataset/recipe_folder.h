// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "base/result.h"
#include "dataset/plan.h"
#include "support/test_data.h"

namespace sigs::test {

// A folder with a recipe in it that uses the sample assets, so that all its files are there.
class RecipeFolder {
 public:
  // {"sigs_dataset": 1, "name": "set", one background "day", one aircraft "jet", one group of one crossing}.
  [[nodiscard]] static nlohmann::ordered_json recipe();

  [[nodiscard]] std::filesystem::path file() const { return folder_ / "set.json"; }
  [[nodiscard]] Result<ReadRecipe> read(const nlohmann::ordered_json& json) const;

  // The plan of it, which must be possible to make.
  [[nodiscard]] Plan plan(const nlohmann::ordered_json& json) const;

  // Message of reading or planning, without the file's name and ": "; empty where nothing is wrong.
  [[nodiscard]] std::string error(const nlohmann::ordered_json& json) const;

 private:
  TemporaryFolder folder_;
};

}  // namespace sigs::test
