// SPDX-License-Identifier: MIT
#include "telemetry/read_track.h"

#include <doctest/doctest.h>

using namespace sigs;
TEST_CASE("a file that is missing is an error that names it") {
  const Result<Track> track = read_track("/nowhere/flight.ulg");
  REQUIRE(!track);
  CHECK(track.error().kind == ErrorKind::cannot_read);
}
