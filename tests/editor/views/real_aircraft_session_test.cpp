// SPDX-License-Identifier: MIT
#include "editor/views/viewport/real_aircraft_session.h"

#include <doctest/doctest.h>

#include "project/json.h"
#include "support/files.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::editor;

namespace {

const FootageBounds kFootage{{640, 480}, 100};

// The only box of an aircraft in a frame.
Box box_at(const RealAircraftBoxes& boxes, const std::string& label, int frame) {
  std::vector<Box> found;
  for (const RealAircraftBox& box : boxes)
    if (box.frame == frame && box.label == label) found.push_back(box.box);
  REQUIRE(found.size() == 1);
  return found.front();
}

RealAircraftBoxes marked(RealAircraftBoxes boxes, int frame, const Box& box, const std::string& label = "A") {
  Result<RealAircraftBoxes> changed = with_box(boxes, label, frame, box, kFootage);
  REQUIRE(changed);
  return *std::move(changed);
}

// The file has 4 decimals.
bool is_near(const Box& a, const Box& b) {
  return std::abs(a.x - b.x) < 1e-4 && std::abs(a.y - b.y) < 1e-4 && std::abs(a.width - b.width) < 1e-4 &&
         std::abs(a.height - b.height) < 1e-4;
}

// A saved project, and a user who marks real aircraft in its footage.
struct MarkingUser {
  test::TemporaryFolder folder;
  Document document;
  Edits edits;
  RealAircraftSession session;

  explicit MarkingUser(const std::string& named = "", bool is_saved = true) {
    Project project;
    if (is_saved) project.file = folder / "flight.json";
    project.footage.real_aircraft = named;
    document = Document(project);
    update();
  }
  // An update of the window.
  void update() {
    document.apply(edits.take_edits());
    (void)session.follow(document);
  }
  Result<void> mark(int frame, const Box& box, const std::string& label = "aircraft 1") {
    const Result<void> done = session.mark(document, edits, label, frame, box, kFootage);
    update();
    return done;
  }
  [[nodiscard]] std::filesystem::path file() const { return folder / "flight.real.csv"; }
};

}  // namespace

TEST_CASE("frames between two boxes of an aircraft are on the straight line between them, in either order") {
  const Box first{10, 20, 30, 12}, last{110, 60, 50, 32};
  for (const bool backwards : {false, true}) {
    RealAircraftBoxes boxes = marked({}, backwards ? 17 : 10, backwards ? last : first);
    boxes = marked(boxes, backwards ? 10 : 17, backwards ? first : last);
    REQUIRE(boxes.size() == 8);
    for (int i = 0; i < 8; ++i) {
      const double share = i / 7.0;
      CHECK(boxes[static_cast<std::size_t>(i)].frame == 10 + i);
      CHECK(is_near(box_at(boxes, "A", 10 + i), {10 + 100 * share, 20 + 40 * share, 30 + 20 * share, 12 + 20 * share}));
      CHECK(is_filled(boxes, static_cast<std::size_t>(i)) == (i > 0 && i < 7));
    }
  }
}

TEST_CASE("a box in the same frame replaces the one before, and what was filled follows it") {
  RealAircraftBoxes boxes = marked(marked({}, 0, {0, 0, 10, 10}), 10, {100, 0, 10, 10});
  boxes = marked(boxes, 20, {100, 200, 10, 10});
  boxes = marked(boxes, 10, {50, 50, 20, 20});
  CHECK(boxes.size() == 21);
  CHECK(is_near(box_at(boxes, "A", 5), {25, 25, 15, 15}));
  CHECK(is_near(box_at(boxes, "A", 15), {75, 125, 15, 15}));
  // One that is drawn over a filled box bends the line there, and leaves the other drawn ones alone.
  boxes = marked(boxes, 16, {80, 300, 10, 10});
  CHECK(is_near(box_at(boxes, "A", 5), {25, 25, 15, 15}));
  CHECK(is_near(box_at(boxes, "A", 10), {50, 50, 20, 20}));
  CHECK(is_near(box_at(boxes, "A", 13), {65, 175, 15, 15}));
  CHECK(is_near(box_at(boxes, "A", 18), {90, 250, 10, 10}));
}

TEST_CASE("another aircraft's boxes stay as they are") {
  const RealAircraftBoxes other = marked(marked({}, 2, {0, 0, 10, 10}, "B"), 8, {60, 60, 10, 10}, "B");
  RealAircraftBoxes boxes = marked(marked(other, 0, {300, 0, 10, 10}), 10, {400, 0, 10, 10});
  CHECK(boxes.size() == 18);
  std::erase_if(boxes, [](const RealAircraftBox& box) { return box.label == "A"; });
  CHECK(boxes == other);
}

