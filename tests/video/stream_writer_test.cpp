// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <thread>

#include "support/files.h"
#include "support/test_data.h"
#include "video/clips.h"
#include "video/video_writer.h"

namespace sigs::test {
namespace {

namespace fs = std::filesystem;

VideoFormat streamed_format(VideoCodec codec, Container container, PixelLayout layout, cv::Size size_px) {
  return {.codec = codec, .container = container, .size_px = size_px, .layout = layout};
}

// Every image that the ffmpeg program decodes, as checksums in the footage's own layout.
std::string checksums_of(const fs::path& path, const std::string& options = {}) {
  const fs::path list = path.string() + ".md5";
  if (!run_ffmpeg("-i \"" + path.string() + "\" " + options + " -f framehash -hash md5 \"" + list.string() + "\""))
    return {};
  std::string sums;
  std::istringstream lines(text_of(list));
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with('#')) sums += line.substr(line.rfind(',')) + "\n";
  return sums;
}

struct Pipe {
  int read_end = -1;
  int write_end = -1;

  Pipe() {
    int ends[2];
    REQUIRE(::pipe2(ends, O_CLOEXEC) == 0);
    read_end = ends[0];
    write_end = ends[1];
    std::signal(SIGPIPE, SIG_IGN);
  }
  ~Pipe() {
    ::close(read_end);
    if (write_end >= 0) ::close(write_end);
  }
};

std::string read_to_the_end(int descriptor) {
  std::string all;
  char bytes[4096];
  for (ssize_t count = 0; (count = ::read(descriptor, bytes, sizeof bytes)) > 0;)
    all.append(bytes, static_cast<std::size_t>(count));
  return all;
}

}  // namespace

TEST_CASE("NUT and Y4M files hold every sample of every layout, as FFmpeg reads them") {
  for (const auto& output : {std::pair{VideoCodec::ffv1, Container::nut}, std::pair{VideoCodec::raw, Container::nut},
                             std::pair{VideoCodec::raw, Container::y4m}})
    for (const PixelLayout layout : kLayouts)
      for (const cv::Size size : {cv::Size(64, 48), cv::Size(33, 21)}) {
        const VideoCodec codec = output.first;
        const Container container = output.second;
        if (container == Container::y4m && layout == PixelLayout::rgb) continue;
        CAPTURE(static_cast<int>(codec));
        CAPTURE(static_cast<int>(container));
        CAPTURE(static_cast<int>(layout));
        const TemporaryFolder folder;
        const fs::path path = folder / (std::string("a.") + extension_of(container));
        write_clip(path, streamed_format(codec, container, layout, size), 5);
        write_clip(folder / "b.mkv", streamed_format(VideoCodec::ffv1, Container::mkv, layout, size), 5);
        const std::string format = layout == PixelLayout::rgb ? "-pix_fmt gbrp" : "";
        const std::string expected = checksums_of(folder / "b.mkv", format);
        if (expected.empty()) return;
        CHECK(std::count(expected.begin(), expected.end(), '\n') == 5);
        CHECK(checksums_of(path, format) == expected);
        FrameSource again = opened(path);
        REQUIRE(again.info().frame_count() == 5);
        for (int n = 0; n < 5; ++n) CHECK(samples_of(again.read(n).value()) == samples_of(test_frame(layout, size, n)));
      }
}

