// SPDX-License-Identifier: MIT
#include "video/image_sequence.h"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "support/test_data.h"
#include "video/clips.h"
#include "video/frame_source.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

constexpr int kImages = 12;
const cv::Size kImageSize(48, 32);

// An image of one brightness, by which it is known again; made by OpenCV.
void write_image(const fs::path& path, int brightness, cv::Size size = kImageSize) {
  REQUIRE(cv::imwrite(path.string(), cv::Mat(size, CV_8UC3, cv::Scalar::all(brightness))));
}

std::string numbered(const char* pattern, int number) {
  std::array<char, 64> name{};
  std::snprintf(name.data(), name.size(), pattern, number);
  return name.data();
}

// Images of brightness 10, 20, ... with numbers from `first` on.
void write_images(const fs::path& folder, const char* pattern, int first = 0, int count = kImages) {
  fs::create_directories(folder);
  for (int i = 0; i < count; ++i) write_image(folder / numbered(pattern, first + i), 10 * (i + 1));
}

int brightness_of(FrameSource& source, int n) {
  const Result<Frame> frame = source.read(n);
  REQUIRE_MESSAGE(frame, frame.error().text());
  return frame->planes[0].at<uchar>(5, 5);
}

Error open_error(const fs::path& path, const SequenceTiming& timing = {}) {
  const Result<FrameSource> source = FrameSource::open(path, nullptr, Quantisers::leave_out, timing);
  REQUIRE_FALSE(source);
  return source.error();
}

bool error_says(const Error& error, const std::string& text) {
  return error.text().find(text) != std::string::npos;
}

}  // namespace

TEST_CASE("images made by FFmpeg of a video are the video's frames, in order and at random") {
  for (const auto& [options, extension] : {std::pair{"-pix_fmt rgb24", "png"}, std::pair{"-pix_fmt rgb24", "tiff"},
                                           std::pair{"-pix_fmt yuvj420p -q:v 3", "jpg"}}) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "images");
    const std::string pattern = std::string("%05d.") + extension;
    if (!make_clip(options, folder / "images" / pattern, "testsrc2=size=128x96:rate=25:duration=0.8")) return;
    // The same images in a container, as they are.
    if (!run_ffmpeg("-i \"" + (folder / "images" / pattern).string() + "\" -c copy \"" +
                    (folder / "video.mkv").string() + "\""))
      return;
    FrameSource video = opened(folder / "video.mkv");
    for (const fs::path& path : {folder / "images" / pattern, folder / "images"}) {
      CAPTURE(path.string());
      FrameSource images = opened(path);
      REQUIRE(images.info().frame_count() == 20);
      CHECK(images.info().size_px == video.info().size_px);
      CHECK(images.info().layout == video.info().layout);
      CHECK(images.info().color == video.info().color);
      for (const int n : shuffled(20)) CHECK(samples_of(images.read(n).value()) == samples_of(video.read(n).value()));
    }
  }
}

TEST_CASE("a folder's images are in natural order, a pattern's begin at the lowest number") {
  const TemporaryFolder folder;
  write_images(folder / "a", "img%d.png", 5);
  write_file(folder / "a" / ".img0.png", "hidden");
  write_file(folder / "a" / "notes.txt", "not an image");
  for (const fs::path& path : {folder / "a", folder / "a/", folder / "a/img%d.png"}) {
    FrameSource source = opened(path);
    REQUIRE(source.info().frame_count() == kImages);
    for (int n = 0; n < kImages; ++n) CHECK(brightness_of(source, n) == 10 * (n + 1));
    CHECK(source.info().path.filename() == (path.has_filename() ? path.filename() : fs::path("a")));
  }
}

TEST_CASE("a missing number is an error of a pattern and a warning of a folder") {
  const TemporaryFolder folder;
  write_images(folder / "a", "f_%04d.png");
  fs::remove(folder / "a/f_0007.png");
  const Error error = open_error(folder / "a/f_%04d.png");
  CHECK(error.kind == ErrorKind::bad_data);
  CHECK(error_says(error, "f_0007.png is missing"));
  const FrameSource source = opened(folder / "a");
  CHECK(source.info().frame_count() == kImages - 1);
  CHECK(warns(source.info(), "f_0007.png"));
  // Names that are times have gaps by nature.
  fs::create_directory(folder / "times");
  for (const char* const name : {"1403636579763555584.png", "1403636579813555456.png", "1403636579863555584.png"})
    write_image(folder / "times" / name, 10);
  CHECK_FALSE(warns(opened(folder / "times").info(), "missing"));
}

