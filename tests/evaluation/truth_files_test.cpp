// SPDX-License-Identifier: MIT
#include "evaluation/readers/truth_files.h"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <opencv2/core/types.hpp>

#include "base/input_file.h"
#include "evaluation/clips.h"
#include "evaluation/metrics/detection_score.h"
#include "evaluation/metrics/slices.h"
#include "support/test_data.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

struct TruthFolder {
  TemporaryFolder folder;

  fs::path put(const std::string& name, const std::string& text) const {
    fs::create_directories((folder / name).parent_path());
    write_file(folder / name, text);
    return folder / name;
  }
};

std::string problem_of(const fs::path& path, const TruthOptions& options = {}) {
  const Result<std::vector<TruthClip>> clips = read_truth_clips(path, options);
  return clips ? "" : clips.error().text();
}

void check_problem(const fs::path& path, const std::string& part, const TruthOptions& options = {}) {
  const std::string problem = problem_of(path, options);
  CHECK_MESSAGE(problem.find(part) != std::string::npos, problem);
  CHECK(problem.find('\n') == std::string::npos);
}

TruthClip only_clip(const fs::path& path, const TruthOptions& options = {}) {
  Result<std::vector<TruthClip>> clips = read_truth_clips(path, options);
  REQUIRE_MESSAGE(clips, clips.error().text());
  REQUIRE(clips->size() == 1);
  return clips->front();
}

// Three frames of 100x50 pixels at 10 Hz. An object covers columns 10 to 29 and rows 5 to 14, counted from 0, in frames
// 0 and 2; a region that is ignored, columns 60 to 79 and rows 20 to 39, lies in frame 1.
const Box kObject{9.5, 4.5, 20, 10};
const Box kRegion{59.5, 19.5, 20, 20};

fs::path coco_truth(const TruthFolder& folder) {
  return folder.put("tiny.coco.json", R"({"videos": [{"id": 1, "name": "tiny", "fps": 10}],
    "categories": [{"id": 7, "name": "plane"}], "images": [
      {"id": 5, "file_name": "tiny/b.png", "width": 100, "height": 50, "video_id": 1, "frame_id": 1},
      {"id": 9, "file_name": "tiny/a.png", "width": 100, "height": 50, "video_id": 1, "frame_id": 0},
      {"id": 2, "file_name": "tiny/c.png", "width": 100, "height": 50, "video_id": 1, "frame_id": 2}],
    "annotations": [
      {"id": 1, "image_id": 9, "category_id": 7, "bbox": [10, 5, 20, 10], "iscrowd": 0, "track_id": 4},
      {"id": 2, "image_id": 5, "category_id": 7, "bbox": [60, 20, 20, 20], "iscrowd": 1},
      {"id": 4, "image_id": 5, "category_id": 7, "bbox": [30, 20, 9, 9], "track_id": 6, "distractor": true},
      {"id": 3, "image_id": 2, "category_id": 7, "bbox": [10, 5, 20, 10], "track_id": 4}]})");
}

fs::path mot_truth(const TruthFolder& folder) {
  folder.put("tiny.mot/gt/gt.txt", "1,4,11,6,20,10,1,1,1\n3,4,11,6,20,10,1,1,1\n2,9,61,21,20,20,0,8,1\n");
  folder.put("tiny.mot/seqinfo.ini",
             "[Sequence]\r\nname=tiny\r\nframeRate=10\r\nseqLength=3\r\nimWidth=100\r\nimHeight=50\r\n");
  return folder.folder / "tiny.mot";
}

void check_tiny(const ClipTruth& truth, int ignored_in_1) {
  REQUIRE(truth.frames() == 3);
  REQUIRE(truth.targets.size() == 1);
  for (const std::size_t frame : {0U, 2U}) {
    REQUIRE(truth.targets[0].frames[frame].visible);
    const Box& box = *truth.targets[0].frames[frame].visible;
    CHECK(box.x == doctest::Approx(kObject.x));
    CHECK(box.y == doctest::Approx(kObject.y));
    CHECK(box.width == doctest::Approx(kObject.width));
    CHECK(box.height == doctest::Approx(kObject.height));
    CHECK(std::isnan(truth.targets[0].frames[frame].distance_m));
  }
  CHECK_FALSE(truth.targets[0].frames[1].visible);
  if (ignored_in_1 == 0) return;
  REQUIRE(truth.ignored.size() == 3);
  REQUIRE(truth.ignored[1].size() == 1);
  CHECK(truth.ignored[1][0] == kRegion);
}

