// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "base/json.h"
#include "base/result.h"

namespace sigs {

// A dataset that has been made, as its files tell it.

// A video of the index.
struct IndexedVideo {
  std::string name;                         // a name that is allowed (dataset/recipe.h)
  std::string split;                        // empty: none
  std::map<std::string, std::string> tags;  // background, aircraft, flight and those of the recipe
  std::map<std::string, double> sampled;    // numbers that were sampled for it ("drawn")
};

// FOLDER/index.json. Errors: cannot_read; bad_data: it is no JSON.
[[nodiscard]] Result<Json> read_index(const std::filesystem::path& folder);

// The videos of an index, in its order. file: the index, named in errors. Error bad_data: it has no list of videos, or
// one without an allowed name.
[[nodiscard]] Result<std::vector<IndexedVideo>> videos_in_index(const Json& index, const std::filesystem::path& file);

// FOLDER/NAME/NAME.xml, whose element "sigs" is there. Errors: cannot_read, which names export.labels; bad_data.
[[nodiscard]] Result<pugi::xml_document> annotations_of(const std::filesystem::path& folder, const std::string& video);

// A number of an annotation; not a number (NaN) where it is missing or no number.
[[nodiscard]] double attribute_of(pugi::xml_node node, const char* name);

// Categories of a video's intruders by their ids, from FOLDER/NAME/NAME.json. Empty where that cannot be read.
[[nodiscard]] std::map<std::string, std::string> categories_of(const std::filesystem::path& folder,
                                                               const std::string& video);

}  // namespace sigs
