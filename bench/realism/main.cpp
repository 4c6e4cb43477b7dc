// SPDX-License-Identifier: MIT
// Whether inserted aircraft can be told from real ones: README.md.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <mutex>
#include <sstream>

#include "accuracy/csv.h"
#include "base/threads.h"
#include "realism/report.h"
#include "realism/samples.h"

namespace {

using namespace sigs;
using namespace sigs::bench;
namespace fs = std::filesystem;

struct Options {
  std::string folder, clip;
  std::vector<std::string> settings;
  int frames = 6;
  int views = 1;
  int jobs = 2;
  bool tuning_only = false;
  bool shakes = false;
  bool thermal = false;
  bool stills = false;
  bool trackers = false;
  bool steps = false;
  bool lit = false;
};

std::vector<LookSettings> settings_of(const Options& options) {
  std::vector<LookSettings> all{{.name = "default"}};
  for (const std::string& text : options.settings) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) accuracy::stop(text + ": expected NAME=FILE or NAME=FOLDER");
    LookSettings settings{.name = text.substr(0, equals), .shakes = options.shakes};
    std::istringstream names(text.substr(equals + 1));
    for (std::string name; std::getline(names, name, ',');) settings.from.emplace_back(name);
    all.push_back(std::move(settings));
  }
  return all;
}

std::vector<Sample> all_samples(const std::vector<RealClip>& clips, const SampleOptions& options, int jobs) {
  std::vector<std::vector<Sample>> by_clip(clips.size());
  std::mutex mutex;
  std::atomic<std::size_t> next{0};
  parallel_for(jobs, jobs, [&](int) {
    Workplace workplace;
    for (std::size_t i = next++; i < clips.size(); i = next++) {
      LeftOut left_out;
      by_clip[i] = samples_of(clips[i], options, workplace, left_out);
      const std::lock_guard lock(mutex);
      std::fprintf(stderr, "%s: %zu samples; left out: %d not found, %d cut, %d without another place\n",
                   clips[i].name.c_str(), by_clip[i].size(), left_out.not_found, left_out.cut, left_out.no_place);
    }
  });
  std::vector<Sample> all;
  for (std::vector<Sample>& some : by_clip) std::move(some.begin(), some.end(), std::back_inserter(all));
  return all;
}

// Sheets: every clip's samples; and for each kind the ten that are told most surely, of all and of held-out clips.
void draw(const std::vector<Sample>& samples, const std::vector<std::string>& kinds,
          const std::vector<ByCertainty>& certain, const fs::path& folder) {
  std::vector<std::string> columns{"real"};
  columns.insert(columns.end(), kinds.begin(), kinds.end());
  draw_histograms(samples, columns, folder / "histograms.png");
  fs::create_directories(folder / "sheets");
  std::map<std::string, std::vector<const Sample*>> by_clip;
  for (const Sample& sample : samples) by_clip[sample.clip].push_back(&sample);
  for (const auto& [clip, some] : by_clip) draw_sheet(some, columns, folder / "sheets" / (clip + ".png"));
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    ByCertainty worst = certain[k];
    std::erase_if(worst, [](const Sample* sample) { return sample->is_tuning; });
    worst.resize(std::min<std::size_t>(10, worst.size()));
    if (!worst.empty()) draw_sheet(worst, {"real", kinds[k]}, folder / ("worst_" + kinds[k] + ".png"));
  }
}

