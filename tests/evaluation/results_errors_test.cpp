// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include "base/staged_outputs.h"
#include "evaluation/clips.h"
#include "evaluation/readers/results.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

// Frames 100 to 102.
struct BadFile {
  const char* name;
  std::string text;
  const char* place;  // behind the file's name
  const char* what;
  bool multiple_per_frame = false;
};

void check_refused(const BadFile& file) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / file.name;
  REQUIRE(write_text(path, file.text, false));
  const Result<Results> results = read_results(path, three_frames(), {.multiple_per_frame = file.multiple_per_frame});
  CAPTURE(file.text.substr(0, 200));
  REQUIRE_FALSE(results);
  const std::string text = results.error().text();
  CAPTURE(text);
  CHECK(results.error().kind == ErrorKind::bad_data);
  CHECK(text.starts_with(path.string() + ": " + file.place));
  CHECK(text.find(file.what) != std::string::npos);
  CHECK(text.find('\n') == std::string::npos);
  CHECK(text.size() < path.string().size() + 250);
}

std::string aot(const std::string& detection, const std::string& image = "frame_000100.png") {
  return "[\n {\"img_name\": \"" + image + "\",\n  \"detections\": [\n   " + detection + "\n  ]}\n]\n";
}

}  // namespace

TEST_CASE("a file whose lines do not match the clip's frames is refused with the line") {
  check_refused(
      {"a.txt", "1,1,2,2\n1,1,2,2\n", "line 2: ", "2 lines, one a frame; it must have 3 (frames 100 to 102)"});
  check_refused({"a.txt", "1,1,2,2\n1,1,2,2\n1,1,2,2\n1,1,2,2\n1,1,2,2\n",
                 "line 4: ", "past the clip's end: the file has 5 lines"});
  check_refused({"a.txt", "1\n0\n", "line 2: ", "2 lines, one a frame; it must have 3"});
  check_refused({"a.txt", "1,1,2,2\n\n1,1,2,2\n", "line 2: ", "is empty amid lines"});
  // An error in a line is reported before an excess of lines.
  check_refused({"a.txt", "1,1,2,2\n1,x,2,2\n", "line 2: ", "'x' is no number"});
}

TEST_CASE("frames that the clip does not have are refused with the line") {
  check_refused({"a.txt", "1,1,1,1,2,2\n4,1,1,1,2,2\n",
                 "line 2: ", "frame 4 is past the clip's end: it has 3 frames, counted from 1"});
  check_refused({"a.txt", "0,1,1,1,2,2\n", "line 1: ", "frame '0' is no whole number from 1"});
  check_refused({"a.txt", "1.5,1,1,1,2,2\n", "line 1: ", "frame '1.5' is no whole number"});
  check_refused({"a.txt", "99999999999,1,1,1,2,2\n", "line 1: ", "frame '99999999999' is no whole number"});
  check_refused({"a.csv", "frame,x,y,width,height\n103,1,1,2,2\n",
                 "line 2: ", "frame 103 of the footage is not of this clip, which is frames 100 to 102"});
  check_refused({"a.csv", "frame,x,y,width,height\n99,1,1,2,2\n", "line 2: ", "frame 99"});
  check_refused(
      {"a.json", aot("{\"x\": 1, \"y\": 1, \"w\": 2, \"h\": 2}", "frame_000103.png"), "line 4: ", "frame 103"});
  check_refused(
      {"a.json", aot("", "15680d9b.png"), "line 2: ", "img_name '15680d9b.png' does not end with a frame number"});
  check_refused({"a.json", aot("", "1568151307970878896.png"), "line 2: ", "does not end with a frame number"});
}

