// SPDX-License-Identifier: MIT
// Waiting times of a user of the editor: the real document, previewer and caches, without a window.
//   bench_editor_preview [PROJECT]

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "editor/document/document.h"
#include "editor/preview/preview_state.h"
#include "project/json.h"

namespace {

using namespace sigs;
using namespace sigs::editor;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPlayerStep(40);  // 25 frames a second
constexpr std::chrono::milliseconds kWindowTurn(16);
constexpr std::chrono::seconds kDrag(3);

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct Spread {
  double median = 0;
  double maximum = 0;  // 95 of 100 are below
};

Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values[values.size() / 2], values[values.size() * 95 / 100]};
}

void print(const char* what, const std::vector<double>& ms, const char* wanted) {
  const Spread spread = spread_of(ms);
  std::printf("%-58s %7.2f ms median %7.2f ms 95 %%   %s\n", what, spread.median, spread.maximum, wanted);
}

// The window's part: requests, and reads the state when it is woken.
class Window {
 public:
  Window(const Document& document, PreviewLimits limits)
      : document_(document), previewer_(limits, [this] { wake(); }) {}

  // Milliseconds until the frame's own image is there.
  double go_to(int frame, bool playing) {
    const Clock::time_point start = Clock::now();
    ask(frame, playing);
    wait([](const PreviewOutput& shown) { return shown.image_is_current; });
    return ms_since(start);
  }

  void ask(int frame, bool playing) {
    PreviewRequest wanted{.revision = document_.revision(),
                          .frame = frame,
                          .range_first = document_.range_first(),
                          .range_last = document_.range_last(),
                          .playing = playing};
    const PreviewOutput shown = previewer_.shown();
    if (shown.scene && wanted.range_last <= wanted.range_first)
      wanted.range_last = static_cast<int>(shown.scene->footage->shape.times_s.size()) - 1;
    previewer_.want(wanted);
  }

  void wait(const std::function<bool(const PreviewOutput&)>& is_there) {
    std::unique_lock lock(mutex_);
    woken_.wait(lock, [&] { return is_there(previewer_.shown()); });
  }

  [[nodiscard]] PreviewOutput shown() const { return previewer_.shown(); }

 private:
  void wake() {
    const std::lock_guard lock(mutex_);
    woken_.notify_all();
  }

  const Document& document_;
  std::mutex mutex_;
  std::condition_variable woken_;
  Previewer previewer_;
};

void open(Document& document, Window& window) {
  window.go_to(0, false);
  document.set_frame_count(static_cast<int>(window.shown().scene->footage->shape.times_s.size()));
}

void measure_played(Document& document) {
  Window window(document, {});
  open(document, window);
  std::vector<double> ms;
  Clock::time_point due = Clock::now();
  for (int frame = document.range_first(); frame <= document.range_last(); ++frame) {
    std::this_thread::sleep_until(due);
    ms.push_back(window.go_to(frame, true));
    due = std::max(due + kPlayerStep, Clock::now());
  }
  print("next frame, played at 25 frames/s", ms, "(wanted: < 40)");

  ms.clear();
  const int count = document.range_last() - document.range_first() + 1;
  const std::vector<bool> cached = window.shown().cached;
  for (int i = 0; i < count; ++i) {
    const int frame = document.range_first() + i * 67 % count;
    if (!cached[static_cast<std::size_t>(frame)]) continue;
    ms.push_back(window.go_to(frame, false));
    std::this_thread::sleep_for(kWindowTurn);
  }
  print("scrub to a cached frame", ms, "(wanted: < 15)");
}

void measure_uncached(Document& document) {
  Window window(document, {.ahead = 0});
  open(document, window);
  std::vector<double> ms;
  for (int frame = document.range_first() + 1; frame <= document.range_last(); ++frame)
    ms.push_back(window.go_to(frame, false));
  print("next frame, nothing fetched ahead", ms, "(wanted: < 40)");
}

void measure_jumps(Document& document) {
  Window window(document, {.ahead = 0});
  open(document, window);
  std::vector<double> ms;
  const int count = document.range_last() - document.range_first() + 1;
  for (int i = 1; i < count; i += 4) ms.push_back(window.go_to(document.range_first() + i * 67 % count, false));
  print("jump to any frame, nothing fetched ahead", ms, "");
}

void measure_drag(Document& document, int frame) {
  Window window(document, {});
  open(document, window);
  window.go_to(frame, false);
  std::vector<double> gaps_ms;
  std::uint64_t observed = 0;
  Clock::time_point last = Clock::now();
  const Clock::time_point end = last + kDrag;
  for (int turn = 0; Clock::now() < end; ++turn) {
    document.apply(ChangeProject{"move waypoint",
                                 [turn](Project& project) {
                                   glm::dvec3& p = project.intruders[0].trajectory.waypoints[1].position_m;
                                   p.y += turn / 40 % 2 == 0 ? 0.25 : -0.25;
                                 },
                                 "drag"});
    window.ask(frame, false);
    std::this_thread::sleep_for(kWindowTurn);
    const PreviewOutput shown = window.shown();
    if (!shown.image || shown.image->revision == observed) continue;
    if (observed != 0) gaps_ms.push_back(ms_since(last));
    observed = shown.image->revision;
    last = Clock::now();
  }
  const double rate_hz = static_cast<double>(gaps_ms.size()) / std::chrono::duration<double>(kDrag).count();
  std::printf("drag a waypoint, frame %-35d %7.1f images/s, %.1f ms apart (median)   (wanted: >= 20)\n", frame, rate_hz,
              spread_of(gaps_ms).median);
}

// Part of every edit, on the window's thread.
void measure_content_id(Project project) {
  constexpr int kWaypoints = 10'000;
  std::vector<WaypointSettings>& waypoints = project.intruders[0].trajectory.waypoints;
  waypoints.assign(kWaypoints, waypoints[0]);
  for (int i = 0; i < kWaypoints; ++i) waypoints[static_cast<std::size_t>(i)].frame = i;
  std::vector<double> ms;
  for (int i = 0; i < 50; ++i) {
    waypoints[0].position_m.x += 1;
    const Clock::time_point start = Clock::now();
    const ContentId id = content_id_of(project);
    ms.push_back(ms_since(start) + (id == ContentId() ? 1e9 : 0));  // so that the call is not left out
  }
  print("content id of 10,000 waypoints", ms, "(wanted: < 2)");
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path path = argc > 1 ? argv[1] : SIGS_PROJECTS_DIR "/head-on/head-on.json";
  const Result<ReadProject> read = read_project(path);
  if (!read) {
    std::fprintf(stderr, "%s\n", read.error().text().c_str());
    return 1;
  }
  measure_content_id(read->project);
  Document document(read->project);
  measure_played(document);
  measure_uncached(document);
  measure_jumps(document);
  for (const int frame : {50, 100, 150}) measure_drag(document, frame);
  return 0;
}
