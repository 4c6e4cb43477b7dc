// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "base/staged_outputs.h"
#include "dataset/index.h"
#include "dataset/merge_labels.h"
#include "dataset/tiny_plan.h"
#include "support/files.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace fs = std::filesystem;

namespace {

// v0, v1, v3 in train, v2 in test; every image a file, so that labels can point at it.
class Labelled {
 public:
  explicit Labelled(const std::vector<std::string>& labels, VideoCodec codec = VideoCodec::ffv1) : tiny(4, 3) {
    for (PlannedVideo& video : tiny.plan.videos) {
      video.project.output.labels = labels;
      video.project.output.codec = codec;
      video.project.output.categories = {"airplane", "drone"};
    }
    CHECK(made(tiny.plan, {.folder = tiny.out(), .source = synthetic_source(), .jobs = 2}).exported == 4);
  }
  [[nodiscard]] fs::path labels() const { return tiny.out() / "labels"; }

  TinyPlan tiny;
};

// The formats that are not merged over videos, and why.
const std::map<std::string, std::string> kNotMerged{
    {"xml", "its <footage> is one for the whole file"},
    {"voc", "its images lie in one folder, and those of two videos have the same names"},
    {"cvat", "its tracks are those of one video"},
    {"jsonl", "its lines do not say which video they are of"}};

}  // namespace

TEST_CASE("COCO labels of a split have every image and annotation of its videos, with ids of their own") {
  const Labelled made({"coco"}, VideoCodec::png);
  const nlohmann::json train = json_of(made.labels() / "coco/train.json");
  CHECK(json_of(made.labels() / "coco/test.json")["videos"].size() == 1);
  CHECK(train["categories"] == json_of(made.tiny.out() / "v0/v0.coco.json")["categories"]);
  std::map<std::string, std::set<std::int64_t>> ids;
  for (const char* const list : {"videos", "images", "annotations", "tracks"})
    for (const nlohmann::json& item : train[list]) CHECK(ids[list].insert(item["id"].get<std::int64_t>()).second);
  REQUIRE(ids["videos"].size() == 3);
  CHECK(ids["images"].size() == 9);
  CHECK(ids["tracks"].size() == 3);
  CHECK(*ids["images"].begin() == 1);
  CHECK(*ids["images"].rbegin() == 9);

  // Each annotation is that of its own video's file.
  std::map<std::int64_t, nlohmann::json> images;
  for (const nlohmann::json& image : train["images"]) images[image["id"]] = image;
  std::map<std::int64_t, std::string> videos;
  for (const nlohmann::json& video : train["videos"]) videos[video["id"]] = video["name"];
  std::map<std::int64_t, nlohmann::json> tracks;
  for (const nlohmann::json& track : train["tracks"]) tracks[track["id"]] = track;
  std::multiset<std::string> said;
  for (const nlohmann::json& image : train["images"])
    CHECK(fs::exists(made.tiny.out() / std::string(image["file_name"])));
  for (const nlohmann::json& annotation : train["annotations"]) {
    const nlohmann::json& image = images.at(annotation["image_id"]);
    CHECK(annotation["video_id"] == image["video_id"]);
    CHECK(tracks.at(annotation["track_id"])["video_id"] == image["video_id"]);
    CHECK(tracks.at(annotation["track_id"])["category_id"] == annotation["category_id"]);
    said.insert(videos.at(image["video_id"]) + image["frame_id"].dump() + annotation["bbox"].dump() +
                annotation["segmentation"].dump());
  }
  std::multiset<std::string> truth;
  for (const std::string video : {"v0", "v1", "v3"}) {
    const nlohmann::json own = json_of(made.tiny.out() / video / (video + ".coco.json"));
    std::map<std::int64_t, nlohmann::json> frames;
    for (const nlohmann::json& image : own["images"]) frames[image["id"]] = image["frame_id"];
    for (const nlohmann::json& annotation : own["annotations"])
      truth.insert(video + frames.at(annotation["image_id"]).dump() + annotation["bbox"].dump() +
                   annotation["segmentation"].dump());
  }
  CHECK(truth.size() >= 6);
  CHECK(said == truth);
}

TEST_CASE("AOT labels of a split hold the flights of its videos as they are") {
  const Labelled made({"aot"});
  const nlohmann::json train = json_of(made.labels() / "aot/train.json");
  nlohmann::json truth;
  for (const std::string video : {"v0", "v1", "v3"})
    truth.update(json_of(made.tiny.out() / video / (video + ".aot.json"))["samples"]);
  CHECK(truth.size() == 3);
  CHECK(train["samples"] == truth);
  CHECK(train.contains("metadata"));
  CHECK(json_of(made.labels() / "aot/test.json") == json_of(made.tiny.out() / "v2/v2.aot.json"));
}

