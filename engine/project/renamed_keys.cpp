// SPDX-License-Identifier: MIT
#include "project/renamed_keys.h"

#include <algorithm>
#include <array>
#include <utility>

namespace sigs {

namespace {

constexpr std::array<RenamedKey, 10> kRenamed{{
    {"own_body.paper.least_area_percent", "own_body.paper.min_area_percent"},
    {"own_body.stable.least_area_percent", "own_body.stable.min_area_percent"},
    {"own_body.stable.least_moving_percent", "own_body.stable.min_moving_percent"},
    {"appearance.point_spread_px", "appearance.psf_sigma_px"},
    {"appearance.chroma_spread_px", "appearance.chroma_blur_px"},
    {"appearance.grain.spread_px", "appearance.grain.correlation_length_px"},
    {"appearance.grain.persistence", "appearance.grain.temporal_correlation"},
    {"appearance.codec.carried_frames", "appearance.codec.predicted_frames"},
    {"export.label_least_pixels", "export.label_min_pixels"},
    {"export.label_least_visible_fraction", "export.label_min_visible_fraction"},
}};

}  // namespace

std::span<const RenamedKey> renamed_keys() {
  return kRenamed;
}

std::string current_key(const std::string& key) {
  const auto* const renamed =
      std::find_if(kRenamed.begin(), kRenamed.end(), [&](const RenamedKey& one) { return one.old_key == key; });
  return renamed == kRenamed.end() ? key : std::string(renamed->key);
}

std::vector<Warning> rename_old_keys(Json& json, std::string_view section, const std::string& where) {
  std::vector<Warning> warnings;
  const std::string prefix = section.empty() ? "" : std::string(section) + ".";
  for (const RenamedKey& renamed : kRenamed) {
    if (!renamed.old_key.starts_with(prefix)) continue;
    const Json::json_pointer before = pointer_of(renamed.old_key.substr(prefix.size()));
    const Json::json_pointer now = pointer_of(renamed.key.substr(prefix.size()));
    if (!json.contains(before)) continue;
    if (json.contains(now)) continue;  // the old one is an unknown key
    // A renamed key stays in its object.
    Json value = std::move(json.at(before));
    Json& object = json.at(before.parent_pointer());
    object.erase(before.back());
    object[now.back()] = std::move(value);
    warnings.push_back({where + std::string(renamed.old_key.substr(prefix.size())),
                        "is called " + now.back() + " today; read as that, and saved so"});
  }
  return warnings;
}

}  // namespace sigs
