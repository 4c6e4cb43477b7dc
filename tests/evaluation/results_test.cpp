// SPDX-License-Identifier: MIT
#include "evaluation/readers/results.h"

#include <doctest/doctest.h>

#include <cmath>

#include "base/staged_outputs.h"
#include "evaluation/clips.h"
#include "support/comma_locale.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

Result<Results> read(const std::string& text, const std::string& name = "tracker.txt",
                     const ResultsOptions& options = {}, const FootageTruth& clip = three_frames()) {
  const TemporaryFolder folder;
  REQUIRE(write_text(folder / name, text, false));
  return read_results(folder / name, clip, options);
}

Results good(const std::string& text, const std::string& name = "tracker.txt", const ResultsOptions& options = {},
             const FootageTruth& clip = three_frames()) {
  Result<Results> results = read(text, name, options, clip);
  REQUIRE_MESSAGE(results, results.error().text());
  return *results;
}

Box box_at(const Results& results, int frame) {
  const ReportedBox* best = results.best_at(frame);
  REQUIRE(best != nullptr);
  return best->box;
}

// Columns 10 to 19 and rows 20 to 24, counted from 0.
const Box kReportedBox{9.5, 19.5, 10, 5};

}  // namespace

TEST_CASE("each layout's way to say columns 10 to 19 and rows 20 to 24 gives the same box") {
  const struct {
    const char* name;
    const char* text;
  } files[] = {
      {"otb.txt", "11,21,10,5\n11,21,10,5\n11,21,10,5\n"},
      {"otb_tabs.txt", "11\t21\t10\t5\n11\t21\t10\t5\n11\t21\t10\t5"},
      {"otb_blanks.txt", "11 21  10 5 \n 11 21 10 5\n1.1e1 +21.0 10.0 .5e1\n"},
      {"otb_trailing.txt", "11,21,10,5,\n11 , 21 , 10 , 5\n11,21,10,5\n\n\n"},
      {"otb_windows.txt",
       "\xEF\xBB\xBF"
       "11,21,10,5\r\n11,21,10,5\r\n11,21,10,5\r\n"},
      {"otb_comment.txt", "# by hand\n11,21,10,5\n# half way\n11,21,10,5\n11,21,10,5\n"},
      {"groundtruth.txt", "10,20,10,5\n10,20,10,5\n10,20,10,5\n"},
      {"polygon.txt", "10,20,20,20,20,25,10,25\n15,20,20,22,15,25,10,22\n20,25,20,20,10,20,10,25\n"},
      {"mot.txt", "1,7,11,21,10,5,0.5,-1,-1,-1\n2,7,11,21,10,5,0.5,-1,-1,-1\n3,7,11,21,10,5,0.5,-1,-1,-1\n"},
      {"mot6.txt", "1,7,11,21,10,5\n3,7,11,21,10,5\n2,7,11,21,10,5\n"},
      {"numpy.txt", "1.0e+00 7.0e+00 1.1e+01 2.1e+01 1.0e+01 5.0e+00\n2 7 11 21 10 5\n3 7 11 21 10 5\n"},
      {"table.csv", "frame,x,y,width,height\n100,10,20,10,5\n101,10,20,10,5\n102,10,20,10,5\n"},
      {"mixed.csv", "name, height,\"x\",y,width,frame\n\"a, b\",5,10,20,10,102\n,5,10,20,10,101\nc,5,10,20,10,100,\n"},
      {"aot.json",
       "[{\"img_name\": \"frame_000100.png\", \"detections\": [{\"x\": 15, \"y\": 22.5, \"w\": 10, \"h\": 5}]},\n"
       "{\"detections\": [{\"x\": 15, \"y\": 22.5, \"w\": 10, \"h\": 5}], \"img_name\": \"flight "
       "7/frame_000101.png\"},\n"
       "{\"img_name\": \"102.jpg\", \"more\": [1, {\"x\": 3}], \"detections\": [{\"k\": {\"x\": [7]}, \"n\": "
       "\"airborne\","
       " \"track_id\": 3, \"x\": 15, \"y\": 22.5, \"w\": 10.0, \"h\": 5e0, \"s\": 0.25}]}]"},
      {"coco.json",
       R"([{"image_id": 1, "category_id": 1, "bbox": [10, 20, 10, 5], "score": 0.5},
           {"segmentation": {"size": [960, 1280], "counts": "x", "more": [{"bbox": 3}]}, "bbox": [10.0, 2e1, 10, 5],
            "score": 1, "image_id": 2, "area": null, "id": "a"},
           {"image_id": 3, "bbox": [10, 20, 10, 5]}])"},
      {"ultralytics.json",
       R"([{"image_id": "frame_000100", "category_id": 1, "bbox": [10, 20, 10, 5], "score": 0.5},
           {"image_id": "clip/frame_000101.png", "bbox": [10, 20, 10, 5], "score": 0.5},
           {"image_id": "102", "bbox": [10, 20, 10, 5], "score": 0.5}])"},
  };
  for (const auto& file : files) {
    CAPTURE(std::string(file.name));
    const CommaLocale comma;
    const Results results = good(file.text, file.name);
    CHECK(results.frames.size() == 3);
    for (int frame = 100; frame <= 102; ++frame) CHECK(box_at(results, frame) == kReportedBox);
    CHECK(results.name + std::filesystem::path(file.name).extension().string() == file.name);
  }
}

