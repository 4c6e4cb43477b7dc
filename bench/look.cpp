// SPDX-License-Identifier: MIT
// What each stage of the footage's look costs: one intruder before frames of the sample flight, composed by
// compose_frame with each stage alone and with all, in turn.
//   bench_look [--size PX] [--rounds N] [MODEL]...     default: 60 px, 15 rounds, airliner and light-aircraft
// Milliseconds of all threads' processor time are the measure: other programs hardly change it. Ratios are to a frame
// without any stage. Exit 1 where all stages together take more than 2.5 times as long.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/statistics.h"
#include "frame/compose_frame.h"
#include "project/fields.h"
#include "project/json.h"
#include "scene/opened_project.h"

namespace {

using namespace sigs;

constexpr double kMaxForAll = 2.5;
constexpr int kFirstFrame = 60, kFrames = 8, kMiddleFrame = 64;
constexpr double kFrameRate_hz = 25, kCameraSpeed_mps = 22;

using Settings = std::vector<std::string>;

struct Case {
  std::string name;
  Settings settings;
};

const Settings kNone{"compositing.blur_px_per_m=0", "appearance.psf_sigma_px=0"};
// The motion of half a frame at 25 frames a second, and the other values as footage has them.
const std::vector<Case> kStages{
    {"tones", {"appearance.black=0.02", "appearance.saturation=0.7"}},
    {"haze", {"appearance.haze.visibility_m=8000"}},
    {"motion blur", {"camera.exposure_s=0.02"}},
    {"point spread", {"appearance.psf_sigma_px=0.45"}},
    {"sharpening", {"appearance.sharpening=1"}},
    {"chroma blur", {"appearance.chroma_blur_px=1.2"}},
    {"grain",
     {"appearance.grain.sd_dark=2", "appearance.grain.sd_bright=3", "appearance.grain.sd_chroma=2",
      "appearance.grain.correlation_length_px=0.8", "appearance.grain.temporal_correlation=0.4"}},
    {"codec match", {"appearance.codec.match=footage"}},
    {"sun, shadow map", {"light.kind=sun", "light.sun.azimuth_deg=120", "light.sun.elevation_deg=40"}}};

[[noreturn]] void stop(const Error& error) {
  std::fprintf(stderr, "error: %s\n", error.text().c_str());
  std::exit(1);
}

template <class T>
T must(Result<T> result) {
  if (!result) stop(result.error());
  return std::move(*result);
}

double processor_ms() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

std::vector<Case> all_cases() {
  std::vector<Case> cases{{"none", {}}};
  cases.insert(cases.end(), kStages.begin(), kStages.end());
  Case all{"all", {}};
  for (const Case& stage : kStages)
    all.settings.insert(all.settings.end(), stage.settings.begin(), stage.settings.end());
  cases.push_back(all);
  return cases;
}

// The sample project with one intruder that flies ahead of the camera, across the view at half of its distance a
// second: some 6 px while the shutter is open.
Project project_of(const std::string& model, double distance_m, const Settings& settings) {
  Project project = must(read_project(std::string(SIGS_PROJECTS_DIR) + "/crossing/crossing.json")).project;
  IntruderSettings& intruder = project.intruders.front();
  intruder.model.file = "../../assets/models/" + model + "/" + model + ".obj";
  intruder.trajectory.waypoints.clear();
  for (const int frame : {0, 199}) {
    const double ahead_m = kCameraSpeed_mps * frame / kFrameRate_hz;
    const double across_m = distance_m / 2 * (frame - kMiddleFrame) / kFrameRate_hz;
    intruder.trajectory.waypoints.push_back(
        {.frame = frame, .position_m = {distance_m + ahead_m, across_m, -150 - distance_m / 8}});
  }
  for (const Settings* some : {&kNone, &settings})
    for (const std::string& setting : *some)
      if (const Result<void> done = set_field(project, setting); !done) stop(done.error());
  return project;
}

// Frames of the footage, with their quantisers.
std::vector<Frame> footage_frames() {
  OpenedProject opened = must(open_project(project_of("airliner", 500, {"appearance.codec.match=footage"}), nullptr));
  std::vector<Frame> frames;
  for (int n = 0; n < kFrames; ++n) frames.push_back(must(opened.source.read(kFirstFrame + n)));
  return frames;
}

Frame copy_of(const Frame& frame) {
  Frame copy = frame;
  for (cv::Mat& plane : copy.planes) plane = plane.clone();
  return copy;
}

// A case with all that its frames need.
class Measured {
 public:
  Measured(Case what, const std::string& model, double distance_m)
      : name_(std::move(what.name)),
        scene_(must(open_project(project_of(model, distance_m, what.settings), nullptr)).scene) {}

