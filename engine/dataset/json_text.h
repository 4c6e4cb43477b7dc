// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dataset/entry.h"
#include "dataset/plan.h"

namespace sigs {

// Keys stay in the order in which they are put.
using Json = nlohmann::ordered_json;

// What a video is: name, split, tags, sampled.
[[nodiscard]] Json described(const PlannedVideo& video);

// A list of files; before: put before each path.
[[nodiscard]] Json described(const std::vector<DatasetFile>& files, const std::string& before);

// With indents, and a newline at the end. Bytes that are no UTF-8 become the replacement character.
[[nodiscard]] std::string json_text(const Json& json);

}  // namespace sigs
