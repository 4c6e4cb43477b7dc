// SPDX-License-Identifier: MIT
#include "geo/geodetic.h"

#include <fmt/format.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>

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

struct LocalFrame::Cartesian {
  GeographicLib::LocalCartesian east_north_up;
};

LocalFrame::LocalFrame(const GeodeticPosition& origin, double heading_rad)
    : origin_(origin),
      heading_rad_(heading_rad),
      cartesian_(std::make_shared<const Cartesian>(
          Cartesian{GeographicLib::LocalCartesian(origin.latitude_deg, origin.longitude_deg, origin.height_m)})) {}

glm::dvec3 LocalFrame::world_of_ned(const glm::dvec3& ned) const {
  const double c = std::cos(heading_rad_);
  const double s = std::sin(heading_rad_);
  return {c * ned.x + s * ned.y, c * ned.y - s * ned.x, ned.z};
}

glm::dvec3 LocalFrame::ned_of_world(const glm::dvec3& in_world) const {
  const double c = std::cos(heading_rad_);
  const double s = std::sin(heading_rad_);
  return {c * in_world.x - s * in_world.y, s * in_world.x + c * in_world.y, in_world.z};
}

glm::dvec3 LocalFrame::world_of(const GeodeticPosition& place) const {
  glm::dvec3 enu;
  cartesian_->east_north_up.Forward(place.latitude_deg, place.longitude_deg, place.height_m, enu.x, enu.y, enu.z);
  return world_of_ned({enu.y, enu.x, -enu.z});
}

GeodeticPosition LocalFrame::place_of(const glm::dvec3& p_in_world) const {
  const glm::dvec3 ned = ned_of_world(p_in_world);
  GeodeticPosition place;
  cartesian_->east_north_up.Reverse(ned.y, ned.x, -ned.z, place.latitude_deg, place.longitude_deg, place.height_m);
  return place;
}

}  // namespace sigs
