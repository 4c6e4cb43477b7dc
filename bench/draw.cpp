// SPDX-License-Identifier: MIT
// Time of rendering an intruder, by its size in the image: the renderer alone, no lens and no background.
//   bench_draw [--csv] [--supersampling N] [--samples N] [--size PX] [--sun] [OBJ FORWARD UP]...
// The two sample models where none is named.

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "render/renderer.h"

namespace {

using namespace sigs;
using Clock = std::chrono::steady_clock;

constexpr double kSizes_px[] = {8, 30, 60, 100, 200, 400};
constexpr int kTurns = 12;     // attitudes that are drawn in turn
constexpr int kRounds = 12;    // over all attitudes
constexpr double kAway = 20;   // times the model's radius
constexpr int kMargin_px = 3;  // around the model in its view

struct Options {
  bool as_csv = false;
  double supersampling = 3;
  int samples_per_pixel = 1;
  bool in_sun = false;
  std::vector<double> sizes_px{std::begin(kSizes_px), std::end(kSizes_px)};
};

struct Named {
  std::string name;
  Mesh mesh;
};

double process_ms() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto ms_of = [](const timeval& t) { return 1e3 * double(t.tv_sec) + 1e-3 * double(t.tv_usec); };
  return ms_of(usage.ru_utime) + ms_of(usage.ru_stime);
}

Pose<frame::Camera, frame::Body> pose_of(const Mesh& mesh, int turn) {
  const double share = double(turn) / kTurns;
  return {rotation_of({0.6 * share - 0.3, 1.1 * share - 0.5, 6.2 * share}), {kAway * mesh.radius_m, 0, 0}};
}

VirtualCamera view_of(double size_px, double supersampling) {
  const double side_px = size_px * supersampling;
  const int side = static_cast<int>(side_px) + 2 * kMargin_px;
  return {.focal_px = side_px * kAway / 2, .center_px = glm::dvec2((side - 1) / 2.0), .size_px = {side, side}};
}

struct Cost {
  double median_ms;
  double min_ms;
  double processor_ms;  // of all threads
  double triangles;
  double draw_calls;
};

// Nothing where the driver fails.
std::optional<Cost> cost_of(Renderer& renderer, const Mesh& mesh, double size_px, const Options& options) {
  const VirtualCamera view = view_of(size_px, options.supersampling);
  const Light light{.p_in_camera = {-2000, 1000, -3000},
                    .kind = options.in_sun ? Light::Kind::sun : Light::Kind::point,
                    .to_sun = {-2, 1, -3},
                    .sky_color = glm::dvec3(0.3),
                    .ground_color = glm::dvec3(0.1)};
  const auto draw = [&](int i) { return renderer.draw(mesh, pose_of(mesh, i % kTurns), light, view).has_value(); };
  for (int i = 0; i < kTurns; ++i)
    if (!draw(i)) return std::nullopt;
  std::vector<double> ms;
  const RenderCounts before = renderer.counts();
  const double start_ms = process_ms();
  for (int i = 0; i < kTurns * kRounds; ++i) {
    const Clock::time_point start = Clock::now();
    if (!draw(i)) return std::nullopt;
    ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  const double count = kTurns * kRounds;
  const double used_ms = (process_ms() - start_ms) / count;
  const RenderCounts after = renderer.counts();
  std::sort(ms.begin(), ms.end());
  return Cost{ms[ms.size() / 2], ms.front(), used_ms, double(after.triangles_drawn - before.triangles_drawn) / count,
              double(after.draw_calls - before.draw_calls) / count};
}

int measure(const std::vector<Named>& models, const Options& options) {
  Result<Renderer> renderer = Renderer::create(options.samples_per_pixel);
  if (!renderer) {
    std::fprintf(stderr, "error: %s\n", renderer.error().text().c_str());
    return 69;
  }
  std::printf(options.as_csv ? "model,faces,size_px,median_ms,min_ms,processor_ms,triangles,draw_calls\n"
                             : "%-24s %8s %8s %10s %10s %13s %10s %6s\n",
              "model", "faces", "size_px", "median_ms", "min_ms", "processor_ms", "triangles", "calls");
  for (const Named& model : models)
    for (const double size_px : options.sizes_px) {
      const std::optional<Cost> cost = cost_of(*renderer, model.mesh, size_px, options);
      if (!cost) return 69;
      std::printf(options.as_csv ? "%s,%zu,%g,%.3f,%.3f,%.3f,%.0f,%.0f\n"
                                 : "%-24s %8zu %8g %10.2f %10.2f %13.2f %10.0f %6.0f\n",
                  model.name.c_str(), model.mesh.indices.size() / 3, size_px, cost->median_ms, cost->min_ms,
                  cost->processor_ms, cost->triangles, cost->draw_calls);
      std::fflush(stdout);
    }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  Options options;
  while (!words.empty() && words.front().starts_with("--")) {
    const std::string option = words.front();
    words.erase(words.begin());
    if (option == "--csv") {
      options.as_csv = true;
      continue;
    }
    if (option == "--sun") {
      options.in_sun = true;
      continue;
    }
    const int number = words.empty() ? 0 : std::atoi(words.front().c_str());
    if (option == "--size" && number > 0) {
      options.sizes_px = {double(number)};
      words.erase(words.begin());
      continue;
    }
    if (number < 1 || number > 8 || (option != "--supersampling" && option != "--samples")) {
      std::fprintf(stderr, "error: %s wants a number from 1 to 8\n", option.c_str());
      return 64;
    }
    if (option == "--samples")
      options.samples_per_pixel = number;
    else
      options.supersampling = number;
    words.erase(words.begin());
  }
  if (words.empty())
    for (const std::string name : {"airliner", "light-aircraft"}) {
      words.push_back(std::string(SIGS_MODELS_DIR) + "/" + name + "/" + name + ".obj");
      words.insert(words.end(), {"+x", "+z"});
    }
  std::vector<Named> models;
  for (std::size_t i = 0; i + 2 < words.size(); i += 3) {
    Result<Mesh> mesh = read_obj(words[i], {.forward = words[i + 1], .up = words[i + 2]});
    if (!mesh) {
      std::fprintf(stderr, "error: %s\n", mesh.error().text().c_str());
      return 65;
    }
    models.push_back({std::filesystem::path(words[i]).stem().string(), std::move(*mesh)});
  }
  return measure(models, options);
}