TEST_CASE("invalid boxes are refused with the line") {
  check_refused({"a.txt", "1,1,2,2\nnan,1,2,2\n1,1,2,2\n", "line 2: ", "x is NaN"});
  check_refused({"a.txt", "1,1,2,2\nNaN,NaN,NaN,NaN\n1,1,2,2\n", "line 2: ", "write nan alone on its line (vot)"});
  check_refused({"a.txt", "1\nnan,1,2,2\n1,1,2,2\n", "line 2: ", "x is NaN"});
  check_refused({"a.txt", "1\n1,2,3,4,nan,6,7,8\n1,1,2,2\n", "line 2: ", "x is NaN"});
  check_refused({"a.txt", "1,1,2,2\n1,1,inf,2\n1,1,2,2\n", "line 2: ", "width is infinite"});
  check_refused({"a.txt", "1,1,2,2\n1,1,2,0\n1,1,2,2\n", "line 2: ",
                 "the box is 2 wide and 0 high: both must be more than 0; where nothing is reported, leave out"});
  check_refused({"a.txt", "1,1,2,2\n1,1,-2,2\n1,1,2,2\n", "line 2: ", "-2 wide"});
  check_refused({"a.txt", "1,1,2,2\n0,0,0,0\n1,1,2,2\n", "line 2: ", "0 wide"});
  check_refused({"a.txt", "1\n5,5,5,5,5,5,5,5\n0\n", "line 2: ", "0 wide"});
  check_refused({"a.txt", "1,1,2,2\n1,1e300,2,2\n1,1,2,2\n", "line 2: ", "y is beyond a billion pixels"});
  check_refused({"a.txt", "1,1,2,2\n1,1e999,2,2\n1,1,2,2\n", "line 2: ", "'1e999' is no number"});
  check_refused({"a.txt", "1,1,1,1,2,nan,1\n", "line 1: ", "height is NaN"});
  check_refused({"a.txt", "1,1,1,1,2,2,nan\n", "line 1: ", "score is NaN"});
  check_refused({"a.csv", "frame,x,y,width,height,score\n100,1,1,0,2,1\n", "line 2: ", "0 wide"});
  check_refused({"a.csv", "frame,x,y,width,height,score\n100,1,1,1,2,inf\n", "line 2: ", "score is infinite"});
  check_refused({"a.csv", "frame,x,y,width,height\n100,1,,2,2\n", "line 2: ", "y '' is no number"});
  check_refused({"a.json", aot("{\"x\": 1, \"y\": 1, \"w\": 0, \"h\": 2}"), "line 4: ", "0 wide"});
  check_refused(
      {"a.json", aot("{\"x\": 1, \"y\": NaN, \"w\": 1, \"h\": 2}"), "line 4: ", "is not JSON from here on, at"});
  check_refused({"a.json", aot("{\"x\": 1, \"y\": 1e999, \"w\": 1, \"h\": 2}"),
                 "line 4: ", "is not JSON from here on, at '1e999'"});
  check_refused({"a.json", aot("{\"x\": 1, \"y\": null, \"w\": 1, \"h\": 2}"), "line 4: ", "y is null, not a number"});
  check_refused({"a.json", aot("{\"x\": 1, \"y\": \"1\", \"w\": 1, \"h\": 2}"), "line 4: ", "y is text, not a number"});
  check_refused({"a.json", aot("{\"x\": 1, \"y\": 1, \"h\": 2}"), "line 4: ", "has no w"});
  // A file of one line gives the entry.
  const std::string good = "{\"x\": 1, \"y\": 1, \"w\": 2, \"h\": 2}";
  const std::string start = "[{\"img_name\": \"100\"}, {\"img_name\": \"101\", \"detections\": [" + good + ", ";
  check_refused(
      {"a.json", start + "{\"x\": 1, \"y\": 1, \"h\": 2}]}]\n", "line 1, [1].detections[1]: ", "has no w", true});
  check_refused(
      {"a.json", start + "{\"x\": 1, \"y\": 1, \"w\": 0, \"h\": 2}]}]", "line 1, [1].detections[1]: ", "0 wide", true});
  check_refused({"a.json", start + "{\"x\": \"1\"}]}]", "line 1, [1].detections[1]: ", "x is text", true});
  check_refused({"a.json", "[{\"img_name\": \"100\"}, {}]", "line 1, [1]: ", "has no img_name"});
}

