// SPDX-License-Identifier: MIT
// Videos and labels through real pipes, read by other programs: ffmpeg, head, and readers that are slow or go
// away.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "base/staged_outputs.h"
#include "base/text.h"
#include "cli/program.h"
#include "cli/tiny_project.h"
#include "labels/labels.h"
#include "project/project.h"
#include "support/files.h"
#include "support/test_data.h"

using namespace sigs;
using namespace sigs::test;

namespace {

namespace fs = std::filesystem;

std::string program() {
  return "'" + (build_dir() / "sigs").string() + "'";
}

// Bash, since pipefail and process substitution are its own.
Run run_bash(const TinyProject& tiny, const std::string& script) {
  write_file(tiny.file("script.sh"), "cd '" + tiny.file("").string() + "'\nSIGS=" + program() + "\n" + script);
  return run_command("timeout 300 bash '" + tiny.file("script.sh").string() + "'");
}

bool has_program(const std::string& test) {
  if (std::system((test + " >/dev/null 2>&1").c_str()) == 0) return true;
  say_skipped("cannot be run here: " + test);
  return false;
}

// The checksums of all images in a list that the ffmpeg program wrote.
std::vector<std::string> sums_in(const fs::path& list) {
  std::vector<std::string> sums;
  std::istringstream lines(text_of(list));
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with('#')) sums.push_back(line.substr(line.rfind(',')));
  return sums;
}

// The program with its standard output and descriptor 3 as pipes of ours.
class Streaming {
 public:
  explicit Streaming(const std::vector<std::string>& arguments) {
    int video[2];
    int labels[2];
    REQUIRE(::pipe2(video, O_CLOEXEC) == 0);
    REQUIRE(::pipe2(labels, O_CLOEXEC) == 0);
    const std::string path = (build_dir() / "sigs").string();
    std::vector<char*> words{const_cast<char*>(path.c_str())};
    for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    child_ = ::fork();
    REQUIRE(child_ >= 0);
    if (child_ == 0) {
      ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
      ::setenv("MALLOC_ARENA_MAX", "1", 1);  // what is freed is used again, by whichever thread
      ::dup2(video[1], STDOUT_FILENO);
      const int high = ::fcntl(labels[1], F_DUPFD, 100);
      ::dup2(high, 3);
      ::close(high);
      ::execv(path.c_str(), words.data());
      ::_exit(127);
    }
    ::close(video[1]);
    ::close(labels[1]);
    video_ = video[0];
    labels_ = labels[0];
  }
  Streaming(const Streaming&) = delete;
  Streaming& operator=(const Streaming&) = delete;
  ~Streaming() {
    ::close(video_);
    ::close(labels_);
    if (child_ > 0) {
      ::kill(child_, SIGKILL);
      ::waitpid(child_, nullptr, 0);
    }
  }

  // Up to a count of bytes, fewer at the end.
  std::string read_video(std::size_t count) { return bytes_of(video_, count); }
  std::string read_line(bool of_labels) {
    std::string line;
    for (std::string byte; line.empty() || line.back() != '\n'; line += byte) {
      byte = bytes_of(of_labels ? labels_ : video_, 1);
      if (byte.empty()) break;
    }
    return line;
  }
  [[nodiscard]] pid_t child() const { return child_; }

