// SPDX-License-Identifier: MIT
#include "evaluation/readers/clip_truth.h"

#include <doctest/doctest.h>

#include <fstream>

#include "base/staged_outputs.h"
#include "labels/formats.h"
#include "support/comma_locale.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

FootageTruth some_footage() {
  return {.video = "a <b> & \"c\".mp4",
          .size_px = {1280, 960},
          .first_frame = 7,
          .last_frame = 9,
          .frame_rate_num = 30000,
          .frame_rate_den = 1001};
}

FrameTruth some_frame(int index) {
  FrameTruth frame{.index = index, .time_s = index * 1001.0 / 30000};
  frame.intruders = {{.id = 0,
                      .name = "jet & co",
                      .position_m = {300, -40, 12.5},
                      .in_image = true,
                      .visible_fraction = 0.75,
                      .visible_box = cv::Rect(10 * index, 20, 31, 12),
                      .visible_pixels = 123,
                      .amodal_box = Box{10.0 * index - 0.625, 19.25, 32.5, 13.125},
                      .horizon = HorizonSide::below},
                     {.id = 1, .name = "glider", .position_m = {-3, 0, 4}, .horizon = HorizonSide::above}};
  return frame;
}

std::filesystem::path written(const TemporaryFolder& folder) {
  const std::filesystem::path path = folder / "truth.xml";
  Result<std::unique_ptr<LabelWriter>> writer = open_sigs_xml(path, {.footage = some_footage()});
  REQUIRE(writer);
  for (int index = 7; index <= 9; ++index) REQUIRE((*writer)->write(some_frame(index)));
  REQUIRE((*writer)->finish({}));
  return path;
}

std::string replaced(std::string text, const std::string& old_text, const std::string& new_text) {
  const std::size_t at = text.find(old_text);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old_text.size(), new_text);
}

void check_same(const TargetFrame& read, const TargetFrame& kept) {
  CHECK(read.visible == kept.visible);
  CHECK(read.amodal_box == kept.amodal_box);  // quarters and eighths: the file's four digits hold them
  CHECK(read.visible_fraction == kept.visible_fraction);
  CHECK(read.visible_pixels == kept.visible_pixels);
  CHECK(read.distance_m == doctest::Approx(kept.distance_m).epsilon(1e-8));  // the file has six digits
  CHECK(read.horizon == kept.horizon);
}

}  // namespace

TEST_CASE("the truth read from an annotation file is that of the frames it was written from") {
  const TemporaryFolder folder;
  const CommaLocale comma;
  const Result<ClipTruth> read = read_truth(written(folder));
  REQUIRE_MESSAGE(read, read.error().text());
  CHECK(read->footage.video == some_footage().video);
  CHECK(read->footage.size_px == cv::Size(1280, 960));
  CHECK(read->footage.first_frame == 7);
  CHECK(read->footage.last_frame == 9);
  CHECK(read->footage.frame_rate_num == 30000);
  CHECK(read->footage.frame_rate_den == 1001);

  ClipTruth kept{.footage = some_footage()};
  for (int index = 7; index <= 9; ++index) REQUIRE(add_frame(kept, some_frame(index)));
  REQUIRE(read->frames() == 3);
  REQUIRE(read->targets.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(read->targets[i].id == kept.targets[i].id);
    CHECK(read->targets[i].name == kept.targets[i].name);
    REQUIRE(read->targets[i].frames.size() == 3);
    for (std::size_t k = 0; k < 3; ++k) check_same(read->targets[i].frames[k], kept.targets[i].frames[k]);
  }
  for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(read->times_s[k] - kept.times_s[k]) < 0.51e-6);
}

TEST_CASE("a box of whole pixels has its edges half a pixel before its first column and row") {
  CHECK(box_of({0, 0, 1, 1}) == Box{-0.5, -0.5, 1, 1});
  const TargetFrame frame = target_frame_of(some_frame(7).intruders[0], {1, 0, 0, 0});
  CHECK(*frame.visible == Box{69.5, 19.5, 31, 12});
  CHECK(frame.distance_m == doctest::Approx(std::sqrt(300.0 * 300 + 40 * 40 + 12.5 * 12.5)).epsilon(1e-14));
  CHECK_FALSE(target_frame_of(some_frame(7).intruders[1], {1, 0, 0, 0}).visible);
  CHECK_FALSE(target_frame_of(some_frame(7).intruders[1], {1, 0, 0, 0}).amodal_box);
}

