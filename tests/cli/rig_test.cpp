// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "cli/program.h"
#include "cli/tiny_project.h"
#include "project/json.h"
#include "support/files.h"
#include "support/process.h"
#include "support/test_data.h"

namespace sigs::test {

namespace {

Run run_rig(const std::string& arguments) {
  return run_together("'" + (build_dir() / "sigs").string() + "' rig " + arguments);
}

// Two cameras of 64x48, the second 90 degrees to the right and 0.5 m to the right of the first.
const std::string kRigChain =
    "cam0:\n  camera_model: pinhole\n  intrinsics: [60, 60, 31.5, 23.5]\n  distortion_model: radtan\n"
    "  distortion_coeffs: [0, 0, 0, 0]\n  resolution: [64, 48]\n  timeshift_cam_imu: 0.001\n"
    "  T_cam_imu: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]\n"
    "cam1:\n  camera_model: pinhole\n  intrinsics: [60, 60, 31.5, 23.5]\n  distortion_model: radtan\n"
    "  distortion_coeffs: [0, 0, 0, 0]\n  resolution: [64, 48]\n  timeshift_cam_imu: 0.251\n"
    "  T_cn_cnm1: [[0, 0, -1, 0], [0, 1, 0, 0], [1, 0, 0, -0.5], [0, 0, 0, 1]]\n";

const std::string kRigProject =
    R"({"sigs": 1, "name": "rig", "cameras": [
      {"name": "nose", "footage": {"video": "a.mkv", "calibration": "chain.yaml#cam0"}, "mount": {"position_m": [1, 0, 0], "attitude_deg": {"roll": 0, "pitch": 0, "yaw": 30}}},
      {"name": "side", "footage": {"video": "b.mkv"}}], "intruders": []})";

bool rig_says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a rig's calibration goes into a project with the mount of its first camera, and says what it is") {
  const TemporaryFolder folder;
  write_file(folder / "chain.yaml", kRigChain);
  write_file(folder / "rig.json", kRigProject);
  const Run said = run_rig("calibration '" + (folder / "chain.yaml").string() + "'");
  CHECK(said.status == 0);
  CHECK(rig_says(said.out, "Kalibr chain, 2 cameras"));
  CHECK(rig_says(said.out, "0.250000"));
  const Run done =
      run_rig("calibration '" + (folder / "chain.yaml").string() + "' --into '" + (folder / "rig.json").string() + "'");
  CAPTURE(done.out);
  REQUIRE(done.status == 0);
  const auto read = read_project(folder / "rig.json");
  REQUIRE(read);
  REQUIRE(read->project.cameras.size() == 2);
  const RigCamera& side = read->project.cameras[1];
  CHECK(side.footage.calibration == "chain.yaml#cam1");
  CHECK(side.clock.offset_s == doctest::Approx(0.25));
  CHECK(side.mount.yaw_deg == doctest::Approx(120));
  // 0.5 m to the right of a camera that looks 30 degrees to the right.
  CHECK(side.mount.position_m.x == doctest::Approx(1 - 0.5 * 0.5));
  CHECK(side.mount.position_m.y == doctest::Approx(0.5 * std::sqrt(0.75)));
  CHECK(read->project.cameras[0].mount.yaw_deg == 30);
}

TEST_CASE(
    "clocks by sound and time code go into a project; without any source the status is 65 and nothing is written") {
  const TemporaryFolder folder;
  write_file(folder / "chain.yaml", kRigChain);
  write_file(folder / "rig.json", kRigProject);
  const std::string noise = "-f lavfi -i anoisesrc=d=12:c=pink:r=16000:seed=5 ";
  const auto made = [&](const std::string& arguments) {
    return std::system(("ffmpeg -v error -y " + arguments + " </dev/null >/dev/null 2>&1").c_str()) == 0;
  };
  if (!made("-f lavfi -i testsrc=size=64x48:rate=25:duration=12 " + noise +
            "-c:v mpeg4 -c:a pcm_s16le -timecode 10:00:00:00 '" + (folder / "a.mkv").string() + "'") ||
      !made("-f lavfi -i testsrc=size=64x48:rate=25:duration=8 -ss 2.5 " + noise +
            "-shortest -c:v mpeg4 -c:a pcm_s16le -timecode 10:00:02:12 '" + (folder / "b.mkv").string() + "'"))
    return say_skipped("ffmpeg is not installed");
  const std::string project = "'" + (folder / "rig.json").string() + "'";
  const Run none = run_rig("sync " + project + " --by log --into");
  CHECK(none.status == 65);
  CHECK(rig_says(none.out, "has no log"));
  CHECK(read_project(folder / "rig.json")->project.cameras[1].clock.offset_s == 0);
  const Run done = run_rig("sync " + project + " --by sound,timecode --into");
  CAPTURE(done.out);
  REQUIRE(done.status == 0);
  CHECK(rig_says(done.out, "time code"));
  CHECK(read_project(folder / "rig.json")->project.cameras[1].clock.offset_s == doctest::Approx(2.5).epsilon(0.001));
  CHECK(run_rig("sync " + project + " --by stars").status == 64);
}

