// SPDX-License-Identifier: MIT
#include "video/libav/demuxer.h"

#include <array>
#include <fstream>
#include <string>
#include <string_view>

namespace sigs::libav {
namespace {

namespace fs = std::filesystem;

// A file cut off in the middle gives an error for each packet that its index still names.
constexpr int kMostReadErrorsInARow = 64;

Result<void> check_is_file(const fs::path& path) {
  std::error_code code;
  if (!fs::exists(path, code)) return fail(path.string(), "no such file", ErrorKind::cannot_read);
  if (fs::is_directory(path, code)) return fail(path.string(), "is a folder, not a video", ErrorKind::cannot_read);
  if (fs::is_regular_file(path, code) && fs::file_size(path, code) == 0)
    return fail(path.string(), "is empty", ErrorKind::cannot_read);
  return {};
}

bool begins_as_mp4(const fs::path& path) {
  std::array<char, 8> head{};
  std::ifstream(path, std::ios::binary).read(head.data(), head.size());
  const std::string_view box(head.data() + 4, 4);
  return box == "ftyp" || box == "mdat" || box == "wide";
}

tl::unexpected<Error> open_failed(const fs::path& path, int error) {
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

}  // namespace

Result<Demuxer> Demuxer::open(const fs::path& path) {
  silence();
  if (const Result<void> file = check_is_file(path); !file) return fail(file.error());
  AVFormatContext* opened = nullptr;
  AVDictionary* options = nullptr;
  av_dict_set(&options, "protocol_whitelist", "file", 0);  // a play list must not reach into the network
  const int error = avformat_open_input(&opened, url_of(path).c_str(), nullptr, &options);
  av_dict_free(&options);
  if (error < 0) return open_failed(path, error);
  InputPtr input(opened);
  if (const int probed = avformat_find_stream_info(input.get(), nullptr); probed < 0) return open_failed(path, probed);
  const int stream = av_find_best_stream(input.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  if (stream < 0 || !is_video(*input->streams[stream]))
    return fail(path.string(), "there is no video in it", ErrorKind::cannot_read);
  for (unsigned i = 0; i < input->nb_streams; ++i)
    if (static_cast<int>(i) != stream) input->streams[i]->discard = AVDISCARD_ALL;
  return Demuxer(std::move(input), stream);
}

bool Demuxer::next(AVPacket& packet) {
  for (int errors = 0; errors < kMostReadErrorsInARow;) {
    av_packet_unref(&packet);
    const int result = av_read_frame(input_.get(), &packet);
    if (result == AVERROR_EOF) {
      broke_off_ = errors > 0;
      return false;
    }
    if (result < 0)
      ++errors;
    else if (packet.stream_index == stream_)
      return true;
  }
  broke_off_ = true;
  return false;
}

bool Demuxer::seek(int64_t time) {
  return avformat_seek_file(input_.get(), stream_, INT64_MIN, time, time, 0) >= 0 ||
         av_seek_frame(input_.get(), stream_, time, AVSEEK_FLAG_BACKWARD) >= 0;
}

}  // namespace sigs::libav
