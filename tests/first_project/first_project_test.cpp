// SPDX-License-Identifier: MIT

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "base/input_file.h"
#include "base/paths.h"
#include "base/pose.h"
#include "first_project/first_model.h"
#include "first_project/first_project.h"
#include "made_project.h"
#include "mesh/model_files.h"
#include "project/json.h"
#include "scene/opened_project.h"
#include "support/files.h"
#include "support/process.h"
#include "support/test_data.h"
#include "telemetry/track.h"

using namespace sigs;
using test::made_and_opened;
using test::noisy_images;
using test::note_on;

namespace fs = std::filesystem;

namespace {

fs::path sample_video() {
  return test::source_dir() / "assets/footage/sample.mp4";
}

// A clip made by FFmpeg: its options after the input, a test pattern.
fs::path made_clip(const test::TemporaryFolder& folder, const std::string& pattern, const std::string& options,
                   const std::string& name = "clip.mp4") {
  const fs::path file = folder / name;
  const test::Run run = test::run_together("ffmpeg -v error -y -f lavfi -i testsrc=" + pattern + " " + options + " '" +
                                           file.string() + "' </dev/null");
  REQUIRE_MESSAGE(run.status == 0, run.out);
  return file;
}

std::string big_endian(std::size_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>(number >> shift & 0xFF));
  return bytes;
}

// Puts the box of Google's spherical video, version 1, into the track of an MP4 whose `moov` is its last box.
void state_spherical(const fs::path& mp4) {
  std::string bytes = read_text(mp4, std::size_t{1} << 30).value();
  const std::string xml =
      "<?xml version=\"1.0\"?><rdf:SphericalVideo xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\" "
      "xmlns:GSpherical=\"http://ns.google.com/videos/1.0/spherical/\"><GSpherical:Spherical>true</"
      "GSpherical:Spherical>"
      "<GSpherical:Stitched>true</GSpherical:Stitched><GSpherical:StitchingSoftware>test</GSpherical:StitchingSoftware>"
      "<GSpherical:ProjectionType>equirectangular</GSpherical:ProjectionType></rdf:SphericalVideo>";
  const std::string id = "\xFF\xCC\x82\x63\xF8\x55\x4A\x93\x88\x14\x58\x7A\x02\x52\x1F\xDD";
  const std::string box = big_endian(8 + id.size() + xml.size()) + "uuid" + id + xml;
  const std::size_t moov = bytes.rfind("moov") - 4, trak = bytes.find("trak", moov) - 4;
  const auto size_at = [&](std::size_t at) {
    std::size_t size = 0;
    for (std::size_t i = 0; i < 4; ++i) size = size << 8 | static_cast<unsigned char>(bytes[at + i]);
    return size;
  };
  bytes.insert(trak + size_at(trak), box);
  for (const std::size_t at : {moov, trak}) bytes.replace(at, 4, big_endian(size_at(at) + box.size()));
  std::ofstream(mp4, std::ios::binary) << bytes;
}

bool notes_guess(const FirstProject& made, const std::string& field) {
  for (const FirstProjectNote& note : made.notes)
    if (note.field == field) return note.is_guess;
  return false;
}

}  // namespace

TEST_CASE("a clip becomes a project that opens without a problem and has its intruder in view") {
  const test::TemporaryFolder folder;
  const FirstProject made = made_and_opened({.video = sample_video(), .out = folder / "a/first.json"}, 0.9);
  CHECK(made.project.name == "first");
  CHECK(notes_guess(made, "footage.calibration"));
  CHECK(fs::exists(folder / "a/light-aircraft/light-aircraft.obj"));
  CHECK(test::text_of(folder / "a/first.notes.txt").find("guessed") != std::string::npos);
  CHECK(test::text_of(folder / "a/first.calibration.xml").find("Not measured") != std::string::npos);
  // Nothing is replaced without being asked for, and then everything is.
  CHECK(make_first_project({.video = sample_video(), .out = folder / "a/first.json", .plain = true}).error().kind ==
        ErrorKind::cannot_create);
  CHECK(
      make_first_project({.video = sample_video(), .out = folder / "a/first.json", .overwrite = true, .plain = true}));
  // A second project shares the model.
  CHECK(make_first_project({.video = sample_video(), .out = folder / "a/second.json", .plain = true}));
}

TEST_CASE("a folder with the video and its project can be moved") {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "here");
  fs::copy_file(sample_video(), folder / "here/clip.mp4");
  made_and_opened({.video = folder / "here/clip.mp4", .out = folder / "here/clip/clip.json", .plain = true});
  fs::rename(folder / "here", folder / "there");
  const Result<ReadProject> read = read_project(folder / "there/clip/clip.json");
  REQUIRE(read);
  CHECK(open_project(read->project, nullptr));
}

