// SPDX-License-Identifier: MIT
#include "geo/geo_path.h"

namespace sigs {

std::string description_of(const GeoPath& path) {
  std::string text = path.description;
  if (path.utc || !path.has_times) return text;
  if (!text.empty()) text += ' ';
  return text += kNoUtcText;
}

}  // namespace sigs
