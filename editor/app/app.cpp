// SPDX-License-Identifier: MIT
#include "editor/app/app.h"

#include <imgui_internal.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>
#include <vector>

#include "base/resources.h"
#include "base/statistics.h"
#include "editor/views/waypoint_actions.h"
#include "editor/widgets/dialog.h"

namespace sigs::editor {

namespace {

std::vector<std::string> problems_of(const PreviewOutput& shown) {
  std::vector<std::string> problems;
  if (!shown.scene) return problems;
  if (!shown.scene->footage->problem.empty()) problems.push_back(shown.scene->footage->problem);
  for (const Problem& problem : shown.scene->draft.problems) problems.push_back(problem.field + ": " + problem.what);
  return problems;
}

nlohmann::json input_of(const ImGuiIO& io, int released_keys) {
  unsigned buttons = 0;
  for (unsigned i = 0; i < std::size(io.MouseDown); ++i) buttons |= io.MouseDown[i] ? 1U << i : 0U;
  return {{"mouse", {io.MousePos.x, io.MousePos.y}}, {"buttons", buttons}, {"released_keys", released_keys}};
}

constexpr double kIdle_s = 0.25;     // between updates while nothing happens
constexpr int kUpdatesToSettle = 3;  // ImGui needs some updates to show all that an event leads to

// Readers find the whole of the old or the new text. It need not be on the disk: nobody reads it after a crash, and
// waiting for the disk in every update would slow down what is watched.
bool replace_at_once(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path part = file.string() + ".part";
  std::ofstream out(part, std::ios::binary);
  out << text;
  out.close();
  std::error_code code;
  if (out) std::filesystem::rename(part, file, code);
  return out && !code;
}

}  // namespace

// Once per update.
bool ProbeWriter::is_at_rest(const nlohmann::json& input, bool has_input_left) {
  if (has_input_left || input != last_input_)
    turns_to_rest_ = kUpdatesToSettle;
  else if (turns_to_rest_ > 0)
    --turns_to_rest_;
  last_input_ = input;
  return turns_to_rest_ == 0;
}

int ProbeWriter::composites_shown(const std::shared_ptr<const PreviewImage>& image) {
  const bool is_same = !image_.owner_before(image) && !image.owner_before(image_);
  if (image && !is_same) {
    ++composites_;
    shown_at_s_.push_back(steady_now_s());
    if (shown_at_s_.size() > 201) shown_at_s_.pop_front();
  }
  image_ = image;
  return composites_;
}

std::vector<double> ProbeWriter::intervals_ms() const {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < shown_at_s_.size(); ++i)
    intervals.push_back(1000 * (shown_at_s_[i] - shown_at_s_[i - 1]));
  if (intervals.empty()) return {0, 0, 0};
  return {quantile(intervals, 0.5), quantile(intervals, 0.9), quantile(intervals, 0.99)};
}

void ProbeWriter::note(const Document& document, const PreviewOutput& shown, const UiProbe& ui_probe,
                       const ProbedWindow& window) {
  if (!wanted()) return;
  nlohmann::json& json = noted_ = nlohmann::json::object();
  json["frame"] = document.playhead();
  json["revision"] = document.state().number;
  json["camera"] = document.active_camera();
  json["unsaved"] = document.has_unsaved_changes();
  json["current"] = shown.image_is_current;
  json["busy"] = shown.busy;
  json["page"] = window.page;
  json["problems"] = problems_of(shown);
  const MemoryUse& memory = shown.memory;
  json["memory"] = {{"images", memory.images},     {"decoded", memory.decoded}, {"shown", memory.shown},
                    {"textures", memory.textures}, {"sum", memory.sum()},       {"limit", memory.limit}};
  json["turns_a_second"] = window.updates_per_second;
  json["composites"] = composites_shown(shown.image);
  json["interval_ms"] = intervals_ms();
  const nlohmann::json input = input_of(ImGui::GetIO(), window.released_keys);
  json.update(input);
  json["at_rest"] = is_at_rest(input, window.has_input_left);
  for (const auto& [name, rect] : ui_probe.all())
    json["places"][name] = {rect.low.x, rect.low.y, rect.size().x, rect.size().y};
}

