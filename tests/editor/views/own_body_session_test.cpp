// SPDX-License-Identifier: MIT
#include "editor/views/mask_fixture.h"

#include <fstream>
#include <opencv2/imgcodecs.hpp>

using namespace sigs;
using namespace sigs::editor;

TEST_CASE("painting begins with the project's mask, which is saved, or with nothing") {
  MaskFixture with("mask.png");
  with.use_mask_of_scene(disk(10));
  with.update();
  CHECK(is_same(with.session.painting().mask(), disk(10)));
  CHECK(with.session.unsaved() == 0);
  CHECK(with.session.is_used(with.document.project()));
  MaskFixture without;
  without.update();
  CHECK(cv::countNonZero(without.session.painting().mask()) == 0);
  CHECK(without.session.painting().mask().size() == kSize);
  CHECK(without.session.unsaved() == 0);
  CHECK_FALSE(without.session.is_used(without.document.project()));
}

TEST_CASE("a detected mask becomes a step of the painting, each time") {
  MaskFixture b;
  b.update();
  b.detect(10);
  CHECK(is_same(b.session.painting().mask(), disk(10)));
  CHECK(b.session.unsaved() != 0);
  CHECK(b.session.painting().undo_name() == "detected mask");
  b.detect(25);
  CHECK(is_same(b.session.painting().mask(), disk(25)));
  b.session.painting().undo();
  CHECK(is_same(b.session.painting().mask(), disk(10)));
  b.update();  // what was undone is not taken over again
  CHECK(is_same(b.session.painting().mask(), disk(10)));
}

TEST_CASE("painted strokes are kept after another detection, until its result is chosen") {
  MaskFixture b;
  b.update();
  b.detect(10);
  b.stroke(35);
  const cv::Mat painted = b.session.painting().mask().clone();
  b.detect(25);
  CHECK(is_same(b.session.painting().mask(), painted));
  CHECK(b.session.found_waits());
  b.session.start_from_found();
  CHECK(is_same(b.session.painting().mask(), disk(25)));
  CHECK_FALSE(b.session.found_waits());
  b.session.painting().undo();
  CHECK(is_same(b.session.painting().mask(), painted));
}

TEST_CASE("a mask is written whole under the name that was chosen, 8 bits, and counts as saved then") {
  MaskFixture b;
  b.update();
  b.detect(10);
  b.session.ask_save_as(b.document.project());
  REQUIRE(b.choose(b.folder / "a mask.png"));
  CHECK(b.session.unsaved() == 0);
  const cv::Mat written = cv::imread((b.folder / "a mask.png").string(), cv::IMREAD_UNCHANGED);
  REQUIRE(written.type() == CV_8UC1);
  CHECK(is_same(written, disk(10)));
  CHECK(b.document.project().footage.own_body_mask.empty());  // saving alone uses it nowhere
  b.stroke(30);
  CHECK(b.session.unsaved() != 0);
  b.session.painting().undo();
  CHECK(b.session.unsaved() == 0);
}

TEST_CASE("using a mask saves it first where it is not saved, and is one step of the project's history") {
  MaskFixture b;
  b.update();
  b.detect(10);
  const std::uint64_t revision = b.document.revision().number;
  b.session.use(b.document.project());
  CHECK(b.document.project().footage.own_body_mask.empty());
  REQUIRE(b.choose(b.folder / "masks.png"));
  b.update();
  CHECK(b.document.project().footage.own_body_mask == "masks.png");
  CHECK(b.session.is_used(b.document.project()));
  b.document.apply(Edit(Undo{}));
  CHECK(b.document.revision().number == revision);
  CHECK_FALSE(b.session.is_used(b.document.project()));
  b.session.use(b.document.project());
  CHECK_FALSE(b.choose("unasked"));  // it is in a file already
  b.update();
  CHECK(b.document.project().footage.own_body_mask == "masks.png");
}