TEST_CASE("CSV labels of a split are the rows of its videos under one header") {
  const Labelled made({"csv"});
  std::string truth;
  for (const std::string video : {"v0", "v1", "v3"}) {
    const std::string own = text_of(made.tiny.out() / video / (video + ".csv"));
    truth += truth.empty() ? own : own.substr(own.find('\n') + 1);
  }
  CHECK(text_of(made.labels() / "csv/train.csv") == truth);
  CHECK(text_of(made.labels() / "csv/test.csv") == text_of(made.tiny.out() / "v2/v2.csv"));
}

TEST_CASE("MOT labels of a split are one benchmark, as TrackEval looks for it") {
  const Labelled made({"mot"}, VideoCodec::png);
  CHECK(text_of(made.labels() / "mot/seqmaps/tiny-train.txt") == "name\nv0\nv1\nv3\n");
  CHECK(text_of(made.labels() / "mot/seqmaps/tiny-test.txt") == "name\nv2\n");
  for (const std::string file : {"gt/gt.txt", "seqinfo.ini", "img1/000001.png", "img1/000003.png"})
    CHECK(text_of(made.labels() / "mot/tiny-train/v3" / file) == text_of(made.tiny.out() / "v3/v3.mot/v3" / file));
  CHECK(fs::equivalent(made.labels() / "mot/tiny-train/v3/img1/000001.png",
                       made.tiny.out() / "v3/v3/frame_000000.png"));  // images cost no space
}

TEST_CASE("KITTI and VOT labels of a split are one folder each") {
  const Labelled made({"kitti", "vot"});
  std::istringstream map(text_of(made.labels() / "kitti/train/evaluate_tracking.seqmap.training"));
  std::vector<std::string> names;
  for (std::string line; std::getline(map, line);) names.push_back(line.substr(0, line.find(' ')));
  CHECK(names == std::vector<std::string>{"v0", "v1", "v3"});
  CHECK(fs::exists(made.labels() / "kitti/train/label_02/v1.txt"));
  CHECK(fs::exists(made.labels() / "kitti/test/calib/v2.txt"));
  std::istringstream list(text_of(made.labels() / "vot/train/list.txt"));
  int sequences = 0;
  for (std::string name; std::getline(list, name); ++sequences)
    CHECK(fs::exists(made.labels() / "vot/train" / name / "groundtruth.txt"));
  CHECK(sequences == 3);
}

TEST_CASE("YOLO's data.yaml names folders of images that are there, each beside its labels") {
  const Labelled made({"yolo"}, VideoCodec::png);
  std::istringstream lines(text_of(made.labels() / "yolo/data.yaml"));
  std::map<std::string, int> folders;
  std::string key;
  std::string rest;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  - ")) {
      if (line[0] != '#' && line.ends_with(':')) key = line.substr(0, line.size() - 1);
      if (line.starts_with("nc: ")) rest = line;
      continue;
    }
    const std::string path = nlohmann::json::parse(line.substr(4));
    ++folders[key];
    CHECK(fs::exists(made.labels() / "yolo" / path / "frame_000002.png"));
    std::string labels = path;
    labels.replace(labels.rfind("/images/"), 8, "/labels/");
    CHECK(fs::exists(made.labels() / "yolo" / labels / "frame_000002.txt"));
  }
  CHECK(folders == std::map<std::string, int>{{"train", 3}, {"val", 1}, {"\"test\"", 1}});
  CHECK(rest == "nc: 2");
}

TEST_CASE("every format has merged labels of each split, or a reason why not") {
  const Labelled made({kLabelNames.begin(), kLabelNames.end()}, VideoCodec::png);
  for (const std::string_view format : kLabelNames) {
    const bool is_merged = fs::exists(made.labels() / format);
    CHECK_MESSAGE(is_merged != kNotMerged.contains(std::string(format)),
                  format << ": kMergers in engine/dataset/merge_labels.cpp, or kNotMerged here");
    if (!is_merged) continue;
    std::string files;
    for (const auto& [file, text] : contents_of(made.labels() / format)) files.append(file).append(text);
    for (const char* const split : {"train", "test"})
      CHECK_MESSAGE(files.find(split) != std::string::npos, format << " " << split);
  }
}

TEST_CASE("formats that do not span videos, and none at all, give no labels folder") {
  std::vector<std::string> names;
  for (const auto& [format, reason] : kNotMerged) names.push_back(format);
  CHECK_FALSE(fs::exists(Labelled(names).labels()));
}

TEST_CASE("merged labels are the same whoever merges them, and go with the formats") {
  Labelled made({"coco", "mot", "csv"});
  const auto before = contents_of(made.tiny.out());
  DatasetRequest merge{.folder = made.tiny.out(), .source = synthetic_source(), .merge_only = true};
  CHECK(sigs::test::made(made.tiny.plan, merge).kept == 4);
  CHECK(contents_of(made.tiny.out()) == before);
  for (PlannedVideo& video : made.tiny.plan.videos) video.project.output.labels = {"csv"};
  merge.merge_only = false;
  merge.resume = true;
  CHECK(sigs::test::made(made.tiny.plan, merge).exported == 4);
  CHECK_FALSE(fs::exists(made.labels() / "coco"));
  CHECK(fs::exists(made.labels() / "csv/train.csv"));
}

