// SPDX-License-Identifier: MIT
// Devices, pipes and folders where files are expected. 3 GB of memory would be used up within seconds of reading one.
#include <doctest/doctest.h>

#include <sys/stat.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "cli/shell.h"
#include "cli/tiny_project.h"
#include "project/fields.h"
#include "project/project.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

namespace fs = std::filesystem;

struct Special {
  std::string path;
  std::string word;  // of the message
};

// One of each kind, with the name of the input.
std::vector<Special> specials(const TinyProject& tiny, const std::string& extension) {
  const std::vector<Special> all{{tiny.file("zero" + extension).string(), "device"},
                                 {tiny.file("pipe" + extension).string(), "pipe"},
                                 {tiny.file("folder" + extension).string(), "folder"},
                                 {tiny.file("kernel" + extension).string(), "kernel"}};
  fs::create_symlink("/dev/zero", all[0].path);
  REQUIRE(mkfifo(all[1].path.c_str(), 0600) == 0);
  fs::create_directory(all[2].path);
  fs::create_symlink("/proc/kmsg", all[3].path);  // a regular file by its mode; reading it waits for ever
  return all;
}

// Replaces the footage by a folder of images, as which alone it may have a file of times.
void put_images_in_place_of_video(TinyProject& tiny) {
  fs::create_directory(tiny.file("images"));
  for (const char* const name : {"0.png", "1.png"})
    REQUIRE(cv::imwrite((tiny.file("images") / name).string(), cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(90))));
  tiny.change("clip.mkv", "images");
}

Run run_limited(const std::string& arguments) {
  return run_shell("ulimit -v 3000000; $SIGS " + arguments);
}

// before + the special file + after
void check_refused(const TinyProject& tiny, const std::string& extension, const std::string& before,
                   const std::string& after = "") {
  for (const Special& special : specials(tiny, extension)) {
    const Run run = run_limited(before + special.path + after);
    CAPTURE(before + special.path + after);
    CHECK_MESSAGE(run.status == 66, run.err);
    CHECK_MESSAGE(is_one_error(run), run.err);
    CHECK_MESSAGE(has(run.err, special.word), run.err);
    CHECK(tiny.files_out() == 0);
  }
}

}  // namespace

TEST_CASE("a device, a pipe, a folder or a file of the kernel is refused as project and as recipe") {
  check_refused(TinyProject(), ".json", "check ");
  check_refused(TinyProject(), ".json", "dataset --dry-run ");
}

TEST_CASE("a device, a pipe, a folder or a file of the kernel is refused wherever a project names a file") {
  Project project;
  project.intruders.resize(1);
  int tried = 0;
  for (const Field& field : fields_of(project)) {
    if (!field.is_path) continue;
    TinyProject tiny;
    if (field.key == "footage.timestamps") put_images_in_place_of_video(tiny);
    const std::string extension = field.key == "footage.video" ? ".mkv" : field.key.ends_with("mask") ? ".png" : ".txt";
    check_refused(tiny, extension, "export " + tiny.project() + " --out " + tiny.out() + " --set '" + field.key + "=",
                  "'");
    ++tried;
  }
  CHECK(tried >= 8);  // those of version 0.1.0
}

TEST_CASE("a device, a pipe, a folder or a file of the kernel is refused by info and mask") {
  for (const char* const extension : {".mkv", ".xml", ".json", ".obj"})
    check_refused(TinyProject(), extension, "info ");
  check_refused(TinyProject(), ".mkv", "mask ");
}

TEST_CASE(
    "a device, a pipe, a folder or a file of the kernel is refused as labels, results and images of an evaluation") {
  TinyProject made;
  REQUIRE(run_shell("$SIGS export " + made.project() + " --out " + made.out()).status == 0);
  const std::string labels = made.out() + "/tiny.xml";
  check_refused(TinyProject(), ".csv", "evaluate track " + labels + " --results ");
  check_refused(TinyProject(), ".csv", "evaluate detect " + labels + " --results ");
  check_refused(TinyProject(), ".xml", "evaluate track ", " --results " + labels);
}

TEST_CASE("a texture or a library of materials that is a pipe or a file of the kernel is left out with a warning") {
  const TinyProject tiny;
  fs::create_symlink("/proc/kmsg", tiny.file("paint.png"));
  write_file(tiny.file("cube.mtl"), "newmtl paint\nKd 1 1 1\nmap_Kd paint.png\n");
  const Run textured = run_limited("export " + tiny.project() + " --out " + tiny.out());
  CHECK_MESSAGE(textured.status == 0, textured.err);
  CHECK_MESSAGE(has(textured.err, "paint.png"), textured.err);
  fs::remove(tiny.file("cube.mtl"));
  REQUIRE(mkfifo(tiny.file("cube.mtl").c_str(), 0600) == 0);
  const Run coloured = run_limited("export --force " + tiny.project() + " --out " + tiny.out());
  CHECK_MESSAGE(coloured.status == 0, coloured.err);
  CHECK_MESSAGE(has(coloured.err, "cube.mtl"), coloured.err);
}