TEST_CASE("the proposed name is the project's mask, else one beside the project, else beside the footage") {
  MaskFixture b;
  b.update();
  b.session.ask_save_as(b.document.project());
  CHECK(b.proposed() == b.folder / "flight_own_body.png");
  Project project = b.document.project();
  project.footage.own_body_mask = "sub/m.png";
  CHECK(usual_mask_file(project) == b.folder / "sub/m.png");
  project.footage.own_body_mask = "m.jpg";  // what is written is a PNG
  CHECK(usual_mask_file(project) == b.folder / "flight_own_body.png");
  project.file.clear();
  project.footage.own_body_mask.clear();
  project.footage.video = "/clips/a.b.mp4";
  CHECK(usual_mask_file(project) == "/clips/a.b_own_body.png");
  CHECK(usual_mask_file(Project()).filename() == "untitled_own_body.png");
}

TEST_CASE("a new name is one that is not taken") {
  MaskFixture b("flight_own_body.png");
  for (const char* taken : {"flight_own_body.png", "flight_own_body_2.png"})
    REQUIRE(write_mask(disk(10), b.folder / taken, false));
  b.use_mask_of_scene(disk(10));
  b.update();
  b.stroke(30);
  b.session.ask_save_and_use(b.document.project());
  CHECK(b.proposed() == b.folder / "flight_own_body_3.png");
  b.session.ask_save_as(b.document.project());
  REQUIRE(b.choose(b.folder / "mine.png"));
  b.stroke(20);
  b.session.ask_save_and_use(b.document.project());
  CHECK(b.proposed() == b.folder / "mine.png");  // its own
}

TEST_CASE("the project's own file is replaced only by the call that says so") {
  MaskFixture b("mask.png");
  REQUIRE(write_mask(disk(10), b.folder / "mask.png", false));
  b.use_mask_of_scene(disk(10));
  b.update();
  CHECK_FALSE(b.session.could_replace(b.document.project()));  // nothing to write
  b.stroke(30);
  CHECK(b.session.could_replace(b.document.project()));
  b.session.use(b.document.project());
  CHECK_FALSE(b.proposed().empty());
  CHECK(is_same(cv::imread((b.folder / "mask.png").string(), cv::IMREAD_UNCHANGED), disk(10)));
  b.session.replace_and_use(b.document.project());
  b.update();
  CHECK(is_same(cv::imread((b.folder / "mask.png").string(), cv::IMREAD_UNCHANGED), b.session.painting().mask()));
  CHECK(b.session.is_used(b.document.project()));
  // The scene reads it anew: the same bytes, and no step is lost by it.
  b.use_mask_of_scene(b.session.painting().mask().clone());
  b.update();
  CHECK(b.session.painting().can_undo());
  b.session.painting().undo();
  CHECK(is_same(b.session.painting().mask(), disk(10)));
}

TEST_CASE("a mask that cannot be written neither counts as saved nor is used") {
  MaskFixture b;
  b.update();
  b.detect(10);
  b.session.use(b.document.project());
  REQUIRE(b.choose(b.folder / "nowhere/mask.png"));
  CHECK(b.errors().find("nowhere") != std::string::npos);
  CHECK(b.session.unsaved() != 0);
  b.update();
  CHECK(b.document.project().footage.own_body_mask.empty());
}

TEST_CASE("the project's mask is followed while nothing is unsaved, and never painted over otherwise") {
  MaskFixture b("mask.png");
  b.use_mask_of_scene(disk(10));
  b.update();
  b.use_mask_of_scene(disk(20));
  b.update();
  CHECK(is_same(b.session.painting().mask(), disk(20)));
  b.stroke(35);
  const cv::Mat painted = b.session.painting().mask().clone();
  b.use_mask_of_scene(disk(30));
  b.update();
  b.update();
  CHECK(is_same(b.session.painting().mask(), painted));
  CHECK(b.session.unsaved() != 0);
}

TEST_CASE("a stroke is not disturbed by results that arrive meanwhile") {
  MaskFixture b;
  b.update();
  b.session.painting().begin_stroke({3, 1}, {5, 5});
  b.detect(25);
  b.use_mask_of_scene(disk(10));
  b.update();
  CHECK(b.session.painting().is_stroking());
  b.session.painting().extend_stroke({20, 5});
  b.session.painting().end_stroke();
  b.update();
  CHECK(b.session.painting().mask().at<uchar>(5, 12) == 255);
  CHECK(b.session.painting().mask().at<uchar>(15, 25) == 0);
}