TEST_CASE("scores, tracks and lines are those of the file") {
  const Results mot = good(
      "1,7,11,21,10,5,0.5,-1\n# a "
      "note\n1,9,31,21,10,5,0.75,-1\n2,-1,1,1,1,1,-1,-1\n2,-2,1,1,1,1,-1,-1\n2,-2,1,1,1,1,-1,-1\n",
      "mot.txt", {.format = ResultsFormat::mot, .multiple_per_frame = true});
  REQUIRE(mot.frames.at(100).size() == 2);
  CHECK(mot.frames.at(100)[0].track == 7);
  CHECK(mot.frames.at(100)[0].score == 0.5);
  CHECK(mot.frames.at(100)[1].line == 3);
  CHECK(mot.best_at(100)->track == 9);
  for (const ReportedBox& box : mot.frames.at(101)) CHECK(box.track == kNoTrack);
  CHECK(mot.frames.at(101).size() == 3);
  CHECK(mot.frames.at(101)[0].score == 1);  // -1: not given
  CHECK(mot.best_at(102) == nullptr);

  const Results csv = good("frame,x,y,width,height,score,track\n100,1,1,1,1,0.125,4\n", "a.csv");
  CHECK(csv.best_at(100)->score == 0.125);
  CHECK(csv.best_at(100)->track == 4);
  CHECK(good("frame,x,y,width,height\n100,1,1,1,1\n", "a.csv").best_at(100)->track == kNoTrack);

  const Results aot = good(
      "[\n{\"img_name\": \"100\", \"detections\": [\n{\"x\": 1, \"y\": 1, \"w\": 1, \"h\": 1, \"s\": 0.5},\n"
      "{\"x\": 1, \"y\": 1, \"w\": 1, \"h\": 1, \"object_id\": 8}]}]",
      "a.json", {.multiple_per_frame = true});
  REQUIRE(aot.frames.at(100).size() == 2);
  CHECK(aot.frames.at(100)[0].score == 0.5);
  CHECK(aot.frames.at(100)[0].track == kNoTrack);
  CHECK(aot.frames.at(100)[0].line == 3);
  CHECK(aot.frames.at(100)[1].score == 1);
  CHECK(aot.frames.at(100)[1].track == 8);
  CHECK(aot.frames.at(100)[1].line == 4);
}