TEST_CASE("samples of 10, 12 and 16 bits go through NUT and Y4M as they are") {
  for (const auto& output : {std::pair{VideoCodec::ffv1, Container::nut}, std::pair{VideoCodec::raw, Container::nut},
                             std::pair{VideoCodec::raw, Container::y4m}})
    for (const PixelLayout layout : kLayouts)
      for (const int bit_depth : {10, 12, 16}) {
        const VideoCodec codec = output.first;
        const Container container = output.second;
        if (container == Container::y4m && layout == PixelLayout::rgb) continue;
        CAPTURE(static_cast<int>(container));
        CAPTURE(static_cast<int>(layout));
        CAPTURE(bit_depth);
        const TemporaryFolder folder;
        VideoFormat format = streamed_format(codec, container, layout, {34, 22});
        format.bit_depth = bit_depth;
        Result<VideoWriter> writer = VideoWriter::open(folder / "a", format);
        REQUIRE(writer);
        for (int n = 0; n < 3; ++n) REQUIRE(writer->write(test_frame(layout, format.size_px, n, {}, bit_depth), n));
        REQUIRE(writer->finish());
        FrameSource again = opened(folder / "a");
        REQUIRE(again.info().frame_count() == 3);
        CHECK(again.info().bit_depth == bit_depth);
        for (int n = 0; n < 3; ++n)
          CHECK(samples_of(again.read(n).value()) == samples_of(test_frame(layout, format.size_px, n, {}, bit_depth)));
      }
}

TEST_CASE("Y4M states range and chroma site, and the rate as a ratio") {
  for (const auto& [color, words] :
       {std::pair{color_info(ColorRange::full, ColorMatrix::bt601, ChromaSite::center), "C420jpeg XCOLORRANGE=FULL"},
        std::pair{color_info(ColorRange::limited, ColorMatrix::bt709, ChromaSite::left),
                  "C420mpeg2 XCOLORRANGE=LIMITED"}}) {
    const TemporaryFolder folder;
    VideoFormat format = streamed_format(VideoCodec::raw, Container::y4m, PixelLayout::yuv420, {16, 8});
    format.color = color;
    format.frame_rate_num = 30000;
    format.frame_rate_den = 1001;
    write_clip(folder / "a.y4m", format, 2);
    const std::string text = text_of(folder / "a.y4m");
    CHECK(text.substr(0, text.find('\n')) == std::string("YUV4MPEG2 W16 H8 F30000:1001 Ip A1:1 ") + words);
    // The sizes by hand: the line, then twice "FRAME\n" with 16 x 8 and two times 8 x 4 samples.
    CHECK(text.size() == text.find('\n') + 1 + 2 * (6 + 128 + 2 * 32));
    CHECK(opened(folder / "a.y4m").info().color.range == color.range);
  }
  const TemporaryFolder folder;
  const Result<VideoWriter> rgb =
      VideoWriter::open(folder / "a", streamed_format(VideoCodec::raw, Container::y4m, PixelLayout::rgb, {16, 8}));
  REQUIRE_FALSE(rgb);
  CHECK(rgb.error().kind == ErrorKind::usage);
}

TEST_CASE("the bytes in a pipe are those of the file, and each frame is there before the next is given") {
  for (const auto& [codec, container] :
       {std::pair{VideoCodec::ffv1, Container::nut}, std::pair{VideoCodec::raw, Container::nut},
        std::pair{VideoCodec::raw, Container::y4m}}) {
    const TemporaryFolder folder;
    const VideoFormat format = streamed_format(codec, container, PixelLayout::yuv420, {32, 24});
    Pipe pipe;
    Result<OutputStream> out = OutputStream::of_descriptor(pipe.write_end, "pipe");
    REQUIRE(out);
    Result<VideoWriter> writer = VideoWriter::open_stream(std::move(*out), format);
    REQUIRE(writer);
    ::close(std::exchange(pipe.write_end, -1));
    std::string bytes;
    REQUIRE(::fcntl(pipe.read_end, F_SETFL, O_NONBLOCK) == 0);
    std::size_t before = 0;
    for (int n = 0; n < 4; ++n) {
      REQUIRE(writer->write(test_frame(format.layout, format.size_px, n), n));
      bytes += read_to_the_end(pipe.read_end);
      // Noise cannot be compressed to nothing: the frame's own bytes are among those that came.
      CHECK(bytes.size() >= before + 200);
      before = bytes.size();
    }
    REQUIRE(writer->finish());
    bytes += read_to_the_end(pipe.read_end);
    write_file(folder / "piped", bytes);
    FrameSource piped = opened(folder / "piped");
    REQUIRE(piped.info().frame_count() == 4);
    for (int n = 0; n < 4; ++n)
      CHECK(samples_of(piped.read(n).value()) == samples_of(test_frame(format.layout, format.size_px, n)));
  }
}