TEST_CASE("the horizontal field of view is as asked for: a pinhole, from 120 degrees on a fisheye") {
  const test::TemporaryFolder folder;
  for (const double fov_deg : {5.0, 40.0, 100.0, 150.0, 200.0}) {
    CAPTURE(fov_deg);
    const FirstProject made = made_and_opened({.video = sample_video(),
                                               .horizontal_fov_deg = fov_deg,
                                               .out = folder / "p.json",
                                               .overwrite = true,
                                               .plain = true});
    const Result<Camera> camera = read_calibration(folder / "p.calibration.xml", cv::Size(1280, 960));
    REQUIRE(camera);
    const double half_rad = fov_deg * 3.14159265358979 / 360;
    const double focal = camera->lens.parameters().fx;
    // The image is 1280 px wide from edge to edge.
    CHECK(focal == doctest::Approx(fov_deg < 120 ? 640 / std::tan(half_rad) : 640 / half_rad));
    CHECK(is_fisheye(camera->lens.parameters().model) == (fov_deg >= 120));
  }
}

TEST_CASE("a calibration is referred to, checked against the footage, and excludes a field of view") {
  const test::TemporaryFolder folder;
  const fs::path calibration = test::source_dir() / "assets/calibrations/sample.xml";
  const FirstProject made =
      made_and_opened({.video = sample_video(), .calibration = calibration, .out = folder / "p.json", .plain = true});
  CHECK(canonical_path(resolved(made.project, made.project.footage.calibration)) == canonical_path(calibration));
  CHECK_FALSE(fs::exists(folder / "p.calibration.xml"));
  const fs::path wide = made_clip(folder, "s=640x360:d=0.2:r=25", "");
  const Result<FirstProject> other =
      make_first_project({.video = wide, .calibration = calibration, .out = folder / "q.json"});
  REQUIRE_FALSE(other);
  CHECK(other.error().text().find("640") != std::string::npos);
  CHECK(other.error().text().find("1280") != std::string::npos);
  CHECK(make_first_project({.video = wide, .calibration = calibration, .horizontal_fov_deg = 70.0}).error().kind ==
        ErrorKind::usage);
  CHECK_FALSE(fs::exists(folder / "q.json"));
}

TEST_CASE(
    "footage that states itself spherical becomes a 360 degree project without a calibration; twice as wide, a hint") {
  const test::TemporaryFolder folder;
  const fs::path clip = made_clip(folder, "size=640x320:rate=25:duration=0.4", "-pix_fmt yuv420p");
  const auto note_of = [&](const char* out, const char* field) {
    const FirstProject made = made_and_opened({.video = clip, .out = folder / out, .plain = true});
    if (made.project.footage.calibration.empty()) CHECK(made.project.camera.pitch_deg == 0);
    CHECK(made.project.footage.calibration.empty() == (made.project.footage.lens_model == LensModel::equirectangular));
    return note_on(made, field);
  };
  const FirstProjectNote flat = note_of("flat/flat.json", "footage.calibration");
  CHECK(flat.remedy.find("360 degree") != std::string::npos);
  state_spherical(clip);
  const FirstProjectNote round = note_of("round/round.json", "footage.lens_model");
  CHECK_FALSE(round.is_guess);
  CHECK(round.text.find("360 degree") != std::string::npos);
}

TEST_CASE("clips of one frame, of odd size, in 4K, with oblong pixels, upright and without times become projects") {
  const test::TemporaryFolder folder;
  const auto works = [&](const fs::path& clip) {
    CAPTURE(clip);
    made_and_opened({.video = clip, .out = folder / "p.json", .overwrite = true});
  };
  works(made_clip(folder, "s=640x480:r=25", "-frames:v 1"));
  works(made_clip(folder, "s=640x480:r=25", "-frames:v 10"));
  works(made_clip(folder, "s=321x243:r=25", "-frames:v 10 -pix_fmt yuv444p", "odd.mkv"));
  works(made_clip(folder, "s=3840x2160:r=25", "-frames:v 3 -preset ultrafast"));
  works(made_clip(folder, "s=720x576:r=25", "-frames:v 10 -vf setsar=16/11"));
  works(made_clip(folder, "s=480x640:r=25", "-frames:v 10"));
  works(made_clip(folder, "s=640x480:r=25", "-frames:v 10 -f h264", "bare.h264"));
}

