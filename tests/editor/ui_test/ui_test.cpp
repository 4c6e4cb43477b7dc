// SPDX-License-Identifier: MIT
#include "editor/ui_test/ui_test.h"
#include "support/files.h"

#include <exception>
#include <fstream>

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

fs::path folder_with_settings(const fs::path& folder, const Json& settings) {
  fs::create_directories(folder / "config/sigs");
  std::ofstream(folder / "config/sigs/editor.json") << settings.dump() << '\n';
  return folder;
}

// The last of an intruder's keys on the timeline.
ScreenPlace last_key(const Json& state) {
  const std::string head = "timeline/row/0/key/";
  ScreenPlace last;
  for (const auto& [name, rect] : state["places"].items())
    if (name.starts_with(head) && rect[0].get<double>() > last.x) last = {rect[0], rect[1], rect[2], rect[3]};
  return last;
}

const Json& trajectory(const Json& project, int intruder) {
  return project.at("intruders").at(static_cast<std::size_t>(intruder)).at("trajectory").at("waypoints");
}

}  // namespace

UiTest::UiTest(std::string name, const Json& settings)
    : name_(std::move(name)), editor_(folder_with_settings(folder_.path(), settings), 1600, 960) {}

UiTest::~UiTest() {
  if (std::uncaught_exceptions() == 0) return;
  try {
    editor_.screenshot(build_dir() / "screenshots" / (name_ + "-failed.png"));
  } catch (const std::exception&) {
    // The test has failed already.
  }
}

void UiTest::image(const std::string& what) {
  editor_.move(1, 1);
  editor_.settle();
  editor_.screenshot(build_dir() / "screenshots" / (name_ + "-" + what + ".png"));
}

void UiTest::dismiss_messages() {
  while (editor_.has_place("toast/0")) editor_.click("toast/0");
}

void UiTest::wait_for_place(const std::string& place) {
  editor_.wait_for(place, [&](const nlohmann::json& now) { return shows(now, place); });
}

void UiTest::scrub_to(int frame, int last) {
  const ScreenPlace ruler = editor_.place("timeline/ruler");
  const double first_x = editor_.place("timeline/row/0/key/0").center_x();
  const Json state = editor_.state();
  const double step_px = (last_key(state).center_x() - first_x) / last;
  const double y = ruler.y + ruler.height / 3;
  const double from_x = first_x + step_px * state["frame"].get<int>();
  editor_.drag(from_x, y, first_x + step_px * frame, y);
  editor_.wait_for("frame " + std::to_string(frame), [&](const Json& now) { return now.value("frame", -1) == frame; });
  editor_.wait_for_image();
}

void UiTest::edit(const std::function<void()>& action) {
  const int before = revision_of(editor_.state());
  action();
  editor_.wait_for("an edit", [&](const Json& now) { return revision_of(now) != before; });
  editor_.wait_for_image();
}

Json UiTest::saved(const fs::path& project) {
  editor_.key("ctrl+s");
  editor_.wait_for("the project to be saved", [](const Json& now) { return !is_unsaved(now); });
  return json_of(project);
}

void UiTest::fill_in(const std::string& place, const std::string& text) {
  (void)editor_.place(place);
  editor_.settle();  // a dialog that has just opened takes the focus for itself first
  editor_.click(place);
  editor_.settle();
  editor_.key("ctrl+a");
  editor_.type(text);
}

Json sample_project(const std::string& name) {
  const fs::path folder = source_dir() / "projects" / name;
  Json project = json_of(folder / (name + ".json"));
  const auto make_absolute = [&](Json& path) {
    path = fs::weakly_canonical(folder / path.get<std::string>()).string();
  };
  for (const char* key : {"video", "calibration", "own_body_mask"})
    if (project["footage"].contains(key)) make_absolute(project["footage"][key]);
  for (Json& intruder : project["intruders"]) make_absolute(intruder["model"]["file"]);
  return project;
}

fs::path put(const Json& project, const fs::path& file) {
  std::ofstream(file) << project.dump(2) << '\n';
  return file;
}

std::vector<glm::dvec3> waypoints_m(const Json& project, int intruder) {
  std::vector<glm::dvec3> positions_m;
  for (const Json& waypoint : trajectory(project, intruder)) {
    const Json& p = waypoint.at("position_m");
    positions_m.emplace_back(p.at(0).get<double>(), p.at(1).get<double>(), p.at(2).get<double>());
  }
  return positions_m;
}

std::vector<double> waypoint_frames(const Json& project, int intruder) {
  std::vector<double> frames;
  for (const Json& waypoint : trajectory(project, intruder)) frames.push_back(waypoint.at("frame").get<double>());
  return frames;
}

}  // namespace sigs::test