TEST_CASE("of equal scores the first is the best") {
  Results results;
  results.frames[3] = {{.score = 0.5, .track = 1}, {.score = 0.75, .track = 2}, {.score = 0.75, .track = 3}};
  results.frames[4] = {};
  CHECK(results.best_at(3)->track == 2);
  CHECK(results.best_at(4) == nullptr);
  CHECK(results.best_at(5) == nullptr);
}

TEST_CASE("VOT's special lines report no box, and 1 marks an initialization") {
  const FootageTruth clip{.first_frame = 0, .last_frame = 6};
  const Results results = good("1\n10,20,10,5\n2\n0\n1\nnan,nan,nan,nan\nnan\n", "run.txt", {}, clip);
  CHECK(results.frames.size() == 1);
  CHECK(box_at(results, 1) == kReportedBox);
  CHECK(results.initializations == std::set<int>{0, 4});
  // Absent in the first frame already: still recognized as VOT's.
  CHECK(good("nan,nan,nan,nan\nnan,nan,nan,nan\n10,20,10,5\n").frames.size() == 1);
}

TEST_CASE("a file with a line a frame may begin where the tracker was started") {
  const FootageTruth clip{.first_frame = 10, .last_frame = 19};
  std::string six;
  for (int i = 0; i < 6; ++i) six += std::to_string(i + 1) + ",1,9,9\n";
  const Results late = good(six, "late.txt", {.start_frame = 14}, clip);
  CHECK(late.frames.size() == 6);
  CHECK(box_at(late, 14).x == -0.5);
  CHECK(box_at(late, 19).x == 4.5);
  // All ten lines belong to all ten frames, wherever the start is.
  const Results whole = good(six + "7,1,9,9\n8,1,9,9\n9,1,9,9\n10,1,9,9\n", "whole.txt", {.start_frame = 14}, clip);
  CHECK(box_at(whole, 10).x == -0.5);
  CHECK(whole.frames.size() == 10);
  const Result<Results> neither = read(six + "7,1,9,9\n", "odd.txt", {.start_frame = 14}, clip);
  REQUIRE_FALSE(neither);
  CHECK(neither.error().what ==
        "ends here with 7 lines, one a frame; it must have 10 (frames 10 to 19), or 6 (from frame 14 on)");
}

TEST_CASE("one coco file covers several clips by the number of their first image") {
  const std::string text = R"([{"image_id": 3, "bbox": [1, 1, 1, 1]}, {"image_id": 4, "bbox": [10, 20, 10, 5]},
      {"image_id": 4, "bbox": [40, 20, 10, 5], "score": 0.5}, {"image_id": 6, "bbox": [10, 20, 10, 5]},
      {"image_id": 7, "bbox": [1, 1, 1, 1]}])";
  const ResultsOptions second{.multiple_per_frame = true, .first_image_id = 4, .last_image_id = 9};
  const Results results = good(text, "a.json", second);
  CHECK(results.frames.size() == 2);
  CHECK(results.frames.at(100).size() == 2);
  CHECK(box_at(results, 100) == kReportedBox);
  CHECK(box_at(results, 102) == kReportedBox);

  const Result<Results> beyond =
      read(text, "a.json", {.multiple_per_frame = true, .first_image_id = 4, .last_image_id = 6});
  REQUIRE_FALSE(beyond);
  CHECK(beyond.error().text().find("image_id 7 is past the last one, 6") != std::string::npos);
  const Result<Results> named = read(R"([{"image_id": "frame_000100", "bbox": [1, 1, 1, 1]}])", "a.json", second);
  REQUIRE_FALSE(named);
  CHECK(named.error().text().find("does not say of which clip") != std::string::npos);
  const Result<Results> other = read("[{\"img_name\": \"100\"}]", "a.json", second);
  REQUIRE_FALSE(other);
  CHECK(other.error().text().find("coco") != std::string::npos);
}

TEST_CASE("the files of a detector without detections are not errors") {
  CHECK(good("frame,x,y,width,height\n", "none.csv").frames.empty());
  CHECK(good("[]", "none.json").frames.empty());
  CHECK(good("[{\"img_name\": \"frame_000101.png\", \"detections\": []}]", "none.json").frames.empty());
}

