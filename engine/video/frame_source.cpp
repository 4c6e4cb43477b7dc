// SPDX-License-Identifier: MIT
#include "video/frame_source.h"

#include <fmt/format.h>

#include <utility>

#include "base/ensure.h"
#include "base/text.h"
#include "video/frame_seeker.h"
#include "video/libav/image_file.h"
#include "video/libav/planes.h"
#include "video/libav/stream_info.h"
#include "video/shared_footage.h"

namespace sigs {

namespace {

namespace fs = std::filesystem;

constexpr size_t kBytesToKeep = 64 << 20;  // of decoded images, for steps back

// Removes the images before the first that can be decoded (in a clip that begins in an open group of pictures). Returns
// their number.
int drop_undecodable_head(libav::FrameOrder& order, int first_ordinal) {
  int n = 0;
  while (n < static_cast<int>(order.ordinals.size()) && order.ordinals[static_cast<size_t>(n)] != first_ordinal) ++n;
  if (n == static_cast<int>(order.ordinals.size())) return 0;
  order.ordinals.erase(order.ordinals.begin(), order.ordinals.begin() + n);
  order.can_start.erase(order.can_start.begin(), order.can_start.begin() + n);
  order.times_s.erase(order.times_s.begin(), order.times_s.begin() + n);
  const double begin_s = order.times_s.front();
  for (double& time_s : order.times_s) time_s -= begin_s;
  return n;
}

// From the packets where that is certain, else by decoding everything.
Result<libav::FrameOrder> order_of(const libav::PacketTable& table, libav::FrameDecoder& stream) {
  const libav::Demuxer& source = stream.demuxer();
  if (auto order = libav::order_from_packets(table, source.format(), source.stream())) return std::move(*order);
  return libav::order_from_decoding(table, stream, libav::frame_rate_of(source));
}

Result<libav::DecodedFrame> first_image(libav::FrameDecoder& stream, const libav::FrameOrder& order) {
  const Result<void> started = stream.start(0, {.threads = 1, .reorder_depth = order.reorder_depth});
  if (!started) return fail(started.error());
  Result<std::optional<libav::DecodedFrame>> first = stream.next();
  if (!first) return fail(first.error());
  if (!*first) return fail("", "no frame of this video can be decoded");
  return std::move(**first);
}

// ITU-R BT.709: 0.2126, 0.7152, 0.0722. They add up to 256, so grey keeps its code.
constexpr int kRed = 54;
constexpr int kGreen = 183;
constexpr int kBlue = 19;
static_assert(kRed + kGreen + kBlue == 256);

constexpr std::size_t kFramesAhead = 8;  // enough for a method that collects some frames and processes them together

}  // namespace

struct FrameSource::State {
  // Size and time of a file, by which a change is noticed.
  struct FileState {
    uintmax_t bytes = 0;
    fs::file_time_type written;

    [[nodiscard]] bool operator==(const FileState&) const = default;
  };

  libav::PacketTable table;
  VideoInfo info;
  std::optional<FrameSeeker> seeker;          // none: a sequence of images
  std::optional<libav::StillFrames> stills;   // none: a video
  const std::atomic<bool>* cancel = nullptr;  // null: none
  FileState file;                             // when it was opened
  libav::Orientation orientation;
  bool quantisers = false;  // frames have their quantisers

  std::optional<cv::Rect> crop;  // of the image; none: all of it
  cv::Size whole_px;             // with a crop: of the image before

  std::shared_ptr<SharedFootage> shared;  // frames come from there, and of the rest only `info` is used; null: no
  std::size_t reader = 0;                 // of these
  ~State() {
    if (shared) shared->leave(reader);
  }

  [[nodiscard]] static FileState state_of(const fs::path& path);
  // An image as it is stored, that of frame n or its substitute.
  struct Shown {
    const AVFrame* image = nullptr;  // null: no image is intact
    int n = 0;
    libav::Orientation orientation;
    std::shared_ptr<const FrameQuantisers> quantisers;
    fs::path file;
  };

