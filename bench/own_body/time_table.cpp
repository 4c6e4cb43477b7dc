// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <map>

#include "accuracy/csv.h"
#include "base/statistics.h"
#include "occlusion/detect.h"
#include "own_body/finding.h"
#include "own_body/measures.h"

namespace sigs::bench {

namespace {

// A way to process the clip, and the times of its rounds.
struct Way {
  OwnBodySettings settings;
  Finding finding;
  std::vector<double> wall_s, cpu_s, decode_wall_s, decode_cpu_s;  // of each round
};

Way way(OwnBodyMethod method, int frames, int every = 1, double settled_percent = 0) {
  Way way{.settings = with_method(method, frames)};
  way.settings.every = every;
  way.settings.settled_percent = settled_percent;
  return way;
}

std::vector<Way> ways(int max_frames) {
  std::vector<Way> ways;
  for (const int frames : {50, 100, 200, 400, 800, 1500})
    for (const OwnBodyMethod method : {OwnBodyMethod::stable, OwnBodyMethod::paper})
      if (frames <= max_frames) ways.push_back(way(method, frames));
  for (const int every : {2, 4, 8, 16}) ways.push_back(way(OwnBodyMethod::stable, max_frames, every));
  for (const double settled_percent : {1.0, 2.0})
    ways.push_back(way(OwnBodyMethod::stable, max_frames, 1, settled_percent));
  return ways;
}

// One round: detection and decoding take turns, so that load on the machine affects both. Each number of frames is
// decoded once; a run that stopped early is compared with decoding the same frames.
void run_once(std::vector<Way>& all, const Clip& clip) {
  std::map<int, Taken> decoding;
  for (Way& way : all) {
    way.finding = found_in(clip, way.settings);
    const int passed = way.finding.cannot.empty() ? way.finding.body.frames_passed : way.settings.frames;
    if (!decoding.contains(passed)) decoding[passed] = decoding_alone(clip, passed);
    way.wall_s.push_back(way.finding.wall_s);
    way.cpu_s.push_back(way.finding.cpu_s);
    way.decode_wall_s.push_back(decoding[passed].wall_s);
    way.decode_cpu_s.push_back(decoding[passed].cpu_s);
  }
}

// Each round's own ratio; then the middle one.
double ratio(const std::vector<double>& ours, const std::vector<double>& theirs) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < ours.size(); ++i) ratios.push_back(ours[i] / theirs[i]);
  return median(ratios);
}

void report(const Way& way, const Clip& clip, const cv::Mat& whole, accuracy::Csv& table) {
  const bool told = way.finding.cannot.empty();
  const double with_truth = agreement(way.finding, clip);
  const double with_whole = told && !whole.empty() ? intersection_over_union(way.finding.body.mask, whole) : 0;
  table.row(name_of(way.settings.method), way.settings.frames, way.settings.every, way.settings.settled_percent,
            way.finding.body.frames_passed, way.finding.body.frames_used, with_truth, with_whole, median(way.wall_s),
            median(way.cpu_s), ratio(way.wall_s, way.decode_wall_s), ratio(way.cpu_s, way.decode_cpu_s));
  std::printf("%-6s %4d frames, every %2d, settled %.1f %%: IoU %.4f, %.2f s, %.2f of decoding\n",
              name_of(way.settings.method), way.settings.frames, way.settings.every, way.settings.settled_percent,
              with_truth, median(way.wall_s), ratio(way.wall_s, way.decode_wall_s));
  std::fflush(stdout);
}

}  // namespace

void measure_time(const accuracy::Call& call) {
  const cv::Size size_px = call.quick ? cv::Size(320, 240) : cv::Size(1280, 960);
  const int max_frames = call.quick ? 200 : 1500, rounds = call.quick ? 1 : 3;
  const Clip clip = encoded_clip(flights::by_name("two parts", {size_px, max_frames}), max_frames, call.folder);
  std::vector<Way> all = ways(max_frames);
  static_cast<void>(decoding_alone(clip, std::min(max_frames, 100)));  // the file is in memory from here on
  for (int round = 0; round < rounds; ++round) {
    run_once(all, clip);
    std::printf("round %d of %d\n", round + 1, rounds);
    std::fflush(stdout);
  }
  const auto whole = std::ranges::find(all, with_method(OwnBodyMethod::stable, max_frames), &Way::settings);
  accuracy::Csv table(call.folder / "time.csv",
                      "method,frames,every,settled_percent,passed,used,iou,iou_with_whole,wall_s,cpu_s,wall_ratio,"
                      "cpu_ratio");
  const cv::Mat mask = whole == all.end() ? cv::Mat() : whole->finding.body.mask;
  for (const Way& way : all) report(way, clip, mask, table);
  std::filesystem::remove(clip.path);
}

}  // namespace sigs::bench