TEST_CASE("a reader that closes its end is an error of writing that says so") {
  for (const Container container : {Container::nut, Container::y4m}) {
    Pipe pipe;
    Result<VideoWriter> writer =
        VideoWriter::open_stream(OutputStream::of_descriptor(pipe.write_end, "the pipe").value(),
                                 streamed_format(VideoCodec::raw, container, PixelLayout::yuv420, {32, 24}));
    REQUIRE(writer);
    ::close(std::exchange(pipe.read_end, ::open("/dev/null", O_RDONLY)));
    const Result<void> written = writer->write(test_frame(PixelLayout::yuv420, {32, 24}, 0), 0);
    REQUIRE_FALSE(written);
    CHECK(written.error().kind == ErrorKind::write_failed);
    CHECK(written.error().text() == "the pipe: its reader has closed it before the end");
  }
}

TEST_CASE("waiting for a reader that does not read ends with an interruption") {
  Pipe pipe;
  std::atomic<bool> cancel{false};
  Result<VideoWriter> writer =
      VideoWriter::open_stream(OutputStream::of_descriptor(pipe.write_end, "pipe", &cancel).value(),
                               streamed_format(VideoCodec::raw, Container::y4m, PixelLayout::gray, {1024, 512}));
  REQUIRE(writer);
  std::thread user([&cancel] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    cancel = true;
  });
  // Half a megabyte is more than a pipe holds.
  const Result<void> written = writer->write(test_frame(PixelLayout::gray, {1024, 512}, 0), 0);
  user.join();
  REQUIRE_FALSE(written);
  CHECK(written.error().kind == ErrorKind::interrupted);
}

TEST_CASE("a descriptor that is closed or open for reading alone is refused") {
  Pipe pipe;
  CHECK(OutputStream::of_descriptor(pipe.read_end, "x").error().kind == ErrorKind::usage);
  CHECK(OutputStream::of_descriptor(987, "x").error().kind == ErrorKind::usage);
}

TEST_CASE("TIFF images hold what PNG images hold, JPEG images nearly that by their quality") {
  for (const PixelLayout layout : kLayouts) {
    const TemporaryFolder folder;
    VideoFormat format{.size_px = {64, 48}, .layout = layout};
    const Frame frame = test_frame(layout, format.size_px, 3);
    const auto written = [&](VideoCodec codec, int quality = 95) {
      format.codec = codec;
      format.jpeg_quality = quality;
      Result<VideoWriter> writer = VideoWriter::open(folder.path(), format);
      REQUIRE(writer);
      REQUIRE(writer->write(frame, 7));
      REQUIRE(writer->finish());
      const fs::path path = folder / (std::string("frame_000007") + image_extension_of(codec));
      return std::pair{cv::imread(path.string(), cv::IMREAD_UNCHANGED), fs::file_size(path)};
    };
    const cv::Mat png = written(VideoCodec::png).first;
    const cv::Mat tiff = written(VideoCodec::tiff).first;
    CHECK(png.channels() == (layout == PixelLayout::gray ? 1 : 3));
    CHECK(cv::norm(png, tiff, cv::NORM_INF) == 0);
    const auto [fine, fine_bytes] = written(VideoCodec::jpeg, 98);
    const auto [coarse, coarse_bytes] = written(VideoCodec::jpeg, 20);
    CHECK(fine.size() == png.size());
    CHECK(fine.channels() == png.channels());
    CHECK(cv::norm(fine, png, cv::NORM_L1) < cv::norm(coarse, png, cv::NORM_L1));
    CHECK(fine_bytes > coarse_bytes);
  }
}

}  // namespace sigs::test