TEST_CASE("folders and patterns without images, and with images of two kinds, are refused") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "empty");
  CHECK(open_error(folder / "empty").kind == ErrorKind::cannot_read);
  CHECK(error_says(open_error(folder / "empty"), "folder"));
  CHECK(open_error(folder / "empty/%06d.png").kind == ErrorKind::cannot_read);
  CHECK(open_error(folder / "nowhere/%06d.png").kind == ErrorKind::cannot_read);
  write_images(folder / "two", "%d.png");
  write_image(folder / "two/3.jpg", 10);
  CHECK(error_says(open_error(folder / "two"), "several kinds"));
  CHECK(opened(folder / "two/%d.png").info().frame_count() == kImages);
  write_file(folder / "two/0.mkv", "");
  CHECK(error_says(open_error(folder / "two/%d.mkv"), "not PNG, TIFF or JPEG"));
}

TEST_CASE("an image of another size is named with both sizes when it is read") {
  const TemporaryFolder folder;
  write_images(folder / "a", "%d.png");
  write_image(folder / "a/4.png", 10, {50, 32});
  FrameSource source = opened(folder / "a");
  CHECK(source.read(3));
  const Result<Frame> frame = source.read(4);
  REQUIRE_FALSE(frame);
  CHECK(error_says(frame.error(), "4.png"));
  CHECK(error_says(frame.error(), "48x32"));
  CHECK(error_says(frame.error(), "50x32"));
}

TEST_CASE("images of 16 bits keep their samples, as OpenCV reads them") {
  for (const char* const name : {"0.png", "0.tiff"}) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "a");
    cv::Mat image(32, 48, CV_16UC3);
    for (int y = 0; y < image.rows; ++y)
      for (int x = 0; x < image.cols; ++x)
        image.at<cv::Vec3w>(y, x) = cv::Vec3w(static_cast<ushort>(1234 * x), static_cast<ushort>(2011 * y), 4097);
    REQUIRE(cv::imwrite((folder / "a" / name).string(), image));
    FrameSource source = opened(folder / "a");
    CHECK(source.info().bit_depth == 16);
    CHECK(source.info().layout == PixelLayout::rgb);
    const Frame frame = source.read(0).value();
    for (int i = 0; i < 3; ++i) {
      cv::Mat plane;
      cv::extractChannel(image, plane, 2 - i);
      CHECK(cv::norm(frame.planes[static_cast<std::size_t>(i)], plane, cv::NORM_INF) == 0);
    }
  }
}

TEST_CASE("damaged images are substituted by the last intact one before them") {
  const TemporaryFolder folder;
  for (const char* const pattern : {"%d.png", "%d.tiff", "%d.jpg"}) {
    CAPTURE(pattern);
    const fs::path images = folder / (std::string(pattern).substr(3));
    write_images(images, pattern);
    for (const int n : {0, 5, 6}) {
      std::vector<uint8_t> bytes = bytes_of(images / numbered(pattern, n));
      bytes.resize(bytes.size() / 2);
      write_bytes(images / numbered(pattern, n), bytes);
    }
    write_file(images / numbered(pattern, 9), "");
    FrameSource source = opened(images);
    const int first = brightness_of(source, 1);
    for (const int n : shuffled(kImages)) {
      const Frame frame = source.read(n).value();
      const int shown = n == 0 ? 1 : n == 5 || n == 6 ? 4 : n == 9 ? 8 : n;
      CHECK(frame.damaged == (shown != n));
      CHECK(std::abs(frame.planes[0].at<uchar>(5, 5) - (first + 10 * (shown - 1))) <= 1);  // JPEG rounds
    }
  }
}

TEST_CASE("a sequence whose images are all damaged says what is wrong with the first") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "a");
  for (const char* const name : {"0.png", "1.png"}) write_file(folder / "a" / name, "no image");
  CHECK(error_says(open_error(folder / "a"), "0.png"));
  CHECK(open_error(folder / "a").kind == ErrorKind::bad_data);
}

TEST_CASE("a pipe among the images is an error, not a wait, and a link to an image is an image") {
  const TemporaryFolder folder;
  write_images(folder / "a", "%d.png", 0, 3);
  REQUIRE(mkfifo((folder / "a/3.png").c_str(), 0600) == 0);
  fs::create_symlink(folder / "a/0.png", folder / "a/4.png");
  FrameSource source = opened(folder / "a");
  REQUIRE(source.info().frame_count() == 5);
  CHECK(brightness_of(source, 4) == 10);
  const Result<Frame> pipe = source.read(3);
  REQUIRE_FALSE(pipe);
  CHECK(pipe.error().kind == ErrorKind::cannot_read);
  CHECK(error_says(pipe.error(), "pipe"));
}

TEST_CASE("a hundred thousand files are listed without being opened") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "a");
  write_image(folder / "a/000000.png", 77);
  for (int n = 1; n < 100000; ++n) std::ofstream(folder / "a" / numbered("%06d.png", n));
  write_image(folder / "a/099999.png", 55);
  FrameSource source = opened(folder / "a");
  REQUIRE(source.info().frame_count() == 100000);
  CHECK(brightness_of(source, 99999) == 55);
}

