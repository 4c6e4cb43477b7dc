// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "editor/preview/content_id.h"
#include "editor/preview/frame_cache.h"
#include "editor/preview/opened_footage.h"
#include "editor/preview/previewer.h"
#include "editor/preview/scene_renderer.h"

namespace sigs::editor {

// A footage by the number that its name has in the book.
struct FootageId {
  std::uint64_t id = 0;  // 0: none yet
  std::filesystem::path path;
};

// What the rendering thread finds when it looks up.
struct PreviewSnapshot {
  std::uint64_t version = 0;
  std::optional<PreviewRequest> wanted;
  FootageId footage;                              // that is open
  std::shared_ptr<const Footage> opened_footage;  // null: none yet
  std::optional<FrameKey> fresh;                  // what was decoded last because it was wanted then
  bool ahead = false;                             // whether now is a time to fetch ahead
};

// What the decoding thread is to do next.
struct DecodeTask {
  std::optional<FootageId> open;
  std::unique_ptr<FrameSource> source;  // in place of the one before
  bool adopt = false;                   // source counts, also where it is null
  std::optional<FrameKey> decode;
};

// Where the window, the decoding and the rendering thread leave requests and results for each other. All calls may come
// from any thread and none takes long, but for those that say that they wait. Frames of images are kept by the number
// of their project's image name ("state"), those of the footage by the footage's.
class PreviewState {
 public:
  PreviewState(PreviewLimits limits, std::function<void()> wake);

  // The window's side.
  void want(const PreviewRequest& wanted);
  [[nodiscard]] PreviewOutput shown() const;
  void set_texture_bytes(std::size_t bytes);
  void set_prefetch_paused(bool paused);
  void stop();

  // The decoding thread's side. Waits; nothing: stop.
  [[nodiscard]] std::optional<DecodeTask> next_decoding();
  void put_opened(const FootageId& footage, OpenedFootage opened);
  void put_decoded(FrameKey key, std::shared_ptr<const DecodedFrame> decoded);

  // The rendering thread's side. Nothing: stop.
  [[nodiscard]] std::optional<PreviewSnapshot> snapshot();
  // Waits until something is new since that snapshot, or for so long.
  void wait_for_changes(std::uint64_t version, std::chrono::milliseconds at_most);
  void identify_revision(std::uint64_t revision, std::uint64_t state, const FootageId& footage);
  [[nodiscard]] std::shared_ptr<const DecodedFrame> decoded(FrameKey key) const;
  [[nodiscard]] bool has_image(FrameKey key) const;
  // The next frame worth rendering ahead that is decoded; grey footage always is.
  [[nodiscard]] std::optional<int> next_prefetch(const PreviewSnapshot& snapshot, std::uint64_t state,
                                                 int frame_count) const;
  void put_scene(std::shared_ptr<const OpenedScene> scene);
  void put_image(FrameKey key, std::shared_ptr<const PreviewImage> image, double took_ms, bool was_wanted);
  void put_untouched(FrameKey key, std::shared_ptr<const cv::Mat> bgr);
  void put_staged(FrameKey key, std::shared_ptr<const PreviewImage> image);
  void put_compared(FrameKey key, std::shared_ptr<const PreviewImage> image);
  [[nodiscard]] bool has_untouched(FrameKey key) const;
  [[nodiscard]] bool has_staged(FrameKey key) const;
  // staged: with its stages; what could not be composed has none.
  [[nodiscard]] bool has_compared(FrameKey key, MethodChoice method, bool staged) const;
  void put_surveys(std::vector<std::shared_ptr<const Survey>> surveys);
  void put_model(std::shared_ptr<const ModelImage> model);

 private:
  using Clock = std::chrono::steady_clock;
  template <class T>
  struct Slot {
    FrameKey key;
    std::shared_ptr<const T> value;  // null: nothing yet
    [[nodiscard]] bool is(FrameKey other) const { return value && key == other; }
  };

  // Changes something under the lock, then tells the window: at once, or soon.
  template <class Change>
  void put(bool at_once, const Change& change);

  // All below under the lock.
  void notify_threads();  // the threads
  [[nodiscard]] bool should_wake(bool at_once);
  [[nodiscard]] std::optional<FrameKey> wanted_key() const;
  [[nodiscard]] int clamped(int frame) const;
  [[nodiscard]] std::shared_ptr<const PreviewImage> found(FrameKey key) const;
  [[nodiscard]] bool is_decoded(FrameKey key) const;
  [[nodiscard]] bool may_prefetch() const;
  [[nodiscard]] std::optional<FrameKey> next_to_decode() const;
  void follow_playhead();
  [[nodiscard]] std::size_t shown_bytes(bool also_cached) const;
  [[nodiscard]] MemoryUse memory() const;
  void share_memory();
  void remember_id(std::uint64_t revision, std::uint64_t state);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::function<void()> wake_;
  PreviewLimits limits_;
  bool stop_ = false;
  bool prefetch_paused_ = false;
  std::uint64_t version_ = 1;  // counts what the threads should look at

  std::optional<PreviewRequest> wanted_;
  Clock::time_point revised_{};
  struct KnownRevision {
    std::uint64_t state = 0;
    std::uint64_t named = 0;  // when, counted: what was named last is known longest
  };
  std::map<std::uint64_t, KnownRevision> revisions_;
  std::map<std::uint64_t, std::uint64_t> revisions_by_time_;  // by `named`: the oldest comes first
  std::uint64_t identifications_ = 0;

  FootageId footage_wanted_;
  std::uint64_t opening_ = 0;
  FootageId footage_;
  std::shared_ptr<const Footage> opened_footage_;
  std::optional<std::unique_ptr<FrameSource>> arrived_;
  FrameCache<DecodedFrame> decoded_;
  Slot<DecodedFrame> last_decoded_;
  std::size_t decoded_bytes_ = 0;  // of one

  std::shared_ptr<const OpenedScene> scene_;
  FrameCache<PreviewImage> images_;
  std::size_t image_bytes_ = 0;    // of one
  std::size_t texture_bytes_ = 0;  // the window's
  Slot<PreviewImage> newest_;
  Slot<cv::Mat> untouched_;
  Slot<PreviewImage> staged_;
  Slot<PreviewImage> compared_;
  std::vector<std::shared_ptr<const Survey>> surveys_;
  std::shared_ptr<const ModelImage> model_;
  double compose_ms_ = 0;

  bool rendering_ = false;
  bool decoding_ = false;
  bool has_news_ = false;  // that the window has not been told of
  Clock::time_point last_wake_{};
};

// Frames after the playhead in the order in which they are likely to be wanted: within the range, and round to its
// other end while it is played.
[[nodiscard]] std::vector<int> prefetch_order(const PreviewRequest& wanted, int frame_count, int maximum);

}  // namespace sigs::editor
