// SPDX-License-Identifier: MIT
// bench_encounter_export PROJECT FOLDER [REPEATS]: what the truth of encounters adds to an export of all frames, for
// all volumes: the search, the summary's file, and the longer labels. Processor time, the median of the repeats. Files
// go into the folder.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "base/statistics.h"
#include "export/export_files.h"
#include "labels/labels.h"
#include "project/json.h"
#include "scene/opened_project.h"

namespace {

using namespace sigs;

double spent_s(const std::function<void()>& work) {
  const auto now_s = [] {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const double before_s = now_s();
  work();
  return now_s() - before_s;
}

template <class T>
T value_or_exit(Result<T> result) {
  if (result) return std::move(*result);
  std::fprintf(stderr, "%s\n", result.error().text().c_str());
  std::exit(1);
}

// Frames as an export labels them, all intruders seen.
std::vector<FrameTruth> frames_of(const Scene& scene) {
  std::vector<FrameTruth> frames;
  for (int number = scene.first_frame; number <= scene.last_frame; ++number) {
    FrameTruth frame{.index = number, .time_s = time_of_frame_s(scene.footage, number)};
    for (std::size_t i = 0; i < scene.intruders.size(); ++i)
      frame.intruders.push_back({.id = static_cast<int>(i),
                                 .name = scene.intruders[i].name,
                                 .visible_box = cv::Rect(600, 400, 40, 20),
                                 .visible_pixels = 300,
                                 .amodal_box = Box{600.25, 400.25, 40, 20},
                                 .detectability = Detectability{}});
    frames.push_back(frame);
  }
  return frames;
}

void write_labels(const std::filesystem::path& folder, const LabelSequence& clip,
                  const std::vector<FrameTruth>& frames) {
  for (const char* const name : {"xml", "csv"}) {
    const auto writer = value_or_exit(label_format(name)->open(folder / name, clip));
    for (const FrameTruth& frame : frames)
      if (!writer->write(frame)) std::exit(1);
    if (!writer->finish({})) std::exit(1);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 64;
  Project project = value_or_exit(read_project(argv[1])).project;
  project.output.encounter = {kWellClearNames.begin(), kWellClearNames.end()};
  const OpenedProject opened = value_or_exit(open_project(project, nullptr));
  const Scene& scene = opened.scene;
  const FrameRange range{scene.first_frame, scene.last_frame};
  LabelSequence clip;
  clip.name = project.name;
  clip.footage.first_frame = range.first;
  clip.footage.last_frame = range.last;
  for (std::size_t i = 0; i < scene.intruders.size(); ++i)
    clip.intruders.push_back({.id = static_cast<int>(i), .category = "airplane"});
  clip.categories = {"airplane"};
  LabelSequence longer = clip;
  longer.volumes = project.output.encounter;
  const std::filesystem::path folder = argv[2];
  const std::vector<FrameTruth> frames = frames_of(scene);
  std::vector<double> added_s;
  for (int repeat = 0; repeat < (argc > 3 ? std::atoi(argv[3]) : 21); ++repeat) {
    const double without_s = spent_s([&] { write_labels(folder, clip, frames); });
    const double with_s = spent_s([&] {
      const ExportedEncounters encounters = value_or_exit(ExportedEncounters::of(project, scene, range));
      if (!encounters.write_json(folder / "encounter.json")) std::exit(1);
      std::vector<FrameTruth> all = frames;
      for (FrameTruth& frame : all) encounters.add_to(frame);
      write_labels(folder, longer, all);
    });
    added_s.push_back(with_s - without_s);
  }
  std::printf("%.1f ms more of the processor for %zu frames\n", 1e3 * median(added_s), frames.size());
  return 0;
}