TEST_CASE("a long clip is used for its middle minute") {
  const test::TemporaryFolder folder;
  const FirstProject made = made_and_opened(
      {.video = made_clip(folder, "s=160x120:r=1:d=600", "-pix_fmt yuv420p"), .out = folder / "p.json"});
  CHECK(made.project.footage.first_frame ==
        269);  // (599 - 60) / 2, rounded down: 599 s from the first frame to the last
  CHECK(made.project.footage.last_frame == 329);
}

TEST_CASE("real clips become projects; a GoPro's log gives the path, KLV its field of view") {
  if (!test::has_real_data()) return;
  const test::TemporaryFolder folder;
  const fs::path coast_video = test::real_data() / "video/air_karma_gopro_coast.mp4";
  const FirstProject coast = made_and_opened({.video = coast_video, .out = folder / "coast.json"}, 0.9);
  // Its attitudes are those of the images, its path the log's, at the log's own times.
  CHECK(coast.project.camera.track.file == "coast.attitude.csv");
  CHECK(std::ranges::any_of(coast.notes, [](const FirstProjectNote& note) {
    return note.field == "footage.cloud_distance_m" && note.text.starts_with("none: clouds cover");
  }));
  const Result<Track> seen = read_track(folder / "coast.attitude.csv");
  const Result<Track> logged = read_track(coast_video);
  REQUIRE(seen);
  REQUIRE(logged);
  CHECK(seen->ned_from_camera.values.size() == 362);
  REQUIRE(seen->position.values.size() == logged->position.values.size());
  for (std::size_t i = 0; i < seen->position.times_s.size(); ++i)
    CHECK(seen->position.times_s[i] == doctest::Approx(logged->position.times_s[i]));
  const FirstProject klv =
      made_and_opened({.video = test::real_data() / "telemetry/klv/h264_klv.ts", .out = folder / "klv.json"});
  CHECK(klv.project.camera.track.file.empty());  // the time of its frame 0 is not known
  CHECK(test::text_of(folder / "klv.calibration.xml").find("tag 16") != std::string::npos);
}

TEST_CASE("telemetry that is there, but of which nothing can be read, is said to be there") {
  if (!test::has_real_data()) return;
  const test::TemporaryFolder folder;
  std::string bytes = test::text_of(test::real_data() / "telemetry/klv/h264_klv.ts");
  const std::string key = "\x06\x0E\x2B\x34";  // each packet begins with it
  for (std::size_t at = bytes.find(key); at != std::string::npos; at = bytes.find(key, at)) bytes[at] = 0;
  test::write_file_and_folders(folder / "clip.ts", bytes);
  const FirstProject made = made_and_opened({.video = folder / "clip.ts", .out = folder / "p.json", .plain = true});
  CHECK(note_on(made, "camera.speed_mps").text.find("clip.ts has no intact ST 0601 packet") != std::string::npos);
  // A video without any telemetry has none that is unusable.
  const FirstProject bare = made_and_opened({.video = sample_video(), .out = folder / "bare.json", .plain = true});
  CHECK(note_on(bare, "camera.speed_mps").text.find("no flight log") != std::string::npos);
}

TEST_CASE("the axes and unit of a user's model are found") {
  if (!test::has_real_data()) return;
  const test::TemporaryFolder folder;
  const fs::path models = test::real_data() / "models";
  for (const char* const name : {"boeing737-300", "glider-centrair101", "helicopter-dauphin"}) {
    CAPTURE(name);
    const FirstProject made = made_and_opened({.video = sample_video(),
                                               .model = models / name / (std::string(name) + ".obj"),
                                               .out = folder / "p.json",
                                               .overwrite = true,
                                               .plain = true});
    CHECK(made.project.intruders.front().model.forward == "-x");
    CHECK(made.project.intruders.front().model.up == "+y");
    CHECK(made.project.intruders.front().model.scale == 1);
  }
}

TEST_CASE("a request to stop ends the making without a file") {
  const test::TemporaryFolder folder;
  const std::atomic<bool> stop = true;
  const Result<FirstProject> made =
      make_first_project({.video = sample_video(), .out = folder / "p.json"}, {.progress = {}, .cancel = &stop});
  REQUIRE_FALSE(made);
  CHECK(made.error().kind == ErrorKind::interrupted);
  CHECK_FALSE(fs::exists(folder / "p.json"));
}

