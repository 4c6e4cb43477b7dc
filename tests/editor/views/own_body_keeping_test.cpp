// SPDX-License-Identifier: MIT
#include "editor/views/mask_fixture.h"

#include "occlusion/detect.h"

using namespace sigs;
using namespace sigs::editor;

TEST_CASE("undoing the project's edit leaves the painting, which keeps the name of its own file") {
  MaskFixture b("mask.png");
  REQUIRE(write_mask(disk(10), b.folder / "mask.png", false));
  b.use_mask_of_scene(disk(10));
  b.update();
  b.stroke(30);
  const cv::Mat painted = b.session.painting().mask().clone();
  CHECK(b.session.mask_text(b.document.project()) == "mask.png, changed, not saved");
  b.session.ask_save_and_use(b.document.project());
  REQUIRE(b.choose(b.folder / "mine.png"));
  b.use_mask_of_scene(painted.clone());
  b.update();
  CHECK(b.session.mask_text(b.document.project()) == "mine.png, used in the project");
  b.document.apply(Edit(Undo{}));
  b.use_mask_of_scene(disk(10));
  b.update();
  CHECK(is_same(b.session.painting().mask(), painted));
  CHECK(b.session.mask_text(b.document.project()) == "mine.png, not used in the project");
  b.session.painting().undo();
  CHECK(b.session.mask_text(b.document.project()) == "mine.png, changed, not saved");
  CHECK_FALSE(b.session.could_replace(b.document.project()));  // mask.png is not its file
  b.session.start_from_project(b.document.project());
  CHECK(b.session.mask_text(b.document.project()) == "mask.png, used in the project");
  CHECK(is_same(b.session.painting().mask(), disk(10)));
}

TEST_CASE("a file that another program has changed is taken over as a step") {
  MaskFixture b("mask.png");
  b.use_mask_of_scene(disk(10));
  b.update();
  b.stroke(30);
  b.session.replace_and_use(b.document.project());
  const cv::Mat painted = b.session.painting().mask().clone();
  b.use_mask_of_scene(disk(20));
  b.update();
  CHECK(is_same(b.session.painting().mask(), disk(20)));
  CHECK(b.session.unsaved() == 0);
  b.session.painting().undo();
  CHECK(is_same(b.session.painting().mask(), painted));
  b.use_mask_of_scene(cv::Mat());  // and a missing one removes nothing
  b.update();
  CHECK(is_same(b.session.painting().mask(), painted));
}

TEST_CASE("the painting is named after its source") {
  MaskFixture b("mask.png");
  b.use_mask_of_scene(disk(10));
  b.update();
  const auto text = [&b] { return b.session.mask_text(b.document.project()); };
  CHECK(text() == "mask.png, used in the project");
  b.detect(25);
  CHECK(text() == "detected, not saved");
  b.stroke(5);
  CHECK(text() == "detected, painted on, not saved");
  b.session.painting().undo();
  b.session.painting().undo();
  CHECK(text() == "mask.png, used in the project");
  b.session.start_from_empty();
  CHECK(text() == "emptied, not saved");
  b.stroke(5);
  CHECK(text() == "painted, not saved");
  MaskFixture without;
  without.update();
  CHECK(without.session.mask_text(without.document.project()) == "Nothing painted");
}

TEST_CASE("before leaving, the mask is saved under a free name and used; only saved where its size differs") {
  MaskFixture b("shared/mask.png");
  b.use_mask_of_scene(disk(10));
  b.update();
  b.stroke(30);
  bool has_gone_on = false;
  b.session.ask_keep(b.document, [&] { has_gone_on = true; });
  CHECK(b.proposed() == b.folder / "flight_own_body.png");
  CHECK_FALSE(has_gone_on);
  b.session.ask_keep(b.document, [&] {
    has_gone_on = true;
    b.document.apply(b.edits.take_edits());  // what comes next sees the edit
    CHECK(b.document.project().footage.own_body_mask == "flight_own_body.png");
  });
  REQUIRE(b.choose(b.folder / "flight_own_body.png"));
  CHECK(has_gone_on);
  b.stroke(10);
  b.scene.draft.scene.footage.size_px = {64, 48};
  b.update();
  b.session.ask_keep(b.document, {});
  REQUIRE(b.choose(b.folder / "other.png"));
  b.update();
  CHECK(b.document.project().footage.own_body_mask == "flight_own_body.png");
}

