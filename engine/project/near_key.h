// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>

namespace sigs {

// The key that somebody who wrote `key` may have meant: the one with the fewest letters changed, added or left out
// (Levenshtein's distance), at most half of the longer one's. None: no key is near.
[[nodiscard]] std::optional<std::string> near_key(std::span<const std::string> keys, const std::string& key);

// "; did you mean seed?", or nothing.
[[nodiscard]] std::string suggestion(std::span<const std::string> keys, const std::string& key);

}  // namespace sigs