TEST_CASE("the same id twice in a frame, or a second box of a tracker, is refused with both lines") {
  const std::string twice = "1,7,1,1,2,2\n1,8,1,1,2,2\n2,7,1,1,2,2\n1,7,1,1,2,2\n";
  check_refused(
      {"a.txt", twice, "line 4: ", "id 7 a second time in frame 1 (100 of the footage), first in line 1", true});
  check_refused({"a.txt", twice, "line 2: ",
                 "a second box for frame 1 (100 of the footage), first in line 1: a tracker reports one a frame"});
  check_refused({"a.csv", "frame,x,y,width,height,track\n100,1,1,2,2,3\n100,1,1,2,2,3\n",
                 "line 3: ", "id 3 a second time", true});
  check_refused({"a.json",
                 aot("{\"x\": 1, \"y\": 1, \"w\": 2, \"h\": 2, \"track_id\": 5},\n   {\"x\": 1, \"y\": 1, \"w\": 2, "
                     "\"h\": 2, \"track_id\": 5}"),
                 "line 5: ", "id 5 a second time in frame 100, first in line 4", true});
  check_refused({"a.json", "[{\"img_name\": \"1/100\"},\n{\"img_name\": \"2/100\"}]",
                 "line 2: ", "frame 100 a second time, first in line 1", true});
}

TEST_CASE("lines of another layout than the first are refused") {
  check_refused({"a.txt", "1,1,2,2\n1,7,1,1,2,2,1,-1,-1,-1\n1,1,2,2\n",
                 "line 2: ", "expected 4 numbers x, y, width, height, found 10"});
  check_refused({"a.txt", "1,1,2,2\n1\n1,1,2,2\n", "line 2: ", "expected 4 numbers"});
  check_refused({"a.txt", "1,7,1,1,2,2,1,-1,-1,-1\n1,1,2,2\n",
                 "line 2: ", "expected frame, id, left, top, width, height and on, found 4"});
  check_refused({"a.txt", "1,7,1,1,2,2,1,-1,-1,-1\n2,7,1,1,2,2\n", "line 2: ", "has 6 fields, line 1 has 10"});
  check_refused({"a.txt", "1\n1,1,1,2,2\n1\n",
                 "line 2: ", "expected 4 numbers (rectangle), 8 (polygon) or one (0, 1, 2), found 5"});
  check_refused({"a.txt", "1\n7\n1\n", "line 2: ", "a number alone is 0, 1 or 2"});
  check_refused({"a.csv", "frame,x,y,width,height\n100,1,1,2\n", "line 2: ", "has 4 values, line 1 names 5"});
  check_refused({"a.csv", "frame,x,y,width,height\n100,1,1,2,2\nframe,x,y,width,height\n",
                 "line 3: ", "frame 'frame' is no number"});
}