TEST_CASE("without times the rate is a guess that is said, with a rate it is that") {
  const TemporaryFolder folder;
  write_images(folder / "a", "%d.png");
  CHECK(warns(opened(folder / "a").info(), "25 frames/s"));
  for (const auto& [rate_hz, num, den] : {std::tuple{30000.0 / 1001, 30000, 1001}, std::tuple{12.5, 25, 2},
                                          std::tuple{0.1, 1, 10}, std::tuple{120.0, 120, 1}}) {
    const FrameSource source =
        FrameSource::open(folder / "a", nullptr, Quantisers::leave_out, {.frame_rate_hz = rate_hz}).value();
    CHECK(source.info().warnings.empty());
    CHECK(source.info().frame_rate_num == num);
    CHECK(source.info().frame_rate_den == den);
    CHECK(source.info().times_s[7] == doctest::Approx(7 / rate_hz).epsilon(1e-12));
  }
  write_clip(folder / "clip.mkv", {.size_px = kImageSize}, 3);
  const FrameSource video =
      FrameSource::open(folder / "clip.mkv", nullptr, Quantisers::leave_out, {.frame_rate_hz = 50}).value();
  CHECK(warns(video.info(), "times of its own"));
  CHECK(video.info().times_s[2] == doctest::Approx(0.08));
}

TEST_CASE("files of times are read in seconds, in nanoseconds and by name") {
  const TemporaryFolder folder;
  write_images(folder / "a", "%d.png", 0, 4);
  const auto times_of = [&](const std::string& text) {
    write_file(folder / "times.txt", text);
    return FrameSource::open(folder / "a", nullptr, Quantisers::leave_out, {.times_file = folder / "times.txt"})
        .value()
        .info();
  };
  const VideoInfo seconds = times_of("# comment\n\n 10.5\r\n10.6\n10.75\n1.1e1\n");
  CHECK(seconds.times_s[1] == doctest::Approx(0.1));
  CHECK(seconds.times_s[3] == doctest::Approx(0.5));
  CHECK(seconds.variable_frame_rate);
  CHECK(seconds.warnings.empty());
  const VideoInfo euroc = times_of(
      "#timestamp [ns],filename\n1403636579763555584,0.png\n1403636579813555456,1.png\n1403636579863555584,2.png\n"
      "1403636579913555456,3.png\n");
  CHECK(euroc.times_s[1] == 0.049999872);
  CHECK(euroc.times_s[3] == 0.149999872);
  CHECK_FALSE(euroc.variable_frame_rate);
  CHECK(double(euroc.frame_rate_num) / euroc.frame_rate_den == doctest::Approx(20).epsilon(1e-4));
  CHECK(times_of("1403636579763555584\n1403636579863555584\n1403636579963555584\n1403636580063555584\n").times_s[3] ==
        doctest::Approx(0.3).epsilon(1e-9));
  // By name, in any order of lines.
  CHECK(times_of("time name\n0.3 rgb/3.png\n0.2 rgb/2.png\n0 rgb/0.png\n0.1 rgb/1.png\n").times_s[2] ==
        doctest::Approx(0.2));
}

TEST_CASE("files of times that do not fit are refused with file and line") {
  const TemporaryFolder folder;
  write_images(folder / "a", "%d.png", 0, 3);
  for (const auto& [times, message] :
       {std::pair{"0\n1\n", "2 times"}, std::pair{"0\n1\n2\n3\n", "4 times"}, std::pair{"0\n1\n1\n", "line 3"},
        std::pair{"0\n2\n1\n", "line 3"}, std::pair{"0\nx\n2\n", "line 2"}, std::pair{"0\nnan\n2\n", "line 2"},
        std::pair{"0\n1e999\n2\n", "line 2"}, std::pair{"a\nb\nc\n", "line 2"}, std::pair{"", "0 times"},
        std::pair{"0 0.png\n1 1.png\n2 7.png\n", "2.png"},
        std::pair{"# [ns]\n-9223372036854775808\n1\n9223372036854775807\n", "line"},
        // From one to the next fits into 64 bits, from the first to the last does not.
        std::pair{"# [ns]\n-9223372036854551616\n1\n922337203685477807\n", "line 4"},
        std::pair{"-1e308\n0\n1e308\n", "line 3"}, std::pair{"# [ns]\n0.5\n1\n2\n", "nanoseconds"}}) {
    const std::string text = times;
    CAPTURE(text);
    write_file(folder / "times.txt", text);
    const Error error = open_error(folder / "a", {.times_file = folder / "times.txt"});
    CHECK(error.kind == ErrorKind::bad_data);
    CHECK(error_says(error, "times.txt"));
    CHECK_MESSAGE(error_says(error, message), error.text());
  }
  CHECK(open_error(folder / "a", {.times_file = folder / "none.txt"}).kind == ErrorKind::cannot_read);
}

}  // namespace sigs::test