TEST_CASE("a stated format is used without detection") {
  const ResultsOptions vot{.format = ResultsFormat::vot};
  CHECK(box_at(good("10,20,10,5\n10,20,10,5\n10,20,10,5\n", "a.txt", vot), 100) == kReportedBox);
  const ResultsOptions mot{.format = ResultsFormat::mot};
  CHECK(box_at(good("1,7,11,21,10,5,1,1\n", "a.txt", mot), 100) == kReportedBox);
  const ResultsOptions csv{.format = ResultsFormat::csv};
  CHECK(box_at(good("frame,x,y,width,height\n100,10,20,10,5\n", "a.txt", csv), 100) == kReportedBox);
  CHECK_FALSE(read("10,20,10,5\n", "a.csv", csv));
  CHECK(results_format_names().size() == 7);
  CHECK(results_format_names()[static_cast<std::size_t>(ResultsFormat::aot)] == "aot");
  CHECK(results_format_names()[static_cast<std::size_t>(ResultsFormat::coco)] == "coco");
  CHECK(results_format_names()[static_cast<std::size_t>(ResultsFormat::automatic)] == "auto");
}

TEST_CASE("numbers keep their last digit whatever the layout") {
  const double x = 123.45678901234567;
  const Results results = good("frame,x,y,width,height\n100,123.45678901234567,-1e3,0.001,1e6\n", "a.csv");
  CHECK(box_at(results, 100) == Box{x - 0.5, -1000.5, 0.001, 1e6});
}

TEST_CASE("three hundred thousand lines are all read") {
  constexpr int kFrames = 100'000;
  std::string text;
  for (int frame = 1; frame <= kFrames; ++frame)
    for (int id = 0; id < 3; ++id)
      text += std::to_string(frame) + "," + std::to_string(id) + ",11,21,10,5,0.5,-1,-1,-1\n";
  const Results results =
      good(text, "many.txt", {.multiple_per_frame = true}, {.first_frame = 0, .last_frame = kFrames - 1});
  REQUIRE(results.frames.size() == kFrames);
  CHECK(results.frames.at(kFrames - 1)[2].line == 3 * kFrames);
}

TEST_CASE("written results are read back unchanged") {
  Results written{.name = "mine"};
  report(written, 3, {0.1, -7.25, 1.0 / 3, 20}, 0, 0.75);
  report(written, 3, {5.5, 6.5, 7, 8}, 4, -2);
  report(written, 9, {1e6, 2e-3, 1e-9, 400}, kNoTrack);
  const TemporaryFolder folder;
  REQUIRE(write_text(folder / "mine.csv", csv_text(written), false).has_value());
  const FootageTruth clip{.size_px = {640, 480}, .last_frame = 9};
  const Result<Results> read = read_results(folder / "mine.csv", clip, {.multiple_per_frame = true});
  REQUIRE_MESSAGE(read.has_value(), read.error().text());
  CHECK(read->name == "mine");
  REQUIRE(read->frames.size() == 2);
  for (const auto& [frame, boxes] : written.frames) {
    REQUIRE(read->frames.at(frame).size() == boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const ReportedBox& back = read->frames.at(frame)[i];
      // The file's x is the edge and half a pixel: a rounding each way.
      CHECK(back.box.x == doctest::Approx(boxes[i].box.x).epsilon(1e-12));
      CHECK(back.box.y == doctest::Approx(boxes[i].box.y).epsilon(1e-12));
      CHECK(back.box.width == boxes[i].box.width);
      CHECK(back.box.height == boxes[i].box.height);
      CHECK(back.score == boxes[i].score);
      CHECK(back.track == boxes[i].track);
    }
  }
}

TEST_CASE("results without a box are a header alone") {
  CHECK(csv_text({.name = "silent"}) == "frame,x,y,width,height,score,track\n");
}

}  // namespace sigs::test
