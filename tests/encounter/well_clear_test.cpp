// SPDX-License-Identifier: MIT
#include "encounter/well_clear.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace sigs;

namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

WellClearVolume en_route() {
  return well_clear_volume("dwc-en-route").value();
}

RelativeState later(const RelativeState& r, double seconds) {
  return {r.horizontal_m + seconds * r.horizontal_mps, r.horizontal_mps, r.vertical_m + seconds * r.vertical_mps,
          r.vertical_mps};
}

// The conditions as the standard words them, in long double and by the formulas of the text.
bool is_lost_by_text(const RelativeState& r, const WellClearVolume& volume) {
  const long double sx = r.horizontal_m.x, sy = r.horizontal_m.y, vx = r.horizontal_mps.x, vy = r.horizontal_mps.y;
  const long double d2 = sx * sx + sy * sy, dot = sx * vx + sy * vy, v2 = vx * vx + vy * vy;
  const long double t = v2 > 0 ? std::max(0.0L, -dot / v2) : 0.0L;
  const long double hmd = std::hypot(sx + t * vx, sy + t * vy);
  const long double limit = volume.dmod_m;
  bool horizontal = d2 <= limit * limit;
  if (!horizontal && dot < 0) horizontal = hmd <= volume.hmd_m && (limit * limit - d2) / dot <= volume.tau_mod_s;
  const long double h = r.vertical_m, vh = r.vertical_mps;
  const bool vertical = std::abs(h) <= volume.zthr_m || (h * vh < 0 && -h / vh <= volume.tcoa_s);
  return horizontal && vertical;
}

}  // namespace

TEST_CASE("the severity of the published example has its published digits") {
  const WellClearVolume volume{"example", 4000 * kFoot_m, 4000 * kFoot_m, 35, 450 * kFoot_m, 0};
  // 100 ft beside and 100 ft ahead, not moving along the line of sight but for closing 1e-12 m/s: HMD 100 ft.
  const RelativeState r{{100 * kFoot_m, 100 * kFoot_m}, {-1e-12, 0}, 100 * kFoot_m, 0};
  CHECK(loss_severity(r, volume) == doctest::Approx(77.38045517985894).epsilon(1e-14));
}

TEST_CASE("severity is 100 at collision, 0 outside of the volume, and falls to 0 at its limits") {
  const WellClearVolume volume = en_route();
  CHECK(loss_severity({{0, 0}, {30, 0}, 0, 0}, volume) == 100);
  CHECK(loss_severity({{volume.dmod_m, 0}, {30, 0}, 0, 0}, volume) == doctest::Approx(0));
  CHECK(loss_severity({{volume.dmod_m + 1, 0}, {30, 0}, 0, 0}, volume) == 0);
  CHECK(loss_severity({{0, 0}, {30, 0}, volume.zthr_m, 0}, volume) == doctest::Approx(0));
  // At the entry by tau: closing at 100 m/s, HMD 0.
  const double entry_m = (3500 + std::sqrt(3500.0 * 3500 + 4 * volume.dmod_m * volume.dmod_m)) / 2;
  CHECK(loss_severity({{entry_m - 1e-6, 0}, {-100, 0}, 0, 0}, volume) == doctest::Approx(0).epsilon(1e-6));
  CHECK(has_lost_well_clear({{entry_m - 1e-6, 0}, {-100, 0}, 0, 0}, volume));
  CHECK_FALSE(has_lost_well_clear({{entry_m + 1e-6, 0}, {-100, 0}, 0, 0}, volume));
}

TEST_CASE("head-on and overtaking: entry and exit are those of the closed form, to 1e-9 s") {
  const WellClearVolume volume = en_route();
  const double d = volume.dmod_m;
  for (const double speed_mps : {240.0, 20.0, 3.0}) {
    // On one line: |s| (|s| + T |v| (-1)) = D^2 at the entry, |s| = D behind at the exit.
    const double flown_m = volume.tau_mod_s * speed_mps;
    const double entry_m = (flown_m + std::sqrt(flown_m * flown_m + 4 * d * d)) / 2;
    const std::optional<TimeInterval> loss = straight_loss({{20000, 0}, {-speed_mps, 0}, 50, 0}, volume);
    REQUIRE(loss);
    CHECK(std::abs(loss->begin_s - (20000 - entry_m) / speed_mps) < 1e-9);
    CHECK(std::abs(loss->end_s - (20000 + d) / speed_mps) < 1e-9);
  }
}

