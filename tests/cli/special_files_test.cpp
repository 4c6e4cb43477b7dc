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
                                 {tiny.file("folder" + extension).string(), "folder"}};
  fs::create_symlink("/dev/zero", all[0].path);
  REQUIRE(mkfifo(all[1].path.c_str(), 0600) == 0);
  fs::create_directory(all[2].path);
  return all;
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

TEST_CASE("a device, a pipe or a folder is refused as project and as recipe") {
  check_refused(TinyProject(), ".json", "check ");
  check_refused(TinyProject(), ".json", "dataset --dry-run ");
}

TEST_CASE("a device, a pipe or a folder is refused wherever a project names a file") {
  for (const auto& [key, extension] :
       {std::pair{"footage.video", ".mkv"}, std::pair{"footage.calibration", ".xml"},
        std::pair{"footage.own_body_mask", ".png"}, std::pair{"camera.attitude_file", ".csv"},
        std::pair{"intruders[0].model.file", ".obj"}}) {
    const TinyProject tiny;
    check_refused(tiny, extension, "export " + tiny.project() + " --out " + tiny.out() + " --set '" + key + "=", "'");
  }
}

TEST_CASE("a device, a pipe or a folder is refused by info and mask") {
  for (const char* const extension : {".mkv", ".xml", ".json", ".obj"})
    check_refused(TinyProject(), extension, "info ");
  check_refused(TinyProject(), ".mkv", "mask ");
}

TEST_CASE("a device, a pipe or a folder is refused as labels, results and images of an evaluation") {
  TinyProject made;
  REQUIRE(run_shell("$SIGS export " + made.project() + " --out " + made.out()).status == 0);
  const std::string labels = made.out() + "/tiny.xml";
  check_refused(TinyProject(), ".csv", "evaluate track " + labels + " --results ");
  check_refused(TinyProject(), ".csv", "evaluate detect " + labels + " --results ");
  check_refused(TinyProject(), ".xml", "evaluate track ", " --results " + labels);
}

TEST_CASE("a texture or a library of materials that is a pipe is left out with a warning") {
  const TinyProject tiny;
  REQUIRE(mkfifo(tiny.file("paint.png").c_str(), 0600) == 0);
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
