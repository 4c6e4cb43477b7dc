// SPDX-License-Identifier: MIT
#include "editor/app/app.h"

#include <imgui.h>

#include <algorithm>
#include <utility>

#include "editor/app/shortcuts.h"
#include "project/json.h"

namespace sigs::editor {

namespace {

constexpr double kIdle_s = 0.25;   // between turns while nothing happens
constexpr int kTurnsToSettle = 3;  // ImGui needs some turns to show all that an event leads to

}  // namespace

App::App(Window& window, Settings settings, Probe probe)
    : window_(window),
      settings_(std::move(settings)),
      probe_(std::move(probe)),
      previewer_(PreviewLimits(), [] { Window::wake(); }) {
  places_.set_wanted(probe_.wanted());
}

void App::open(const std::filesystem::path& path) {
  Result<ReadProject> read = read_project(path);
  if (!read) return;
  document_ = Document(std::move(read->project), document_.last_number() + 1);
}

double App::patience_s() const {
  return playback_.playing() || restless_turns_ > 0 ? 0 : kIdle_s;
}

void App::ask_preview() {
  previewer_.want({.revision = document_.revision(),
                   .frame = document_.playhead(),
                   .direction = playback_.speed() < 0 ? -1 : 1,
                   .range_first = document_.range_first(),
                   .range_last = document_.range_last(),
                   .playing = playback_.playing(),
                   .footage = wishes_.footage,
                   .stages = wishes_.stages,
                   .compare_with = wishes_.compare_with,
                   .turntable = wishes_.turntable});
}

void App::advance(const Shown& shown) {
  if (!playback_.playing() || !shown.scene) return;
  const FootageShape& shape = shown.scene->footage->shape;
  const PlayedFrame due = playback_.frame_at(
      now_s_, {shape.times_s, shape.frame_interval_s},
      {document_.range_first(), document_.range_last(), settings_.loop});
  document_.apply(Edit(GoToFrame{due.frame}));
  if (due.over) playback_.pause();
}

void App::take_edits() {
  const int playhead = document_.playhead();
  document_.apply(edits_.take_edits());
  // Scrubbed while it plays: on from there.
  if (document_.playhead() != playhead && playback_.playing())
    playback_.play(now_s_, document_.playhead(), playback_.speed());
}

void App::play(double speed) {
  if (speed == 0)
    playback_.pause();
  else
    playback_.play(now_s_, document_.playhead(), speed);
}

void App::draw(const Shown& shown) {
  wishes_ = {};
  places_.clear();
  const Studio studio{.document = document_,
                      .shown = shown,
                      .settings = settings_,
                      .textures = textures_,
                      .edits = edits_,
                      .wishes = wishes_,
                      .places = places_,
                      .playing = playback_.playing(),
                      .speed = playback_.speed()};
  const ImGuiViewport& screen = *ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(screen.WorkPos);
  ImGui::SetNextWindowSize(screen.WorkSize);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::Begin("SIGS", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::PopStyleVar(2);
  layout_.draw(studio, settings_);
  ImGui::End();
  take_keys(studio);
}

void App::take(const Request& request) {
  if (std::holds_alternative<Quit>(request)) done_ = true;
  if (const auto* wanted = std::get_if<Play>(&request)) play(wanted->speed);
  if (std::holds_alternative<TogglePlay>(request)) play(playback_.playing() ? 0 : 1);
  if (const auto* loop = std::get_if<SetLoop>(&request)) settings_.loop = loop->loop;
}

void App::turn(double now_s, bool something_happened) {
  now_s_ = now_s;
  restless_turns_ = something_happened ? kTurnsToSettle : std::max(0, restless_turns_ - 1);
  const Shown shown = previewer_.shown();
  if (shown.scene) document_.set_frame_count(static_cast<int>(shown.scene->footage->shape.times_s.size()));
  advance(shown);
  window_.begin(settings_);
  draw(shown);
  window_.end();
  textures_.end_turn();
  probe_.tell(document_, shown, places_, "project");
  take_edits();
  for (const Request& request : edits_.take_requests()) take(request);
  ask_preview();
  if (window_.wants_to_close()) done_ = true;
}

}  // namespace sigs::editor
