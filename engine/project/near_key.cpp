// SPDX-License-Identifier: MIT
#include "project/near_key.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace sigs {

namespace {

// Levenshtein's distance: how many letters to change, add or leave out.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({changed, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::optional<std::string> near_key(std::span<const std::string> keys, const std::string& key) {
  std::optional<std::string> nearest;
  std::size_t least = 0;
  for (const std::string& known : keys) {
    const std::size_t distance = edit_distance(known, key);
    if (2 * distance > std::max(known.size(), key.size())) continue;
    if (nearest && distance >= least) continue;
    nearest = known;
    least = distance;
  }
  return nearest;
}

std::string suggestion(std::span<const std::string> keys, const std::string& key) {
  const std::optional<std::string> near = near_key(keys, key);
  return near ? "; did you mean " + *near + "?" : "";
}

}  // namespace sigs