TEST_CASE("a mask is kept for the camera that it was painted for, whichever is active by then") {
  MaskFixture b;
  Project rig = b.document.whole();
  rig.cameras.resize(2);
  for (std::size_t i = 0; i < 2; ++i) {
    rig.cameras[i].name = i == 0 ? "left" : "right";
    rig.cameras[i].footage.video = "flight.mp4";
  }
  b.document = Document(rig);
  b.document.apply(ActivateCamera{1});
  b.update();
  b.stroke(30);
  CHECK(b.session.to_keep().camera == 1);
  b.document.apply(ActivateCamera{0});  // and the tab is not drawn again
  b.session.ask_keep(b.document, {});
  REQUIRE(b.choose(b.folder / "right.png"));
  b.document.apply(b.edits.take_edits());
  CHECK(b.document.whole().cameras[1].footage.own_body_mask == "right.png");
  CHECK(b.document.whole().cameras[0].footage.own_body_mask.empty());
}

TEST_CASE("a detected mask follows the soft edge at once, and is restored with it") {
  MaskFixture b;
  b.update();
  b.detect(20);
  const std::uint64_t state = b.session.unsaved();
  const cv::Mat found = b.session.painting().mask().clone();
  const auto set_edge = [&b](double edge_px) {
    b.document.apply(ChangeProject{"edge", [=](Project& p) { p.own_body.soft_edge_px = edge_px; }, {}});
    b.update();
  };
  for (const double edge_px : {4.0, 6.0}) {
    set_edge(edge_px);
    CHECK(is_same(b.session.painting().mask(), soft_edged(found > 127, edge_px)));
    CHECK(b.session.painting().undo_name() == "soft edge");
    CHECK_FALSE(b.session.edge_waits());
  }
  b.session.painting().undo();  // one step for both
  CHECK(is_same(b.session.painting().mask(), found));
  b.session.painting().redo();
  set_edge(1);
  CHECK(is_same(b.session.painting().mask(), found));
  CHECK(b.session.unsaved() == state);
}

TEST_CASE("a mask with strokes gets another soft edge only when the person asks") {
  MaskFixture b;
  b.update();
  b.detect(20);
  b.stroke(5);
  const cv::Mat painted = b.session.painting().mask().clone();
  b.document.apply(ChangeProject{"edge", [](Project& p) { p.own_body.soft_edge_px = 5; }, {}});
  b.update();
  CHECK(is_same(b.session.painting().mask(), painted));
  CHECK(b.session.edge_waits());
  b.session.feather();
  CHECK_FALSE(b.session.edge_waits());
  CHECK(is_same(b.session.painting().mask(), soft_edged(painted > 127, 5)));
  CHECK(b.session.mask_text(b.document.project()) == "detected, not saved");
}

TEST_CASE("the share follows the painting, also within a stroke") {
  MaskFixture b;
  b.update();
  b.update();
  CHECK(b.session.share() == 0);
  const auto counted = [&b] {
    return static_cast<double>(cv::countNonZero(b.session.painting().mask() > 127)) / kSize.area();
  };
  b.session.painting().begin_stroke({3, 1}, {10, 5});
  for (const double x : {20.0, 30.0}) {
    b.session.painting().extend_stroke({x, 5});
    b.update();
    CHECK(b.session.share() == counted());
    CHECK(b.session.share() > 0);
  }
  b.session.painting().end_stroke();
  b.update();
  CHECK(b.session.share() == counted());
  b.session.painting().undo();
  b.update();
  CHECK(b.session.share() == 0);
}

TEST_CASE(
    "a mask that is recovered after a crash is unsaved as it was, and neither project nor detection replaces it") {
  for (const bool has_strokes_of_user : {false, true}) {
    MaskFixture b;
    b.update();
    b.session.forget();
    b.session.recover({.pixels = disk(25), .has_strokes = has_strokes_of_user});
    b.use_mask_of_scene(disk(10));
    b.update();
    CHECK(is_same(b.session.painting().mask(), disk(25)));
    CHECK(b.session.unsaved() != 0);
    CHECK(b.session.mask_text(b.document.project()) == "recovered, not saved");
    const MaskToKeep kept = b.session.to_keep();
    CHECK(kept.state == b.session.unsaved());
    CHECK(is_same(kept.pixels, disk(25)));
    CHECK(kept.has_strokes == has_strokes_of_user);
    CHECK_FALSE(kept.is_changing);
    b.detect(12);
    CHECK(is_same(b.session.painting().mask(), has_strokes_of_user ? disk(25) : disk(12)));
    CHECK(b.session.found_waits() == has_strokes_of_user);
    b.session.painting().begin_stroke({3, 1}, {5, 5});
    CHECK(b.session.to_keep().is_changing);
    b.session.painting().take_back_stroke();
    REQUIRE(b.session.painting().can_undo() == !has_strokes_of_user);
  }
}