  [[nodiscard]] Result<void> open(libav::Demuxer demuxer);
  [[nodiscard]] Result<void> open_images(const SequenceTiming& timing);
  [[nodiscard]] Result<Shown> show(int n);
  // luma_alone: of footage with luma, the result has no other planes and is gray.
  [[nodiscard]] Result<Frame> read(int n, bool luma_alone);
  [[nodiscard]] bool has_changed() const { return seeker && !(state_of(info.path) == file); }
};

FrameSource::State::FileState FrameSource::State::state_of(const fs::path& path) {
  std::error_code code;
  FileState state{.bytes = fs::file_size(path, code)};
  state.written = fs::last_write_time(path, code);
  return state;
}

Result<void> FrameSource::State::open(libav::Demuxer demuxer) {
  table = libav::PacketTable::read(demuxer);
  if (const Result<void> on = demuxer.check_interrupt(); !on) return on;
  libav::FrameDecoder stream(libav::PacketReader(info.path, std::move(demuxer), table), table);
  Result<libav::FrameOrder> order = order_of(table, stream);
  if (!order) return fail(order.error());
  const Result<libav::DecodedFrame> first = first_image(stream, *order);
  if (!first) return fail(first.error());
  const int dropped = drop_undecodable_head(*order, first->ordinal);
  const Result<libav::Orientation> asked = libav::orientation_of(stream.demuxer().stream());
  if (!asked) return fail(asked.error());
  orientation = *asked;
  info = libav::video_info_of(info.path, stream.demuxer(), table, *order, *first->frame, orientation);
  if (const Result<void> possible = libav::check_orientation(orientation, info.layout); !possible) return possible;
  if (dropped > 0)
    info.warnings.push_back(
        {info.path.string(), fmt::format("{} images before the first that can be decoded are left out", dropped)});
  seeker.emplace(std::move(stream), std::move(*order), table, kBytesToKeep, quantisers);
  const Result<FrameSeeker::Found> intact = seeker->find(0);
  if (!intact) return fail(intact.error());
  if (intact->image == nullptr) return fail("", "every frame of this video is damaged");
  return {};
}

Result<void> FrameSource::State::open_images(const SequenceTiming& timing) {
  const Result<ImageSequence> sequence = listed_sequence(info.path, timing);
  if (!sequence) return fail(sequence.error());
  stills.emplace(sequence->files, quantisers, cancel);
  const Result<libav::StillFrames::Found> first = stills->find(0);
  if (!first) return fail(first.error());
  // All are damaged: the first says what with.
  if (first->image == nullptr) return fail(libav::decoded_still(sequence->files.front(), false).error());
  info = libav::sequence_info_of(info.path, *sequence, *first->image);
  return libav::check_orientation(first->image->orientation, info.layout);
}

Result<FrameSource> FrameSource::open(const fs::path& path, const std::atomic<bool>* cancel, Quantisers quantisers,
                                      const SequenceTiming& timing) {
  return guarded([&]() -> Result<FrameSource> {
    // Once `cancel` is set, FFmpeg's readers act as if the file ended: any error may follow from that.
    const auto failed = [&](const Error& error) -> tl::unexpected<Error> {
      if (cancel != nullptr && cancel->load()) return libav::interrupted();
      return fail(libav::named(error, path));
    };
    auto state = std::make_unique<State>();
    state->info.path = path.has_filename() ? path : path.parent_path();  // "images/" is "images"
    state->cancel = cancel;
    state->quantisers = quantisers == Quantisers::read;
    if (is_image_sequence(path)) {
      if (const Result<void> opened = state->open_images(timing); !opened) return failed(opened.error());
      return FrameSource(std::move(state));
    }
    Result<libav::Demuxer> demuxer = libav::Demuxer::open(path, cancel);
    if (!demuxer) return failed(demuxer.error());
    state->file = State::state_of(path);
    const Result<void> opened = state->open(std::move(*demuxer));
    if (!opened) return failed(opened.error());
    if (timing.frame_rate_hz > 0 || !timing.times_file.empty())
      state->info.warnings.push_back(
          {path.string(), "is a video and has times of its own; those given for a sequence of images are not used"});
    return FrameSource(std::move(state));
  });
}

std::vector<FrameSource> FrameSource::shared(FrameSource source, const std::vector<FrameSteps>& frames, int ahead) {
  const auto footage = std::make_shared<SharedFootage>(std::move(source), frames, ahead);
  std::vector<FrameSource> sources;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    auto state = std::make_unique<State>();
    state->info = footage->info();
    state->shared = footage;
    state->reader = i;
    sources.push_back(FrameSource(std::move(state)));
  }
  return sources;
}

