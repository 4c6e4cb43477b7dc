// SPDX-License-Identifier: MIT
#include "editor/views/easel.h"

#include "occlusion/soft_edge.h"

using namespace sigs;
using namespace sigs::editor;

TEST_CASE("undoing the project's edit leaves the painting, which keeps the name of its own file") {
  Easel b("mask.png");
  REQUIRE(write_mask(disk(10), b.folder / "mask.png", false));
  b.use_mask_of_scene(disk(10));
  b.turn();
  b.stroke(30);
  const cv::Mat painted = b.work.painting().mask().clone();
  CHECK(b.work.mask_text(b.document.project()) == "mask.png, changed, not saved");
  b.work.ask_save_and_use(b.document.project());
  REQUIRE(b.choose(b.folder / "mine.png"));
  b.use_mask_of_scene(painted.clone());
  b.turn();
  CHECK(b.work.mask_text(b.document.project()) == "mine.png, used in the project");
  b.document.apply(Edit(Undo{}));
  b.use_mask_of_scene(disk(10));
  b.turn();
  CHECK(is_same(b.work.painting().mask(), painted));
  CHECK(b.work.mask_text(b.document.project()) == "mine.png, not used in the project");
  b.work.painting().undo();
  CHECK(b.work.mask_text(b.document.project()) == "mine.png, changed, not saved");
  CHECK_FALSE(b.work.could_replace(b.document.project()));  // mask.png is not its file
  b.work.start_from_project(b.document.project());
  CHECK(b.work.mask_text(b.document.project()) == "mask.png, used in the project");
  CHECK(is_same(b.work.painting().mask(), disk(10)));
}

TEST_CASE("a file that another program has changed is taken over as a step") {
  Easel b("mask.png");
  b.use_mask_of_scene(disk(10));
  b.turn();
  b.stroke(30);
  b.work.replace_and_use(b.document.project());
  const cv::Mat painted = b.work.painting().mask().clone();
  b.use_mask_of_scene(disk(20));
  b.turn();
  CHECK(is_same(b.work.painting().mask(), disk(20)));
  CHECK(b.work.unsaved() == 0);
  b.work.painting().undo();
  CHECK(is_same(b.work.painting().mask(), painted));
  b.use_mask_of_scene(cv::Mat());  // and one that is gone takes nothing away
  b.turn();
  CHECK(is_same(b.work.painting().mask(), painted));
}

TEST_CASE("the painting is called by where it comes from") {
  Easel b("mask.png");
  b.use_mask_of_scene(disk(10));
  b.turn();
  const auto text = [&b] { return b.work.mask_text(b.document.project()); };
  CHECK(text() == "mask.png, used in the project");
  b.detect(25);
  CHECK(text() == "detected, not saved");
  b.stroke(5);
  CHECK(text() == "detected, painted on, not saved");
  b.work.painting().undo();
  b.work.painting().undo();
  CHECK(text() == "mask.png, used in the project");
  b.work.start_from_empty();
  CHECK(text() == "emptied, not saved");
  b.stroke(5);
  CHECK(text() == "painted, not saved");
  Easel without;
  without.turn();
  CHECK(without.work.mask_text(without.document.project()) == "Nothing painted");
}

TEST_CASE("before it is left the mask is saved under a free name and used; only saved where it does not fit") {
  Easel b("shared/mask.png");
  b.use_mask_of_scene(disk(10));
  b.turn();
  b.stroke(30);
  bool has_gone_on = false;
  b.work.ask_keep(b.document.project(), [&] { has_gone_on = true; });
  CHECK(b.proposed() == b.folder / "flight_own_body.png");
  CHECK_FALSE(has_gone_on);
  b.work.ask_keep(b.document.project(), [&] {
    has_gone_on = true;
    b.document.apply(b.edits.take_edits());  // what comes next sees the edit
    CHECK(b.document.project().footage.own_body_mask == "flight_own_body.png");
  });
  REQUIRE(b.choose(b.folder / "flight_own_body.png"));
  CHECK(has_gone_on);
  b.stroke(10);
  b.scene.draft.scene.footage.size_px = {64, 48};
  b.turn();
  b.work.ask_keep(b.document.project(), {});
  REQUIRE(b.choose(b.folder / "other.png"));
  b.turn();
  CHECK(b.document.project().footage.own_body_mask == "flight_own_body.png");
}

