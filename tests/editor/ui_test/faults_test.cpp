// SPDX-License-Identifier: MIT
// The editor is killed while it saves, and saves on a full disk.
#include <doctest/doctest.h>
#include <sched.h>
#include <sys/mount.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <thread>

#include "editor/ui_test/ui_test.h"
#include "support/files.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

void open_project(EditorDriver& editor, const fs::path& project, const Environment& environment = {}) {
  editor.start({project.string()}, environment);
  editor.wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
  editor.wait_for_image();
}

// One waypoint more, the same each time, in a frame that has none. The project is shown at frame 0.
void add_one_waypoint(UiTest& ui_test, int frame = 1) {
  for (int i = 1; i <= frame; ++i) {
    ui_test.editor().key("Right");
    ui_test.editor().wait_for("the next frame", [i](const Json& now) { return now.value("frame", -1) == i; });
  }
  ui_test.edit([&] { ui_test.editor().key("Return"); });
}

bool keeps_recovery(const fs::path& home) {
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(home / "state/sigs/recovery", code))
    if (entry.path().extension() == ".json") return true;
  return false;
}

bool has_staging_folder(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().starts_with(".sigs-")) return true;
  return false;
}

// A project, what the edit makes of it, and an editor that has made the edit and kept it for recovery.
struct EditedProject {
  UiTest ui_test{"faults", {{"autosave_s", 1}}};
  fs::path project = put(sample_project("head-on"), ui_test.folder() / "mine.json");
  std::string older = text_of(project);

  void begin(const Environment& environment = {}) {
    write_file(project, older);
    open_project(ui_test.editor(), project, environment);
    add_one_waypoint(ui_test);
    ui_test.editor().wait_for("the recovery file", [&](const Json&) { return keeps_recovery(ui_test.folder()); });
  }
  // Without any fault.
  std::string saved() {
    begin();
    static_cast<void>(ui_test.saved(project));
    ui_test.editor().kill();
    return text_of(project);
  }
  // Work that the killed editor had not saved is offered, and taken; in the end all of it is saved.
  void check_nothing_lost(const std::string& newer) {
    const std::string left = text_of(project);
    CHECK((left == older || left == newer));
    EditorDriver& editor = ui_test.editor();
    if (keeps_recovery(ui_test.folder())) {
      editor.start({});
      editor.click("start/recover.0");
      editor.wait_for("the project", [](const Json& now) { return now.value("page", "") == "project"; });
      editor.wait_for_image();
    } else {
      CHECK(left == newer);
      open_project(editor, project);
      add_one_waypoint(ui_test, 2);
      editor.key("ctrl+z");
      editor.settle();
    }
    if (is_unsaved(editor.state())) static_cast<void>(ui_test.saved(project));
    CHECK(text_of(project) == newer);
    editor.kill();
    CHECK_FALSE(keeps_recovery(ui_test.folder()));
  }
};

int kills(int usual) {
  const char* const asked = std::getenv("SIGS_TEST_FAULTS");
  return asked == nullptr ? usual : std::atoi(asked);
}

}  // namespace

TEST_CASE("killed while it saves, the editor leaves the older project or the newer one, and no work is lost") {
  if (!can_drive_windows()) return;
  EditedProject edited;
  const std::string newer = edited.saved();
  REQUIRE(newer != edited.older);
  for (const char* const moment : {"SIGS_TEST_KILL_BEFORE", "SIGS_TEST_KILL_AFTER"}) {
    CAPTURE(moment);
    edited.begin({{"LD_PRELOAD", (build_dir() / "sigs_fault_injection.so").string()}, {moment, "mine.json"}});
    edited.ui_test.editor().key("ctrl+s");
    CHECK(edited.ui_test.editor().exit_status() == 128 + SIGKILL);
    CHECK((text_of(edited.project) == newer) == (moment == std::string("SIGS_TEST_KILL_AFTER")));
    edited.check_nothing_lost(newer);
  }
  std::mt19937 random(1);
  for (int i = 0; i < kills(1); ++i) {
    edited.begin();
    edited.ui_test.editor().kill_after_key("ctrl+s", 0.08 * static_cast<double>(random() % 1000) / 1000);
    edited.check_nothing_lost(newer);
  }
}

TEST_CASE("a project that cannot be saved on a full disk stays as it was, and unsaved, until there is room") {
  if (!can_drive_windows()) return;
  UiTest ui_test("full-disk");
  const fs::path disk = ui_test.folder() / "disk";
  fs::create_directory(disk);
  const bool is_mounted = unshare(CLONE_NEWNS) == 0 && mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                          mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=64k") == 0;
  if (!is_mounted) return say_skipped("no file system can be mounted");
  const fs::path project = put(sample_project("head-on"), disk / "mine.json");
  const std::string older = text_of(project);
  write_file(disk / "filler", std::string(60 << 10, 'x'));
  open_project(ui_test.editor(), project);
  add_one_waypoint(ui_test);
  ui_test.editor().key("ctrl+s");
  (void)ui_test.editor().place("toast/0");
  ui_test.image("message");
  CHECK(is_unsaved(ui_test.editor().state()));
  CHECK(text_of(project) == older);
  CHECK_FALSE(has_staging_folder(disk));
  fs::remove(disk / "filler");
  CHECK(waypoint_frames(ui_test.saved(project)).size() == 4);
  CHECK_FALSE(has_staging_folder(disk));
  ui_test.editor().kill();
  umount2(disk.c_str(), MNT_DETACH);
}

}  // namespace sigs::test
