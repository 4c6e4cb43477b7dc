// SPDX-License-Identifier: MIT
// Slip of an intruder that is fixed in the world against the background of real footage: README.md.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <string>

#include "accuracy/csv.h"
#include "base/pose.h"
#include "world_lock/image_motion.h"
#include "world_lock/slip.h"
#include "world_lock/strips.h"

namespace {

using namespace sigs;
using namespace sigs::bench;

struct Options {
  std::string folder, clip, images, figure;
  double field_deg = 60;
  bool init = false;
};

// Root mean square and largest length of vectors.
struct Spread {
  double rms_px = 0, max_px = 0;
};

// Of one knowledge of the camera; what: by sample, then by knowledge.
Spread spread_of(const std::vector<std::vector<cv::Point2d>>& what, std::size_t knowledge) {
  Spread spread;
  for (const auto& of_sample : what) {
    const double length_px = cv::norm(of_sample[knowledge]);
    spread.rms_px += length_px * length_px;
    spread.max_px = std::max(spread.max_px, length_px);
  }
  spread.rms_px = std::sqrt(spread.rms_px / std::max<double>(1, static_cast<double>(what.size())));
  return spread;
}

std::vector<std::vector<cv::Point2d>> all_of(const SlipRun& run, std::vector<cv::Point2d> SlipSample::*what) {
  std::vector<std::vector<cv::Point2d>> all;
  for (const SlipSample& sample : run.samples) all.push_back(sample.*what);
  return all;
}

// What holds for the clip whatever is known of the camera.
struct Reference {
  double sd_px = 0, longest_s = 0, growth_per_s = 0;
  std::size_t frames = 0;
};

Reference reference_of(const SlipRun& run) {
  Reference reference;
  std::set<int> frames;
  for (const SlipSample& sample : run.samples) {
    reference.sd_px += sample.reference_sd_px / static_cast<double>(run.samples.size());
    reference.longest_s = std::max(reference.longest_s, sample.since_s);
    frames.insert(sample.frame);
    if (sample.since_s > 1)
      reference.growth_per_s = std::max(reference.growth_per_s, std::abs(std::log(sample.growth)) / sample.since_s);
  }
  reference.frames = frames.size();
  return reference;
}

void write_samples(const Clip& clip, const std::vector<CameraKnowledge>& cameras, const SlipRun& run,
                   accuracy::Csv& table) {
  for (const SlipSample& s : run.samples)
    for (std::size_t k = 0; k < cameras.size(); ++k)
      table.row(clip.source.name, cameras[k].name, s.start, s.place, s.frame, s.corners, s.reference_sd_px,
                s.background.x, s.background.y, s.step_px[k].x, s.step_px[k].y, s.offset_px[k].x, s.offset_px[k].y,
                s.growth);
}

struct Tables {
  accuracy::Csv motion, slip, samples;
};

void measure(const ClipSource& source, const Options& options, Tables& tables) {
  Clip clip = loaded(source, options.folder);
  const ImageMotion motion = image_motion(clip);
  const char* verdict = motion.tracked < kMinTracked     ? "cannot be followed"
                        : motion.range_px < kMinRange_px ? "stands still"
                                                         : "moves";
  tables.motion.row(source.name, clip.frame_count(), motion.tracked, motion.step_rms_px, motion.range_px, verdict);
  std::printf("%s: %d frames, %.0f %% followed, %.2f px a frame, within %.0f px: %s\n", source.name.c_str(),
              clip.frame_count(), 100 * motion.tracked, motion.step_rms_px, motion.range_px, verdict);
  std::fflush(stdout);
  if (std::string_view(verdict) != "moves") return;
  std::string lens;
  std::vector<CameraKnowledge> cameras;
  if (options.init) {
    InitKnowledge init = init_knowledge_of(clip, options.folder);
    cameras = std::move(init.cameras);
    std::printf("  %s\n", init.said.c_str());
    lens = init.said;
    std::replace(lens.begin(), lens.end(), ',', ';');
  } else {
    lens = fit_guessed_lens(clip, options.folder);
    cameras = knowledge_of(clip, options.folder);
  }
  const SlipRun run = options.init ? slip_of(clip, cameras, kDistant_m) : slip_of(clip, cameras);
  write_samples(clip, cameras, run, tables.samples);
  const Reference reference = reference_of(run);
  const auto steps = all_of(run, &SlipSample::step_px), offsets = all_of(run, &SlipSample::offset_px);
  const auto trembles = trembling(run), beyond = travels(source) ? offsets_beyond_parallax(run) : offsets;
  for (std::size_t k = 0; k < cameras.size(); ++k) {
    const Spread step = spread_of(steps, k), tremble = spread_of(trembles, k), offset = spread_of(offsets, k),
                 left = spread_of(beyond, k);
    tables.slip.row(source.name, cameras[k].name, reference.frames, run.samples.size(), cameras[k].lost_frames,
                    step.rms_px, step.max_px, tremble.rms_px, tremble.max_px, offset.rms_px, offset.max_px, left.rms_px,
                    left.max_px, reference.longest_s, reference.sd_px, 100 * reference.growth_per_s,
                    run.distances_differ_px, lens);
    std::printf(
        "  %-20s slip %.3f px rms, %.2f max; trembling %.3f rms; off by %.2f rms, %.2f max; beyond parallax %.2f rms, "
        "%.2f max\n",
        cameras[k].name.c_str(), step.rms_px, step.max_px, tremble.rms_px, offset.rms_px, offset.max_px, left.rms_px,
        left.max_px);
  }
  std::printf("  %zu frames, up to %.1f s, reference %.3f px, growth up to %.1f %% a second\n", reference.frames,
              reference.longest_s, reference.sd_px, 100 * reference.growth_per_s);
  std::fflush(stdout);
}

void measure_all(const Options& options) {
  const std::filesystem::path folder = options.folder;
  std::filesystem::create_directories(folder);
  Tables tables{{folder / "motion.csv", "clip,frames,tracked,step_rms_px,range_px,verdict"},
                {folder / "slip.csv",
                 "clip,camera,frames,samples,lost,step_rms_px,step_max_px,tremble_rms_px,tremble_max_px,offset_rms_px,"
                 "offset_max_px,beyond_rms_px,beyond_max_px,longest_s,reference_sd_px,growth_percent_per_s,distances_"
                 "differ_px,lens"},
                {folder / "samples.csv",
                 "clip,camera,start,place,frame,corners,reference_sd_px,background_x,background_y,step_x,step_y,"
                 "offset_x,offset_y,growth"}};
  for (ClipSource source : clip_sources()) {
    source.guessed_field_rad = rad_of_deg(options.field_deg);
    if (options.clip.empty() || (',' + options.clip + ',').find(',' + source.name + ',') != std::string::npos)
      measure(source, options, tables);
  }
}

}  // namespace

int main(int count, char** arguments) {
  CLI::App app("Slip of an intruder that is fixed in the world against the background of real footage.");
  Options options;
  app.add_option("FOLDER", options.folder, "where tables and estimates go")->required();
  app.add_option("--clip", options.clip, "this one alone, or these, divided by commas");
  app.add_flag("--init", options.init,
               "the project that `sigs init` makes of a clip, with its camera.track and without");
  app.add_option("--field", options.field_deg,
                 "field of view of clips without calibration whose turns do not show it, degrees")
      ->check(CLI::Range(5, 150));
  app.add_option("--images", options.images, "instead: strips of enlarged frames of the clip coast, or of --clip");
  app.add_option("--figure", options.figure, "instead: the figure of the documentation, from our own footage");
  CLI11_PARSE(app, count, arguments);
  if (!options.images.empty())
    draw_strips(options.clip.empty() ? "coast" : options.clip, options.folder, options.images);
  else if (!options.figure.empty())
    draw_figure(options.folder, options.figure);
  else
    measure_all(options);
}
