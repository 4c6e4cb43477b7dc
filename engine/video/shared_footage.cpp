// SPDX-License-Identifier: MIT
#include "video/shared_footage.h"

#include <algorithm>

#include "base/ensure.h"
#include "base/threads.h"

namespace sigs {

std::vector<std::uint8_t> CodedFootage::slice(std::size_t number, const std::vector<std::uint8_t>& header,
                                              const std::function<std::vector<std::uint8_t>()>& code) {
  Slice& slice = slices_.at(number);
  const std::lock_guard lock(slice.mutex);
  if (slice.bytes.empty()) return slice.bytes = code();
  const bool same_header =
      header.size() <= slice.bytes.size() && std::equal(header.begin(), header.end(), slice.bytes.begin());
  return same_header ? slice.bytes : code();
}

SharedFootage::SharedFootage(FrameSource source, const std::vector<FrameSteps>& readers, int ahead)
    : source_(std::move(source)), ahead_(static_cast<std::size_t>(ahead)) {
  ENSURE(ahead >= 1);
  for (const FrameSteps& frames : readers) readers_.push_back({frames.first, frames.at(frames.count - 1)});
  first_kept_ = slowest();
}

int SharedFootage::slowest() const {
  int n = kGone;
  for (const Reader& reader : readers_) n = std::min(n, reader.next);
  return n;
}

bool SharedFootage::is_kept(int n) const {
  return n >= first_kept_ && n < first_kept_ + static_cast<int>(kept_.size());
}

// The slowest reader may always, so that it waits for none: its frame is the first that is needed, and nothing is kept.
bool SharedFootage::may_decode(int n) const {
  if (is_decoding_) return false;
  return n <= slowest() || (n == first_kept_ + static_cast<int>(kept_.size()) && kept_.size() < ahead_);
}

void SharedFootage::advance(std::size_t reader, int next) {
  readers_[reader].next = next;
  const int needed = slowest();
  while (!kept_.empty() && first_kept_ < needed) {
    kept_.pop_front();
    ++first_kept_;
  }
  changed_.notify_all();
}

// Decodes while the lock is released.
SharedFootage::Decoded SharedFootage::decoded(std::unique_lock<std::mutex>& lock, int n) {
  is_decoding_ = true;
  lock.unlock();
  Result<Frame> frame = guarded([&] { return source_.read(n); });
  if (frame) frame->coded = std::make_shared<CodedFootage>(*frame);
  lock.lock();
  is_decoding_ = false;
  auto decoded = std::make_shared<const Result<Frame>>(std::move(frame));
  if (n >= first_kept_ + static_cast<int>(kept_.size())) {
    if (kept_.empty()) first_kept_ = n;
    kept_.push_back(decoded);
  }
  changed_.notify_all();
  return decoded;
}

Result<Frame> SharedFootage::read(std::size_t reader, int n) {
  Decoded frame;
  {
    std::unique_lock lock(mutex_);
    if (n != readers_[reader].next) advance(reader, n);
    changed_.wait(lock, [&] { return is_kept(n) || may_decode(n); });
    frame = is_kept(n) ? kept_[static_cast<std::size_t>(n - first_kept_)] : decoded(lock, n);
    advance(reader, n < readers_[reader].last ? n + 1 : kGone);
  }
  if (!*frame) return fail(frame->error());
  return cloned(**frame);
}

void SharedFootage::leave(std::size_t reader) {
  const std::lock_guard lock(mutex_);
  advance(reader, kGone);
}

}  // namespace sigs