TEST_CASE("the annotation file of the documentation is read as documented") {
  const Result<std::string> page = read_text(source_dir() / "docs" / "annotation-format.md");
  REQUIRE(page);
  const std::size_t begin = page->find("<?xml");
  const std::size_t end = page->find("```", begin);
  REQUIRE(end != std::string::npos);
  const TemporaryFolder folder;
  // Its second frame is abridged there; completed here.
  const std::string text = replaced(page->substr(begin, end - begin), "last_frame=\"101\"", "last_frame=\"100\"");
  const std::size_t second = text.find("  <frame index=\"101\"");
  REQUIRE(write_text(folder / "doc.xml", text.substr(0, second) + "</sigs>\n", false));
  const Result<ClipTruth> clip = read_truth(folder / "doc.xml");
  REQUIRE_MESSAGE(clip, clip.error().text());
  REQUIRE(clip->targets.size() == 2);
  const TargetFrame& airliner = clip->targets[0].frames[0];
  CHECK(*airliner.visible == Box{300.5, 401.5, 41, 13});
  CHECK(*airliner.amodal_box == Box{300.6238, 401.8833, 41.0037, 13.0201});
  CHECK(airliner.visible_pixels == 287);
  CHECK(airliner.distance_m == 933.547347);
  CHECK(airliner.horizon == HorizonSide::above);
  CHECK(clip->targets[1].frames[0].horizon == HorizonSide::below);
  CHECK_FALSE(clip->targets[1].frames[0].visible);
}

TEST_CASE("an annotation file of an older sigs, and one with encounters, are read alike") {
  const TemporaryFolder folder;
  const std::string now = read_text(written(folder)).value();
  const std::string of_first = R"(visible_fraction="0.75" horizon="below">)";
  const std::string older = replaced(now, of_first, R"(visible_fraction="0.75">)");
  const std::string newer = replaced(now, "    </intruder>",
                                     R"(      <encounter range_rate_mps="-6" closing_speed_mps="6" bearing_deg="1" )"
                                     R"(elevation_deg="2" hmd_m="3" vmd_m="4" time_to_closest_approach_s="5">
        <well_clear volume="nmac" lost="false" severity="0" />
      </encounter>
    </intruder>)");
  REQUIRE(write_text(folder / "older.xml", older, false));
  REQUIRE(write_text(folder / "newer.xml", newer, false));
  const Result<ClipTruth> read = read_truth(folder / "truth.xml");
  const Result<ClipTruth> read_older = read_truth(folder / "older.xml");
  const Result<ClipTruth> read_newer = read_truth(folder / "newer.xml");
  REQUIRE(read);
  REQUIRE_MESSAGE(read_older, read_older.error().text());
  REQUIRE_MESSAGE(read_newer, read_newer.error().text());
  CHECK(read_older->targets[0].frames[0].horizon == HorizonSide::unknown);
  for (const Result<ClipTruth>* const other : {&read_older, &read_newer})
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t k = other == &read_older ? 1 : 0; k < 3; ++k)
        check_same((*other)->targets[i].frames[k], read->targets[i].frames[k]);
}

TEST_CASE("a distractor is no target, neither read nor composed, and does not take the place of one") {
  const TemporaryFolder folder;
  FrameTruth frame = some_frame(7);
  frame.intruders[0].is_distractor = true;
  ClipTruth composed{.footage = some_footage()};
  REQUIRE(add_frame(composed, frame));
  const std::filesystem::path path = folder / "truth.xml";
  Result<std::unique_ptr<LabelWriter>> writer = open_sigs_xml(path, {.footage = some_footage()});
  REQUIRE(writer);
  for (int index = 7; index <= 9; ++index) {
    FrameTruth next = some_frame(index);
    next.intruders[0].is_distractor = true;
    REQUIRE((*writer)->write(next));
  }
  REQUIRE((*writer)->finish({}));
  const Result<ClipTruth> read = read_truth(path);
  REQUIRE_MESSAGE(read, read.error().text());
  for (const ClipTruth* const clip : std::initializer_list<const ClipTruth*>{&composed, &*read}) {
    REQUIRE(clip->targets.size() == 1);
    CHECK(clip->targets[0].id == 1);
    CHECK(clip->targets[0].name == "glider");
  }
  const std::string decoy = replaced(read_text(path).value(), "role=\"distractor\"", "role=\"decoy\"");
  REQUIRE(write_text(path, decoy, true));
  const Result<ClipTruth> wrong = read_truth(path);
  REQUIRE(!wrong);
  CHECK(wrong.error().text().find("role") != std::string::npos);
}