// Overlap by counting: sums over a grid of a tenth of a pixel.
double gridded_overlap(const Box& a, const Box& b) {
  const auto in = [](const Box& box, double x, double y) {
    return x > box.x && x < box.x + box.width && y > box.y && y < box.y + box.height;
  };
  int both = 0;
  int any = 0;
  for (int i = 0; i < 1000; ++i)
    for (int k = 0; k < 500; ++k) {
      const double x = i / 10.0 + 0.05 - 0.5;
      const double y = k / 10.0 + 0.05 - 0.5;
      both += in(a, x, y) && in(b, x, y);
      any += in(a, x, y) || in(b, x, y);
    }
  return static_cast<double>(both) / any;
}

}  // namespace

TEST_CASE("a text in a truth's file is no key, whatever it says") {
  const TruthFolder folder;
  const std::string coco = text_of(coco_truth(folder));
  const auto described = folder.put("described.json", R"({"made for": "samples",)" + coco.substr(1));
  check_tiny(only_clip(described).truth, 1);
  check_problem(folder.put("words.json", R"({"made of": "images", "as": "samples"})"), "is not labels (.xml)");
  check_problem(folder.put("list.json", R"(["samples", "images"])"), "is not labels (.xml)");
}

TEST_CASE("one clip is the same truth as a coco file, a mot folder and a yolo folder") {
  const TruthFolder folder;
  const TruthClip coco = only_clip(coco_truth(folder));
  CHECK(coco.name == "tiny");
  check_tiny(coco.truth, 1);
  CHECK(coco.truth.has_ids);
  CHECK(coco.truth.targets[0].id == 4);
  CHECK(coco.images.by_id.at(9) == 0);
  CHECK(coco.images.by_name.at("tiny/c.png") == 2);
  CHECK(coco.images.by_name.at("c") == 2);
  const TruthClip mot = only_clip(mot_truth(folder));
  CHECK(mot.name == "tiny.mot");
  check_tiny(mot.truth, 1);
  CHECK(mot.truth.times_s == coco.truth.times_s);
  CHECK(mot.truth.times_s[2] == doctest::Approx(0.2));
  for (const char* const name : {"7", "8", "9"})
    folder.put(std::string("yolo/labels/frame_") + name + ".txt", *name == '8' ? "" : "0 0.2 0.2 0.2 0.2\n");
  const TruthClip yolo = only_clip(folder.folder / "yolo", {.size_px = {100, 50}});
  check_tiny(yolo.truth, 0);
  CHECK(yolo.truth.footage.first_frame == 7);
  CHECK_FALSE(yolo.truth.has_ids);
  CHECK_FALSE(yolo.truth.has_times);
  folder.put("yolo/labels/frame_9.txt", "0 0.1 0.1 0.3 0.1 0.3 0.3 0.1 0.3\n");  // the same as a polygon
  check_tiny(only_clip(folder.folder / "yolo", {.size_px = {100, 50}}).truth, 0);
}

TEST_CASE("figures that need no range are the same for a truth without one, and the others are named") {
  const TruthFolder folder;
  ClipTruth own = clip_of(3, 10, [](int i) {
    TargetFrame frame = visible_at(kObject);
    if (i == 1) frame = {.distance_m = 500};
    return frame;
  });
  // One matches, one is a false alarm in each of frames 0 and 1.
  Results results{.name = "eye"};
  const Box shifted = moved(kObject, 6, 0);
  report(results, 0, shifted, kNoTrack);
  report(results, 0, {80, 40, 5, 5}, kNoTrack);
  report(results, 1, {30, 0, 12, 12}, kNoTrack);
  CHECK(gridded_overlap(kObject, shifted) == doctest::Approx(14.0 / 26).epsilon(0.01));  // more than 0.2: a match
  const DetectionScore expected = score_detections("eye", {{"own", own, results}}, {});
  CHECK(expected.false_alarm_boxes == 2);
  for (const fs::path& path : {coco_truth(folder), mot_truth(folder)}) {
    const std::vector<DetectedClip> clips{{"other", only_clip(path).truth, results}};
    const DetectionScore score = score_detections("eye", clips, {});
    CHECK(score.false_alarm_boxes == 2);
    CHECK(score.false_boxes_per_frame == expected.false_boxes_per_frame);
    CHECK(score.false_alarms_per_hour == doctest::Approx(expected.false_alarms_per_hour));
    CHECK(std::isnan(score.frame_detection_rate));
    CHECK(score.all.encounters == 0);
    const FrameSlice any = frame_slices(clips, {}).front();
    CHECK(any.frames == 2);
    CHECK(any.matched == 1);
    REQUIRE(left_out_of(clips).size() == 1);
    CHECK(left_out_of(clips)[0].find("no ranges: EDR, AFDR") != std::string::npos);
  }
  CHECK(left_out_of({{"own", own, results}}).empty());
}

