// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "base/staged_outputs.h"
#include "cli/program.h"
#include "cli/tiny_project.h"
#include "support/test_data.h"
#include "video/clips.h"

using namespace sigs;
using namespace sigs::test;

namespace {

// One line of error on stderr, the right exit status, and no file left.
void check_refused(const TinyProject& tiny, int status, const std::string& message, const std::string& more = "") {
  const Run run = run_sigs("export " + tiny.project() + " --out " + tiny.out() + " " + more);
  CHECK_MESSAGE(run.status == status, run.err);
  CHECK_MESSAGE(has(run.err, message), run.err);
  CHECK_MESSAGE(has(run.err, "error: "), run.err);
  CHECK_MESSAGE(std::count(run.err.begin(), run.err.end(), '\n') == 1, run.err);
  CHECK(run.out.empty());
  CHECK(tiny.files_out() == 0);
}

void cut(const std::filesystem::path& path, double share) {
  std::filesystem::resize_file(
      path, static_cast<std::uintmax_t>(static_cast<double>(std::filesystem::file_size(path)) * share));
}

}  // namespace

TEST_CASE("a missing project exits with status 66") {
  const Run run = run_sigs("export nowhere.json");
  CHECK(run.status == 66);
  CHECK(run.err == "error: nowhere.json: no such file\n");
}

TEST_CASE("a project that is not JSON exits with status 78 and names the line") {
  const TinyProject tiny;
  write_file(tiny.project(), "{\n \"sigs\": 1,\n");
  check_refused(tiny, 78, "p.json: is not JSON");
}

TEST_CASE("a missing video is named by its field") {
  TinyProject tiny;
  tiny.change("clip.mkv", "gone.mkv");
  check_refused(tiny, 66, "p.json: footage.video: no such file");
}

TEST_CASE("a file that is not a video is reported by its field") {
  const TinyProject tiny;
  write_file(tiny.file("clip.mkv"), "this is no video");
  const Run run = run_sigs("export " + tiny.project() + " --out " + tiny.out());
  CHECK((run.status == 65 || run.status == 66));
  CHECK_MESSAGE(has(run.err, "p.json: footage.video: "), run.err);
  CHECK(tiny.files_out() == 0);
}

TEST_CASE("a video that ends early gives the frames that are there") {
  TinyProject tiny;
  cut(tiny.file("clip.mkv"), 0.6);
  tiny.change(R"({"frame": 9,)", R"({"frame": 5,)");
  const Run run = run_sigs("export " + tiny.project() + " --out " + tiny.out());
  CHECK_MESSAGE(run.status == 0, run.err);
  CHECK_MESSAGE(has(run.err, "warning: "), run.err);
  CHECK(tiny.files_out() == 3);
}

TEST_CASE("an option without a value is refused by its name, and a setting is named once") {
  const TinyProject tiny;
  check_refused(tiny, 64, "error: --frames: has no value", "--frames ''");
  check_refused(tiny, 64, "error: --codec: has no value", "--codec ''");
  check_refused(tiny, 64, "error: --set: has no value", "--set ''");
  check_refused(tiny, 64, "error: --set camera.speed_mps=nan: expected", "--set camera.speed_mps=nan");
  check_refused(tiny, 78, "light.ambient: is 1.0000001; it must lie between 0 and 1", "--set light.ambient=1.0000001");
  const Run below = run_sigs("evaluate detect a.xml --results b.csv --split ''");
  CHECK(below.status == 64);
  CHECK_MESSAGE(has(below.err, "error: --split: has no value"), below.err);
}

TEST_CASE("a calibration with too few numbers or NaN is named by file and key") {
  const TinyProject tiny;
  const std::string lens = read_text(tiny.file("lens.xml")).value();
  std::string few = lens;
  few.replace(few.find("23.5 0. 0. 1."), 13, "23.5");
  write_file(tiny.file("lens.xml"), few);
  check_refused(tiny, 65, "p.json: footage.calibration: ");
  std::string nan = lens;
  nan.replace(nan.find("-0.1 0.01"), 9, ".Nan 0.01");
  write_file(tiny.file("lens.xml"), nan);
  check_refused(tiny, 65, "lens.xml: distortion_coefficients");
}

