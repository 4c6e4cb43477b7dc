// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "autocalibration/autocalibration.h"
#include "autocalibration/lens_by_motion.h"
#include "autocalibration/made_tracks.h"
#include "base/pose.h"
#include "base/stopwatch.h"
#include "telemetry/track.h"

// bench_autocalibration made FIRST LAST   seeds of made tracks: error and coverage of both methods, by lens
// bench_autocalibration clips VIDEO...    what is found in footage
namespace {

using namespace sigs;

struct Score {
  int found = 0, covered = 0, seeds = 0;
  double error2 = 0, half = 0;

  void add(const std::optional<LensEstimate>& fit, double truth_rad) {
    ++seeds;
    if (!fit) return;
    ++found;
    covered += fit->field_low_rad <= truth_rad && truth_rad <= fit->field_high_rad ? 1 : 0;
    error2 += std::pow(fit->lens.horizontal_field_rad() / truth_rad - 1, 2);
    half += (fit->field_high_rad - fit->field_low_rad) / 2 / truth_rad;
  }
  [[nodiscard]] std::string text() const {
    if (found == 0) return fmt::format("0 of {}", seeds);
    return fmt::format("{} of {} | {} | {:.2f} | {:.2f}", found, seeds, covered, 100 * std::sqrt(error2 / found),
                       100 * half / found);
  }
};

struct MadeLens {
  const char* name;
  LensModel model;
  double focal_px, k1;
};
constexpr MadeLens kLenses[] = {{"pinhole 65 deg", LensModel::brown_conrady, 1000, 0},
                                {"pinhole 30 deg", LensModel::brown_conrady, 2400, 0},
                                {"k1 -0.2", LensModel::brown_conrady, 900, -0.2},
                                {"k1 +0.1", LensModel::brown_conrady, 1000, 0.1},
                                {"fisheye 110 deg", LensModel::kannala_brandt, 650, 0.02}};

void measure_made(int first, int last) {
  fmt::print(
      "| lens | motion | method | found | covered | error rms, % | half interval, % "
      "|\n|---|---|---|---|---|---|---|\n");
  struct Kind {
    const char* name;
    test::MadeTurns turns;
  };
  const std::vector<Kind> kinds{{"pan +-30 deg", {}},
                                {"pan +-10 deg", {.pan_rad = 0.17}},
                                {"shake only", {.pan_rad = 0.01}},
                                {"pan +-10 deg, travelling", {.pan_rad = 0.17, .speed_mps = 15}}};
  for (const MadeLens& lens : kLenses)
    for (const Kind& kind : kinds) {
      const Camera camera = test::made_camera({1280, 720}, lens.model, lens.focal_px, lens.k1);
      const double truth_rad = test::field_rad(camera);
      Score turn;
      Score gyro;
      for (int seed = first; seed <= last; ++seed) {
        test::MadeTurns turns = kind.turns;
        turns.seed = static_cast<unsigned>(seed);
        const test::MadeTracks made = test::made_tracks(camera, turns);
        const LensAnswer by_turn = lens_by_turn(made.tracks, {});
        if (std::getenv("WHY") && !by_turn.fit) fmt::print("{}\n", by_turn.reason);
        if (std::getenv("WHY") && by_turn.fit) fmt::print("d {}\n", by_turn.fit->lens.distortion);
        turn.add(by_turn.fit, truth_rad);
        gyro.add(lens_by_gyro(made.tracks, made.log, {}).answer.fit, truth_rad);
      }
      fmt::print("| {} | {} | turn | {} |\n| {} | {} | gyroscope | {} |\n", lens.name, kind.name, turn.text(),
                 lens.name, kind.name, gyro.text());
      std::fflush(stdout);
    }
}

void measure_clip(const std::string& path) {
  auto footage = FrameSource::open(path);
  if (!footage) {
    fmt::print("{}\n", footage.error().text());
    return;
  }
  const auto log = read_track(path);
  const Stopwatch watch;
  const auto found = autocalibrated(*footage, log ? &*log : nullptr, {}, {}, {});
  if (!found) {
    fmt::print("{}  [{:.1f} s]\n", found.error().text(), watch.elapsed_s());
    return;
  }
  fmt::print("{}: {}  [{:.1f} s]\n", path.substr(path.rfind('/') + 1), summary_of(*found), watch.elapsed_s());
  for (const Warning& warning : found->warnings) fmt::print("  {}\n", warning.what);
  if (std::getenv("JSON") != nullptr) fmt::print("{}", json_of(*found));
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  if (what == "made" && argc == 4) measure_made(std::atoi(argv[2]), std::atoi(argv[3]));
  for (int i = 2; what == "clips" && i < argc; ++i) measure_clip(argv[i]);
  return 0;
}