TEST_CASE("a report in a region that is ignored is no false alarm, and nobody has to find it") {
  const TruthFolder folder;
  for (const fs::path& path : {coco_truth(folder), mot_truth(folder)}) {
    Results results{.name = "eye"};
    report(results, 1, {60, 20, 3, 3}, kNoTrack);   // within it
    report(results, 1, {76, 25, 8, 4}, kNoTrack);   // 3.5 of 8 columns: less than half, but near
    report(results, 1, {10, 5, 20, 10}, kNoTrack);  // elsewhere
    report(results, 0, {60, 20, 3, 3}, kNoTrack);   // the region is not in this frame
    const DetectionScore score = score_detections("eye", {{"clip", only_clip(path).truth, results}}, {});
    CHECK(score.false_alarm_boxes == 2);
    CHECK(score.frames == 3);
  }
}

TEST_CASE("classes that are not asked for are ignored boxes") {
  const TruthFolder folder;
  const fs::path path = folder.put("a.json", R"({"categories": [{"id": 1, "name": "bird"}, {"id": 2, "name": "plane"}],
    "images": [{"id": 1, "file_name": "x.png"}], "annotations": [
      {"image_id": 1, "category_id": 1, "bbox": [1, 1, 4, 4]}, {"image_id": 1, "category_id": 2, "bbox": [9, 9, 4, 4]}]})");
  CHECK(only_clip(path).truth.targets.size() == 2);
  const ClipTruth planes = only_clip(path, {.classes = {"plane"}}).truth;
  REQUIRE(planes.targets.size() == 1);
  CHECK(planes.targets[0].name == "plane");
  REQUIRE(planes.ignored.size() == 1);
  CHECK(planes.ignored[0].size() == 1);
  check_problem(path, "no box is of class kite; there are: bird, plane", {.classes = {"kite"}});
}