TEST_CASE("an OBJ without faces or with indices out of range is named by its field") {
  const TinyProject tiny;
  write_file(tiny.file("cube.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  check_refused(tiny, 65, "p.json: intruders[0].model.file: ");
  write_file(tiny.file("cube.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  check_refused(tiny, 65, "p.json: intruders[0].model.file: ");
}

TEST_CASE("a missing MTL or texture is drawn grey with a warning") {
  const TinyProject tiny;
  std::filesystem::remove(tiny.file("cube.mtl"));
  const Run run = run_sigs("export " + tiny.project() + " --out " + tiny.out());
  CHECK_MESSAGE(run.status == 0, run.err);
  CHECK_MESSAGE(has(run.err, "warning: "), run.err);
  CHECK_MESSAGE(has(run.err, "cube.mtl"), run.err);
  write_file(tiny.file("cube.mtl"), "newmtl paint\nKd 1 1 1\nmap_Kd gone.png\n");
  const Run textured = run_sigs("export " + tiny.project() + " --force --out " + tiny.out());
  CHECK_MESSAGE(textured.status == 0, textured.err);
  CHECK_MESSAGE(has(textured.err, "gone.png"), textured.err);
}

TEST_CASE("unknown keys give warnings and the export continues") {
  TinyProject tiny;
  tiny.change(R"("name": "tiny",)", R"("name": "tiny", "colour": "red",)");
  const Run run = run_sigs("export " + tiny.project() + " --out " + tiny.out());
  CHECK(run.status == 0);
  CHECK_MESSAGE(has(run.err, "p.json: colour: unknown key"), run.err);
}

TEST_CASE("waypoints that are not finite or have equal frames exit with status 78") {
  TinyProject tiny;
  tiny.change(R"({"frame": 9,)", R"({"frame": 0,)");
  check_refused(tiny, 78, "p.json: intruders[0].trajectory.waypoints[1].frame: is 0, not after waypoints[0]");
  tiny.change("[20, 3, -150]", "[20, NaN, -150]");
  check_refused(tiny, 78, "p.json: is not JSON");
}

TEST_CASE("waypoints without frames that fall into one frame exit with status 78") {
  TinyProject tiny;
  tiny.change(R"({"frame": 9, )", "{");
  check_refused(tiny, 78, "p.json: intruders[0].trajectory.waypoints", "--set footage.last_frame=0");
}

TEST_CASE("a mask of another size says both sizes") {
  TinyProject tiny;
  cv::imwrite(tiny.file("m.png").string(), cv::Mat::zeros(10, 10, CV_8UC1));
  tiny.change(R"("calibration")", R"("own_body_mask": "m.png", "calibration")");
  check_refused(tiny, 65, "p.json: footage.own_body_mask: ");
}

TEST_CASE("frames beyond the footage exit with status 64, a project's range beyond it with status 78") {
  const TinyProject tiny;
  check_refused(tiny, 64, "the project has frames 0 to 9", "--frames 5-12");
  check_refused(tiny, 64, "expected A-B", "--frames 5-x");
  check_refused(tiny, 78, "the footage has 10 frames", "--set footage.last_frame=12");
}

TEST_CASE("a folder that cannot be created exits with status 73") {
  const TinyProject tiny;
  write_file(tiny.file("blocked"), "a file where a folder is wanted");
  const Run run = run_sigs("export " + tiny.project() + " --out " + tiny.file("blocked/out").string());
  CHECK(run.status == 73);
  CHECK_MESSAGE(has(run.err, "blocked/out"), run.err);
}

TEST_CASE("a full disk exits with status 74 and leaves no file") {
  const TinyProject tiny;
  const Run run = run_sigs_after(kFullDisk, "export " + tiny.project() + " --out " + tiny.out());
  CHECK_MESSAGE(run.status == 74, run.err);
  CHECK_MESSAGE(has(run.err, "tiny.mkv"), run.err);
  CHECK(tiny.files_out() == 0);
}

TEST_CASE("an unsupported pair of codec and container exits with status 78 before anything is written") {
  const TinyProject tiny;
  check_refused(tiny, 78, "export.video.container: mp4 cannot hold ffv1", "--codec ffv1 --container mp4");
  check_refused(tiny, 78, "export.video.container: avi cannot hold hevc", "--codec hevc --container avi");
  check_refused(tiny, 78, "export.video.container: avi cannot hold av1", "--codec av1 --container avi");
}

TEST_CASE("a crf beyond the codec's range is refused") {
  const TinyProject tiny;
  check_refused(tiny, 64, "--crf 52: is 52; of h264 and hevc 51 is the worst", "--codec hevc --crf 52");
  check_refused(tiny, 78, "export.video.crf: is 52; of h264 and hevc 51 is the worst",
                "--codec hevc --set export.video.crf=52");
}

TEST_CASE("h264 of an odd size is named by its field before anything is written") {
  const TinyProject tiny(10, {63, 48});
  check_refused(tiny, 78, "p.json: export.video.codec: h264 needs an even width and height, the footage is 63x48",
                "--codec h264");
  check_refused(tiny, 78, "hevc needs an even width", "--codec hevc");
  const Run run = run_sigs("check " + tiny.project() + " --set export.video.codec=h264");
  CHECK(run.status == 78);
}

TEST_CASE("output that cannot be written is not a success") {
  if (!std::filesystem::exists("/dev/full")) {
    say_skipped("no /dev/full");
    return;
  }
  const TinyProject tiny;
  const std::string command = (build_dir() / "sigs").string() + " check " + tiny.project() + " >/dev/full 2>/dev/null";
  CHECK(WEXITSTATUS(std::system(command.c_str())) == 74);
}

TEST_CASE("waypoints spread over too few frames are reported in frames") {
  TinyProject tiny;
  tiny.change(R"({"frame": 9, )", R"({"position_m": [20, 0, -150]}, {"frame": 30, )");
  tiny.change(R"({"frame": 0, )", R"({"frame": 40, )");
  const Run run = run_sigs("export " + tiny.project() + " --out " + tiny.out());
  CHECK(run.status == 78);
  CHECK_MESSAGE(has(run.err, "waypoints[2].frame: is 30, not after waypoints[0]"), run.err);
}

namespace {

// A bit flipped in the last byte, the checksum, of these frames' packets.
void damage_frames(const std::filesystem::path& clip, int first, int count) {
  std::vector<uint8_t> bytes = bytes_of(clip);
  const std::vector<PacketPlace> packets = packets_of(clip);
  for (int i = first; i < first + count; ++i) {
    const PacketPlace& packet = packets.at(static_cast<std::size_t>(i));
    bytes[packet.offset + packet.size - 1] ^= 0x04;
  }
  write_bytes(clip, bytes);
}

}  // namespace

TEST_CASE("more damaged frames than are allowed are an error that says how to allow them") {
  const TinyProject tiny;
  damage_frames(tiny.file("clip.mkv"), 4, 2);
  const Run refused = run_sigs("export " + tiny.project() + " --out " + tiny.out());
  CHECK(refused.status == 65);
  CHECK_MESSAGE(has(refused.err, "damaged"), refused.err);
  CHECK_MESSAGE(has(refused.err, "footage.max_substituted_percent"), refused.err);
  CHECK(tiny.files_out() == 0);

  const Run allowed =
      run_sigs("export " + tiny.project() + " --set footage.max_substituted_percent=20 --out " + tiny.out());
  CHECK_MESSAGE(allowed.status == 0, allowed.err);
  CHECK_MESSAGE(has(allowed.err, "2 of 10 frames of the footage are damaged"), allowed.err);
}

TEST_CASE("folders made for an export that fails are gone again, and those that were there stay") {
  const TinyProject tiny;
  std::filesystem::create_directory(tiny.file("mine"));
  damage_frames(tiny.file("clip.mkv"), 4, 2);
  for (const char* folder : {"mine/new/deep", "mine"}) {
    const Run run = run_sigs("export " + tiny.project() + " --out " + tiny.file(folder).string());
    CHECK_MESSAGE(run.status != 0, run.err);
    CHECK(std::filesystem::is_empty(tiny.file("mine")));
  }
}

TEST_CASE("a substituted frame is marked in the labels") {
  const TinyProject tiny;
  damage_frames(tiny.file("clip.mkv"), 4, 2);
  const Run run = run_sigs("export " + tiny.project() + " --set footage.max_substituted_percent=20 --labels xml,csv" +
                           " --set name=x --out " + tiny.out());
  REQUIRE_MESSAGE(run.status == 0, run.err);
  const std::string xml = read_text(std::filesystem::path(tiny.out()) / "x.xml").value();
  for (int n = 0; n < 10; ++n) {
    CAPTURE(n);
    const std::size_t begin = xml.find("<frame index=\"" + std::to_string(n) + "\"");
    REQUIRE(begin != std::string::npos);
    const std::string element = xml.substr(begin, xml.find('>', begin) - begin);
    CHECK(has(element, "substituted=\"true\"") == (n == 4 || n == 5));
  }
  const std::string csv = read_text(std::filesystem::path(tiny.out()) / "x.csv").value();
  CHECK(has(csv.substr(0, csv.find('\n')), ",substituted"));
  CHECK(has(csv, ",true,project,project,"));
  const Run frame = run_sigs("frame " + tiny.project() + " --frame 4 --out " + tiny.out());
  CHECK(frame.status == 0);
  CHECK_MESSAGE(has(frame.err, "frame 4 is damaged"), frame.err);
}