TEST_CASE("what was found follows the soft edge at once, and comes back with it") {
  Easel b;
  b.turn();
  b.detect(20);
  const std::uint64_t state = b.work.unsaved();
  const cv::Mat found = b.work.painting().mask().clone();
  const auto set_edge = [&b](double edge_px) {
    b.document.apply(ChangeProject{"edge", [=](Project& p) { p.own_body.soft_edge_px = edge_px; }, {}});
    b.turn();
  };
  for (const double edge_px : {4.0, 6.0}) {
    set_edge(edge_px);
    CHECK(is_same(b.work.painting().mask(), soft_edged(found > 127, edge_px)));
    CHECK(b.work.painting().undo_name() == "soft edge");
    CHECK_FALSE(b.work.edge_waits());
  }
  b.work.painting().undo();  // one step for both
  CHECK(is_same(b.work.painting().mask(), found));
  b.work.painting().redo();
  set_edge(1);
  CHECK(is_same(b.work.painting().mask(), found));
  CHECK(b.work.unsaved() == state);
}

TEST_CASE("a mask with strokes gets another soft edge only when the person asks") {
  Easel b;
  b.turn();
  b.detect(20);
  b.stroke(5);
  const cv::Mat painted = b.work.painting().mask().clone();
  b.document.apply(ChangeProject{"edge", [](Project& p) { p.own_body.soft_edge_px = 5; }, {}});
  b.turn();
  CHECK(is_same(b.work.painting().mask(), painted));
  CHECK(b.work.edge_waits());
  b.work.soften();
  CHECK_FALSE(b.work.edge_waits());
  CHECK(is_same(b.work.painting().mask(), soft_edged(painted > 127, 5)));
  CHECK(b.work.mask_text(b.document.project()) == "detected, not saved");
}

TEST_CASE("the share follows what is painted, also within a stroke") {
  Easel b;
  b.turn();
  b.turn();
  CHECK(b.work.share() == 0);
  const auto counted = [&b] {
    return static_cast<double>(cv::countNonZero(b.work.painting().mask() > 127)) / kSize.area();
  };
  b.work.painting().begin_stroke({3, 1}, {10, 5});
  for (const double x : {20.0, 30.0}) {
    b.work.painting().go_on({x, 5});
    b.turn();
    CHECK(b.work.share() == counted());
    CHECK(b.work.share() > 0);
  }
  b.work.painting().end_stroke();
  b.turn();
  CHECK(b.work.share() == counted());
  b.work.painting().undo();
  b.turn();
  CHECK(b.work.share() == 0);
}

TEST_CASE(
    "a mask that is recovered after a crash is unsaved as it was, and neither project nor detection replaces it") {
  for (const bool by_hand : {false, true}) {
    Easel b;
    b.turn();
    b.work.forget();
    b.work.recover({disk(25), by_hand});
    b.use_mask_of_scene(disk(10));
    b.turn();
    CHECK(is_same(b.work.painting().mask(), disk(25)));
    CHECK(b.work.unsaved() != 0);
    CHECK(b.work.mask_text(b.document.project()) == "recovered, not saved");
    const MaskToKeep kept = b.work.to_keep();
    CHECK(kept.state == b.work.unsaved());
    CHECK(is_same(kept.pixels, disk(25)));
    CHECK(kept.has_strokes == by_hand);
    CHECK_FALSE(kept.is_changing);
    b.detect(12);
    CHECK(is_same(b.work.painting().mask(), by_hand ? disk(25) : disk(12)));
    CHECK(b.work.found_waits() == by_hand);
    b.work.painting().begin_stroke({3, 1}, {5, 5});
    CHECK(b.work.to_keep().is_changing);
    b.work.painting().take_back_stroke();
    REQUIRE(b.work.painting().can_undo() == !by_hand);
  }
}