TEST_CASE("a challenge's truth has ranges of some objects, and its images' names are those of the results") {
  const TruthFolder folder;
  std::string entities;
  for (int i = 0; i < 40; ++i) {
    entities += i == 0 ? "" : ",";
    entities += R"({"img_name": "15)" + std::to_string(1000 + i) + R"(a0.png", "id": "Airplane1", "bb": [10, 5, 20, 10],
      "blob": {"frame": )" +
                std::to_string(i) + R"(, "range_distance_m": )" + std::to_string(500 - 10 * i) +
                R"(}, "labels": {"is_above_horizon": 1}})";
    entities += R"(,{"img_name": "15)" + std::to_string(1000 + i) +
                R"(a0.png", "id": "Bird1", "bb": [50, 20, 20, 10], "blob": {"frame": )" + std::to_string(i) + "}}";
  }
  const std::string flight = R"({"metadata": {"fps": 10.0, "number_of_frames": 60}, "entities": [)" + entities + "]}";
  const fs::path path = folder.put("groundtruth.json", R"({"samples": {"a0": )" + flight + "}}");
  const TruthClip clip = only_clip(path);
  CHECK(clip.truth.frames() == 60);
  REQUIRE(clip.truth.targets.size() == 2);
  CHECK(clip.truth.targets[0].frames[39].distance_m == 110);
  CHECK(clip.truth.targets[0].frames[0].horizon == HorizonSide::above);
  CHECK_FALSE(clip.truth.targets[0].frames[40].visible);

  std::string found;
  for (int i = 0; i < 20; ++i)
    found += std::string(i == 0 ? "" : ",") + R"({"img_name": "15)" + std::to_string(1000 + i) +
             R"(a0.png", "detections": [{"x": 20, "y": 10, "w": 20, "h": 10, "s": 0.9, "track_id": 3},
                {"x": 60, "y": 25, "w": 20, "h": 10, "s": 0.9}]})";
  found += R"(,{"img_name": "elsewhere.png", "detections": [{"x": 60, "y": 25, "w": 20, "h": 10, "s": 0.9}]})";
  const fs::path results = folder.put("result.json", "[" + found + "]");
  const Result<std::vector<Results>> shared = read_shared_results(results, {&clip}, ResultsFormat::automatic);
  REQUIRE_MESSAGE(shared, shared.error().text());
  REQUIRE(shared->size() == 1);
  CHECK((*shared)[0].boxes_elsewhere == 1);
  CHECK((*shared)[0].frames.at(7)[0].box == kObject);
  const std::vector<DetectedClip> clips{{"a0", clip.truth, (*shared)[0]}};
  const DetectionScore score = score_detections("eye", clips, {});
  CHECK(score.all.encounters == 1);  // 4 s, within 700 m, nearest 110 m
  CHECK(score.all.detected == 1);
  CHECK(score.above_horizon.encounters == 1);
  CHECK(score.false_alarm_boxes == 0);  // a report at the bird, whose range is not known, is none
  CHECK(score.frame_detection_rate == doctest::Approx(20.0 / 40));
  CHECK(score.hours == doctest::Approx(6.0 / 3600));
  REQUIRE(left_out_of(clips).size() == 1);
  CHECK(left_out_of(clips)[0].find("range of 1 of 2 objects") != std::string::npos);
}

TEST_CASE("results of several clips in one file go to the clip whose image they name") {
  const TruthFolder folder;
  const fs::path path = folder.put("a.json", R"({"videos": [{"id": 1, "name": "one"}, {"id": 2, "name": "two"}],
    "images": [{"id": 11, "file_name": "one/1.png", "video_id": 1}, {"id": 12, "file_name": "one/2.png", "video_id": 1},
               {"id": 21, "file_name": "two/1.png", "video_id": 2}], "annotations": []})");
  const Result<std::vector<TruthClip>> clips = read_truth_clips(path);
  REQUIRE_MESSAGE(clips, clips.error().text());
  REQUIRE(clips->size() == 2);
  const auto read = [&](const std::string& image) {
    const fs::path file = folder.put("r.json", R"([{"image_id": )" + image + R"(, "bbox": [1, 2, 3, 4]}])");
    return read_shared_results(file, {&(*clips)[0], &(*clips)[1]}, ResultsFormat::automatic);
  };
  for (const std::string image : {"12", "\"one/2.png\"", "\"2\""}) {
    const Result<std::vector<Results>> shared = read(image);
    REQUIRE_MESSAGE(shared, shared.error().text());
    CHECK((*shared)[1].frames.empty());
    REQUIRE((*shared)[0].frames.contains(1));
    CHECK((*shared)[0].frames.at(1)[0].box == Box{0.5, 1.5, 3, 4});
  }
  CHECK((*read("21"))[1].frames.contains(0));
  CHECK((*read("99"))[0].boxes_elsewhere == 1);
  CHECK((*read("\"1\""))[0].boxes_elsewhere == 1);  // both clips have an image called so
}

TEST_CASE("the size of images is read from PNG and JPEG headers") {
  const TruthFolder folder;
  folder.put("y/labels/1.txt", "0 0.5 0.5 0.5 0.5\n");
  check_problem(folder.folder / "y", "1.txt: its image is not there");
  const std::string png = std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x64\0\0\0\x32", 24);
  folder.put("y/images/1.png", png);
  CHECK(*only_clip(folder.folder / "y").truth.targets[0].frames[0].visible == Box{24.5, 12, 50, 25});
  fs::remove(folder.folder / "y/images/1.png");
  folder.put("y/images/1.jpg", std::string("\xff\xd8\xff\xe0\0\4ab\xff\xc0\0\x0b\x08\0\x32\0\x64\1", 19));
  CHECK(*only_clip(folder.folder / "y").truth.targets[0].frames[0].visible == Box{24.5, 12, 50, 25});
  for (const std::string& damaged : {std::string("\xff\xd8\xff\xe0\0\0\0\0\0\0\0\0\0\0", 14), std::string("\xff\xd8"),
                                     std::string("GIF89a"), png.substr(0, 20), std::string()}) {
    folder.put("y/images/1.jpg", damaged);
    check_problem(folder.folder / "y", "1.jpg: its size cannot be read");
  }
}

