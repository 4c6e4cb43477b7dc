// SPDX-License-Identifier: MIT
// Aircraft that the footage itself shows are marked by a few boxes.
#include <doctest/doctest.h>

#include <sstream>

#include "editor/ui_test/ui_test.h"
#include "support/files.h"
#include "support/process.h"

namespace sigs::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

// Edges of a box in the pixels of the screen and, as the file has them, in those of the footage.
struct DraggedBox {
  double x = 0, y = 0, to_x = 0, to_y = 0;

  [[nodiscard]] std::vector<double> in_file(const ScreenPlace& image, double scale) const {
    // A box that begins with the first pixel, at the image's left edge, has x = 1 in the file.
    return {(x - image.x) / scale + 1, (y - image.y) / scale + 1, (to_x - x) / scale, (to_y - y) / scale};
  }
};

void drag_box(UiTest& ui_test, const DraggedBox& box) {
  ui_test.editor().drag(box.x, box.y, box.to_x, box.to_y);
  ui_test.editor().wait_for_image();
}

// The four numbers of each line, by frame.
std::map<int, std::vector<double>> boxes_in(const fs::path& csv) {
  std::map<int, std::vector<double>> boxes;
  std::istringstream text(text_of(csv));
  std::string line;
  for (std::getline(text, line); std::getline(text, line);) {
    std::istringstream cells(line);
    std::string frame, label, cell;
    std::getline(cells, frame, ',');
    std::getline(cells, label, ',');
    std::vector<double>& box = boxes[std::stoi(frame)];
    while (std::getline(cells, cell, ',')) box.push_back(std::stod(cell));
  }
  return boxes;
}

void choose_in_menu(UiTest& ui_test, double x, double y, const std::string& item) {
  ui_test.editor().click(x, y, 3);
  ui_test.editor().click("viewport/menu/" + item);
}

}  // namespace

TEST_CASE("two boxes by the mouse mark a real aircraft in all frames between, in a file that exports ignore") {
  if (!can_drive_windows()) return;
  UiTest ui_test("real-aircraft");
  EditorDriver& editor = ui_test.editor();
  const fs::path project = put(sample_project("crossing"), ui_test.folder() / "flight.json");
  const fs::path csv = ui_test.folder() / "flight.real.csv";
  editor.start({project.string()});
  editor.wait_for_image();
  ui_test.scrub_to(40);
  editor.wait_for_image();
  const ScreenPlace image = editor.place("viewport/image");
  const double scale = image.width / 1280;

  const double x = std::round(image.x), y = std::round(image.y);
  choose_in_menu(ui_test, x + 60, y + 60, "mark real aircraft");
  ui_test.wait_for_place("viewport/real aircraft box");
  const DraggedBox first{x + 100, y + 70, x + 140, y + 90};
  ui_test.edit([&] { drag_box(ui_test, first); });  // the project names the file
  ui_test.wait_for_place("viewport/real/aircraft 1");
  ui_test.scrub_to(50);
  editor.wait_for_image();
  CHECK_FALSE(editor.has_place("viewport/real/aircraft 1"));
  const DraggedBox last{x + 220, y + 130, x + 280, y + 160};
  drag_box(ui_test, last);
  ui_test.image("marked");
  editor.key("ctrl+z");
  CHECK(boxes_in(csv).size() == 1);
  editor.key("ctrl+y");
  for (int i = 0; i < 5; ++i) editor.key("Left");
  editor.wait_for_image();
  CHECK(editor.state()["frame"].get<int>() == 45);
  ui_test.wait_for_place("viewport/real/aircraft 1");
  ui_test.image("between");
  editor.key("Escape");
  editor.wait_for("no box", [](const Json& now) { return !shows(now, "viewport/real aircraft box"); });

  const auto boxes = boxes_in(csv);
  REQUIRE(boxes.size() == 11);
  const std::vector<double> a = first.in_file(image, scale), b = last.in_file(image, scale);
  // The file has 4 decimals, the place of the image on the screen fewer.
  for (const auto& [frame, box] : boxes)
    for (std::size_t i = 0; i < 4; ++i)
      CHECK(box.at(i) == doctest::Approx(a[i] + (b[i] - a[i]) * (frame - 40) / 10.0).epsilon(1e-3));

  // What is exported ignores the box, as whole pixels.
  CHECK(ui_test.saved(project)["footage"]["real_aircraft"] == "flight.real.csv");
  std::ostringstream command;
  command << build_dir() / "sigs"
          << " export " << project << " --frames 45 --masks none --labels coco --progress none --out "
          << ui_test.folder() / "out";
  const Run exported = run_together(command.str());
  REQUIRE_MESSAGE(exported.status == 0, exported.out);
  int ignored = 0;
  const Json coco = json_of(ui_test.folder() / "out/crossing.coco.json");
  for (const Json& region : coco["annotations"])
    if (region.value("real_aircraft", false) && ++ignored == 1) {
      CHECK(region["iscrowd"] == 1);
      CHECK(std::abs(region["bbox"][0].get<double>() - (boxes.at(45)[0] - 1)) <= 1);
    }
  CHECK(ignored > 0);

  // The right button deletes it, here and everywhere, and undo brings it back.
  const ScreenPlace there = editor.place("viewport/real/aircraft 1");
  choose_in_menu(ui_test, there.center_x(), there.center_y(), "delete box");
  editor.wait_for("no box here", [](const Json& now) { return !shows(now, "viewport/real/aircraft 1"); });
  CHECK(boxes_in(csv).size() == 10);
  editor.key("Left");
  editor.wait_for_image();
  const ScreenPlace before = editor.place("viewport/real/aircraft 1");
  choose_in_menu(ui_test, before.center_x(), before.center_y(), "delete real aircraft");
  editor.wait_for("no boxes", [](const Json& now) { return !shows(now, "viewport/real/aircraft 1"); });
  CHECK(boxes_in(csv).empty());
  editor.key("ctrl+z");
  editor.key("ctrl+z");
  CHECK(boxes_in(csv) == boxes);
}

}  // namespace sigs::test