// The paper's figures 7 to 13 (a real intruder beside a simulated one, seven times) with the last of the ways to
// insert: held-out clips, one sample of each, the largest targets first.
void draw_paper_figures(const std::vector<Sample>& samples, const std::string& kind, const fs::path& file) {
  constexpr std::size_t kFigures = 7;
  std::map<std::string, const Sample*> by_clip;
  for (const Sample& sample : samples)
    if (!sample.is_tuning && target_of(sample, kind) != nullptr) by_clip.emplace(sample.clip, &sample);
  std::vector<const Sample*> chosen;
  for (const auto& [clip, sample] : by_clip) chosen.push_back(sample);
  std::sort(chosen.begin(), chosen.end(), [](const Sample* a, const Sample* b) {
    return a->targets.front().look.box.width > b->targets.front().look.box.width;
  });
  chosen.resize(std::min(kFigures, chosen.size()));
  if (!chosen.empty()) draw_sheet(chosen, {"real", kind}, file);
}

}  // namespace

int main(int count, char** arguments) {
  CLI::App app("Whether inserted aircraft can be told from real ones.");
  Options options;
  app.add_option("FOLDER", options.folder, "where tables and sheets go")->required();
  app.add_option(
      "--settings-from", options.settings,
      "NAME=FILE or NAME=FOLDER: a further way to insert, by the settings of a JSON file, or of CLIP.json in a "
      "folder; several with commas between, the later ones over the earlier ones; may be given several times");
  app.add_flag("--shake", options.shakes,
               "these move with the camera's shake, as if the project had its track; it is taken from the real target");
  app.add_option("--clip", options.clip, "clips whose name contains this alone");
  app.add_flag("--tuning", options.tuning_only, "the tuning clips alone");
  app.add_flag("--stills", options.stills, "the stills in place of the clips");
  app.add_flag("--thermal", options.thermal, "clips of a thermal camera");
  app.add_flag("--trackers", options.trackers, "instead: how OpenCV's trackers follow real and inserted targets");
  app.add_flag("--lit", options.lit,
               "instead: how bright the intruder is beside a real target before and after lit_like()");
  app.add_option("--views", options.views, "of each sample, of which the one as large as the real target is taken")
      ->check(CLI::Range(1, 100));
  app.add_flag("--steps", options.steps, "with --trackers: what each equality of real and inserted target changes");
  app.add_option("--frames", options.frames, "frames of each clip")->check(CLI::Range(1, 30));
  app.add_option("--jobs", options.jobs, "threads")->check(CLI::Range(1, 64));
  CLI11_PARSE(app, count, arguments);
  const fs::path folder = options.folder;
  fs::create_directories(folder / "calibrations");
  std::vector<RealClip> clips = options.stills ? real_stills() : options.thermal ? thermal_clips() : real_clips();
  std::erase_if(clips, [&](const RealClip& clip) {
    return clip.name.find(options.clip) == std::string::npos || (options.tuning_only && !clip.is_tuning);
  });
  if (clips.empty()) accuracy::stop(std::string(SIGS_TEST_DATA) + "/track: no clip with boxes");
  const SampleOptions sampling{.folder = folder / "calibrations",
                               .settings = settings_of(options),
                               .frames_per_clip = options.frames,
                               .views = options.views,
                               .steps = options.steps};
  if (options.lit) {
    compare_lit(clips, sampling, options.jobs);
    return 0;
  }
  if (options.trackers) {
    compare_trackers(clips, sampling, options.jobs, folder);
    return 0;
  }
  const std::vector<Sample> samples = all_samples(clips, sampling, options.jobs);
  std::vector<std::string> kinds{"moved"};
  for (const LookSettings& settings : sampling.settings) kinds.push_back(settings.name);
  write_measures(samples, folder / "measures.csv");
  for (const std::string& kind : kinds) {
    const auto with = std::count_if(samples.begin(), samples.end(),
                                    [&](const Sample& sample) { return target_of(sample, kind) != nullptr; });
    std::printf("%s: %td of %zu could be told from the background\n", kind.c_str(), with, samples.size());
  }
  const std::vector<ByCertainty> certain = write_aucs(samples, kinds, folder);
  write_medians(samples, kinds, folder / "medians.md");
  draw(samples, kinds, certain, folder);
  draw_paper_figures(samples, kinds.back(), folder / "figures_7_to_13.png");
}