TEST_CASE("images give the project their folder's name, and leave their folder as it is") {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "flight");
  const fs::path numbered = made_clip(folder, "size=320x240:rate=25", "-frames:v 12", "flight/%04d.png");
  const auto files_in = [](const fs::path& path) {
    return std::distance(fs::directory_iterator(path), fs::directory_iterator());
  };
  REQUIRE(files_in(folder / "flight") == 12);
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  for (const fs::path& footage : {fs::path("flight"), fs::path("flight/%04d.png")}) {
    CAPTURE(footage.string());
    const FirstProject made = made_and_opened({.video = footage, .timing = {.frame_rate_hz = 50}});
    CHECK(made.project.name == "flight");
    CHECK(made.project.file == canonical_name(folder / "flight-project/flight.json"));
    CHECK(made.project.footage.video == "../" + footage.string());
    CHECK(made.project.footage.frame_rate_hz == 50.0);
    CHECK(files_in(folder / "flight") == 12);
    fs::remove_all(folder / "flight-project");
  }
  fs::current_path(before);
}

TEST_CASE("the intruder of a first project has the footage's noise; a plain one has none") {
  const test::TemporaryFolder folder;
  const double sd = 4;
  FirstProjectOptions options{
      .video = noisy_images(folder, sd), .timing = {.frame_rate_hz = 25}, .out = folder / "p.json"};
  const FirstProject made = made_and_opened(options);
  // 10 % is what the estimate of noise promises between 0.2 and 0.8 of the brightness (docs/appearance.md).
  const GrainSettings& grain = made.project.appearance.grain;
  CHECK(0.5 * (grain.sd_dark + grain.sd_bright) == doctest::Approx(sd).epsilon(0.1));
  CHECK_FALSE(note_on(made, "appearance.grain").is_guess);
  CHECK(made.project.appearance.codec.match == CodecMatchChoice::none);  // PNG keeps every sample
  CHECK(made.project.compositing.blur_px_per_m == 0);
  CHECK(made.project.compositing.quality == QualityChoice::automatic);  // within 0.25 codes of exact
  // What the footage does not tell is at its default, and said.
  CHECK(note_on(made, "appearance.psf_sigma_px").is_guess);
  CHECK(note_on(made, "appearance.haze.visibility_m").is_guess);
  CHECK_FALSE(made.project.appearance.haze.visibility_m);

  options.plain = true;
  options.overwrite = true;
  const FirstProject plain = made_and_opened(options);
  CHECK(plain.project.appearance == AppearanceSettings{});
  CHECK(plain.project.compositing == CompositingSettings{});
}

TEST_CASE("the intruder of a first project goes through the footage's codec, and is gray in gray footage") {
  const test::TemporaryFolder folder;
  const fs::path gray = made_clip(folder, "s=320x240:r=25:d=1", "-vf hue=s=0 -c:v libx264 -pix_fmt yuv420p");
  const FirstProject made = made_and_opened({.video = gray, .out = folder / "p.json"});
  CHECK(made.project.appearance.codec.match == CodecMatchChoice::footage);
  CHECK(made.project.appearance.codec.predicted_frames > 0);
  CHECK(made.project.appearance.saturation == 0);
  CHECK_FALSE(note_on(made, "appearance.saturation").is_guess);
}

TEST_CASE("making a first project tells its progress, and ends soon where it is stopped on the way") {
  const test::TemporaryFolder folder;
  std::vector<std::string> steps;
  int before = -1;
  const auto follow = [&](int done, int total, const std::string& step) {
    CHECK(done >= std::exchange(before, done));
    CHECK(done <= total);
    if (steps.empty() || steps.back() != step) steps.push_back(step);
  };
  const FirstProjectOptions options{.video = made_clip(folder, "s=320x240:r=25:d=1", ""), .out = folder / "p.json"};
  REQUIRE(planned_first_project(options, {.progress = follow}));
  CHECK(before == 100);
  REQUIRE(steps.size() > 4);
  for (const std::string& step : steps) {
    if (step.empty()) continue;  // nothing is next
    std::atomic<bool> stop = false;
    const auto stop_at_step = [&](int /*done*/, int /*total*/, const std::string& now) { stop = stop || now == step; };
    const Result<FirstProject> made = make_first_project(options, {.progress = stop_at_step, .cancel = &stop});
    REQUIRE_FALSE(made);
    CHECK_MESSAGE(made.error().kind == ErrorKind::interrupted, step);
    CHECK_FALSE(fs::exists(folder / "p.json"));
  }
}