TEST_CASE("a truth that is wrong is refused in one line that says where") {
  const TruthFolder folder;
  const auto mot = [&](const std::string& rows, const std::string& part, const std::string& info = "seqLength=3\n") {
    folder.put("m/gt/gt.txt", rows);
    folder.put("m/seqinfo.ini", info);
    check_problem(folder.folder / "m", part);
  };
  mot("1,1,1,1,5,5\n4,1,1,1,5,5\n", "gt.txt: line 2: frame 4 is past seqLength");
  mot("0,1,1,1,5,5\n", "line 1: frame '0' is no whole number from 1 on");
  mot("1,1,1,1,5,5\n1,1,1,1,5,5\n", "line 2: object 1 a second time in frame 0");
  mot("1,1,1,1,5\n", "line 1: has 5 columns");
  mot("1,1,1,nan,5,5\n", "line 1: column 4: 'nan' is no number");
  mot("1,1,1,1,0,5\n", "line 1: the box is 0 wide");
  mot("1,1,1,1,5,5,1,1,1.5\n", "line 1: the visible share is not from 0 to 1");
  mot("", "gt.txt: has no row", "[Sequence]\n");
  mot("1,1,1,1,5,5\n", "line 1: seqlength: 'x' is no whole number", "seqLength=x\n");
  mot("1,1,1,1,5,5\n", "seqLength is 101001, but there are 1 row", "seqLength=101001\n");
  mot("1,1,1,1,5,5\n", "seqLength is 9000000, but there are 1 row", "seqLength=9000000\n");
  mot("1,1,1,1,5,5\n", "line 1: framerate: '0' is no rate", "frameRate=0\n");

  const auto coco = [&](const std::string& text, const std::string& part) {
    check_problem(folder.put("c.json", text), part);
  };
  const std::string images = R"({"images": [{"id": 1, "file_name": "a.png"}], )";
  coco("{\"images\": [], \"annotations\": []}", "c.json: has no image");
  coco(images + "\"x\": 1}", "has no list \"annotations\"");
  coco(images + R"("annotations": [{"image_id": 2, "category_id": 1, "bbox": [1, 1, 4, 4]}]})",
       "annotations[0].image_id 2 is no image of the file");
  coco(images + R"("annotations": [{"image_id": 1, "category_id": 1, "bbox": [1, 1, 4]}]})",
       "annotations[0].bbox is not a list of 4 numbers");
  coco(images + R"("annotations": [{"image_id": 1, "category_id": 1, "bbox": [1, 1, 0, 4]}]})",
       "annotations[0]: the box is 0 wide");
  coco(images + R"("annotations": [{"image_id": 1, "category_id": 1, "bbox": [1, 1, 4, 4], "iscrowd": 2}]})",
       "annotations[0].iscrowd is neither 0 nor 1");
  coco(images + R"("annotations": [{"image_id": 1, "category_id": 1, "bbox": [1, 1, 4, 4], "distance_m": -1}]})",
       "annotations[0]: the distance is below 0");
  coco(images + R"("categories": [{"id": 3, "name": "x"}], "annotations": [
         {"image_id": 1, "category_id": 1, "bbox": [1, 1, 4, 4]}]})",
       "annotations[0].category_id 1 is no category");
  coco(R"({"images": [{"id": 1, "file_name": "a.png", "frame_id": 1}, {"id": 2, "file_name": "b.png", "frame_id": 3}],
         "annotations": []})",
       "image b.png: frame 3 follows frame 1: those between are missing");
  coco(R"({"images": [{"id": 1, "file_name": "a.png", "frame_id": 1}, {"id": 2, "file_name": "b.png"}],
         "annotations": []})",
       "1 of 2 images have a frame_id");
  coco(R"({"images": [{"id": 1, "file_name": "a.png"}, {"id": 1, "file_name": "b.png"}], "annotations": []})",
       "images[1].id 1 is there twice");
  coco("{\"images\": 3}", "images is not a list");
  coco("{\"images\": [", "c.json: is not JSON");
  coco("[]", "c.json: is not labels (.xml)");

  const auto aot = [&](const std::string& flight, const std::string& part) {
    check_problem(folder.put("g.json", R"({"samples": {"f": )" + flight + "}}"), part);
  };
  const std::string entity = R"({"img_name": "a", "id": "A1", "bb": [1, 1, 2, 2], "blob": {"frame": 5}})";
  aot(R"({"entities": []})", "samples.f: has no entity");
  aot(R"({"metadata": {"number_of_frames": 9000000}, "entities": [)" + entity + "]}",
      "number_of_frames is 9000000, but");
  aot(R"({"entities": [)" + entity + "," + entity + "]}", "samples.f, A1: object 0 a second time in frame 5");
  aot(R"({"entities": [{"img_name": "a", "blob": {"frame": -1}}]})", "blob.frame -1 is not from 0");

  const auto yolo = [&](const std::string& name, const std::string& text, const std::string& part) {
    fs::remove_all(folder.folder / "y");
    folder.put("y/labels/frame_1.txt", "");
    folder.put("y/labels/" + name, text);
    check_problem(folder.folder / "y", part, {.size_px = {100, 50}});
  };
  yolo("frame_3.txt", "", "frame_3: frame 3 follows frame 1: those between are missing");
  yolo("frame.txt", "", "has no frame number at its end");
  yolo("x_1.txt", "", "has the number of frame_1: frame 1");
  yolo("frame_2.txt", "0 0.5 0.5 0.1 0.1 0.9\n", "frame_2.txt: line 1: has 6 numbers");
  yolo("frame_2.txt", "0 50 0.5 0.1 0.1\n", "line 1: '50' is no share of the image");
  yolo("frame_2.txt", "0 0.5 0.5 0 0.1\n", "line 1: the box is 0 wide");
  yolo("frame_2.txt", "plane 0.5 0.5 0.1 0.1\n", "line 1: 'plane' is no number");
  yolo("frame_99999999.txt", "", "frame 99999999 is beyond");
  folder.put("y/labels/frame_3.txt", "");
  fs::remove(folder.folder / "y/labels/frame_99999999.txt");
  CHECK(only_clip(folder.folder / "y", {.size_px = {100, 50}, .stills = true}).truth.frames() == 2);
}

