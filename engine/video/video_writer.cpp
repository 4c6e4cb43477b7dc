// SPDX-License-Identifier: MIT
#include "video/video_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/ensure.h"
#include "base/image_codecs.h"
#include "base/text.h"
#include "base/threads.h"
#include "video/libav/splice_file.h"
#include "video/libav/video_file.h"

namespace sigs {

namespace fs = std::filesystem;

// Uncompressed video as mjpegtools, FFmpeg and GStreamer exchange it (yuv4mpeg(5)): a line of text with size, rate and
// layout, then for each frame "FRAME", a line break and its planes, samples of more than 8 bits in words of 16. Frames
// have no times: they come at the nominal rate. Matrix, primaries and transfer have no place in it; range and chroma
// site have.
class Y4mFile {
 public:
  // Writes the first line. Errors: usage (RGB, which it has no layout for), write_failed, interrupted.
  [[nodiscard]] static Result<Y4mFile> begin(OutputStream out, const VideoFormat& format);

  // Each frame leaves the process before the function returns. Errors: write_failed, interrupted.
  [[nodiscard]] Result<void> write(const Frame& frame);
  [[nodiscard]] Result<void> finish() { return out_.close(); }

 private:
  Y4mFile(OutputStream out, int bit_depth) : out_(std::move(out)), bit_depth_(bit_depth) {}

  OutputStream out_;
  int bit_depth_ = 8;  // that is written
  std::string bytes_;  // of one frame, reused
};

namespace {

struct CodecTraits {
  const char* name;
  int max_bit_depth;
  int max_crf = 0;
  const char* image_extension = "";
};

const CodecTraits& traits_of(VideoCodec codec) {
  static constexpr std::array<CodecTraits, 10> kTraits{{{"ffv1", 16},
                                                        {"h264", 10, 51},
                                                        {"hevc", 12, 51},
                                                        {"av1", 12, 63},
                                                        {"mjpeg", 8},
                                                        {"png", 16, 0, ".png"},
                                                        {"tiff", 16, 0, ".tiff"},
                                                        {"jpeg", 8, 0, ".jpg"},
                                                        {"raw", 16},
                                                        {"source", 16}}};
  return kTraits.at(static_cast<std::size_t>(codec));
}

static_assert(std::endian::native == std::endian::little, "y4m has words with the low byte first");

// The depth in which frames are written: y4m has 8, 9, 10, 12, 14 and 16 bits, of grey 8, 9, 10, 12 and 16.
int stored_depth(const VideoFormat& format) {
  const int wanted = std::min(format.bit_depth, format.max_bit_depth);
  if (wanted == 11) return 12;
  if (wanted == 13) return format.layout == PixelLayout::gray ? 16 : 14;
  return wanted == 15 || (wanted == 14 && format.layout == PixelLayout::gray) ? 16 : wanted;
}

// The name of a layout, as FFmpeg writes and reads it: "C422", of more than 8 bits "C422p10", "Cmono10". Only 4:2:0 of
// 8 bits has chroma sites. Empty for RGB.
std::string layout_text(const VideoFormat& format) {
  static constexpr std::array kLayouts{"Cmono", "C420", "C422", "C444"};  // in the order of PixelLayout
  static constexpr std::array kSites{"mpeg2", "jpeg", "paldv"};           // in the order of ChromaSite
  if (format.layout == PixelLayout::rgb) return {};
  const std::string layout = kLayouts.at(static_cast<std::size_t>(format.layout));
  if (const int depth = stored_depth(format); depth > 8)
    return fmt::format("{}{}{}", layout, format.layout == PixelLayout::gray ? "" : "p", depth);
  if (format.layout != PixelLayout::yuv420) return layout;
  return layout + kSites.at(static_cast<std::size_t>(format.color.chroma_site));
}

// Frames are progressive ("Ip"). The range is stated even where the footage does not: it is what was assumed of it.
std::string first_line(const VideoFormat& format, const std::string& layout) {
  return fmt::format("YUV4MPEG2 W{} H{} F{}:{} Ip A{}:{} {} XCOLORRANGE={}\n", format.size_px.width,
                     format.size_px.height, format.frame_rate_num, format.frame_rate_den, format.pixel_aspect_num,
                     format.pixel_aspect_den, layout, format.color.range == ColorRange::full ? "FULL" : "LIMITED");
}

// One channel for gray, else BGR, of 8 or 16 bits.
cv::Mat stored_image(const Frame& frame, int bit_depth) {
  cv::Mat image = bit_depth > 8 ? bgr16_of(frame) : bgr_of(frame);
  if (frame.layout == PixelLayout::gray) cv::extractChannel(image, image, 0);
  return image;
}

std::vector<int> parameters_of(const VideoFormat& format) {
  if (format.codec == VideoCodec::jpeg) return {cv::IMWRITE_JPEG_QUALITY, format.jpeg_quality};
  return {};
}

// As folder/frame_000123.png: gray for gray footage (as full range), else RGB; 16-bit for frames of more than 8 bits,
// but JPEG. PNG and TIFF (LZW) keep every sample of it; JPEG is 4:2:0.
Result<void> write_numbered_image(const fs::path& folder, const VideoFormat& format, const Frame& frame, int number) {
  const char* const extension = image_extension_of(format.codec);
  const int depth = std::min({frame.bit_depth, format.max_bit_depth, max_bit_depth(format.codec)});
  const fs::path path = folder / fmt::format("frame_{:06}{}", number, extension);
  std::vector<uchar> bytes;
  try {
    image_codecs::imencode(extension, stored_image(frame, depth), bytes, parameters_of(format));
  } catch (const cv::Exception& problem) {
    return fail(path.string(), fmt::format("cannot be written as an image ({}): {}", extension, problem.err),
                ErrorKind::write_failed);
  }
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out)
    return fail(path.string(), fmt::format("could not be written: {}", std::strerror(errno)), ErrorKind::write_failed);
  return {};
}

}  // namespace

