// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <string>

#include "support/test_data.h"
#include "video/clips.h"

using namespace sigs;
using namespace sigs::test;

namespace {

VideoFormat plain_format(VideoCodec codec, Container container, cv::Size size_px) {
  VideoFormat format;
  format.codec = codec;
  format.container = container;
  format.size_px = size_px;
  return format;
}

Error refused(const std::filesystem::path& path, const VideoFormat& format) {
  const Result<VideoWriter> writer = VideoWriter::open(path, format);
  REQUIRE(!writer.has_value());
  return writer.error();
}

// The first error of opening, writing and finishing.
Result<void> outcome(const std::filesystem::path& path, const VideoFormat& format, int frames) {
  Result<VideoWriter> writer = VideoWriter::open(path, format);
  if (!writer) return fail(writer.error());
  for (int n = 0; n < frames; ++n)
    if (const Result<void> written = writer->write(test_frame(format.layout, format.size_px, n), n); !written)
      return written;
  return writer->finish();
}

}  // namespace

TEST_CASE("a codec and a container that do not go together are both named") {
  const TemporaryFolder folder;
  const Error error = refused(folder / "a.mp4", plain_format(VideoCodec::ffv1, Container::mp4, {64, 48}));
  CHECK(error.kind == ErrorKind::usage);
  CHECK(error.what.find("ffv1") != std::string::npos);
  CHECK(error.what.find("mp4") != std::string::npos);
  CHECK(!std::filesystem::exists(folder / "a.mp4"));
}

TEST_CASE("an odd size is refused only by H264 with subsampled chroma") {
  const TemporaryFolder folder;
  const Error error = refused(folder / "a.mkv", plain_format(VideoCodec::h264, Container::mkv, {65, 48}));
  CHECK(error.kind == ErrorKind::usage);
  CHECK(error.what.find("65x48") != std::string::npos);
  CHECK(error.what.find("ffv1") != std::string::npos);
  VideoFormat full_chroma = plain_format(VideoCodec::h264, Container::mkv, {65, 47});
  full_chroma.layout = PixelLayout::yuv444;
  CHECK(outcome(folder / "b.mkv", full_chroma, 2).has_value());
  CHECK(outcome(folder / "c.mkv", plain_format(VideoCodec::mjpeg, Container::mkv, {65, 47}), 2).has_value());
}

TEST_CASE("an empty or tiny image is refused") {
  const TemporaryFolder folder;
  CHECK(refused(folder / "a.mkv", plain_format(VideoCodec::ffv1, Container::mkv, {3, 48})).kind == ErrorKind::usage);
  CHECK(refused(folder / "a.mkv", plain_format(VideoCodec::ffv1, Container::mkv, {0, 48})).kind == ErrorKind::usage);
}

TEST_CASE("a missing folder cannot be written into") {
  const TemporaryFolder folder;
  CHECK(refused(folder / "absent" / "a.mkv", plain_format(VideoCodec::ffv1, Container::mkv, {64, 48})).kind ==
        ErrorKind::cannot_create);
  CHECK(refused(folder / "absent", plain_format(VideoCodec::png, Container::mkv, {64, 48})).kind ==
        ErrorKind::cannot_create);
}

TEST_CASE("a full disk is an error for every codec and container") {
  if (!std::filesystem::exists("/dev/full")) {
    say_skipped("no /dev/full");
    return;
  }
  for (const auto& output :
       {std::pair{VideoCodec::ffv1, Container::mkv}, std::pair{VideoCodec::ffv1, Container::avi},
        std::pair{VideoCodec::h264, Container::mp4}, std::pair{VideoCodec::h264, Container::mkv},
        std::pair{VideoCodec::mjpeg, Container::avi}, std::pair{VideoCodec::mjpeg, Container::mp4}})
    for (const int frames : {1, 60}) {  // one frame may fit into a buffer and fail only at the end
      const VideoCodec codec = output.first;
      const Container container = output.second;
      CAPTURE(static_cast<int>(codec));
      CAPTURE(static_cast<int>(container));
      const Result<void> result = outcome("/dev/full", plain_format(codec, container, {64, 48}), frames);
      REQUIRE(!result.has_value());
      CHECK(result.error().kind == ErrorKind::write_failed);
      CHECK(result.error().what.find("No space left") != std::string::npos);
    }
}

TEST_CASE("a PNG that cannot be written is an error") {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder / "frame_000000.png");
  const Result<void> result = outcome(folder.path(), plain_format(VideoCodec::png, Container::mkv, {64, 48}), 1);
  REQUIRE(!result.has_value());
  CHECK(result.error().kind == ErrorKind::write_failed);
}

TEST_CASE("a writer that is destroyed without finish reports nothing") {
  const TemporaryFolder folder;
  Result<VideoWriter> writer =
      VideoWriter::open(folder / "a.mkv", plain_format(VideoCodec::h264, Container::mkv, {64, 48}));
  REQUIRE(writer.has_value());
  CHECK(writer->write(test_frame(PixelLayout::yuv420, {64, 48}, 0), 0).has_value());
}
