// SPDX-License-Identifier: MIT
#include "evaluation/readers/truth_files.h"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <string>

#include "evaluation/metrics/track_score.h"
#include "evaluation/readers/results.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

struct Sequences {
  TemporaryFolder folder;

  fs::path put(const std::string& name, const std::string& text) const {
    fs::create_directories((folder / name).parent_path());
    write_file(folder / name, text);
    return (folder / name).parent_path();
  }
};

SequenceTruth read_good(const fs::path& folder) {
  Result<SequenceTruth> sequence = read_sequence_truth(folder);
  REQUIRE_MESSAGE(sequence, sequence.error().text());
  return *sequence;
}

void check_wrong(const fs::path& folder, const std::string& part) {
  const Result<SequenceTruth> sequence = read_sequence_truth(folder);
  REQUIRE_FALSE(sequence);
  const std::string text = sequence.error().text();
  CHECK_MESSAGE(text.find(part) != std::string::npos, text);
}

}  // namespace

TEST_CASE("boxes of otb count from 1, those of vot from 0, and a target without box is absent") {
  const Sequences sequences;
  const fs::path otb =
      sequences.put("otb/groundtruth_rect.txt", "11\t6\t20\t10\r\n0,0,0,0\nNaN,NaN,NaN,NaN\n12,6,20,10\n");
  const fs::path vot = sequences.put("vot/groundtruth.txt", "10,5,20,10\nnan\nnan,nan,nan,nan\n11.0,5,20,10\n");
  CHECK(is_sequence_folder(otb));
  CHECK(is_sequence_folder(vot));
  CHECK_FALSE(is_sequence_folder(sequences.folder.path()));
  CHECK(sequences_in(sequences.folder.path()).size() == 2);
  for (const fs::path& folder : {otb, vot}) {
    const SequenceTruth sequence = read_good(folder);
    CHECK(sequence.name == folder.filename());
    REQUIRE(sequence.truth.frames() == 4);
    REQUIRE(sequence.truth.targets.size() == 1);
    const std::vector<TargetFrame>& frames = sequence.truth.targets[0].frames;
    CHECK(*frames[0].visible == Box{9.5, 4.5, 20, 10});
    CHECK_FALSE(frames[1].visible);
    CHECK_FALSE(frames[2].visible);
    CHECK(*frames[3].visible == Box{10.5, 4.5, 20, 10});
    CHECK(std::isnan(frames[0].distance_m));
    CHECK(std::isnan(sequence.truth.times_s[3]));
    CHECK(sequence.images.empty());
  }
}

TEST_CASE("the box of a polygon is its bounding rectangle, as OpenCV finds it") {
  const Sequences sequences;
  const std::vector<cv::Point2f> corners{{30.25F, 10.5F}, {50, 14.75F}, {47.5F, 40}, {28, 36.25F}};
  std::string line;
  for (const cv::Point2f& corner : corners)
    line += (line.empty() ? "" : ",") + std::to_string(corner.x) + "," + std::to_string(corner.y);
  const Box box = *read_good(sequences.put("p/groundtruth.txt", line + "\n")).truth.targets[0].frames[0].visible;
  // OpenCV's rectangle is of whole pixels: all that the corners touch.
  const cv::Rect bounds = cv::boundingRect(corners);
  CHECK(std::floor(box.x + 0.5) == bounds.x);
  CHECK(std::floor(box.y + 0.5) == bounds.y);
  CHECK(std::floor(box.x + 0.5 + box.width) + 1 == bounds.x + bounds.width);
  CHECK(std::floor(box.y + 0.5 + box.height) + 1 == bounds.y + bounds.height);
  CHECK(box == Box{27.5, 10, 22, 29.5});
}

TEST_CASE("several files of boxes are several targets, and properties of vot are read") {
  const Sequences sequences;
  sequences.put("two/groundtruth_rect.1.txt", "1,1,5,5\n2,1,5,5\n");
  const SequenceTruth two = read_good(sequences.put("two/groundtruth_rect.2.txt", "9,9,5,5\n9,9,5,5\n"));
  REQUIRE(two.truth.targets.size() == 2);
  CHECK(two.truth.targets[1].id == 1);
  sequences.put("vot/sequence", "name=x\nfps=10\nwidth=640\n");
  sequences.put("vot/visible_fraction.value", "1\n0.25\n");
  sequences.put("vot/distance_m.value", "310.5\n300\n");
  sequences.put("vot/color/00000001.png", "");
  const SequenceTruth vot = read_good(sequences.put("vot/groundtruth.txt", "1,1,5,5\n2,1,5,5\n"));
  CHECK(vot.truth.times_s[1] == doctest::Approx(0.1));
  CHECK(vot.truth.targets[0].frames[1].visible_fraction == 0.25);
  CHECK(vot.truth.targets[0].frames[0].distance_m == 310.5);
  CHECK(vot.images.filename() == "color");
  sequences.put("video/video.mp4", "");
  CHECK(read_good(sequences.put("video/groundtruth.txt", "1,1,5,5\n")).images.filename() == "video.mp4");
}

TEST_CASE("a truth of otb read as the results of a tracker follows itself without error") {
  const Sequences sequences;
  const fs::path folder = sequences.put("s/groundtruth_rect.txt", "11,6,20,10\n12,6,20,10\n14,7,21,10\n");
  const SequenceTruth sequence = read_good(folder);
  const Result<Results> results =
      read_results(folder / "groundtruth_rect.txt", sequence.truth.footage, {.format = ResultsFormat::otb});
  REQUIRE_MESSAGE(results, results.error().text());
  const TrackScore score = score_track(sequence.truth, sequence.truth.targets[0], *results, {});
  CHECK(score.scored == 3);
  CHECK(score.mean_center_error_px == 0);
  CHECK(score.mean_overlap == 1);
}

TEST_CASE("a sequence that is wrong is refused with file and line") {
  const Sequences sequences;
  const auto otb = [&](const std::string& text, const std::string& part) {
    check_wrong(sequences.put("s/groundtruth_rect.txt", text), part);
  };
  otb("", "groundtruth_rect.txt: has no line");
  otb("1,2,3\n", "line 1: has 3 numbers; a box has 4");
  otb("1,2,3,4\n1,2,x,4\n", "line 2: 'x' is no number");
  otb("1,2,-3,4\n", "line 1: width and height must not be negative");
  otb("1,2,nan,4\n", "line 1: has a number that is NaN");
  otb("1,2,inf,4\n", "line 1: has a number that is NaN or beyond");
  otb("1,2,3,4,5,6,7,8\n", "line 1: has 8 numbers");
  check_wrong(sequences.put("v/groundtruth.txt", "m1,2,3,4,5,6\n"), "line 1: is a mask in VOT's encoding");
  sequences.put("w/distance_m.value", "1\n2\n");
  check_wrong(sequences.put("w/groundtruth.txt", "1,2,3,4\n"), "distance_m.value: has 2 lines, groundtruth.txt has 1");
  sequences.put("t/groundtruth_rect.1.txt", "1,1,5,5\n");
  check_wrong(sequences.put("t/groundtruth_rect.2.txt", "1,1,5,5\n1,1,5,5\n"), "2.txt: has 2 lines");
  sequences.put("f/sequence", "fps=-1\n");
  check_wrong(sequences.put("f/groundtruth.txt", "1,2,3,4\n"), "sequence: line 1: fps is no rate");
}

}  // namespace sigs::test