TEST_CASE("the clocks of the sample rig are found by its cameras' turns, with and without its mounts") {
  const auto sample = read_project(source_dir() / "projects" / "rig" / "rig.json");
  REQUIRE(sample);
  for (const char* const option : {"", " --find-mounts"}) {
    const TemporaryFolder folder;
    Project unset = sample->project;
    for (RigCamera& camera : unset.cameras) {
      camera.clock = {};
      for (std::string* const file :
           {&camera.footage.video, &camera.footage.calibration, &camera.footage.own_body_mask})
        if (!file->empty()) *file = (sample->project.file.parent_path() / *file).string();
    }
    REQUIRE(write_project(unset, folder / "rig.json", true));
    const Run done =
        run_rig("sync '" + (folder / "rig.json").string() + "' --by turns --progress none --into" + option);
    CAPTURE(done.out);
    REQUIRE(done.status == 0);
    const auto read = read_project(folder / "rig.json");
    REQUIRE(read);
    for (std::size_t i = 1; i < sample->project.cameras.size(); ++i) {
      const double error_s = read->project.cameras[i].clock.offset_s - sample->project.cameras[i].clock.offset_s;
      CAPTURE(sample->project.cameras[i].name);
      CHECK(std::abs(error_s) < 0.005);
    }
  }
}