  // Exit status, or 128 + signal; two minutes at most.
  int ended() {
    int status = 0;
    for (int i = 0; i < 1200; ++i) {
      if (::waitpid(child_, &status, WNOHANG) == child_) {
        child_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return -1;
  }

  [[nodiscard]] bool is_running() {
    int status = 0;
    if (::waitpid(child_, &status, WNOHANG) == 0) return true;
    child_ = -1;
    return false;
  }

 private:
  static std::string bytes_of(int descriptor, std::size_t count) {
    std::string bytes(count, '\0');
    std::size_t there = 0;
    while (there < count) {
      const ssize_t got = ::read(descriptor, bytes.data() + there, count - there);
      if (got <= 0) break;
      there += static_cast<std::size_t>(got);
    }
    bytes.resize(there);
    return bytes;
  }

  pid_t child_ = -1;
  int video_ = -1;
  int labels_ = -1;
};

// Kilobytes that a process has in memory.
long resident_kb(pid_t child) {
  std::ifstream status("/proc/" + std::to_string(child) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmRSS:")) return std::stol(line.substr(6));
  return 0;
}

}  // namespace

TEST_CASE("the images in a pipe are those in the exported file, as the ffmpeg program decodes them") {
  if (!has_program("ffmpeg -version")) return;
  const TinyProject tiny;
  for (const char* const options : {"", "--container y4m", "--codec raw", "--codec ffv1 --container nut --jobs 3"}) {
    CAPTURE(options);
    const Run run = run_bash(tiny, std::string(R"(set -eo pipefail
$SIGS export p.json --out file --force >/dev/null 2>&1
ffmpeg -v error -y -i file/tiny.mkv -f framemd5 file.md5
$SIGS export p.json --out - )") + options +
                                       R"( 2>err.txt | ffmpeg -v error -y -i - -f framemd5 pipe.md5
ls)");
    CHECK_MESSAGE(run.status == 0, run.err << run.out);
    CHECK(sums_in(tiny.file("file.md5")).size() == 10);
    CHECK(sums_in(tiny.file("pipe.md5")) == sums_in(tiny.file("file.md5")));
    CHECK_FALSE(has(text_of(tiny.file("err.txt")), "error"));
    CHECK_FALSE(fs::exists(tiny.file("-")));
  }
}

TEST_CASE("every container keeps the times of frames that are not evenly spaced, or is refused by its name") {
  if (!has_program("ffmpeg -version")) return;
  const TinyProject tiny;
  // Ten frames: five at 25 a second, then five 0.12 s apart.
  REQUIRE(run_bash(tiny,
                   "ffmpeg -v error -i clip.mkv -vf \"setpts='if(lt(N,5),N*0.04,0.2+(N-5)*0.12)/TB'\" "
                   "-vsync vfr -c:v ffv1 uneven.mkv")
              .status == 0);
  const auto times_of = [&](const std::string& file) {
    const Run run = run_bash(
        tiny, "ffprobe -v error -select_streams v -show_entries frame=pts_time -of csv=p=0 " + file + " | tr -d ,");
    std::vector<double> times_s;
    std::istringstream lines(run.out);
    for (double time_s = 0; lines >> time_s;) times_s.push_back(time_s);
    return times_s;
  };
  const std::vector<double> truth = times_of("uneven.mkv");
  REQUIRE(truth.size() == 10);
  REQUIRE(truth.back() == doctest::Approx(0.68));
  int kept = 0, refused = 0;
  for (const std::string codec : {"ffv1", "h264", "hevc", "av1", "mjpeg", "raw"})
    for (const std::string container : {"auto", "mkv", "mp4", "avi", "nut", "y4m"}) {
      CAPTURE(codec);
      CAPTURE(container);
      fs::remove_all(tiny.file("out"));
      const std::string options = " --out out --masks none --codec " + codec + " --container " + container;
      if (run_bash(tiny, "$SIGS export p.json" + options).status != 0)
        continue;  // codec and container do not go together
      fs::remove_all(tiny.file("out"));
      const Run run = run_bash(tiny, "$SIGS export p.json --set footage.video=uneven.mkv" + options + " 2>&1");
      if (run.status != 0) {
        ++refused;
        CHECK(run.status == 78);
        CHECK_MESSAGE(has(run.out, "export.video.container: " + container + " has no times"), run.out);
        CHECK(std::count(run.out.begin(), run.out.end(), '\n') == 1);
        CHECK((container == "avi" || container == "y4m"));
        CHECK_FALSE(fs::exists(tiny.file("out/tiny." + container)));
        CHECK(run_bash(tiny, "$SIGS check p.json --set footage.video=uneven.mkv --set export.video.codec=" + codec +
                                 " --set export.video.container=" + container)
                  .status == 78);
        continue;
      }
      ++kept;
      fs::path video;
      for (const fs::directory_entry& entry : fs::directory_iterator(tiny.file("out")))
        if (entry.path().extension() != ".xml") video = entry.path();
      const std::vector<double> found = times_of("out/" + video.filename().string());
      REQUIRE(found.size() == truth.size());
      for (std::size_t n = 0; n < truth.size(); ++n)
        CHECK(std::abs(found[n] - found[0] - truth[n]) < 1.1e-3);  // Matroska's tick
      CHECK(has(run.out, "mkv is written, not avi") == (codec == "mjpeg" && container == "auto"));
    }
  CHECK(kept >= 15);    // of each codec auto, mkv, mp4 where it goes
  CHECK(refused == 4);  // avi of ffv1, h264, mjpeg; y4m
}

TEST_CASE("a sequence of images gives the frames that the same images in a video give") {
  if (!has_program("ffmpeg -version")) return;
  const TinyProject tiny;
  const Run run = run_bash(tiny, R"(set -e
mkdir images
ffmpeg -v error -i clip.mkv -pix_fmt rgb24 -start_number 31 images/shot_%04d.png
ffmpeg -v error -framerate 25 -start_number 31 -i images/shot_%04d.png -c:v ffv1 -pix_fmt gbrp rgb.mkv
for video in images images/shot_%04d.png rgb.mkv; do
  rm -rf out; $SIGS export p.json --set footage.video=$video --set footage.frame_rate=25 --out out >/dev/null 2>>err.txt
  ffmpeg -v error -y -i out/tiny.mkv -f framemd5 $(echo $video | tr / _).md5
  grep -v '<footage' out/tiny.xml >$(echo $video | tr / _).xml
done)");
  REQUIRE_MESSAGE(run.status == 0, run.err);
  const std::vector<std::string> expected = sums_in(tiny.file("rgb.mkv.md5"));
  CHECK(expected.size() == 10);
  for (const char* const name : {"images", "images_shot_%04d.png"}) {
    CHECK(sums_in(tiny.file(std::string(name) + ".md5")) == expected);
    CHECK(text_of(tiny.file(std::string(name) + ".xml")) == text_of(tiny.file("rgb.mkv.xml")));
  }
}

TEST_CASE("an export does not replace the images that it reads") {
  const TinyProject tiny;
  const Run made =
      run_bash(tiny, "$SIGS export p.json --out . --codec png --masks none --labels none && mv tiny images");
  REQUIRE_MESSAGE(made.status == 0, made.err);
  for (const char* const video : {"images", "images/frame_%06d.png"}) {
    const Run run = run_bash(tiny, std::string("$SIGS export p.json --set footage.video=") + video +
                                       " --set name=images --out . --codec png --masks none --labels none --force");
    CHECK_MESSAGE(run.status == 73, run.err);
    CHECK(has(run.err, "read by this export"));
  }
}

TEST_CASE("folders of labels name and link TIFF and JPEG images by their own extensions") {
  const TinyProject tiny;
  for (const auto& [codec, extension] : {std::pair{"tiff", ".tiff"}, std::pair{"jpeg", ".jpg"}}) {
    for (int run = 0; run < 2; ++run)  // the second replaces what the first has written
      REQUIRE(run_sigs("export " + tiny.project() + " --out " + tiny.out() + " --force --masks none --codec " + codec +
                       " --labels " + listed(kLabelNames, ","))
                  .status == 0);
    const fs::path image = tiny.file("out/tiny/frame_000004") += extension;
    for (const LabelFormat& format : label_formats()) {
      if (!format.is_folder) continue;
      const fs::path folder = tiny.file("out") / ("tiny" + std::string(format.suffix));
      CHECK_MESSAGE(fs::equivalent(image, folder / image_in_labels(format.name, 4, 0, image.extension().string())),
                    format.name);
    }
    for (const auto& text :
         {std::pair{"tiny.mot/tiny/seqinfo.ini", std::string("imExt=") + extension},
          std::pair{"tiny.vot/tiny/sequence", std::string("color/%08d") + extension},
          std::pair{"tiny.coco.json", std::string("tiny/frame_000004") + extension},
          std::pair{"tiny.aot.json", std::string("tiny/frame_000004") + extension},
          std::pair{"tiny.voc/Annotations/frame_000004.xml", std::string("<filename>frame_000004") + extension}})
      CHECK_MESSAGE(has(text_of(tiny.file("out") / text.first), text.second), text.first);
    fs::remove_all(tiny.out());
  }
}

TEST_CASE("the first image is there long before the last one is composed") {
  const TinyProject tiny(3000, {256, 192});
  for (const char* const container : {"y4m", "nut"}) {
    Streaming sigs({"export", tiny.project(), "--out", "-", "--container", container, "--labels-fd", "3"});
    const std::string label = sigs.read_line(true);
    REQUIRE(!label.empty());
    CHECK(nlohmann::json::parse(label)["index"] == 0);
    CHECK(sigs.read_video(20000).size() == 20000);  // of some 200 MB, or 100
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    // It waits for its reader, with some frames in its queues and in the pipe.
    CHECK(sigs.is_running());
  }
}

TEST_CASE("the label of a frame is there once its image is, and the same as in the XML file") {
  const TinyProject tiny;
  REQUIRE(run_sigs("export " + tiny.project() + " --out " + tiny.out() + " --labels jsonl --masks none").status == 0);
  std::istringstream expected(text_of(tiny.file("out/tiny.jsonl")));
  Streaming sigs({"export", tiny.project(), "--out", "-", "--container", "y4m", "--labels-fd", "3", "--jobs", "2"});
  CHECK(sigs.read_line(false).starts_with("YUV4MPEG2 W64 H48 "));
  for (int n = 0; n < 10; ++n) {
    REQUIRE(sigs.read_line(false) == "FRAME\n");
    REQUIRE(sigs.read_video(64 * 48 * 3 / 2).size() == 64 * 48 * 3 / 2);
    std::string line;
    REQUIRE(std::getline(expected, line));
    CHECK(sigs.read_line(true) == line + "\n");
  }
  CHECK(sigs.read_video(1).empty());
  CHECK(sigs.read_line(true).empty());
  CHECK(sigs.ended() == 0);
}

TEST_CASE("memory does not grow while a reader is slow") {
  const TinyProject tiny(600, {640, 480});
  Streaming sigs({"export", tiny.project(), "--out", "-", "--container", "y4m", "--jobs", "2"});
  const std::size_t frame_bytes = 6 + 640 * 480 * 3 / 2;
  REQUIRE(sigs.read_line(false).starts_with("YUV4MPEG2"));
  for (int n = 0; n < 200; ++n) REQUIRE(sigs.read_video(frame_bytes).size() == frame_bytes);
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  const long early_kb = resident_kb(sigs.child());
  std::this_thread::sleep_for(std::chrono::seconds(2));  // in which it could compose the rest
  for (int n = 0; n < 350; ++n) REQUIRE(sigs.read_video(frame_bytes).size() == frame_bytes);
  // 350 frames are 160 MB. A quarter of that is allowed for what an allocator keeps.
  CHECK(resident_kb(sigs.child()) < early_kb + 40000);
}

TEST_CASE("a reader that closes the pipe early gives one line and status 74") {
  const TinyProject tiny(300, {256, 192});
  for (const char* const container : {"nut --codec raw", "y4m"}) {
    const Run run = run_bash(tiny, std::string("$SIGS export p.json --out - --container ") + container +
                                       " 2>err.txt | head -c 1000 >/dev/null; echo ${PIPESTATUS[0]}");
    CHECK(run.out == "74\n");
    const std::string said = text_of(tiny.file("err.txt"));
    CHECK_MESSAGE(has(said, "standard output: its reader has closed it"), said);
    CHECK(std::count(said.begin(), said.end(), '\n') == 1);
  }
  const Run labels =
      run_bash(tiny, "$SIGS export p.json --out out --labels-fd 3 3> >(head -n 1 >/dev/null) 2>err.txt; echo $?");
  CHECK(labels.out == "74\n");
  CHECK_MESSAGE(has(text_of(tiny.file("err.txt")), "labels"), text_of(tiny.file("err.txt")));
  CHECK(tiny.files_out() == 0);
}

TEST_CASE("Ctrl-C ends a stream whose reader does not read") {
  const TinyProject tiny(300, {256, 192});
  Streaming sigs({"export", tiny.project(), "--out", "-", "--container", "y4m"});
  REQUIRE(sigs.read_video(1000).size() == 1000);
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  REQUIRE(sigs.is_running());
  ::kill(sigs.child(), SIGINT);
  CHECK(sigs.ended() == 130);
}

TEST_CASE("in real time no frame is early") {
  const TinyProject tiny;
  const auto begin = std::chrono::steady_clock::now();
  const Run run = run_bash(tiny, "$SIGS export p.json --out - --realtime 2>/dev/null | wc -c");
  CHECK(run.status == 0);
  // Ten frames at 25 a second: the last is due 0.36 s after the first.
  CHECK(std::chrono::steady_clock::now() - begin >= std::chrono::milliseconds(360));
}

TEST_CASE("labels go to standard output beside a video in a file, and nothing else does") {
  const TinyProject tiny;
  const Run run = run_bash(tiny, "$SIGS export p.json --out out --labels-fd 1 2>/dev/null");
  CHECK(run.status == 0);
  std::istringstream lines(run.out);
  int index = 0;
  for (std::string line; std::getline(lines, line); ++index) CHECK(nlohmann::json::parse(line)["index"] == index);
  CHECK(index == 10);
  CHECK(fs::exists(tiny.file("out/tiny.mkv")));
}

TEST_CASE("what cannot be streamed is refused, and so is a terminal") {
  const TinyProject tiny;
  for (const char* const options : {"--container mp4 --codec h264", "--container mkv", "--codec png", "--codec tiff",
                                    "--labels coco", "--masks video", "--labels-fd 1", "--labels-fd 77"}) {
    const Run run =
        run_bash(tiny, std::string("$SIGS export p.json --out - ") + options + " | wc -c; exit ${PIPESTATUS[0]}");
    CHECK_MESSAGE(run.status == 64, options << ": " << run.err);
    CHECK(run.out == "0\n");
  }
  if (!has_program("command -v script")) return;
  const Run terminal = run_bash(tiny, "script -qec \"$SIGS export p.json --out -\" /dev/null </dev/null; exit $?");
  CHECK(terminal.status == 64);
  CHECK_MESSAGE(has(terminal.out, "terminal"), terminal.out);
}