void ProbeWriter::write() {
  if (!wanted()) return;
  ++update_;
  const std::string text = noted_.dump();
  if (text == last_) return;
  noted_["turn"] = update_;
  if (replace_at_once(file_, noted_.dump() + "\n")) last_ = text;
}

App::App(Window& window, Settings settings, ProbeWriter probe)
    : window_(window),
      settings_(std::move(settings)),
      probe_writer_(std::move(probe)),
      preview_(PreviewLimits(), [] { Window::wake(); }),
      own_body_(edits_, [] { Window::wake(); }),
      ego_motion_(edits_, [] { Window::wake(); }),
      horizon_watch_([] { Window::wake(); }),
      appearance_(edits_, [] { Window::wake(); }),
      light_(edits_, [] { Window::wake(); }),
      scoring_([] { Window::wake(); }),
      shell_(document_, settings_,
             {.samples = resource_file("projects").value_or(std::filesystem::path()),
              .models = resource_file("assets/models").value_or(std::filesystem::path()),
              .recovery_folder = recovery_folder(),
              .version = SIGS_VERSION,
              .help = help_lines(),
              .wake = [] { Window::wake(); },
              .mask = {.unsaved = [this] { return own_body_.unsaved(); },
                       .save_then = [this](std::function<void()> next) { keep_mask_then(std::move(next)); },
                       .to_keep = [this] { return own_body_.to_keep(); }}}) {
  ui_probe_.set_wanted(probe_writer_.wanted());
}

// What comes next has to see the edit that uses the mask: it is not saved either.
void App::keep_mask_then(std::function<void()> next) {
  own_body_.ask_keep(document_, [this, next = std::move(next)] {
    take_edits();
    next();
  });
}

double App::wait_timeout_s() const {
  if (playback_.playing() || redraw_updates_left_ > 0) return 0;
  return shell_.needs_redraw() ? 0.1 : kIdle_s;
}

void App::ask_preview() {
  const PreviewRequest active{.revision = document_.revision(),
                              .frame = document_.playhead(),
                              .direction = playback_.speed() < 0 ? -1 : 1,
                              .range_first = document_.range_first(),
                              .range_last = document_.range_last(),
                              .playing = playback_.playing(),
                              .footage = needs_.footage,
                              .stages = needs_.stages,
                              .compare_with = needs_.compare_with,
                              .turntable = needs_.turntable,
                              .encounters = needs_.encounters};
  preview_.want(
      document_,
      {.active = active, .all_images = needs_.all_cameras, .only_active = ImGui::IsMouseDown(ImGuiMouseButton_Left)});
}