TEST_CASE("two cameras in one image, as of a stereo camera, give what FFmpeg's crop of each gives") {
  const TinyProject tiny(10);
  const auto in = [&](const std::string& name) { return "'" + tiny.file(name).string() + "'"; };
  const auto ffmpeg = [](const std::string& arguments) {
    return std::system(("ffmpeg -v error -y " + arguments + " </dev/null >/dev/null 2>&1").c_str()) == 0;
  };
  const std::string lossless = " -c:v ffv1 -level 3 ";
  if (!ffmpeg("-f lavfi -i testsrc2=size=132x52:rate=25:duration=0.4 -pix_fmt yuv420p" + lossless + in("both.mkv")))
    return say_skipped("ffmpeg is not installed");
  for (const char* const folder : {"left", "right"}) std::filesystem::create_directory(tiny.file(folder));
  REQUIRE(ffmpeg("-i " + in("both.mkv") + " -vf crop=64:48:2:4:exact=1" + lossless + in("left/both.mkv")));
  REQUIRE(ffmpeg("-i " + in("both.mkv") + " -vf crop=64:48:68:4:exact=1" + lossless + in("right/both.mkv")));
  const std::string intruders = text_of(tiny.file("p.json")).substr(text_of(tiny.file("p.json")).find("\"intruders\""));
  const auto project = [&](const std::string& left, const std::string& right) {
    return R"({"sigs": 1, "name": "pair", "export": {"video": {"codec": "ffv1"}, "labels": ["csv"]}, "cameras": [
      {"name": "left", "footage": {)" +
           left + R"(, "calibration": "lens.xml"}},
      {"name": "right", "footage": {)" +
           right + R"(, "calibration": "lens.xml"}, "mount": {"position_m": [0, 1, 0]}}],
      )" + intruders;
  };
  const std::string size = R"("width_px": 64, "height_px": 48)";
  write_file(tiny.file("one.json"),
             project(R"("video": "both.mkv", "crop": {"left_px": 2, "top_px": 4, )" + size + "}",
                     R"("video": "both.mkv", "crop": {"left_px": 68, "top_px": 4, "height_px": 48})"));
  write_file(tiny.file("two.json"), project(R"("video": "left/both.mkv")", R"("video": "right/both.mkv")"));
  for (const std::string name : {"one", "two"}) {
    const Run done = run_sigs("export " + in(name + ".json") + " --progress none --out " + in(name));
    CAPTURE(done.err);
    REQUIRE(done.status == 0);
    for (const std::string camera : {"left", "right"}) {
      REQUIRE(ffmpeg("-i " + in(name + "/pair." + camera + ".mkv") + " -f framemd5 " + in(name + camera)));
      const Run frame = run_sigs("frame " + in(name + ".json") + " --camera " + camera + " --frame 5 --out " +
                                 in(name + camera + "_frame"));
      CAPTURE(frame.err);
      CHECK(frame.status == 0);
    }
  }
  for (const std::string camera : {"left", "right"}) {
    CAPTURE(camera);
    CHECK(rig_says(text_of(tiny.file("one" + camera)), "64x48"));
    CHECK(text_of(tiny.file("one" + camera)) == text_of(tiny.file("two" + camera)));
    CHECK(text_of(tiny.file("one/pair." + camera + ".csv")) == text_of(tiny.file("two/pair." + camera + ".csv")));
    int images = 0;
    for (const auto& image : std::filesystem::recursive_directory_iterator(tiny.file("one" + camera + "_frame"))) {
      if (image.path().extension() != ".png") continue;
      const auto twin = tiny.file("two" + camera + "_frame") / image.path().filename();
      CHECK(text_of(image.path()) == text_of(twin));
      ++images;
    }
    CHECK(images > 0);
  }
  CHECK(text_of(tiny.file("oneleft")) != text_of(tiny.file("oneright")));

  // A calibration made for the whole image says the same once its principal point is moved.
  write_file(tiny.file("whole.yaml"), "K: [80, 0, 99.5, 0, 80, 27.5, 0, 0, 1]\nD: []\nimage_size: [132, 52]\n");
  write_file(tiny.file("part.yaml"), "K: [80, 0, 31.5, 0, 80, 23.5, 0, 0, 1]\nD: []\nimage_size: [64, 48]\n");
  for (const std::string calibration : {"whole", "part"}) {
    const Run done =
        run_sigs("export " + in("p.json") + " --set footage.video=both.mkv --set footage.crop.left_px=68 " +
                 "--set footage.crop.top_px=4 --set footage.calibration=" + calibration +
                 ".yaml --progress none --out " + in(calibration));
    CAPTURE(done.err);
    CHECK(done.status == 0);
    CHECK(rig_says(done.err, "made for the whole footage, 132x52") == (calibration == "whole"));
  }
  const std::string by_whole = text_of(tiny.file("whole/tiny.xml"));
  CHECK(by_whole.substr(by_whole.find("<intruder ")) ==
        text_of(tiny.file("part/tiny.xml")).substr(text_of(tiny.file("part/tiny.xml")).find("<intruder ")));
  const auto refused = [&](const std::string& set) {
    return run_sigs("export " + in("p.json") + " --set footage.video=both.mkv " + set + " --out " + in("none"));
  };
  const Run beyond = refused("--set footage.crop.left_px=100 --set footage.crop.width_px=64");
  CHECK(beyond.status == 65);
  CHECK_MESSAGE(rig_says(beyond.err, "64x52 from (100, 0) on is not within the footage's 132x52"), beyond.err);
  CHECK(rig_says(refused("--set footage.crop.left_px=132").err, "is not within"));
  CHECK(rig_says(refused("--set footage.crop.left_px=1").err,
                 "footage.crop.left_px: its corner (1, 0) is not on a sample of colour"));
  CHECK(rig_says(refused("--set footage.crop.left_px=2 --set export.video.codec=source").err, "copies packets"));
}

TEST_CASE("an intruder that no camera of a rig sees gives one warning, and one that a camera sees none") {
  const TinyProject tiny(4);
  const std::string whole = text_of(tiny.file("p.json"));
  const std::string intruders = whole.substr(whole.find("\"intruders\""));
  const std::string footage = R"("footage": {"video": "clip.mkv", "calibration": "lens.xml"})";
  for (const bool one_sees : {true, false}) {
    CAPTURE(one_sees);
    const std::string back = R"("mount": {"attitude_deg": {"yaw": 180}})";
    write_file(tiny.file("rig.json"), R"({"sigs": 1, "name": "rig", "cameras": [{"name": "one", )" + footage + ", " +
                                          back + R"(}, {"name": "two", )" + footage +
                                          (one_sees ? std::string("}") : ", " + back + "}") + "], " + intruders);
    const std::string name = "'" + tiny.file("rig.json").string() + "'";
    const std::string out = " --progress none --out '" + tiny.file(one_sees ? "seen" : "unseen").string() + "'";
    for (const Run& done : {run_sigs("check " + name), run_sigs("export " + name + out)}) {
      CAPTURE(done.err);
      CHECK(done.status == 0);
      CHECK(rig_says(done.err, "visible in no camera") != one_sees);
      CHECK_FALSE(rig_says(done.err, "never visible"));
    }
    const Run first = run_sigs("check " + name + " --camera one");
    CHECK_FALSE(rig_says(first.err, "visible in no camera"));
  }
}

}  // namespace sigs::test