TEST_CASE(
    "images and videos whose headers claim a hundred thousand pixels a side are refused and nothing is allocated") {
  const TinyProject tiny;
  const std::string ppm = "P6\n100000 100000\n255\n" + std::string(100, 'x');
  const std::string y4m = "YUV4MPEG2 W16400 H8000 F25:1 Ip A1:1 C420jpeg\nFRAME\n" + std::string(100, 'x');
  write_file(tiny.file("large.ppm"), ppm);
  write_file(tiny.file("large.y4m"), y4m);
  write_file(tiny.file("cube.mtl"), "newmtl paint\nKd 1 1 1\nmap_Kd large.ppm\n");
  const std::string check = "check " + tiny.project();
  const Run textured = run_limited(check);
  CHECK_MESSAGE(textured.status == 0, textured.err);
  CHECK_MESSAGE(has(textured.err, "is 100000x100000; at most 8192x8192"), textured.err);
  for (const char* const field : {"footage.own_body_mask", "footage.occluder_mask"}) {
    const Run masked = run_limited(check + " --set " + field + "=large.ppm");
    CHECK_MESSAGE(masked.status == 65, masked.err);
    CHECK_MESSAGE(has(masked.err, "is 100000x100000, the footage is 64x48"), masked.err);
  }
  const Run video = run_limited("info " + tiny.file("large.y4m").string());
  CHECK_MESSAGE(video.status == 65, video.err);
  CHECK_MESSAGE(has(video.err, "is 16400x8000; images of at most 16384 pixels a side"), video.err);
  fs::create_directory(tiny.file("images"));
  // The size is that of the header alone; the checksum of the chunk is not looked at before it.
  write_file(
      tiny.file("images") / "0.png",
      std::string("\x89PNG\r\n\x1A\n\0\0\0\rIHDR\0\1\x86\xA0\0\1\x86\xA0\x8\2\0\0\0", 29) + std::string(100, 'x'));
  const Run images = run_limited("info " + tiny.file("images").string());
  CHECK_MESSAGE(images.status == 65, images.err);
  CHECK_MESSAGE(has(images.err, "is 100000x100000; images of at most 16384"), images.err);
}

TEST_CASE("links to regular files are inputs like any other") {
  const TinyProject tiny;
  for (const char* const name : {"p.json", "clip.mkv", "lens.xml", "cube.obj", "cube.mtl"}) {
    fs::rename(tiny.file(name), tiny.file(std::string("real.") + name));
    fs::create_symlink(std::string("real.") + name, tiny.file(name));
  }
  const Run run = run_limited("check " + tiny.project());
  CHECK_MESSAGE(run.status == 0, run.err);
  CHECK_MESSAGE(run.err.empty(), run.err);
}

TEST_CASE("a calibration above the size limit is refused before it is read") {
  const TinyProject tiny;
  fs::resize_file(tiny.file("lens.xml"), std::uintmax_t{1} << 33);  // sparse
  const Run run = run_limited("check " + tiny.project());
  CHECK_MESSAGE(run.status == 65, run.err);
  CHECK_MESSAGE(has(run.err, "lens.xml: is larger than 4 MiB"), run.err);
}

TEST_CASE("playlists are refused, those that never end too") {
  const TinyProject tiny;
  const std::string clip = tiny.file("clip.mkv").string();
  write_file(
      tiny.file("live.m3u8"),
      "#EXTM3U\n#EXT-X-VERSION:3\n#EXT-X-TARGETDURATION:2\n#EXT-X-MEDIA-SEQUENCE:0\n#EXTINF:2.0,\n" + clip + "\n");
  write_file(tiny.file("plain.m3u"), "#EXTM3U\n" + clip + "\n");
  write_file(tiny.file("list.ffconcat"), "ffconcat version 1.0\nfile '" + clip + "'\n");
  write_file(tiny.file("clip.mpd"),
             "<?xml version=\"1.0\"?>\n<MPD xmlns=\"urn:mpeg:dash:schema:mpd:2011\" type=\"dynamic\">"
             "<Period><AdaptationSet><Representation><BaseURL>" +
                 clip + "</BaseURL></Representation></AdaptationSet></Period></MPD>\n");
  for (const char* const name : {"live.m3u8", "plain.m3u", "list.ffconcat", "clip.mpd"}) {
    const Run run = run_limited("info " + tiny.file(name).string());
    CHECK_MESSAGE(run.status == 66, run.err);
    CHECK_MESSAGE(is_one_error(run), run.err);
    CHECK_MESSAGE(has(run.err, "is a playlist"), run.err);
  }
}
