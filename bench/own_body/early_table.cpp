// SPDX-License-Identifier: MIT
#include <cstdio>

#include "own_body/finding.h"
#include "own_body/measures.h"

namespace sigs::bench {

namespace {

constexpr double kSettledPercent = 1;

void measure_early(const flights::Flight& flight, int frames, const accuracy::Call& call, accuracy::Csv& table) {
  const Clip clip = encoded_clip(flight, frames, call.folder);
  OwnBodySettings settings = with_method(OwnBodyMethod::stable, frames);
  settings.settled_percent = 0;
  const Finding whole = found_in(clip, settings);
  settings.settled_percent = kSettledPercent;
  const Finding early = found_in(clip, settings);
  table.row(flight.name, kSettledPercent, early.body.frames_used, whole.body.frames_used, agreement(early, clip),
            agreement(whole, clip), early.wall_s, whole.wall_s);
  std::printf("%-26s %4d of %4d frames, IoU %.4f of %.4f, %.2f s of %.2f s\n", flight.name.c_str(),
              early.body.frames_used, whole.body.frames_used, agreement(early, clip), agreement(whole, clip),
              early.wall_s, whole.wall_s);
  std::fflush(stdout);
  std::filesystem::remove(clip.path);
}

}  // namespace

void measure_early_stop(const accuracy::Call& call) {
  accuracy::Csv table(call.folder / "early.csv",
                      "flight,settled_percent,used,used_of,iou,iou_of_all,wall_s,wall_s_of_all");
  const flights::FlightSettings making{.size_px = call.quick ? cv::Size(320, 240) : cv::Size(640, 480),
                                       .frames = call.quick ? 200 : 1500};
  for (const flights::Flight& flight : flights::all(making))
    if (flight.is_decidable) measure_early(flight, making.frames, call, table);
}

}  // namespace sigs::bench