TEST_CASE("footage of another size begins anew, but not while something is unsaved") {
  MaskFixture b;
  b.update();
  b.scene.draft.scene.footage.size_px = {64, 48};
  b.update();
  CHECK(b.session.painting().mask().size() == cv::Size(64, 48));
  b.stroke(30);
  b.scene.draft.scene.footage.size_px = kSize;
  b.update();
  CHECK_FALSE(b.session.fits());
  CHECK(b.session.painting().mask().size() == cv::Size(64, 48));
  CHECK(b.session.unsaved() != 0);
  b.session.begin_anew();
  b.update();
  CHECK(b.session.fits());
  CHECK(b.session.unsaved() == 0);
}

TEST_CASE("results of other footage are discarded") {
  MaskFixture b;
  b.update();
  b.detect(10);
  b.document.apply(ChangeProject{"video", [](Project& p) { p.footage.video = "other.mp4"; }, {}});
  b.update();
  CHECK_FALSE(b.session.detection().value);
  CHECK(is_same(b.session.painting().mask(), disk(10)));
}

TEST_CASE("another project has nothing of the previous one") {
  MaskFixture b;
  b.update();
  b.detect(10);
  b.session.forget();
  CHECK(b.session.unsaved() == 0);
  CHECK(b.session.painting().empty());
  CHECK(b.session.file().empty());
  b.update();
  CHECK(cv::countNonZero(b.session.painting().mask()) == 0);
  CHECK_FALSE(b.session.found_waits());
}

TEST_CASE("painting can start from a file, whose size has to be the footage's") {
  MaskFixture b;
  b.update();
  REQUIRE(write_mask(disk(12), b.folder / "good.png", false));
  REQUIRE(write_mask(cv::Mat::zeros(5, 5, CV_8UC1), b.folder / "small.png", false));
  std::ofstream(b.folder / "no.png") << "no image";
  b.session.ask_start_from_file(b.document.project());
  REQUIRE(b.choose(b.folder / "good.png"));
  CHECK(is_same(b.session.painting().mask(), disk(12)));
  for (const char* file : {"small.png", "no.png", "nowhere.png"}) {
    b.session.ask_start_from_file(b.document.project());
    REQUIRE(b.choose(b.folder / file));
    CHECK(b.errors().find(file) != std::string::npos);
    CHECK(is_same(b.session.painting().mask(), disk(12)));
  }
  b.session.start_from_empty();
  CHECK(cv::countNonZero(b.session.painting().mask()) == 0);
  b.session.painting().undo();
  CHECK(is_same(b.session.painting().mask(), disk(12)));
}

TEST_CASE("clouds of a frame are a step of the painting, and a painting becomes the project's occluder of a frame") {
  MaskFixture b;
  b.update();
  b.session.start_from_clouds(disk(20));
  CHECK(is_same(b.session.painting().mask(), disk(20)));
  CHECK(b.session.painting().undo_name() == "clouds");
  b.session.start_from_clouds(cv::Mat::ones(3, 3, CV_8UC1));  // of another size
  CHECK(is_same(b.session.painting().mask(), disk(20)));
  b.document.apply(ChangeProject{"clouds", [](Project& p) { p.footage.cloud_distance_m = 900; }, {}});
  b.session.ask_use_as_occluder(b.document.project(), 17);
  REQUIRE(b.choose(b.folder / "clouds.png"));
  b.update();
  const FootageSettings& footage = b.document.project().footage;
  CHECK(footage.occluder_mask == "clouds.png");
  CHECK(footage.occluder_frame == 17);
  CHECK(footage.occluder_distance_m == 900);
  CHECK_FALSE(footage.cloud_distance_m);  // painted clouds take their place
  CHECK(footage.own_body_mask.empty());
  CHECK(b.session.mask_text(b.document.project()) == "clouds.png, the project's occluder");
  CHECK(is_same(cv::imread((b.folder / "clouds.png").string(), cv::IMREAD_UNCHANGED), disk(20)));
}