TEST_CASE("climbing through: the vertical limits cut the loss") {
  WellClearVolume volume = en_route();
  volume.zthr_m = 100;
  volume.dmod_m = volume.hmd_m = 1000;
  const RelativeState inside{{10, 0}, {0, 0}, -700, 5};
  const std::optional<TimeInterval> loss = straight_loss(inside, volume);
  REQUIRE(loss);
  CHECK(loss->begin_s == doctest::Approx(120).epsilon(1e-14));
  CHECK(loss->end_s == doctest::Approx(160).epsilon(1e-14));
  volume.tcoa_s = 30;  // 150 m below
  CHECK(straight_loss(inside, volume)->begin_s == doctest::Approx(110).epsilon(1e-14));
  CHECK(straight_loss(inside, volume)->end_s == doctest::Approx(160).epsilon(1e-14));
  CHECK_FALSE(straight_loss({{10, 0}, {0, 0}, -700, 0}, volume));
  CHECK(straight_loss({{10, 0}, {0, 0}, -70, 0}, volume)->begin_s == -kForever);
  CHECK(predicted_loss({{10, 0}, {0, 0}, -70, 0}, volume)->begin_s == 0);
  CHECK(predicted_loss({{10, 0}, {0, 0}, -70, 0}, volume)->end_s == kForever);
  CHECK_FALSE(predicted_loss({{10, 0}, {0, 0}, 700, 5}, volume));  // it was in the past
}

TEST_CASE("1e7 m away at 1e-9 m/s the entry is right to the last digits") {
  WellClearVolume volume = en_route();
  volume.dmod_m = volume.hmd_m = 1000;
  const std::optional<TimeInterval> loss = straight_loss({{-1e7, 2}, {1e-9, 0}, 0, 0}, volume);
  REQUIRE(loss);
  const double half_m = std::sqrt(1000.0 * 1000 - 4);
  CHECK(loss->begin_s == doctest::Approx((1e7 - half_m) / 1e-9).epsilon(1e-13));
  CHECK(loss->end_s == doctest::Approx((1e7 + half_m) / 1e-9).epsilon(1e-13));
  // Just outside: the root near 0 comes from the product of both, not from their difference.
  const std::optional<TimeInterval> near =
      straight_loss({{-(1000 + 1e-9), 0}, {1e-9, 0}, 0, 0}, {"own", 1000, 1000, 0, 1, 0});
  REQUIRE(near);
  CHECK(near->begin_s == doctest::Approx((1000 + 1e-9 - 1000.0) / 1e-9).epsilon(1e-6));
}

TEST_CASE("the predicted interval is that in which the conditions hold, for random states and volumes") {
  std::mt19937 random(7);
  const auto number = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967295.0;
  };
  int losses = 0;
  for (int i = 0; i < 4000; ++i) {
    const WellClearVolume volume{"own",
                                 number(10, 2000),
                                 number(10, 2000),
                                 i % 3 == 0 ? 0 : number(0, 60),
                                 number(5, 300),
                                 i % 2 == 0 ? 0 : number(0, 40)};
    const RelativeState r{{number(-5e3, 5e3), number(-5e3, 5e3)},
                          {number(-90, 90), number(-90, 90)},
                          number(-400, 400),
                          i % 5 == 0 ? 0 : number(-15, 15)};
    const std::optional<TimeInterval> loss = straight_loss(r, volume);
    CHECK(has_lost_well_clear(r, volume) == is_lost_by_text(r, volume));
    for (int k = 0; k < 40; ++k) {
      const double t = number(-150, 150);
      const bool is_within = loss && t >= loss->begin_s && t <= loss->end_s;
      if (loss && std::min(std::abs(t - loss->begin_s), std::abs(t - loss->end_s)) < 1e-7) continue;
      CHECK_MESSAGE(is_lost_by_text(later(r, t), volume) == is_within, i << " at " << t);
    }
    if (!loss) continue;
    ++losses;
    const double middle_s = (std::max(loss->begin_s, -1e5) + std::min(loss->end_s, 1e5)) / 2;
    CHECK(is_lost_by_text(later(r, middle_s), volume));
    for (const double edge_s : {loss->begin_s, loss->end_s})
      if (std::isfinite(edge_s) && loss->end_s - loss->begin_s > 1e-3) {
        const double out = edge_s == loss->begin_s ? -1 : 1;
        CHECK(is_lost_by_text(later(r, edge_s - out * 1e-6), volume));
        CHECK_FALSE(is_lost_by_text(later(r, edge_s + out * 1e-6), volume));
      }
  }
  CHECK(losses > 400);
}

TEST_CASE("volumes have names; an unknown one is answered with the list, limits below zero are refused") {
  CHECK(en_route().dmod_m == doctest::Approx(1219.2));
  CHECK(well_clear_volume("NMAC").value().zthr_m == doctest::Approx(30.48));
  const Result<WellClearVolume> none = well_clear_volume("dwc");
  REQUIRE_FALSE(none);
  CHECK(none.error().text().find("dwc-terminal") != std::string::npos);
  for (const double bad : {-1.0, std::nan(""), kForever}) {
    WellClearVolume volume = en_route();
    volume.zthr_m = bad;
    REQUIRE_FALSE(check_volume(volume));
    CHECK(check_volume(volume).error().text().find("zthr") != std::string::npos);
  }
}

TEST_CASE("a state that is not finite has no loss") {
  const RelativeState bad{{std::nan(""), 0}, {0, 0}, 0, 0};
  CHECK_FALSE(has_lost_well_clear(bad, en_route()));
  CHECK_FALSE(straight_loss(bad, en_route()));
  CHECK(loss_severity(bad, en_route()) == 0);
}