Result<Y4mFile> Y4mFile::begin(OutputStream out, const VideoFormat& format) {
  const std::string layout = layout_text(format);
  if (layout.empty())
    return fail(out.name(), "y4m has no place for RGB images; use the container nut", ErrorKind::usage);
  Y4mFile file(std::move(out), stored_depth(format));
  if (const Result<void> begun = file.out_.write(first_line(format, layout)); !begun) return fail(begun.error());
  return file;
}

Result<void> Y4mFile::write(const Frame& frame) {
  const Frame stored = with_bit_depth(frame, bit_depth_);
  bytes_ = "FRAME\n";
  for (int i = 0; i < stored.plane_count(); ++i) {
    const cv::Mat& plane = stored.planes[static_cast<std::size_t>(i)];
    for (int y = 0; y < plane.rows; ++y)
      bytes_.append(plane.ptr<char>(y), static_cast<std::size_t>(plane.cols) * plane.elemSize());
  }
  return out_.write(bytes_);
}

struct VideoWriter::State {
  fs::path path;
  VideoFormat format;
  std::optional<libav::VideoFile> file;     // empty: another one
  std::optional<Y4mFile> y4m;               // empty: another one, or a folder of images
  std::optional<libav::SpliceFile> splice;  // empty: another one
  bool finished = false;
};

Result<VideoWriter> VideoWriter::open(const fs::path& path, const VideoFormat& format) {
  auto state = std::make_unique<State>();
  state->path = path;
  state->format = format;
  if (writes_images(format.codec)) {
    std::error_code code;
    if (!fs::is_directory(path, code))
      return fail(path.string(), "no such folder to write images into", ErrorKind::cannot_create);
    return VideoWriter(std::move(state));
  }
  if (format.container == Container::y4m) {
    Result<OutputStream> out = OutputStream::create(path);
    if (!out) return fail(out.error());
    return open_stream(std::move(*out), format);
  }
  Result<libav::VideoFile> file = guarded([&] { return libav::VideoFile::create(path, format); });
  if (!file) return fail(file.error());
  state->file.emplace(std::move(*file));
  return VideoWriter(std::move(state));
}