TEST_CASE("boxes of a file from elsewhere are not taken for filled ones") {
  RealAircraftBoxes boxes;
  for (int frame = 0; frame < 9; ++frame)
    boxes.push_back({frame, "A", {8.5, 8.5, 5, 5}, std::to_string(frame) + ",A,10,10,5,5"});
  const RealAircraftBoxes changed = marked(boxes, 4, {200, 200, 5, 5});
  for (int frame = 0; frame < 9; ++frame)
    if (frame != 4) CHECK(changed[static_cast<std::size_t>(frame)] == boxes[static_cast<std::size_t>(frame)]);
}

TEST_CASE("a box is clipped to the image; what is left of it must have a pixel, in a frame of the footage") {
  CHECK(is_near(box_at(marked({}, 0, {-20, 470, 40, 40}), "A", 0), {-0.5, 470, 20.5, 9.5}));
  CHECK(is_near(box_at(marked({}, 0, {-20, -20, 2000, 2000}), "A", 0), {-0.5, -0.5, 640, 480}));
  for (const Box& wrong : {Box{10, 10, 0, 0}, Box{10, 10, 30, 0}, Box{10, 10, 0.9, 30}, Box{10, 10, -5, 5},
                           Box{700, 10, 30, 30}, Box{10, std::nan(""), 30, 30}})
    CHECK_FALSE(with_box({}, "A", 0, wrong, kFootage));
  for (const int frame : {-1, 100, 5000}) CHECK_FALSE(with_box({}, "A", frame, {10, 10, 30, 30}, kFootage));
  CHECK(with_box({}, "A", 99, {10, 10, 30, 30}, kFootage));
}

TEST_CASE("what is marked lies in a file beside the project, which names it, and is read as boxes by frame") {
  MarkingUser user;
  REQUIRE(user.mark(3, {10, 20, 30, 12}));
  REQUIRE(user.mark(5, {20, 20, 30, 12}));
  CHECK(user.document.project().footage.real_aircraft == "flight.real.csv");
  CHECK(test::text_of(user.file()) ==
        "frame,label,x,y,w,h\n3,aircraft 1,11.5000,21.5000,30.0000,12.0000\n"
        "4,aircraft 1,16.5000,21.5000,30.0000,12.0000\n5,aircraft 1,21.5000,21.5000,30.0000,12.0000\n");
  const Result<BoxesByFrame> read = read_boxes_by_frame(user.file());
  REQUIRE(read);
  CHECK(*read == BoxesByFrame{{3, {{10, 20, 30, 12}}}, {4, {{15, 20, 30, 12}}}, {5, {{20, 20, 30, 12}}}});
  CHECK(user.session.new_label() == "aircraft 2");
  // Who opens the project again goes on where this one ended.
  RealAircraftSession again;
  (void)again.follow(user.document);
  CHECK(again.boxes() == user.session.boxes());
  CHECK(is_filled(again.boxes(), 1));
}

TEST_CASE("each change can be undone and made again, and the file has every state") {
  MarkingUser user;
  std::vector<std::string> texts;
  const auto remember = [&] { texts.push_back(test::text_of(user.file())); };
  REQUIRE(user.mark(0, {10, 20, 30, 12}));
  remember();
  REQUIRE(user.mark(9, {90, 20, 30, 12}));
  remember();
  REQUIRE(user.session.remove(user.document, user.edits, user.session.boxes()[4]));
  remember();
  CHECK(user.session.boxes().size() == 9);
  REQUIRE(user.session.remove_all(user.document, user.edits, "aircraft 1"));
  CHECK(user.session.boxes().empty());
  CHECK(read_boxes_by_frame(user.file()).value().empty());
  for (int i = 2; i >= 0; --i) {
    REQUIRE(user.session.undo(user.document, user.edits));
    CHECK(test::text_of(user.file()) == texts[static_cast<std::size_t>(i)]);
  }
  REQUIRE(user.session.undo(user.document, user.edits));
  CHECK_FALSE(user.session.can_undo());
  CHECK(user.session.boxes().empty());
  REQUIRE(user.session.redo(user.document, user.edits));
  REQUIRE(user.session.redo(user.document, user.edits));
  CHECK(test::text_of(user.file()) == texts[1]);
  REQUIRE(user.mark(20, {0, 0, 9, 9}, "other"));
  CHECK_FALSE(user.session.can_redo());
}

