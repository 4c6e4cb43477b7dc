// SPDX-License-Identifier: MIT
// What near intruders cost: one aircraft before frames of the sample flight, composed by compose_frame.
//   bench_near [--rounds N] [--set FIELD=VALUE]... [WORD]...
// default: 3 rounds; only the cases whose names contain all of the words. --set changes a setting of the projects.
// Prints a line a case: its name, its share of the image in percent, and the medians of drawing, compositing, both, and
// of the processor time of all threads, in milliseconds a frame. bench/near.sh compares qualities.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/csv.h"
#include "base/statistics.h"
#include "frame/compose_frame.h"
#include "project/fields.h"
#include "project/json.h"
#include "scene/opened_project.h"

namespace {

using namespace sigs;
using accuracy::stop;

constexpr int kFirstFrame = 60, kFrames = 4, kMiddleFrame = 61;

using Settings = std::vector<std::string>;

struct Case {
  std::string name;
  std::string model;
  double size_px = 0;     // longer side of the silhouette; 0: at the distance
  double distance_m = 0;  // from the camera to the body's reference point
  Settings settings;
};

// "filling" spans the image from edge to edge; "inside" has the camera within the sphere around the body, so that it is
// drawn in several views.
struct Place {
  std::string name;
  double size_px;
  double airliner_m;
  double light_aircraft_m;
};
const std::vector<Place> kPlaces{{"filling", 0, 12, 4}, {"inside", 0, 5, 2.5}, {"400px", 400, 0, 0},
                                 {"200px", 200, 0, 0},  {"60px", 60, 0, 0},    {"8px", 8, 0, 0}};

const std::vector<std::pair<std::string, Settings>> kLights{
    {"point", {}}, {"sun", {"light.kind=sun", "light.sun.azimuth_deg=120", "light.sun.elevation_deg=40"}}};

// The footage's look, as footage has it.
const std::vector<std::pair<std::string, Settings>> kLooks{
    {"plain", {"compositing.blur_px_per_m=0", "appearance.psf_sigma_px=0"}},
    {"look",
     {"camera.exposure_s=0.01", "camera.readout_s=0.02", "appearance.haze.visibility_m=8000",
      "appearance.psf_sigma_px=0.45", "appearance.sharpening=1", "appearance.black=0.02",
      "appearance.chroma_blur_px=1.2", "appearance.grain.sd_dark=2", "appearance.grain.sd_bright=3"}}};

template <class T>
T must(Result<T> result) {
  if (!result) stop(result.error().text());
  return std::move(*result);
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const std::string model : {"airliner", "light-aircraft"})
    for (const Place& place : kPlaces)
      for (const auto& [light, light_settings] : kLights)
        for (const auto& [look, look_settings] : kLooks) {
          Settings settings = light_settings;
          settings.insert(settings.end(), look_settings.begin(), look_settings.end());
          cases.push_back({.name = model + " " + place.name + " " + light + " " + look,
                           .model = model,
                           .size_px = place.size_px,
                           .distance_m = model == "airliner" ? place.airliner_m : place.light_aircraft_m,
                           .settings = settings});
        }
  return cases;
}

// The sample project with a camera that stands still and one intruder that flies across the view, a fortieth of its
// distance a frame: some 20 px in the middle of the image.
Project project_of(const Case& what, double distance_m) {
  Project project = must(read_project(std::string(SIGS_PROJECTS_DIR) + "/crossing/crossing.json")).project;
  project.camera.speed_mps = 0;
  IntruderSettings& intruder = project.intruders.front();
  intruder.model.file = "../../assets/models/" + what.model + "/" + what.model + ".obj";
  intruder.trajectory.waypoints.clear();
  for (const int frame : {0, 199})
    intruder.trajectory.waypoints.push_back(
        {.frame = frame, .position_m = {distance_m, distance_m * (frame - kMiddleFrame) / 40, -150 - distance_m / 8}});
  for (const std::string& setting : what.settings)
    if (const Result<void> done = set_field(project, setting); !done) stop(done.error().text());
  return project;
}

Scene scene_of(const Case& what, double distance_m) {
  return must(open_project(project_of(what, distance_m), nullptr)).scene;
}

struct Cost {
  std::vector<double> draw_ms, composite_ms, total_ms, processor_ms;
};

// Adds what the frames cost to `cost`; gives back the truth of the middle one.
IntruderTruth compose(const Scene& scene, const std::vector<Frame>& footage, ComposeContext& context, Cost& cost) {
  IntruderTruth truth;
  for (int n = 0; n < kFrames; ++n) {
    Frame background = cloned(footage[static_cast<std::size_t>(n)]);
    const double start_s = accuracy::cpu_s();
    ComposedFrame frame = must(compose_frame(scene, kFirstFrame + n, std::move(background), context));
    cost.processor_ms.push_back(1e3 * (accuracy::cpu_s() - start_s));
    cost.draw_ms.push_back(1e3 * frame.times.draw_s);
    cost.composite_ms.push_back(1e3 * frame.times.composite_s);
    cost.total_ms.push_back(cost.draw_ms.back() + cost.composite_ms.back());
    if (kFirstFrame + n == kMiddleFrame) truth = std::move(frame.truth.intruders.front());
  }
  return truth;
}

// At which the silhouette's longer side has this size.
double distance_of(const Case& what, const std::vector<Frame>& footage, ComposeContext& context) {
  double distance_m = 100;
  for (int i = 0; i < 5; ++i) {
    const Scene scene = scene_of(what, distance_m);
    Cost unused;
    const std::optional<Box> box = compose(scene, footage, context, unused).amodal_box;
    distance_m *= box ? std::max(box->width, box->height) / what.size_px : 0.5;
    context.forget(scene.models.front()->mesh);
  }
  return distance_m;
}

void measure(const Case& what, int rounds, const std::vector<Frame>& footage) {
  ComposeContext context;
  const Scene scene = scene_of(what, what.size_px > 0 ? distance_of(what, footage, context) : what.distance_m);
  Cost cost;
  const IntruderTruth truth = compose(scene, footage, context, cost);  // uploads, and fills tables
  cost = {};
  for (int round = 0; round < rounds; ++round) (void)compose(scene, footage, context, cost);
  const double share = 100.0 * truth.visible_pixels / scene.footage.size_px.area();
  std::printf("%s %.1f %.2f %.2f %.2f %.2f\n", what.name.c_str(), share, median(cost.draw_ms),
              median(cost.composite_ms), median(cost.total_ms), median(cost.processor_ms));
  std::fflush(stdout);
}

std::vector<Frame> footage_frames() {
  OpenedProject opened = must(open_project(project_of({.model = "airliner"}, 500), nullptr));
  std::vector<Frame> frames;
  for (int n = 0; n < kFrames; ++n) frames.push_back(must(opened.source.read(kFirstFrame + n)));
  return frames;
}

}  // namespace

int main(int argc, char** argv) {
  int rounds = 3;
  std::vector<std::string> words;
  Settings settings;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--rounds" && i + 1 < argc)
      rounds = std::max(1, std::atoi(argv[++i]));
    else if (word == "--set" && i + 1 < argc)
      settings.emplace_back(argv[++i]);
    else
      words.push_back(word);
  }
  const std::vector<Frame> footage = footage_frames();
  for (Case what : all_cases()) {
    what.settings.insert(what.settings.end(), settings.begin(), settings.end());
    const auto is_in_name = [&](const std::string& word) { return what.name.find(word) != std::string::npos; };
    if (std::all_of(words.begin(), words.end(), is_in_name)) measure(what, rounds, footage);
  }
}