FrameSource::FrameSource(std::unique_ptr<State> state) : state_(std::move(state)) {}
FrameSource::FrameSource(FrameSource&&) noexcept = default;
FrameSource& FrameSource::operator=(FrameSource&&) noexcept = default;
FrameSource::~FrameSource() = default;

const VideoInfo& FrameSource::info() const {
  return state_->info;
}

Result<void> FrameSource::crop(const cv::Rect& part) {
  ENSURE(!state_->crop);
  const cv::Size whole = state_->info.size_px;
  const cv::Rect rect(part.x, part.y, part.width > 0 ? part.width : whole.width - part.x,
                      part.height > 0 ? part.height : whole.height - part.y);
  const bool is_within = rect.x >= 0 && rect.y >= 0 && rect.width > 0 && rect.height > 0 &&
                         rect.width <= whole.width - rect.x && rect.height <= whole.height - rect.y;
  if (!is_within)
    return fail("", fmt::format("{} from ({}, {}) on is not within the footage's {}", image_size_text(rect.size()),
                                rect.x, rect.y, image_size_text(whole)));
  const cv::Size step = chroma_step(state_->info.layout);
  if (rect.x % step.width != 0 || rect.y % step.height != 0)
    return fail("", fmt::format("its corner ({}, {}) is not on a sample of colour, of which this footage has one in "
                                "{} columns and {} rows",
                                rect.x, rect.y, step.width, step.height));
  state_->crop = rect;
  state_->whole_px = whole;
  state_->info.size_px = rect.size();
  state_->info.part = ImagePart{whole, rect.tl()};
  return {};
}

Result<FrameSource::State::Shown> FrameSource::State::show(int n) {
  if (stills) {
    const Result<libav::StillFrames::Found> found = stills->find(n);
    if (!found) return fail(found.error());
    if (found->image == nullptr) return Shown{};
    return Shown{found->image->frame.get(), found->n, found->image->orientation, found->image->quantisers,
                 stills->file(found->n)};
  }
  const Result<FrameSeeker::Found> found = seeker->find(n);
  if (!found) return fail(found.error());
  if (found->image == nullptr) return Shown{};
  return Shown{found->image->frame.get(), found->n, orientation, found->image->quantisers, info.path};
}

Result<Frame> FrameSource::State::read(int n, bool luma_alone) {
  const Result<Shown> shown = show(n);
  if (!shown) return fail(libav::named(shown.error(), info.path));
  const std::string where = stills ? shown->file.string() : fmt::format("{}: frame {}", info.path.string(), n);
  if (shown->image == nullptr)
    return fail(fmt::format("{}: frame {}", info.path.string(), n), "is damaged, and so are all others");
  const AVFrame& image = *shown->image;
  const cv::Size stored_px(image.width, image.height);
  const cv::Size size = libav::oriented(stored_px, shown->orientation);
  const cv::Size expected_px = crop ? whole_px : info.size_px;
  if (size != expected_px)
    return fail(where, fmt::format("the image's size changes from {} to {}", image_size_text(expected_px),
                                   image_size_text(size)));
  const libav::Conversion wanted{.layout = info.layout, .bit_depth = info.bit_depth};
  Result<Frame> frame =
      luma_alone ? libav::luma_frame_of(image, wanted, info.color) : libav::frame_of(image, wanted, info.color);
  if (!frame) return fail(where, frame.error().what);
  if (!(shown->orientation == libav::Orientation{})) frame = libav::oriented(*frame, shown->orientation);
  frame->quantisers = libav::oriented(shown->quantisers, stored_px, shown->orientation);
  frame->time_s = info.times_s[static_cast<size_t>(n)];
  frame->damaged = shown->n != n;
  return frame;
}