TEST_CASE("the guesses of a project are read back from beside it, each with the value that its setting has") {
  const test::TemporaryFolder folder;
  const FirstProject made = made_and_opened({.video = sample_video(), .out = folder / "first.json"}, 0.9);
  const std::vector<FirstProjectGuess> guesses = guesses_beside(folder / "first.json");
  const auto count =
      std::count_if(made.notes.begin(), made.notes.end(), [](const FirstProjectNote& n) { return n.is_guess; });
  REQUIRE(static_cast<std::ptrdiff_t>(guesses.size()) == count);
  REQUIRE(count > 3);
  const Project read = read_project(folder / "first.json")->project;
  for (const FirstProjectGuess& guess : guesses) {
    CAPTURE(guess.field);
    CHECK(notes_guess(made, guess.field));
    for (const char* const of_terminal : {"--", "`"})  // of no use in a window
      CHECK_MESSAGE(guess.text.find(of_terminal) == std::string::npos, guess.text);
    CHECK_FALSE(guess.value.empty());
    CHECK(guess.value == setting_text(read, guess.field));
  }
  Project changed = read;
  changed.camera.position_m.z = -77.25;
  CHECK(setting_text(changed, "camera.position_m") != setting_text(read, "camera.position_m"));
  CHECK(guesses_beside(folder / "second.json").empty());
}

TEST_CASE("a model is copied once, beside another of its name, and never overwrites one") {
  const test::TemporaryFolder folder;
  const fs::path sample = test::source_dir() / "assets/models/quadcopter/quadcopter.obj";
  const Result<fs::path> first = model_copied_into(folder.path(), sample);
  REQUIRE(first);
  CHECK(*first == folder / "quadcopter/quadcopter.obj");
  CHECK(test::text_of(*first) == test::text_of(sample));
  CHECK(*model_copied_into(folder.path(), sample) == *first);
  CHECK(*model_copied_into(folder.path(), *first) == *first);  // it lies there
  test::write_file_and_folders(*first, "v 0 0 0\n");
  const Result<fs::path> second = model_copied_into(folder.path(), sample);
  REQUIRE(second);
  CHECK(*second == folder / "quadcopter-2/quadcopter.obj");
  CHECK(test::text_of(*first) == "v 0 0 0\n");
}

TEST_CASE(
    "a model keeps the folders of its textures in the copy; one that reaches farther than beside its folder is not "
    "copied") {
  const test::TemporaryFolder folder;
  const std::string triangle = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n";
  test::write_file_and_folders(folder / "in/jet.obj", triangle);
  test::write_file_and_folders(folder / "in/m.mtl", "newmtl a\nmap_Kd skin/a.png\n");
  test::write_file_and_folders(folder / "in/skin/a.png", "x");
  test::write_file_and_folders(folder / "a.png", "x");
  REQUIRE(model_copied_into(folder / "out", folder / "in/jet.obj"));
  CHECK(fs::exists(folder / "out/jet/skin/a.png"));
  test::write_file_and_folders(folder / "in/m.mtl", "newmtl a\nmap_Kd ../a.png\nnewmtl b\nmap_Kd skin/a.png\n");
  const Result<fs::path> beside = model_copied_into(folder / "out1", folder / "in/jet.obj");
  REQUIRE(beside);
  CHECK(*beside == folder / "out1/jet/in/jet.obj");
  CHECK(fs::exists(folder / "out1/jet/a.png"));
  CHECK(fs::exists(folder / "out1/jet/in/skin/a.png"));
  test::write_file_and_folders(folder / "far/in/jet.obj", triangle);
  test::write_file_and_folders(folder / "far/in/m.mtl", "newmtl a\nmap_Kd ../../a.png\n");
  const Result<fs::path> outside = model_copied_into(folder / "out2", folder / "far/in/jet.obj");
  REQUIRE_FALSE(outside);
  CHECK(outside.error().text().find("a.png") != std::string::npos);
  CHECK_FALSE(fs::exists(folder / "out2"));
}

TEST_CASE("every sample model can be copied, with all of its files") {
  const test::TemporaryFolder folder;
  int count = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(test::source_dir() / "assets/models")) {
    const fs::path obj = entry.path() / (entry.path().filename().string() + ".obj");
    if (!fs::exists(obj)) continue;
    const Result<fs::path> copied = model_copied_into(folder.path(), obj);
    REQUIRE_MESSAGE(copied, copied.error().text());
    const Result<std::vector<fs::path>> original = files_of_model(obj), copies = files_of_model(*copied);
    REQUIRE(copies);
    CHECK(copies->size() == original->size());
    for (const fs::path& file : *copies) CHECK_MESSAGE(fs::exists(file), file);
    ++count;
  }
  CHECK(count >= 10);
}