TEST_CASE("a truth that is cut off or damaged anywhere is read or refused in one line") {
  const TruthFolder folder;
  coco_truth(folder);
  mot_truth(folder);
  folder.put("y/labels/frame_1.txt", "0 0.2 0.2 0.2 0.2\n0 0.1 0.1 0.3 0.1 0.3 0.3\n");
  folder.put("g.json", R"({"samples": {"f": {"metadata": {"fps": 10, "number_of_frames": 9}, "entities": [
    {"img_name": "a", "id": "A1", "bb": [1, 1, 2, 2], "blob": {"frame": 5, "range_distance_m": 3}}]}}})");
  const std::pair<const char*, const char*> cases[] = {{"tiny.coco.json", "tiny.coco.json"},
                                                       {"tiny.mot", "tiny.mot/gt/gt.txt"},
                                                       {"tiny.mot", "tiny.mot/seqinfo.ini"},
                                                       {"y", "y/labels/frame_1.txt"},
                                                       {"g.json", "g.json"}};
  for (const auto& [input, name] : cases) {
    const std::string file = name;
    const std::string whole = read_text(folder.folder / file).value();
    CAPTURE(file);
    for (std::size_t at = 0; at < whole.size(); ++at)
      for (const char letter : {'\0', '9', '-', '"', '}'}) {
        std::string changed = whole.substr(0, at);
        if (letter != '\0') changed += letter + whole.substr(at + 1);
        write_file(folder.folder / file, changed);
        const std::string problem = problem_of(folder.folder / input, {.size_px = {100, 50}});
        if (problem.find('\n') != std::string::npos) FAIL_CHECK(problem);
      }
    write_file(folder.folder / file, whole);
    CHECK(problem_of(folder.folder / input, {.size_px = {100, 50}}).empty());
  }
}

}  // namespace sigs::test
