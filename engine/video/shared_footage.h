// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "base/result.h"
#include "video/frame_source.h"

namespace sigs {

// One image of the footage and the slices of it that encoders have coded so far. Videos of the same footage differ only
// where their intruders are: where a slice of theirs has the footage's samples, one of them codes it and the others
// copy it. May be used from any thread.
class CodedFootage {
 public:
  static constexpr std::size_t kSlices = 4;  // of FFV1

  // image: nobody writes to its samples any more
  explicit CodedFootage(Frame image) : image_(std::move(image)) {}

  [[nodiscard]] const Frame& image() const { return image_; }

  // The bytes of a slice, which code() gives the first time; meanwhile others that want it wait. They must depend on
  // the image's samples and `header` alone, with which they begin; those of another header are coded and not kept.
  [[nodiscard]] std::vector<std::uint8_t> slice(std::size_t number, const std::vector<std::uint8_t>& header,
                                                const std::function<std::vector<std::uint8_t>()>& code);

 private:
  struct Slice {
    std::mutex mutex;
    std::vector<std::uint8_t> bytes;  // empty: not coded yet
  };
  Frame image_;
  std::array<Slice, kSlices> slices_;
};

// One decoder for several readers that go through the same footage at the same time, each on a thread of its own; they
// use it by FrameSource::shared(). It has no thread: a frame is decoded by the reader that asks for it first, and kept
// until all have read it. A reader that is `ahead` frames before the slowest waits; the slowest never waits for another
// one, so some reader always goes on. Memory: `ahead` frames.
class SharedFootage {
 public:
  // readers: the frames that each will read, in rising order; ahead: 1 or more
  SharedFootage(FrameSource source, const std::vector<FrameSteps>& readers, int ahead);

  [[nodiscard]] const VideoInfo& info() const { return source_.info(); }

  // Frame n, whose samples no other reader has. Frames out of order are right too, but may be decoded again. Errors as
  // FrameSource::read(), the same one for each reader of the frame.
  [[nodiscard]] Result<Frame> read(std::size_t reader, int n);

  // No frame is kept for the reader any more, and none waits for it. To be called once for each.
  void leave(std::size_t reader);

 private:
  struct Reader {
    int next = 0;  // the frame that it is to read next; kGone: none
    int last = 0;
  };
  using Decoded = std::shared_ptr<const Result<Frame>>;
  static constexpr int kGone = std::numeric_limits<int>::max();

  [[nodiscard]] int slowest() const;
  [[nodiscard]] bool is_kept(int n) const;
  [[nodiscard]] bool may_decode(int n) const;
  void advance(std::size_t reader, int next);
  [[nodiscard]] Decoded decoded(std::unique_lock<std::mutex>& lock, int n);

  FrameSource source_;  // used by the thread for which is_decoding_ was set
  std::size_t ahead_;
  std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  std::vector<Reader> readers_;
  std::deque<Decoded> kept_;  // frames first_kept_, first_kept_ + 1, ...
  int first_kept_ = 0;
  bool is_decoding_ = false;
};

}  // namespace sigs