Result<Frame> FrameSource::read(int n) {
  return read(n, false);
}

Result<LumaFrame> FrameSource::read_luma(int n) {
  const Result<Frame> frame = read(n, true);
  if (!frame) return fail(frame.error());
  return guarded([&]() -> Result<LumaFrame> { return LumaFrame{n, luma_of(*frame), frame->damaged}; });
}

Result<Frame> FrameSource::read(int n, bool luma_alone) {
  ENSURE(n >= 0 && n < state_->info.frame_count());
  const auto cropped = [&](Result<Frame> whole) -> Result<Frame> {
    if (!whole || !state_->crop) return whole;
    return part_of(*whole, *state_->crop);
  };
  if (state_->shared) return guarded([&] { return cropped(state_->shared->read(state_->reader, n)); });
  Result<Frame> frame = guarded([&] { return cropped(state_->read(n, luma_alone)); });
  // After a cancellation the result may be incomplete.
  if (state_->cancel != nullptr && state_->cancel->load()) return libav::interrupted();
  // Checked after reading: the result may mix the old and the new file.
  if (state_->has_changed())
    return fail(state_->info.path.string(), "changed while it was being read; start again when nothing writes to it",
                ErrorKind::cannot_read);
  return frame;
}

cv::Mat luma_of(const Frame& footage) {
  Frame frame = footage;
  if (frame.layout != PixelLayout::rgb) {
    frame.layout = PixelLayout::gray;  // only luma is rounded
    return with_bit_depth(frame, 8).planes[0];
  }
  frame = with_bit_depth(frame, 8);
  cv::Mat luma(frame.size_px(), CV_8UC1);
  for (int y = 0; y < luma.rows; ++y) {
    const uchar* const red = frame.planes[0].ptr<uchar>(y);
    const uchar* const green = frame.planes[1].ptr<uchar>(y);
    const uchar* const blue = frame.planes[2].ptr<uchar>(y);
    uchar* const out = luma.ptr<uchar>(y);
    for (int x = 0; x < luma.cols; ++x)
      out[x] = static_cast<uchar>((kRed * red[x] + kGreen * green[x] + kBlue * blue[x] + 128) >> 8);
  }
  return luma;
}

cv::Mat luma_of_part(const Frame& frame, const cv::Rect& rect) {
  Frame part = frame;
  part.planes[0] = frame.planes[0](rect);
  if (frame.layout == PixelLayout::rgb)
    for (std::size_t plane = 1; plane < 3; ++plane) part.planes[plane] = frame.planes[plane](rect);
  return luma_of(part);
}

LumaStream::LumaStream(FrameSource& footage, const FrameSteps& steps) : ahead_(kFramesAhead) {
  Result<std::thread> thread = started_thread([this, &footage, steps] { decode(footage, steps); },
                                              [this](Error error) { give_up(std::move(error)); });
  if (thread)
    thread_ = std::move(*thread);
  else
    give_up(std::move(thread.error()));
}

LumaStream::~LumaStream() {
  ahead_.close();
  if (thread_.joinable()) thread_.join();
}

void LumaStream::give_up(Error error) {
  failure_ = std::move(error);
  ahead_.close();
}

std::optional<Result<LumaFrame>> LumaStream::next() {
  std::optional<Result<LumaFrame>> frame = ahead_.take();
  if (frame || !failure_) return frame;
  return fail(*std::exchange(failure_, std::nullopt));
}

void LumaStream::decode(FrameSource& footage, const FrameSteps& steps) {
  for (int i = 0; i < steps.count; ++i) {
    Result<LumaFrame> frame = footage.read_luma(steps.at(i));
    const bool is_read = frame.has_value();
    if (!ahead_.put(std::move(frame)) || !is_read) break;
  }
  ahead_.close();
}

}  // namespace sigs
