// SPDX-License-Identifier: MIT
#include "video/libav/demuxer.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <new>
#include <numeric>
#include <span>
#include <string>
#include <string_view>

extern "C" {
#include <libavutil/crc.h>
}

#include "base/image_codecs.h"
#include "base/input_file.h"

namespace sigs::libav {

namespace fs = std::filesystem;

namespace {

// A truncated file gives an error for each packet that its index still lists.
constexpr int kMaxReadErrorsInARow = 64;
// More than any codec reorders. Frame 0 is among the first packets.
constexpr int kPacketsForFrame0 = 64;

Result<void> check_is_file(const fs::path& path) {
  if (const Result<void> file = check_input_file(path, "video"); !file) return file;
  std::error_code code;
  if (fs::file_size(path, code) == 0) return fail(path.string(), "is empty", ErrorKind::cannot_read);
  return {};
}

bool begins_as_mp4(const fs::path& path) {
  std::array<char, 8> head{};
  std::ifstream(path, std::ios::binary).read(head.data(), head.size());
  const std::string_view box(head.data() + 4, 4);
  return box == "ftyp" || box == "mdat" || box == "wide";
}

// HLS, DASH and FFmpeg's own lists. They name other files, which may be anywhere and never end.
bool begins_as_playlist(const fs::path& path) {
  std::string head(4096, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return head.find("#EXTM3U") < 16 || head.find("ffconcat") < 16 || head.find("<MPD") != std::string::npos;
}

// The formats that may be read, for FFmpeg's format_whitelist: all but those that name other files or are programs.
std::string formats_of_one_file() {
  constexpr std::array<std::string_view, 10> kOthers{
      "hls", "applehttp", "concat", "dash", "imf", "sdp", "rtsp", "avisynth", "vapoursynth", "webm_dash_manifest"};
  std::string names;
  void* at = nullptr;
  while (const AVInputFormat* format = av_demuxer_iterate(&at)) {
    std::string_view rest = format->name;  // "mov,mp4,m4a"
    const std::string_view first = rest.substr(0, rest.find(','));
    if (std::find(kOthers.begin(), kOthers.end(), first) == kOthers.end())
      names.append(names.empty() ? "" : ",").append(rest);
  }
  return names;
}

int is_cancelled(void* cancel) {
  return cancel != nullptr && static_cast<const std::atomic<bool>*>(cancel)->load() ? 1 : 0;
}

// An input that is not open yet. FFmpeg checks `cancel` wherever it waits or reads.
AVFormatContext* new_input(const std::atomic<bool>* cancel) {
  AVFormatContext* context = avformat_alloc_context();
  if (context == nullptr) throw std::bad_alloc();
  context->interrupt_callback = {is_cancelled, const_cast<std::atomic<bool>*>(cancel)};
  return context;
}

tl::unexpected<Error> open_failed(const fs::path& path, int error) {
  if (error == AVERROR_EXIT) return interrupted();
  check_memory(error);
  if (begins_as_playlist(path))
    return fail(path.string(), "is a playlist, not a video; name the video file itself", ErrorKind::cannot_read);
  if (error == AVERROR(EACCES))
    return fail(path.string(), "may not be read: permission denied", ErrorKind::cannot_read);
  if (begins_as_mp4(path))
    return fail(path.string(),
                "is an MP4 without a usable index (moov): the recording was cut short before the index was written; "
                "repair it with a tool such as untrunc");
  return fail(path.string(), "is not a video that can be read: " + text_of(error), ErrorKind::cannot_read);
}

// FFmpeg "plays" text files as terminal art.
bool is_text_art(AVCodecID codec) {
  return codec == AV_CODEC_ID_ANSI || codec == AV_CODEC_ID_BINTEXT || codec == AV_CODEC_ID_XBIN ||
         codec == AV_CODEC_ID_IDF;
}

bool is_video(const AVStream& stream) {
  return stream.codecpar->codec_type == AVMEDIA_TYPE_VIDEO && (stream.disposition & AV_DISPOSITION_ATTACHED_PIC) == 0 &&
         !is_text_art(stream.codecpar->codec_id);
}

// Of what the container states, and of what the first packets of the streams showed.
Result<void> check_image_sizes(const AVFormatContext& input, const fs::path& path) {
  for (unsigned i = 0; i < input.nb_streams; ++i) {
    const AVCodecParameters& stream = *input.streams[i]->codecpar;
    if (stream.codec_type != AVMEDIA_TYPE_VIDEO) continue;
    if (const Result<void> checked = check_image_size({stream.width, stream.height}); !checked)
      return fail(path.string(), checked.error().what);
  }
  return {};
}

// Looks at the first packets of all streams, as FFmpeg does to know their formats. Negative: an error.
int probe(AVFormatContext& input) {
  std::vector<AVDictionary*> options(input.nb_streams, nullptr);
  for (AVDictionary*& option : options) av_dict_set_int(&option, "max_pixels", kMaxImagePixels, 0);
  const int probed = avformat_find_stream_info(&input, options.data());
  for (AVDictionary*& option : options) av_dict_free(&option);
  return probed;
}

// A slice footer: slice_size (3 bytes, big endian, without the footer), error_status (1), slice_crc_parity (4).
constexpr size_t kFooterBytes = 8;

// Whether every slice of an FFV1 version 3 packet has a matching checksum (RFC 9043, section 4.9, slice footer). A
// stream written without checksums never matches. FFmpeg's decoder conceals a damaged slice without a report.
bool ffv1_checksums_match(std::span<const uint8_t> packet) {
  if (packet.empty()) return false;
  const AVCRC* table = av_crc_get_table(AV_CRC_32_IEEE);
  while (!packet.empty()) {
    if (packet.size() < kFooterBytes) return false;
    const auto footer = packet.last(kFooterBytes);
    const size_t slice_bytes = (size_t{footer[0]} << 16 | size_t{footer[1]} << 8 | footer[2]) + kFooterBytes;
    if (slice_bytes > packet.size()) return false;
    // The checksum is chosen so that the whole slice with it has the remainder 0.
    if (av_crc(table, 0, packet.last(slice_bytes).data(), slice_bytes) != 0) return false;
    packet = packet.first(packet.size() - slice_bytes);
  }
  return true;
}

PacketMark mark_of(const AVPacket& packet) {
  return {.pts = packet.pts,
          .dts = packet.dts,
          .file_position = packet.pos,
          .size = packet.size,
          .key = (packet.flags & AV_PKT_FLAG_KEY) != 0,
          .discarded = (packet.flags & AV_PKT_FLAG_DISCARD) != 0,
          .corrupt = (packet.flags & AV_PKT_FLAG_CORRUPT) != 0};
}

// Whether an image that the container calls a keyframe is one by its own header, as far as FFmpeg has a parser for it.
// Some containers call the images of an intra refresh keyframes, or all images.
class KeyCheck {
 public:
  explicit KeyCheck(const AVCodecParameters& parameters) : context_(avcodec_alloc_context3(nullptr)) {
    if (context_ == nullptr || avcodec_parameters_to_context(context_.get(), &parameters) < 0) throw std::bad_alloc();
    parser_.reset(av_parser_init(static_cast<int>(parameters.codec_id)));
    if (parser_ != nullptr) parser_->flags |= PARSER_FLAG_COMPLETE_FRAMES;
  }

  [[nodiscard]] bool allows(const AVPacket& packet) {
    if (parser_ == nullptr) return true;
    uint8_t* data = nullptr;
    int size = 0;
    parser_->pict_type = AV_PICTURE_TYPE_NONE;
    av_parser_parse2(parser_.get(), context_.get(), &data, &size, packet.data, packet.size, packet.pts, packet.dts,
                     packet.pos);
    return parser_->pict_type != AV_PICTURE_TYPE_P && parser_->pict_type != AV_PICTURE_TYPE_B;
  }

 private:
  struct Close {
    void operator()(AVCodecParserContext* parser) const { av_parser_close(parser); }
  };
  CodecPtr context_;
  std::unique_ptr<AVCodecParserContext, Close> parser_;
};

// Marks the packets whose checksums do not match. A stream in which none match has no checksums.
void mark_corrupt(std::vector<PacketMark>& marks, const std::vector<bool>& checksums_match) {
  if (std::find(checksums_match.begin(), checksums_match.end(), true) == checksums_match.end()) return;
  for (size_t i = 0; i < marks.size(); ++i)
    if (!checksums_match[i]) marks[i].corrupt = true;
}

}  // namespace

tl::unexpected<Error> interrupted() {
  return fail("", "interrupted; nothing was written", ErrorKind::interrupted);
}

Result<InputPtr> open_input(const fs::path& path, const std::atomic<bool>* cancel) {
  silence();
  if (const Result<void> file = check_is_file(path); !file) return fail(file.error());
  AVFormatContext* opened = new_input(cancel);
  AVDictionary* options = nullptr;
  av_dict_set(&options, "protocol_whitelist", "file", 0);
  av_dict_set(&options, "format_whitelist", formats_of_one_file().c_str(), 0);
  const int error = avformat_open_input(&opened, url_of(path).c_str(), nullptr, &options);
  av_dict_free(&options);
  if (error < 0) return open_failed(path, error);
  InputPtr input(opened);
  if (const Result<void> stated = check_image_sizes(*input, path); !stated) return fail(stated.error());
  if (const int probed = probe(*input); probed < 0) return open_failed(path, probed);
  if (const Result<void> shown = check_image_sizes(*input, path); !shown) return fail(shown.error());
  return input;
}

int video_stream_of(AVFormatContext& input) {
  const int stream = av_find_best_stream(&input, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  return stream >= 0 && is_video(*input.streams[stream]) ? stream : -1;
}

void keep_only(AVFormatContext& input, int index) {
  for (unsigned i = 0; i < input.nb_streams; ++i)
    input.streams[i]->discard = static_cast<int>(i) == index ? AVDISCARD_DEFAULT : AVDISCARD_ALL;
}

Step next_packet(AVFormatContext& input, int index, AVPacket& packet) {
  for (int errors = 0; errors < kMaxReadErrorsInARow;) {
    av_packet_unref(&packet);
    const int result = av_read_frame(&input, &packet);
    check_memory(result);
    if (result == AVERROR_EOF) return errors > 0 ? Step::broke_off : Step::end;
    if (result == AVERROR_EXIT) return Step::broke_off;
    if (result < 0)
      ++errors;
    else if (packet.stream_index == index)
      return Step::packet;
  }
  return Step::broke_off;
}

std::int64_t stamp_of(const AVPacket& packet) {
  return packet.pts != AV_NOPTS_VALUE ? packet.pts : packet.dts;
}

std::optional<double> time_of_frame_0(AVFormatContext& input) {
  const int video = video_stream_of(input);
  if (video < 0) return {};
  keep_only(input, video);
  const PacketPtr packet = new_packet();
  const bool all_are_shown = has_true_time_stamps(input);
  std::optional<std::int64_t> first;
  for (int read = 0; read < kPacketsForFrame0 && next_packet(input, video, *packet) == Step::packet;) {
    const bool is_shown = (packet->flags & AV_PKT_FLAG_DISCARD) == 0 && packet->size > 0;
    const bool can_begin = first || all_are_shown || (packet->flags & AV_PKT_FLAG_KEY) != 0;
    if (!is_shown || !can_begin || stamp_of(*packet) == AV_NOPTS_VALUE) continue;
    first = first ? std::min(*first, stamp_of(*packet)) : stamp_of(*packet);
    ++read;
  }
  if (!first) return {};
  return static_cast<double>(*first) * av_q2d(input.streams[video]->time_base);
}

bool has_true_time_stamps(const AVFormatContext& format) {
  const std::string_view name = format.iformat->name;
  return name.starts_with("mov,mp4") || name.starts_with("matroska");
}

Result<Demuxer> Demuxer::open(const fs::path& path, const std::atomic<bool>* cancel) {
  Result<InputPtr> input = open_input(path, cancel);
  if (!input) return fail(input.error());
  const int stream = video_stream_of(**input);
  if (stream < 0) return fail(path.string(), "there is no video in it", ErrorKind::cannot_read);
  for (unsigned i = 0; i < (*input)->nb_streams; ++i)
    if (static_cast<int>(i) != stream) (*input)->streams[i]->discard = AVDISCARD_ALL;
  return Demuxer(std::move(*input), stream, cancel);
}

bool Demuxer::next(AVPacket& packet) {
  const Step step = next_packet(*input_, stream_, packet);
  if (step != Step::packet) broke_off_ = step == Step::broke_off;
  return step == Step::packet;
}

Result<void> Demuxer::check_interrupt() const {
  if (cancel_ != nullptr && cancel_->load()) return interrupted();
  return {};
}

bool Demuxer::seek(int64_t time) {
  return avformat_seek_file(input_.get(), stream_, INT64_MIN, time, time, 0) >= 0 ||
         av_seek_frame(input_.get(), stream_, time, AVSEEK_FLAG_BACKWARD) >= 0;
}

PacketTable PacketTable::read(Demuxer& demuxer) {
  PacketTable table;
  const bool is_ffv1 = demuxer.stream().codecpar->codec_id == AV_CODEC_ID_FFV1;
  std::vector<bool> checksums_match;
  KeyCheck key_check(*demuxer.stream().codecpar);
  const PacketPtr packet = new_packet();
  while (demuxer.next(*packet)) {
    table.marks_.push_back(mark_of(*packet));
    if (table.marks_.back().key && packet->size > 0) table.marks_.back().key = key_check.allows(*packet);
    if (is_ffv1) checksums_match.push_back(ffv1_checksums_match({packet->data, static_cast<size_t>(packet->size)}));
  }
  table.broke_off_ = demuxer.broke_off();
  mark_corrupt(table.marks_, checksums_match);
  table.sort_by_position();
  return table;
}

void PacketTable::sort_by_position() {
  by_position_.resize(marks_.size());
  std::iota(by_position_.begin(), by_position_.end(), 0);
  std::stable_sort(by_position_.begin(), by_position_.end(),
                   [&](int a, int b) { return (*this)[a].file_position < (*this)[b].file_position; });
}

bool PacketTable::any_corrupt() const {
  return std::any_of(marks_.begin(), marks_.end(), [](const PacketMark& mark) { return mark.corrupt; });
}

bool PacketTable::looks_like(int ordinal, const AVPacket& packet) const {
  const PacketMark& mark = (*this)[ordinal];
  return mark.file_position == packet.pos && mark.size == packet.size && mark.pts == packet.pts;
}

bool PacketTable::matches(int ordinal, const AVPacket& packet) const {
  return packet.pos >= 0 && looks_like(ordinal, packet);
}

std::optional<int> PacketTable::ordinal_of(const AVPacket& packet) const {
  const auto first =
      std::lower_bound(by_position_.begin(), by_position_.end(), packet.pos,
                       [&](int ordinal, int64_t position) { return (*this)[ordinal].file_position < position; });
  std::optional<int> found;
  for (auto it = first; it != by_position_.end() && (*this)[*it].file_position == packet.pos; ++it) {
    if (!matches(*it, packet)) continue;
    if (found) return {};  // an edit list may present the same bytes twice
    found = *it;
  }
  return found;
}

}  // namespace sigs::libav
