// SPDX-License-Identifier: MIT
#include "accuracy/runner.h"

#include "accuracy/csv.h"
#include "accuracy/scenes.h"

namespace sigs::accuracy {

Effort effort_of(const Call& call) {
  return call.quick ? Effort{.rounds = 1, .samples_per_side = 4} : Effort{};
}

ComposeContext& Benches::of(const Method& method) {
  const auto [at, is_new] = benches_.try_emplace(
      std::tuple(method.samples, method.lens_tolerance_px, method.supersampling, method.quality),
      ComposeSettings{.samples_per_pixel = method.samples, .lens_tolerance_px = method.lens_tolerance_px});
  // OpenGL starts here and in no frame's time.
  if (is_new)
    if (const Result<Renderer*> renderer = at->second.renderer(); !renderer) stop(renderer.error().text());
  return at->second;
}

void Benches::forget(const Scene& scene) {
  for (auto& [settings, context] : benches_)
    for (const auto& model : scene.models) context.forget(model->mesh);
}

std::vector<Runner> runners_of(const Scene& scene, const std::vector<Method>& methods) {
  std::vector<Runner> runners;
  for (const Method& method : methods) {
    runners.push_back({.method = method, .scene = scene});
    runners.back().scene.compositing.method = method.choice;
    runners.back().scene.compositing.supersampling = method.supersampling;
    runners.back().scene.compositing.quality = method.quality;
  }
  return runners;
}

ComposedFrame composed(const Runner& runner, const Frame& background, Benches& benches) {
  Result<ComposedFrame> frame = compose_frame(runner.scene, kFrame, cloned(background), benches.of(runner.method));
  if (!frame) stop(frame.error().text());
  return std::move(*frame);
}

void time(std::vector<Runner>& runners, const Frame& background, Benches& benches, int rounds) {
  for (Runner& runner : runners)
    runner.first_composite_ms = 1e3 * composed(runner, background, benches).times.composite_s;
  for (int round = 0; round < rounds; ++round)
    for (Runner& runner : runners) {
      if (round % runner.skip != 0) continue;
      const double cpu_before_s = cpu_s();
      const FrameTimes times = composed(runner, background, benches).times;
      runner.cpu_ms.push_back(1e3 * (cpu_s() - cpu_before_s));
      runner.draw_ms.push_back(1e3 * times.draw_s);
      runner.composite_ms.push_back(1e3 * times.composite_s);
      runner.total_ms.push_back(1e3 * (times.draw_s + times.composite_s));
    }
}

}  // namespace sigs::accuracy