TEST_CASE("a file that is not a result file is refused") {
  check_refused({"a.txt", "", "is empty", "an empty list [] (aot, coco)"});
  check_refused({"a.txt", "\xEF\xBB\xBF\r\n \n# nothing\n", "is empty", ""});
  check_refused({"a.txt", "hello there\n", "line 1: ", "is of no known layout: 'hello' is neither a number nor"});
  check_refused({"a.txt", "1,2,3\n", "line 1: ", "is of no known layout: 3 numbers"});
  check_refused({"a.txt", std::string("1,2\0", 4), "line 1: ", "is not text"});
  check_refused({"a.txt",
                 "\xFF\xFE"
                 "1,2",
                 "line 1: ", "UTF-16"});
  check_refused({"a.txt", "1,,2,2\n1,1,2,2\n1,1,2,2\n", "line 1: ", "'' is neither"});
  check_refused({"a.csv", "frame,x,y,w,h\n", "line 1: ", "has no column width; the first line names the columns"});
  check_refused({"a.csv", "frame,x,x,y,width,height\n", "line 1: ", "has column x twice"});
  check_refused({"a.txt", std::string(100'000, 'x') + "\n1", "line 1: ", "'xxxxxxxx"});
  check_refused({"a.txt", "m0,0,20,10,5,5\n", "line 1: ", "'m0' is neither"});
  check_refused({"a.json", "{\"img_name\": 3}", "line 1: ", "is an object; results are"});
  check_refused({"a.json", "[1]", "line 1: ", "is a number; results are"});
  check_refused({"a.json", "[[]]", "line 1: ", "is a list; results are"});
  check_refused({"a.json", "\n\"x\"", "line 2: ", "is text; results are"});
  check_refused({"a.json", "[\n{\"detections\": []}]", "line 2: ", "has no img_name"});
  check_refused({"a.json", "[\n{\"img_name\": 3}]", "line 2: ", "img_name is a number"});
  check_refused(
      {"a.json", "[\n{\"img_name\": \"100\",\n\"detections\": 3}]", "line 3: ", "detections is a number, not a list"});
  check_refused(
      {"a.json", "[\n{\"img_name\": \"100\",\n\"detections\": [3]}]", "line 3: ", "is a number; results are"});
  check_refused({"a.json", "[\n{\"img_name\": \"100\",\n", "line", "is not JSON from here on"});
  check_refused({"a.json", "[] []", "line 1: ", "is not JSON from here on"});
}

TEST_CASE("a file that does not exist cannot be read") {
  CHECK(read_results("/nowhere/a.txt", three_frames()).error().kind == ErrorKind::cannot_read);
}

TEST_CASE("invalid coco results are refused with the line, and the entry where all are in one line") {
  const std::string good = R"({"image_id": 1, "bbox": [1, 1, 2, 2]})";
  const auto second = [&](const std::string& entry) { return "[" + good + ",\n" + entry + "]\n"; };
  check_refused({"a.json", second(R"({"bbox": [1, 1, 2, 2]})"), "line 2: ", "has no image_id"});
  check_refused({"a.json", second(R"({"image_id": 2})"), "line 2: ", "has no bbox"});
  check_refused({"a.json", second(R"({"image_id": 2, "bbox": [1, 1, 2]})"), "line 2: ", "4 numbers"});
  check_refused({"a.json", second(R"({"image_id": 2, "bbox": [1, 1, 2, 2, 5, 6, 7]})"), "line 2: ", "4 numbers"});
  check_refused({"a.json", second(R"({"image_id": 2, "bbox": 7})"), "line 2: ", "bbox is a number"});
  check_refused({"a.json", second(R"({"image_id": 2, "bbox": [1, 1, null, 2]})"), "line 2: ", "bbox holds null"});
  check_refused({"a.json", second(R"({"image_id": 2, "bbox": [1, 1, 0, 2]})"), "line 2: ", "0 wide"});
  check_refused({"a.json", second(R"({"image_id": 2, "bbox": [1, 1, 2, 2], "score": "high"})"), "line 2: ", "score"});
  check_refused({"a.json", second(R"({"image_id": 0, "bbox": [1, 1, 2, 2]})"), "line 2: ", "from 1"});
  check_refused({"a.json", second(R"({"image_id": 1.5, "bbox": [1, 1, 2, 2]})"), "line 2: ", "from 1"});
  check_refused({"a.json", second(R"({"image_id": 4, "bbox": [1, 1, 2, 2]})"), "line 2: ", "not of this clip"});
  check_refused(
      {"a.json", second(R"({"image_id": 2147483647, "bbox": [1, 1, 2, 2]})"), "line 2: ", "not of this clip"});
  check_refused({"a.json", second(R"({"image_id": "sky", "bbox": [1, 1, 2, 2]})"), "line 2: ", "frame_000123"});
  check_refused({"a.json", second("7"), "line 2: ", "is a number"});
  check_refused({"a.json", second("[]"), "line 2: ", "is a list"});
  check_refused({"a.json", "[" + good + "," + good, "line", "is not JSON from here on", true});
  check_refused({"a.json", "[" + good + R"(, {"image_id": 2}])", "line 1, [1]: ", "has no bbox"});
  check_refused({"a.json", "[" + good + "," + good + "]", "line 1, [1]: ", "a second box for frame"});
}

TEST_CASE("a JSON file of neither layout is refused with the known ones") {
  check_refused({"a.json", R"([{"file": "100.png", "boxes": [[1, 1, 2, 2]]}])", "line 1: ", "(aot)"});
  check_refused({"a.json", R"([{"file": "100.png", "boxes": [[1, 1, 2, 2]]}])", "line 1: ", "(coco)"});
  check_refused({"a.json", R"({"images": [], "annotations": []})", "line 1: ", "(coco)"});
}

}  // namespace sigs::test
