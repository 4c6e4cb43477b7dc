// SPDX-License-Identifier: MIT
#include "editor/views/export_view.h"

#include <doctest/doctest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <atomic>
#include <map>
#include <memory>
#include <string>
#include <thread>

#include "editor/views/view_fixture.h"
#include "editor/widgets/theme.h"
#include "scene/draft.h"
#include "scene/scene_files.h"
#include "support/files.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::editor;
using sigs::test::TemporaryFolder;

namespace {

constexpr int kUpdatesToSettle = 12;  // ImGui takes some to find how large a window is

const Warning kLongWarning{"head-on.json: intruders[0].trajectory",
                           "the flight exceeds what an aircraft of this kind can do, in frames 20 to 48 and in "
                           "others, by more than twice its load factor"};

struct Rect {
  float x, y, width, height;
  [[nodiscard]] bool operator==(const Rect&) const = default;
};
std::ostream& operator<<(std::ostream& out, const Rect& rect) {
  return out << rect.x << " " << rect.y << " " << rect.width << " " << rect.height;
}

// The dialog on a screen of 1600 x 960, drawn update by update without a window.
struct ExportDialog : ViewFixture {
  explicit ExportDialog(const Project& project) : ViewFixture(project) {
    ImGui::CreateContext();
    load_fonts(15);
    apply_theme();
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {1600, 960};
    io.IniFilename = nullptr;
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    ui_probe.set_wanted(true);
    view.open(document);
    draw();
  }
  ~ExportDialog() { ImGui::DestroyContext(); }
  ExportDialog(const ExportDialog&) = delete;
  ExportDialog& operator=(const ExportDialog&) = delete;

  void draw() {
    for (int i = 0; i < kUpdatesToSettle; ++i) {
      ui_probe.clear();
      ImGui::NewFrame();
      view.draw(context, job);
      ImGui::EndFrame();
      apply();
    }
  }

  void press(const std::string& name) {
    const ScreenRect rect = ui_probe.all().at(name);
    const glm::dvec2 middle = (rect.low + rect.high) / 2.0;
    ImGui::GetIO().MousePos = {static_cast<float>(middle.x), static_cast<float>(middle.y)};
    draw();
    ImGui::GetIO().MouseDown[0] = true;
    draw();
    ImGui::GetIO().MouseDown[0] = false;
    draw();
  }

  // Where the dialog is, and its buttons.
  [[nodiscard]] std::map<std::string, Rect> places() const {
    const ImGuiWindow* const window = ImGui::FindWindowByName("Export###export");
    REQUIRE(window != nullptr);
    std::map<std::string, Rect> all{{"dialog", {window->Pos.x, window->Pos.y, window->Size.x, window->Size.y}}};
    for (const char* const name : {"export/folder", "export/close", "export/go", "export/cancel", "export/hide"})
      if (const auto found = ui_probe.all().find(name); found != ui_probe.all().end()) {
        const glm::dvec2 low = found->second.low, size = found->second.high - low;
        all[name] = {float(low.x), float(low.y), float(size.x), float(size.y)};
      }
    return all;
  }

  // The scene that is shown, with so many problems.
  void show_problems(int count) {
    SceneFiles files;
    auto scene = std::make_shared<OpenedScene>(
        OpenedScene{.footage = std::make_shared<const Footage>(),
                    .draft = draft_scene(context.project(), placeholder_footage(context.project()), files)});
    for (int i = 0; i < count; ++i) scene->draft.problems.push_back({"intruders[0].model.file", kLongWarning.what});
    shown.scene = std::move(scene);
  }

  ExportView view;
  std::atomic<int> warnings = 0;  // that the export is to give
  ExportJob job{[] {},
                [this](const ExportRequest&, const JobControl& control) -> Result<ExportReport> {
                  for (int given = 0; !*control.cancel; std::this_thread::yield())
                    for (; given < warnings; ++given) control.warn(kLongWarning);
                  return fail("", "stopped", ErrorKind::interrupted);
                }};
};

Project project_in(const TemporaryFolder& folder) {
  Project project;
  project.file = folder / "head-on.json";
  project.name = "head-on";
  return project;
}

}  // namespace

TEST_CASE("the export dialog and its buttons stay where they are, whatever there is to say before an export") {
  const TemporaryFolder folder;
  ExportDialog it(project_in(folder));
  const auto before = it.places();
  it.show_problems(3);
  it.draw();
  CHECK(it.places() == before);
  it.document.apply(ChangeProject{"labels", [](Project& p) { p.output.labels = {"yolo", "coco"}; }, {}});
  it.draw();
  CHECK(it.places() == before);
  // A long command, which takes more lines.
  it.document.apply(ChangeProject{
      "file", [](Project& p) { p.file = "/" + std::string(300, 'a') + "/" + std::string(200, 'b') + ".json"; }, {}});
  it.draw();
  CHECK(it.places() == before);
}

TEST_CASE("the question whether files may be replaced moves nothing either") {
  const TemporaryFolder folder;
  ExportDialog it(project_in(folder));
  const auto before = it.places();
  test::write_file_and_folders(folder / "out/head-on.xml", "mine");
  it.press("export/go");
  CHECK_FALSE(it.job.is_running());
  auto after = it.places();
  // "Replace" is a little wider or narrower than "Export".
  CHECK(after["export/go"].y == before.at("export/go").y);
  for (const char* const one : {"dialog", "export/folder"}) CHECK(after[one] == before.at(one));
}

TEST_CASE("warnings that come during an export move neither the dialog nor its buttons") {
  const TemporaryFolder folder;
  ExportDialog it(project_in(folder));
  it.press("export/go");
  REQUIRE(it.job.is_running());
  it.draw();
  const auto before = it.places();
  REQUIRE(before.contains("export/hide"));
  for (const int count : {1, 5, 300}) {
    it.warnings = count;
    while (it.job.state().warnings.size() < static_cast<std::size_t>(count)) std::this_thread::yield();
    it.draw();
    CAPTURE(count);
    CHECK(it.places() == before);
  }
}