TEST_CASE("videos whose labels cannot be merged are refused before anything is made") {
  TinyPlan tiny(2);
  for (PlannedVideo& video : tiny.plan.videos) video.project.output.labels = {"coco"};
  tiny.plan.videos[1].project.output.categories = {"drone"};
  const Result<DatasetReport> categories = make_dataset(tiny.plan, {.folder = tiny.out()}, {});
  REQUIRE_FALSE(categories);
  CHECK_MESSAGE(categories.error().what.find("export.categories") != std::string::npos, categories.error().what);
  tiny.plan.videos[1].project.output.categories = {};
  for (const char* const format : {"kitti", "xml"}) {
    CAPTURE(format);
    const char* const names[] = {"a b", "a_b"};
    for (std::size_t i = 0; i < 2; ++i) {
      tiny.plan.videos[i].name = tiny.plan.videos[i].project.name = names[i];
      tiny.plan.videos[i].project.output.labels = {format};
    }
    CHECK(make_dataset(tiny.plan, {.folder = tiny.out(), .source = synthetic_source()}, {}).has_value() ==
          (std::string(format) == "xml"));
  }
}

TEST_CASE("labels that differ from the program's own format are reported, with the line") {
  const Labelled made({"coco", "aot"});
  for (const std::string file : {"v1.coco.json", "v1.aot.json"}) {
    CAPTURE(file);
    const fs::path path = made.tiny.out() / "v1" / file;
    const std::string text = text_of(path);
    std::string wrong = text;
    wrong.resize(wrong.size() / 2);
    std::error_code code;
    fs::remove_all(made.tiny.out() / "labels", code);
    write_file(path, wrong);
    // As if the entry did not list it: the merge itself checks what it reads.
    const SplitLabels labels{.dataset = "tiny", .split = "train", .videos = {{"v1", path}}};
    const fs::path into = made.tiny.inputs().file("merged");
    const Result<void> merged =
        file.find("coco") != std::string::npos ? merge_coco(labels, into) : merge_aot(labels, into);
    REQUIRE_FALSE(merged);
    CHECK_MESSAGE(merged.error().where.starts_with(path.string()), merged.error().text());
    CHECK_MESSAGE(merged.error().text().find("line ") != std::string::npos, merged.error().text());
    write_file(path, text);
  }
}

// YAML readers take "\ud83d\ude00" for two separate code units; so do PyYAML and all that build on it.
TEST_CASE("characters beyond the basic plane are unchanged in YOLO's data.yaml") {
  const TemporaryFolder folder;
  const std::string name = "clip \xF0\x9F\x98\x80 \"\xC3\xA9\"";
  fs::create_directories(folder / name / "v.yolo/labels/v");
  fs::create_directories(folder / "merged");
  CHECK(write_text(folder / name / "v.yolo/data.yaml", "train: images/v\nnc: 0\nnames: {}\n", false));
  const std::vector<SplitLabels> splits{
      {.dataset = "d", .split = "\xF0\x9F\x98\x80", .videos = {{name, folder / name / "v.yolo"}}}};
  REQUIRE(merge_yolo(splits, folder / "merged", "../"));
  const std::string path = R"(  - "../clip )"
                           "\xF0\x9F\x98\x80"
                           R"( \")"
                           "\xC3\xA9"
                           R"(\"/v.yolo/images/v")";
  CHECK(text_of(folder / "merged/data.yaml").find("\n\"\xF0\x9F\x98\x80\":\n" + path + "\nnc: 0\n") !=
        std::string::npos);
}

TEST_CASE("labels that cannot be read to their end are an error, not the end of a list") {
  const TemporaryFolder folder;
  fs::create_directories(folder / "v1.csv");  // opens as a file does, but gives no byte
  CHECK(write_text(folder / "v0.csv", "frame\r\n0\r\n", false));
  const SplitLabels labels{
      .dataset = "d", .split = "all", .videos = {{"v0", folder / "v0.csv"}, {"v1", folder / "v1.csv"}}};
  const Result<void> merged = merge_csv(labels, folder / "all.csv");
  REQUIRE_FALSE(merged);
  CHECK(merged.error().kind == ErrorKind::cannot_read);
  CHECK(merged.error().where == (folder / "v1.csv").string());
}

TEST_CASE("labels that are taken away while the index is made are an error of the dataset's folder, not of an input") {
  const Labelled made({"coco"});
  std::vector<FinishedVideo> videos;
  for (const PlannedVideo& video : made.tiny.plan.videos) videos.push_back({&video, {}});
  fs::remove(made.tiny.out() / "v1" / "v1.coco.json");
  const Result<DatasetIndex> index = make_index(made.tiny.plan, synthetic_source(), made.tiny.out(), videos, nullptr);
  REQUIRE_FALSE(index);
  CHECK(index.error().kind == ErrorKind::write_failed);
  CHECK(index.error().where == (made.tiny.out() / "v1/v1.coco.json").string());
}
