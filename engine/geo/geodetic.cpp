// SPDX-License-Identifier: MIT
#include "geo/geodetic.h"

#include <fmt/format.h>

#include "base/text.h"

namespace sigs {

namespace {

// False for NaN too.
bool is_within(double number, double low, double high) {
  return number >= low && number <= high;
}

tl::unexpected<Error> out_of_range(const char* name, double number, const char* range) {
  return fail("", fmt::format("{} {} is not {}", name, short_number_text(number), range));
}

}  // namespace

Result<void> check_place(const GeodeticPosition& place) {
  if (!is_within(place.latitude_deg, -90, 90)) return out_of_range("latitude", place.latitude_deg, "from -90 to 90");
  if (!is_within(place.longitude_deg, -180, 180))
    return out_of_range("longitude", place.longitude_deg, "from -180 to 180");
  if (!is_within(place.height_m, kLowestHeight_m, kHighestHeight_m))
    return out_of_range("height", place.height_m, "from -12,000 to 10,000,000 m");
  return {};
}

}  // namespace sigs