Result<VideoWriter> VideoWriter::open_stream(OutputStream out, const VideoFormat& format) {
  auto state = std::make_unique<State>();
  state->path = out.name();
  state->format = format;
  return guarded([&]() -> Result<VideoWriter> {
    if (format.container == Container::y4m) {
      Result<Y4mFile> file = Y4mFile::begin(std::move(out), format);
      if (!file) return fail(file.error());
      state->y4m.emplace(std::move(*file));
    } else {
      Result<libav::VideoFile> file = libav::VideoFile::create(std::move(out), format);
      if (!file) return fail(file.error());
      state->file.emplace(std::move(*file));
    }
    return VideoWriter(std::move(state));
  });
}

Result<VideoWriter> VideoWriter::open_splice(const fs::path& path, const SplicePlan& plan,
                                             const std::atomic<bool>* cancel) {
  return guarded([&]() -> Result<VideoWriter> {
    Result<libav::SpliceFile> splice = libav::SpliceFile::create(path, plan.splice, cancel);
    if (!splice) return fail(libav::named(splice.error(), path));
    auto state = std::make_unique<State>();
    state->path = path;
    state->splice.emplace(std::move(*splice));
    return VideoWriter(std::move(state));
  });
}

VideoWriter::VideoWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;
VideoWriter& VideoWriter::operator=(VideoWriter&&) noexcept = default;
VideoWriter::~VideoWriter() = default;

void VideoWriter::warm_up() {
  if (!state_->file) return;
  // A failure for lack of memory is not reported here: it fails again where it is needed.
  static_cast<void>(guarded([this]() -> Result<void> {
    state_->file->warm_up();
    return {};
  }));
}

Result<void> VideoWriter::write(const Frame& frame, int number) {
  ENSURE(!state_->finished);
  return guarded([&] {
    if (state_->file) return state_->file->write(frame);
    if (state_->splice) return state_->splice->write(frame, number);
    if (state_->y4m) return state_->y4m->write(frame);
    return write_numbered_image(state_->path, state_->format, frame, number);
  });
}

Result<void> VideoWriter::write_blank(double time_s, int number) {
  ENSURE(!state_->finished);
  return guarded([&] {
    if (state_->file) return state_->file->write_blank(time_s);
    const VideoFormat& format = state_->format;
    Frame blank = blank_frame(format.layout, format.size_px, format.color, format.bit_depth);
    if (state_->y4m) return state_->y4m->write(blank);
    return write_numbered_image(state_->path, format, blank, number);
  });
}

Result<void> VideoWriter::finish() {
  ENSURE(!state_->finished);
  state_->finished = true;
  return guarded([this] {
    if (state_->y4m) return state_->y4m->finish();
    if (state_->splice) return state_->splice->finish();
    return state_->file ? state_->file->finish() : Result<void>();
  });
}

const char* image_extension_of(VideoCodec codec) {
  return traits_of(codec).image_extension;
}

int max_bit_depth(VideoCodec codec) {
  return traits_of(codec).max_bit_depth;
}

const char* name_of(VideoCodec codec) {
  return traits_of(codec).name;
}

int max_crf(VideoCodec codec) {
  return traits_of(codec).max_crf;
}

Container container_of(const VideoInfo& footage) {
  if (footage.container.starts_with("matroska")) return Container::mkv;
  if (footage.container == "avi") return Container::avi;
  return lower_case(footage.path.extension().string()) == ".mov" ? Container::mov : Container::mp4;
}

const char* extension_of(Container container) {
  static constexpr std::array kExtensions{"mkv", "mp4", "avi", "nut", "y4m", "mov"};
  return kExtensions.at(static_cast<std::size_t>(container));
}

}  // namespace sigs