  ComposedFrame compose(const Frame& footage, int n) {
    Frame background = copy_of(footage);
    const double start_ms = processor_ms();
    ComposedFrame frame = must(compose_frame(scene_, kFirstFrame + n, std::move(background), context_));
    processor_ms_.push_back(processor_ms() - start_ms);
    draw_ms_.push_back(1e3 * frame.times.draw_s);
    composite_ms_.push_back(1e3 * frame.times.composite_s);
    return frame;
  }

  void forget_times() {
    for (std::vector<double>* const times : {&processor_ms_, &draw_ms_, &composite_ms_}) times->clear();
  }

  [[nodiscard]] double cost_ms() const { return median(processor_ms_); }

  void print(double none_ms) const {
    std::printf("| %s | %.2f | %.2f | %.2f | %.2f |\n", name_.c_str(), median(draw_ms_), median(composite_ms_),
                cost_ms(), cost_ms() / none_ms);
  }

 private:
  std::string name_;
  Scene scene_;
  ComposeContext context_;
  std::vector<double> processor_ms_, draw_ms_, composite_ms_;
};

double longer_side_px(const std::string& model, double distance_m, const std::vector<Frame>& footage) {
  const int middle = kMiddleFrame - kFirstFrame;
  const ComposedFrame frame =
      Measured({}, model, distance_m).compose(footage[static_cast<std::size_t>(middle)], middle);
  const std::optional<Box>& box = frame.truth.intruders.front().amodal_box;
  return box ? std::max(box->width, box->height) : 1;
}

// At which the silhouette's longer side has this size.
double distance_of(const std::string& model, double size_px, const std::vector<Frame>& footage) {
  double distance_m = 300;
  for (int i = 0; i < 5; ++i) distance_m *= longer_side_px(model, distance_m, footage) / size_px;
  return distance_m;
}

// The ratio of all stages together to none.
double measure(const std::string& model, double size_px, int rounds, const std::vector<Frame>& footage) {
  const double distance_m = distance_of(model, size_px, footage);
  std::printf("\n%s, %.0f px, at %.0f m; ", model.c_str(), longer_side_px(model, distance_m, footage), distance_m);
  std::vector<std::unique_ptr<Measured>> cases;
  for (const Case& one : all_cases()) cases.push_back(std::make_unique<Measured>(one, model, distance_m));
  for (int round = -1; round < rounds; ++round) {
    if (round == 0)
      for (const auto& one : cases) one->forget_times();
    for (int n = 0; n < kFrames; ++n)
      for (const auto& one : cases) (void)one->compose(footage[static_cast<std::size_t>(n)], n);
  }
  const ComposedFrame all = cases.back()->compose(footage.front(), 0);
  std::printf(
      "with all: moves by %.1f px, %lld pixels through the codec, %lld samples filtered, %lld of noise\n\n",
      all.truth.intruders.front().image_formation.motion_blur_px, static_cast<long long>(all.op_counts.pixels_coded),
      static_cast<long long>(all.op_counts.samples_filtered), static_cast<long long>(all.op_counts.samples_of_noise));
  const double none_ms = cases.front()->cost_ms();
  std::printf("| stage | drawing, ms | compositing, ms | processor ms | ratio |\n|---|---|---|---|---|\n");
  for (const auto& one : cases) one->print(none_ms);
  return cases.back()->cost_ms() / none_ms;
}

}  // namespace

int main(int argc, char** argv) {
  double size_px = 60;
  int rounds = 15;
  std::vector<std::string> models;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--size" && i + 1 < argc)
      size_px = std::max(1.0, std::atof(argv[++i]));
    else if (word == "--rounds" && i + 1 < argc)
      rounds = std::max(1, std::atoi(argv[++i]));
    else
      models.push_back(word);
  }
  if (models.empty()) models = {"airliner", "light-aircraft"};
  const std::vector<Frame> footage = footage_frames();
  bool is_within = true;
  for (const std::string& model : models) is_within &= measure(model, size_px, rounds, footage) <= kMaxForAll;
  if (!is_within) std::fprintf(stderr, "error: all stages take more than %.1f times as long as none\n", kMaxForAll);
  return is_within ? 0 : 1;
}
