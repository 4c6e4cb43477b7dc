// SPDX-License-Identifier: MIT
// The sizes of docs/limits.md. The files are sparse: they take no room on the disk, and reading one would take long.
#include <doctest/doctest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/input_file.h"
#include "camera/camera.h"
#include "dataset/recipe.h"
#include "encounter/daa_file.h"
#include "encounter_model/encounter_model.h"
#include "evaluation/readers/aot_files.h"
#include "evaluation/readers/clip_truth.h"
#include "evaluation/readers/results.h"
#include "evaluation/readers/truth_files.h"
#include "geo/recorded_path.h"
#include "mesh/mesh.h"
#include "project/json.h"
#include "scene/scene_files.h"
#include "support/test_data.h"
#include "telemetry/track.h"
#include "video/frame_source.h"
#include "video/image_sequence.h"

using namespace sigs;
using namespace sigs::test;

namespace {

namespace fs = std::filesystem;

template <class T>
std::string refusal_of(const Result<T>& read) {
  return read ? std::string() : read.error().text();
}

// A kind of file: how it begins, the most that is read of it, and its reader, which gives the message of its error.
struct LimitedFile {
  std::string name;
  std::string begin;
  std::uint64_t limit_mib = 0;
  std::function<std::string(const fs::path&)> refusal;
};

std::vector<LimitedFile> limited_files() {
  const auto track = [](const fs::path& path) { return refusal_of(read_track(path)); };
  const auto results = [](const fs::path& path) { return refusal_of(read_results(path, {})); };
  return {{"lens.xml", "", 4, [](const fs::path& path) { return refusal_of(read_calibration(path)); }},
          {"p.json", "", 64, [](const fs::path& path) { return refusal_of(read_project(path)); }},
          {"r.json", "", 64, [](const fs::path& path) { return refusal_of(read_recipe(path)); }},
          {"model.obj", "", 2048, [](const fs::path& path) { return refusal_of(read_obj(path)); }},
          {"attitude.csv", "", 1024, [](const fs::path& path) { return refusal_of(read_attitude_file(path)); }},
          {"labels.xml", "", 1024, [](const fs::path& path) { return refusal_of(read_truth(path)); }},
          {"truth.json", "", 1024, [](const fs::path& path) { return refusal_of(read_truth_clips(path)); }},
          {"groundtruth.json", "", 1024, [](const fs::path& path) { return refusal_of(read_aot_truth(path)); }},
          {"result.json", "", 1024, [](const fs::path& path) { return refusal_of(read_aot_reports(path)); }},
          {"results.csv", "", 1024, results},
          {"log.ulg", "ULog\x01\x12\x35\x01", 2048, track},
          {"log.csv", "time_s,latitude_deg,longitude_deg\n", 1024, track},
          {"log.srt", "1\n00:00:00,000 --> 00:00:01,000\n[latitude: 1] [longitude: 2]\n", 1024, track},
          {"pair.daa", "", 1024, [](const fs::path& path) { return refusal_of(read_encounter_file(path)); }},
          {"model.txt", "", 64, [](const fs::path& path) { return refusal_of(read_encounter_model(path)); }},
          {"path.gpx", "", 256, [](const fs::path& path) { return refusal_of(read_recorded_paths(path)); }},
          {"times.txt", "", 1024, [](const fs::path& path) { return refusal_of(read_image_times(path, {"0.png"})); }}};
}

}  // namespace

TEST_CASE("a file larger than its kind is read of is refused by its size") {
  for (const LimitedFile& kind : limited_files()) {
    const TemporaryFolder folder;
    const fs::path path = folder / kind.name;
    write_file(path, kind.begin);
    fs::resize_file(path, kind.limit_mib * kMebibyte + 1);
    const std::string refusal = kind.refusal(path);
    CHECK_MESSAGE(refusal.find("is larger than " + std::to_string(kind.limit_mib) + " MiB") != std::string::npos,
                  kind.name, ": ", refusal);
  }
}

TEST_CASE("an image of a sequence larger than a gibibyte is refused by its size") {
  const TemporaryFolder folder;
  write_file(folder / "0.png", "\x89PNG\r\n\x1a\n");
  fs::resize_file(folder / "0.png", 1024 * kMebibyte + 1);
  CHECK(refusal_of(FrameSource::open(folder.path())).find("is larger than 1024 MiB") != std::string::npos);
}

TEST_CASE("a library of materials larger than 64 MiB is left out with a warning") {
  const TemporaryFolder folder;
  write_file(folder / "model.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
  write_file(folder / "m.mtl", "newmtl red\nKd 1 0 0\n");
  fs::resize_file(folder / "m.mtl", 64 * kMebibyte + 1);
  const Result<Mesh> mesh = read_obj(folder / "model.obj");
  REQUIRE_MESSAGE(mesh, mesh.error().text());
  bool is_said = false;
  for (const Warning& warning : mesh->warnings) is_said = is_said || warning.text().find("m.mtl") != std::string::npos;
  CHECK(is_said);
}