TEST_CASE("an invalid annotation file is refused with its line") {
  const TemporaryFolder folder;
  const Result<std::string> good = read_text(written(folder));
  REQUIRE(good);
  const struct {
    const char* old_text;
    const char* new_text;
    const char* place;
    const char* what;
  } cases[] = {
      // Lines 1 and 2 are the head, 3 the footage, 4 frame 7, 6 its first intruder; 19 frame 8, 34 frame 9.
      {"version=\"1\">\n  <foo", "version=\"2\">\n  <foo", "truth.xml: is no SIGS", "<sigs version=\"1\">"},
      {"frame index=\"8\"", "frame index=\"9\"", "line 19", "frame 9 stands where frame 8 belongs"},
      {"frame index=\"8\"", "frame index=\"7\"", "line 19", "frame 7 stands where frame 8 belongs"},
      {"first_frame=\"7\"", "first_frame=\"6\"", "line 4", "frame 7 stands where frame 6 belongs"},
      {"last_frame=\"9\"", "last_frame=\"8\"", "line 34", "frame 9 is past the footage's last_frame, 8"},
      {"last_frame=\"9\"", "last_frame=\"10\"", "line 34", "ends before frame 10"},
      {"last_frame=\"9\"", "last_frame=\"99\"", "line 34", "ends before frame 10"},
      {"last_frame=\"9\"", "last_frame=\"2000000000\"", "line 34", "ends before frame 10"},
      {"last_frame=\"9\"", "last_frame=\"6\"", "line 3", "before its first_frame"},
      {"width=\"1280\"", "width=\"0\"", "line 3", "footage width: '0' is no whole number from 1 to"},
      {"frame_rate=\"30000/1001\"", "frame_rate=\"30000/0\"", "line 3", "frame_rate: '30000/0' is no ratio"},
      {"time_s=\"0.233567\"", "time_s=\"nan\"", "line 4", "time_s: 'nan' is no number"},
      {"time_s=\"0.233567\"", "time_s=\"0,23\"", "line 4", "time_s: '0,23' is no number"},
      {"time_s=\"0.233567\"", "", "line 4", "frame has no attribute time_s"},
      {"width=\"31\"", "width=\"0\"", "line 10", "box width: '0' is no whole number from 1"},
      {"x=\"70\"", "x=\"70.5\"", "line 10", "box x: '70.5' is no whole number"},
      {"x=\"70\"", "x=\"9999999999999\"", "line 10", "box x: '9999999999999' is no whole number"},
      {"width=\"32.5\"", "width=\"-1\"", "line 11", "silhouette width and height must not be negative"},
      {"width=\"32.5\"", "width=\"1e200\"", "line 11", "silhouette reaches beyond 1e100 pixels"},
      {"horizon=\"below\"", "horizon=\"under\"", "line 6", "intruder horizon: 'under' is not above, on or below"},
      {"<distance m", "<distanz m", "line 6", "intruder has no element distance"},
      {"intruder id=\"1\"", "intruder id=\"0\"", "line 4", "intruder 0 stands behind intruder 0"},
      {"</frame>\n  <frame index=\"8\"", "</frame>\n  <frame index=\"8\"></frame><frame index=\"8\"", "line 19",
       "frame has no attribute time_s"},
      {"</frame>\n  <frame index=\"8\"", "</frame>\n  <frame index=\"8\" time_s=\"1\"></frame><frame index=\"8\"",
       "line 19", "frame 8 has 0 intruders, the frames before it 2"},
      {"</sigs>", "", "line", "is not XML from here on"},
  };
  for (const auto& wrong : cases) {
    CAPTURE(wrong.new_text);
    REQUIRE(write_text(folder / "truth.xml", replaced(*good, wrong.old_text, wrong.new_text), true));
    const Result<ClipTruth> read = read_truth(folder / "truth.xml");
    REQUIRE_FALSE(read);
    CAPTURE(read.error().text());
    CHECK(read.error().kind == ErrorKind::bad_data);
    CHECK(read.error().text().find("truth.xml: ") != std::string::npos);
    CHECK(read.error().text().find(wrong.place) != std::string::npos);
    CHECK(read.error().text().find(wrong.what) != std::string::npos);
    CHECK(read.error().text().find('\n') == std::string::npos);
  }
  CHECK(read_truth(folder / "none.xml").error().kind == ErrorKind::cannot_read);
}

TEST_CASE("the intruders of a frame are those of the frames before it") {
  ClipTruth clip{.footage = some_footage()};
  REQUIRE(add_frame(clip, some_frame(7)));
  FrameTruth other = some_frame(8);
  other.intruders[1].id = 5;
  const Result<void> added = add_frame(clip, other);
  REQUIRE_FALSE(added);
  CHECK(added.error().what == "frame 8 has intruder 5 where the frames before it have 1");
  CHECK(clip.frames() == 1);  // and nothing of it has been kept
  CHECK(clip.targets[0].frames.size() == 1);
  CHECK_FALSE(add_frame(clip, some_frame(9)));
  CHECK_FALSE(add_frame(clip, some_frame(7)));
  CHECK(add_frame(clip, some_frame(8)));
}

TEST_CASE("a clip without an intruder has truth all the same") {
  ClipTruth clip{.footage = some_footage()};
  REQUIRE(add_frame(clip, FrameTruth{.index = 7}));
  REQUIRE(add_frame(clip, FrameTruth{.index = 8, .time_s = 0.1}));
  CHECK(clip.frames() == 2);
  CHECK(clip.targets.empty());
}

}  // namespace sigs::test
