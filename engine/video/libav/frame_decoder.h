// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "base/result.h"
#include "video/frame_quantisers.h"
#include "video/libav/demuxer.h"
#include "video/libav/handles.h"

namespace sigs::libav {

// From packets to decoded images: the packets in order of decoding from any one on, a decoder, and the images that it
// gives, each with the ordinal of its packet; the order in which images are shown.

struct DecoderSettings {
  int threads = 1;
  int reorder_depth = 0;    // how many images can come before another one although they are decoded later; at least
  bool quantisers = false;  // images come with their quantisers. Then one image is decoded at a time: FFmpeg 5.1 lists
                            // those of an image that another thread may still be decoding
};

// Whether the decoder calls an image a keyframe.
[[nodiscard]] bool is_key(const AVFrame& frame);

// Whether every image of a codec is coded without reference to others.
[[nodiscard]] bool is_intra_only(AVCodecID codec);

// Whether FFmpeg decodes several images of a codec at a time.
[[nodiscard]] bool decodes_ahead(AVCodecID codec);

// Reads packets from any ordinal on. Where a seek of the container leads is checked against the table; where seeking
// cannot be trusted the file is read from its start, which costs reading but no decoding.
class PacketReader {
 public:
  //   table  of the same file; it outlives the reader
  PacketReader(std::filesystem::path path, Demuxer demuxer, const PacketTable& table)
      : path_(std::move(path)), demuxer_(std::move(demuxer)), table_(&table) {}

  [[nodiscard]] const Demuxer& demuxer() const { return demuxer_; }

  // Makes next() continue with the packet of this ordinal. Errors as of Demuxer::open.
  [[nodiscard]] Result<void> go_to(int ordinal);

  // Reads the next packet and returns its ordinal, nothing at the end. Error bad_data: the file has changed.
  [[nodiscard]] Result<std::optional<int>> next(AVPacket& packet);

 private:
  [[nodiscard]] bool seek_before(int ordinal);
  [[nodiscard]] Result<bool> read_on();
  [[nodiscard]] Error changed() const;
  void keep();
  [[nodiscard]] Result<void> reopen();

  std::filesystem::path path_;
  Demuxer demuxer_;
  const PacketTable* table_;
  int met_ = -1;                  // ordinal of the packet last taken from the demuxer
  int wanted_ = 0;                // ordinal of the packet that next() returns
  int read_ = -1;                 // one more than the ordinal of the newest packet in recent_; -1: nothing is read
  std::deque<PacketPtr> recent_;  // the last packets, so that a step back needs no seek
  size_t recent_bytes_ = 0;       // of the packets in recent_
  bool held_ = false;             // the packet met_ was read to find out where a seek has led
  bool sought_ = true;  // the demuxer has not read straight from the file's start; the first pass leaves it at the end
  PacketPtr packet_ = new_packet();  // the one last taken from the demuxer
};

// A decoded image and the packet that it comes from.
struct DecodedFrame {
  FramePtr frame;
  int ordinal = 0;
  // Where they are asked for and the stream states them: in the image as it is stored. For images that FFmpeg gives
  // without them (MPEG-1, -2 and -4: the last one of a group) those of the image before, with the type unknown.
  std::shared_ptr<const FrameQuantisers> quantisers{};
};

// Decodes images in order of presentation, from any packet on.
class FrameDecoder {
 public:
  FrameDecoder(PacketReader reader, const PacketTable& table) : reader_(std::move(reader)), table_(&table) {}

  [[nodiscard]] const Demuxer& demuxer() const { return reader_.demuxer(); }

  // Opens a fresh decoder for the packets from this one on, up to the one before `end` (none: all).
  // Errors: cannot_read (no decoder for this codec, or it refuses the stream); those of PacketReader::go_to.
  [[nodiscard]] Result<void> start(int ordinal, const DecoderSettings& settings, std::optional<int> end = {});

  // The next image; nothing at the end. Errors are those of PacketReader::next; damage is not an error: see damaged().
  [[nodiscard]] Result<std::optional<DecodedFrame>> next();

  // Ordinal of the last packet that was given to the decoder since start().
  [[nodiscard]] int fed() const { return fed_; }

  // The packets since start() that are damaged, as reported by the decoder, the container or a checksum. Once an image
  // has been returned, the set is complete for all packets up to that of the image.
  [[nodiscard]] const std::set<int>& damaged() const { return damaged_; }

 private:
  [[nodiscard]] Result<void> feed();
  void add_quantisers(DecodedFrame& image);
  void note_decoder_errors();
  void note_refusal();

  PacketReader reader_;
  const PacketTable* table_;
  // With several threads FFmpeg 5.1 loses flags on images, but not the decoder's reports.
  std::unique_ptr<DecoderErrors> decoder_errors_ = std::make_unique<DecoderErrors>();
  CodecPtr decoder_;  // of the last start()
  PacketPtr packet_ = new_packet();
  int fed_ = -1;
  int end_ = 0;              // ordinal before which the input ends
  std::deque<int> in_work_;  // packets whose result is not known yet, one per thread
  std::set<int> damaged_;
  bool wants_quantisers_ = false;
  std::map<int, JpegTables> tables_;                   // by ordinal, of JPEG images that the decoder has not given yet
  std::shared_ptr<const FrameQuantisers> quantisers_;  // of the last image given since start()
};

// Which packet gives the n-th image, and when it is shown.
struct FrameOrder {
  std::vector<int> ordinals{};  // of each image's packet, in order of presentation
  // For each image: decoding can begin at its packet, and gives it and all later images without the ones before.
  std::vector<bool> can_start{};
  std::vector<double> times_s{};   // 0 for the first, increasing
  bool times_are_nominal = false;  // the container's time stamps are missing or do not increase
  bool intra_only = false;         // every packet can be decoded alone
  bool in_fields = false;          // an image may consist of two packets; it has the ordinal of the first
  bool decodes_ahead = false;      // the decoder works on several images at a time
  int reorder_depth = 0;           // DecoderSettings::reorder_depth
};

// The order from the packets alone, where each gives exactly one image and has its own time stamp; else nothing.
[[nodiscard]] std::optional<FrameOrder> order_from_packets(const PacketTable& table, const AVFormatContext& format,
                                                           const AVStream& stream);

// The order found by decoding everything: for codecs with hidden or repeated images, and containers without time stamps
// or with an unreliable index.
//   frame_rate  spaces the images where the container has no usable times
[[nodiscard]] Result<FrameOrder> order_from_decoding(const PacketTable& table, FrameDecoder& images,
                                                     AVRational frame_rate);

}  // namespace sigs::libav