void App::advance(const PreviewOutput& shown) {
  if (!playback_.playing() || !shown.scene) return;
  const FootageShape& shape = counted_frames(shown.scene->draft.scene).footage;
  const PlayedFrame due = playback_.frame_at(now_s_, {shape.times_s, shape.frame_interval_s},
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

void App::draw(const PreviewOutput& shown, const std::vector<PreviewOutput>& rig) {
  needs_ = {};
  ui_probe_.clear();
  // A key that ends a dialog or a menu in this update was meant for that.
  const bool keys_are_taken = any_popup_open();
  close_popup_with_escape();
  const ViewContext context{
      .document = document_,
      .shown = shown,
      .settings = settings_,
      .textures = textures_,
      .edits = edits_,
      .needs = needs_,
      .ui_probe = ui_probe_,
      .playing = playback_.playing(),
      .speed = playback_.speed(),
      .scored = scored_.get(),
      .ego_motion = &ego_motion_.state(),
      .appearance = &appearance_.state(),
      .light = &light_.state(),
      .horizons = horizon_watch_.seen(),
      .guesses = &shell_.guesses(),
      .rig = document_.cameras().empty() || rig.size() != document_.cameras().size() ? nullptr : &rig};
  ask_scores(context);
  shell_.draw_menu(context);
  const ImGuiViewport& screen = *ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(screen.WorkPos);
  ImGui::SetNextWindowSize(screen.WorkSize);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::Begin("SIGS", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::PopStyleVar(2);
  if (shell_.has_project())
    layout_.draw(context, own_body_, settings_);
  else
    shell_.draw_start_page(context);
  ImGui::End();
  shell_.draw_over_all(context);
  if (!keys_are_taken) handle_keys(context, shell_.has_project());
}

void App::ask_scores(const ViewContext& context) {
  if (results_.files().empty()) return scoring_.want({});
  // Results are of the footage of a rig's first camera.
  const PreviewOutput& first = context.rig != nullptr ? context.rig->front() : context.shown;
  scoring_.want({.scene = first.scene,
                 .surveys = first.surveys,
                 .files = results_.files(),
                 .intruder = current_intruder(context).value_or(0)});
}

// What is wrong with a file is reported once, when it is known what it is measured by: which frame a tracker was
// started in may hang on that.
void App::report_result_problems() {
  if (!scored_) return reported_problems_.clear();
  if (scored_->truth != TruthKind::measured && scored_->truth_problem.empty()) return;
  for (const ScoredTracker& tracker : scored_->trackers) {
    std::string& reported = reported_problems_[tracker.file.id];
    if (tracker.problem != reported && !tracker.problem.empty()) edits_.ask(ShowMessage{tracker.problem, true});
    reported = tracker.problem;
  }
}

bool App::handle_results(const Request& request) {
  if (const auto* wanted = std::get_if<LoadResults>(&request)) {
    if (!shell_.has_project()) return true;
    if (wanted->path.empty()) {
      const std::filesystem::path near =
          results_.files().empty() ? document_.project().file : results_.files().back().path;
      edits_.ask(AskForFile{.title = "Load a tracker's results",
                            .extensions = {".txt", ".csv", ".json"},
                            .start = near.parent_path() / "",
                            .chosen = [this](const std::filesystem::path& path) { edits_.ask(LoadResults{path}); }});
    } else {
      results_.add(wanted->path);
      settings_.show_inspector = true;
    }
  } else if (const auto* gone = std::get_if<RemoveResults>(&request)) {
    results_.remove(gone->id);
  } else if (const auto* look = std::get_if<ShowResults>(&request)) {
    results_.set_shown(look->id, look->shown);
  } else {
    return false;
  }
  return true;
}

void App::handle(const Request& request) {
  if (handle_results(request) || shell_.handle(request)) return;
  if (std::holds_alternative<ToggleFullScreen>(request)) window_.toggle_full_screen();
  if (std::holds_alternative<ShowOwnBody>(request)) layout_.show_own_body();
  if (std::holds_alternative<EstimateCameraMotion>(request)) ego_motion_.start(document_);
  if (std::holds_alternative<StopCameraMotion>(request)) ego_motion_.stop();
  if (std::holds_alternative<MatchFootage>(request)) appearance_.start(document_);
  if (std::holds_alternative<StopMatchingFootage>(request)) appearance_.stop();
  if (std::holds_alternative<ShowLightLike>(request)) layout_.show_light_like();
  if (const auto* wanted = std::get_if<LightLike>(&request)) light_.start(document_, *wanted);
  if (std::holds_alternative<StopLightLike>(request)) light_.stop();
  if (std::holds_alternative<ShowHorizon>(request)) layout_.show_horizon();
  if (std::holds_alternative<ToggleAllCameras>(request)) layout_.toggle_all_cameras();
  if (const auto* wanted = std::get_if<Play>(&request)) play(wanted->speed);
  if (std::holds_alternative<TogglePlay>(request)) play(playback_.playing() ? 0 : 1);
  if (const auto* loop = std::get_if<SetLoop>(&request)) settings_.loop = loop->loop;
  if (const auto* depth = std::get_if<ShowAllSettings>(&request)) settings_.all_settings = depth->all;
}

void App::show_title() {
  const Project& project = document_.project();
  const std::string name = project.file.empty() ? project.name : project.file.filename().string();
  const std::string title =
      !shell_.has_project() ? "SIGS" : name + (document_.has_unsaved_changes() ? " * - SIGS" : " - SIGS");
  if (title != title_) window_.set_title(shortened(title, 200));
  title_ = title;
}

void App::count_updates() {
  ++updates_;
  if (now_s_ - counted_since_s_ < 1) return;
  updates_per_second_ = updates_ / (now_s_ - counted_since_s_);
  updates_ = 0;
  counted_since_s_ = now_s_;
}

bool App::finish_typing() {
  has_left_text_ = !has_left_text_ && ImGui::GetIO().WantTextInput;
  if (!has_left_text_) return false;
  ImGui::ClearActiveID();
  redraw_updates_left_ = kUpdatesToSettle;
  return true;
}

void App::update(double now_s, bool something_happened) {
  now_s_ = now_s;
  redraw_updates_left_ = something_happened ? kUpdatesToSettle : std::max(0, redraw_updates_left_ - 1);
  count_updates();
  const std::vector<PreviewOutput>& rig = preview_.shown(document_);
  const PreviewOutput shown = rig[std::min(document_.active_camera(), rig.size() - 1)];
  if (shown.scene)
    document_.set_frame_count(static_cast<int>(counted_frames(shown.scene->draft.scene).footage.times_s.size()));
  advance(shown);
  scored_ = scoring_.scored();
  report_result_problems();
  ego_motion_.follow(document_);
  horizon_watch_.follow(shown.scene);
  appearance_.follow(document_);
  light_.follow(document_);
  window_.begin(settings_);
  draw(shown, rig);
  probe_writer_.note(document_, shown, ui_probe_,
                     {.page = shell_.has_project() ? "project" : "start",
                      .updates_per_second = updates_per_second_,
                      .released_keys = window_.released_keys(),
                      .has_input_left = window_.has_input_left()});
  take_edits();
  ask_preview();  // it works while OpenGL does
  window_.end(layout_.images_at());
  textures_.end_update(PreviewLimits().texture_bytes());
  preview_.set_texture_bytes(textures_.bytes());
  probe_writer_.write();
  const std::uint64_t document = document_.first_number();
  if (!(window_.wants_to_close() || window_.has_dropped()) || !finish_typing()) {
    for (const std::filesystem::path& path : window_.take_dropped()) shell_.handle_dropped(path, edits_);
    take_edits();
  }
  for (const Request& request : edits_.take_requests()) handle(request);
  if (window_.wants_to_close() && !has_left_text_) {
    window_.refuse_to_close();
    shell_.handle(Quit{});
  }
  shell_.update(now_s_);
  if (document_.first_number() != document) {
    ImGui::ClearActiveID();  // what is being typed belongs to the other project
    playback_.pause();
    own_body_.forget();
    ego_motion_.forget();
    appearance_.forget();
    light_.forget();
    results_.clear();
    scored_.reset();
    scoring_.want({});
  }
  if (const std::optional<RecoveredMask> mask = shell_.take_recovered_mask()) own_body_.recover(*mask);
  preview_.set_prefetch_paused(shell_.is_exporting() || own_body_.job().is_running() ||
                               ego_motion_.state().is_running() || appearance_.state().is_running());
  show_title();
  ask_preview();
  done_ = shell_.is_done();
  if (done_) window_.remember_in(settings_);
  // Recent projects are kept at once: the program may be ended from outside.
  if (done_ || settings_.recent != kept_recent_) {
    kept_recent_ = settings_.recent;
    (void)write_settings(settings_, settings_file());
  }
}

}  // namespace sigs::editor