TEST_CASE("lines of a file from elsewhere stay as they are written, with columns that are not known here") {
  MarkingUser user("seen.csv");
  test::write_file_and_folders(user.folder / "seen.csv",
                               "Frame;who\n7,BIRD,1,2,3,4,far\n5,AIRPLANE,12.30,20,1e1,8\n"
                               "5,AIRPLANE,300,20,10,0\n");
  user.update();
  CHECK(user.session.boxes().size() == 3);
  CHECK_FALSE(user.session.is_track("AIRPLANE"));  // two of one kind in a frame
  CHECK(user.session.is_track("BIRD"));
  REQUIRE(user.mark(6, {10, 20, 30, 12}));
  CHECK(test::text_of(user.folder / "seen.csv") ==
        "Frame;who\n5,AIRPLANE,12.30,20,1e1,8\n5,AIRPLANE,300,20,10,0\n"
        "6,aircraft 1,11.5000,21.5000,30.0000,12.0000\n7,BIRD,1,2,3,4,far\n");
  CHECK(user.document.project().footage.real_aircraft == "seen.csv");
  CHECK_FALSE(user.document.can_undo());
}

TEST_CASE("nothing of a file is lost that cannot be read, that another program changes, or that no project names") {
  MarkingUser user("seen.csv");
  const std::filesystem::path seen = user.folder / "seen.csv";
  test::write_file_and_folders(seen, "frame,label,x,y,w,h\n7,BIRD,a,2,3,4\n");
  user.update();
  CHECK_FALSE(user.mark(6, {10, 20, 30, 12}));
  CHECK(test::text_of(seen) == "frame,label,x,y,w,h\n7,BIRD,a,2,3,4\n");

  test::write_file_and_folders(seen, "frame,label,x,y,w,h\n7,BIRD,1,2,3,4\n");
  user.update();
  REQUIRE(user.mark(6, {10, 20, 30, 12}));
  test::write_file_and_folders(seen, "frame,label,x,y,w,h\n");
  CHECK_FALSE(user.session.mark(user.document, user.edits, "A", 6, {10, 20, 30, 12}, kFootage));
  CHECK(test::text_of(seen) == "frame,label,x,y,w,h\n");
  CHECK_FALSE(user.session.can_undo());

  MarkingUser other;
  REQUIRE(other.mark(0, {10, 20, 30, 12}));
  other.document.apply(Edit(Undo{}));
  other.update();
  CHECK(other.session.boxes().empty());
  const std::string before = test::text_of(other.file());
  REQUIRE(other.mark(0, {90, 20, 30, 12}));
  CHECK(other.document.project().footage.real_aircraft == "flight.real_2.csv");
  CHECK(test::text_of(other.file()) == before);
}

TEST_CASE("a project without a file is to be saved first, and a folder that cannot be written to changes nothing") {
  MarkingUser unsaved("", false);
  const Result<void> refused = unsaved.mark(0, {10, 20, 30, 12});
  REQUIRE_FALSE(refused);
  CHECK(refused.error().text().find("save") != std::string::npos);
  MarkingUser user("nowhere/seen.csv");
  CHECK_FALSE(user.mark(0, {10, 20, 30, 12}));
  CHECK(user.session.boxes().empty());
  CHECK_FALSE(user.session.can_undo());
}

TEST_CASE("boxes belong to the footage of the active camera") {
  MarkingUser user;
  Project rig = user.document.project();
  for (const char* name : {"front", "left"}) rig.cameras.emplace_back().name = name;
  user.document = Document(rig, 100);
  CHECK(user.session.follow(user.document));
  CHECK_FALSE(user.session.follow(user.document));
  REQUIRE(user.mark(0, {10, 20, 30, 12}));
  user.document.apply(Edit(ActivateCamera{1}));
  CHECK(user.session.follow(user.document));
  CHECK(user.session.boxes().empty());
  REQUIRE(user.mark(5, {90, 20, 30, 12}));
  const auto& cameras = user.document.whole().cameras;
  CHECK(cameras[0].footage.real_aircraft == "flight.front.real.csv");
  CHECK(cameras[1].footage.real_aircraft == "flight.left.real.csv");
  CHECK(read_boxes_by_frame(user.folder / "flight.left.real.csv").value() == BoxesByFrame{{5, {{90, 20, 30, 12}}}});
}
