// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "project/json_reading.h"

namespace sigs {

// A key of the project file that had another name in older files: "appearance.point_spread_px" is
// "appearance.psf_sigma_px" today. Old names are read wherever today's are; only today's are written.
struct RenamedKey {
  std::string_view old_key;
  std::string_view key;
};

[[nodiscard]] std::span<const RenamedKey> renamed_keys();

// The name that a key has today: its new one where it was renamed, else itself.
[[nodiscard]] std::string current_key(const std::string& key);

// Moves the values that stand under old names in a part of a project file to today's names, and gives back a warning for
// each. Where both stand there, today's counts and the old one stays as it is.
//   section  the part's key in the project, "appearance"; empty: the whole project
//   where    what warnings put before the key, "p.json: "
std::vector<Warning> rename_old_keys(Json& json, std::string_view section, const std::string& where);

}  // namespace sigs
