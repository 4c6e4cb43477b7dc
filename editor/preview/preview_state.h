// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "editor/document/content_id.h"
#include "editor/preview/frame_cache.h"
#include "editor/preview/opened_footage.h"
#include "editor/preview/preview_output.h"

namespace sigs::editor {

// A video file in one of its versions.
struct FootageId {
  ContentId id;  // of its stamp; ContentId(): none is known yet
  std::filesystem::path path;
};

// What the rendering thread works by: a copy of the state at one moment.
struct PreviewSnapshot {
  std::uint64_t version = 0;                      // see wait_for_changes()
  std::optional<PreviewRequest> wanted;           // none: nothing was asked for yet
  FootageId footage;                              // that is open
  std::shared_ptr<const Footage> opened_footage;  // null: none yet
  std::optional<FrameKey> fresh;                  // the frame that was decoded last because it was wanted
  bool ahead = false;                             // whether frames may be composited ahead
};

// What the decoding thread is to do next; one of the three.
struct DecodeTask {
  std::optional<FootageId> open;        // open this footage
  std::unique_ptr<FrameSource> source;  // where adopt is set: read from this one from now on; null: there is none
  bool adopt = false;
  std::optional<FrameKey> decode;  // decode this frame
};

// The state that the window, the decoding and the rendering thread share: requests one way, results the other. All
// calls may come from any thread, and none takes long except those that say that they wait. Images are kept by the
// combined_id() of their project's settings and files, frames of the footage by the FootageId.
class PreviewState {
 public:
  PreviewState(PreviewLimits limits, std::function<void()> wake);

  // For the window. Texture bytes and the pause are as in Previewer.
  void want(const PreviewRequest& wanted);
  [[nodiscard]] PreviewOutput shown() const;
  void set_texture_bytes(std::size_t bytes);
  void set_prefetch_paused(bool paused);
  void stop();

  // For the decoding thread. Waits until there is something to do; none: stop.
  [[nodiscard]] std::optional<DecodeTask> next_decoding();
  void put_opened(const FootageId& footage, OpenedFootage opened);
  void put_decoded(FrameKey key, std::shared_ptr<const DecodedFrame> decoded);

  // For the rendering thread. None: stop.
  [[nodiscard]] std::optional<PreviewSnapshot> snapshot();
  // Waits until something has changed since the snapshot of that version, or for so long.
  void wait_for_changes(std::uint64_t version, std::chrono::milliseconds at_most);
  // How the files of the wanted revision lie on disk: input_files_id_of() and the footage among them. Until the next
  // call this counts for every revision that is wanted, so that undo finds its images without the rendering thread.
  void set_input_files(const ContentId& input_files, const FootageId& footage);
  [[nodiscard]] std::shared_ptr<const DecodedFrame> decoded(FrameKey key) const;
  [[nodiscard]] bool has_image(FrameKey key) const;
  // The next frame to composite ahead: the first of prefetch_order() that is not there, if its footage is decoded (grey
  // footage always is) and the cache would keep it.
  [[nodiscard]] std::optional<int> next_prefetch(const PreviewSnapshot& snapshot, const ContentId& content,
                                                 int frame_count) const;
  void put_scene(std::shared_ptr<const OpenedScene> scene);
  void put_image(FrameKey key, std::shared_ptr<const PreviewImage> image, double took_ms, bool was_wanted);
  void put_untouched(FrameKey key, std::shared_ptr<const cv::Mat> bgr);
  void put_staged(FrameKey key, std::shared_ptr<const PreviewImage> image);
  void put_compared(FrameKey key, std::shared_ptr<const PreviewImage> image);
  [[nodiscard]] bool has_untouched(FrameKey key) const;
  [[nodiscard]] bool has_staged(FrameKey key) const;
  // staged: with its stages; a frame that could not be composed has none.
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

  // Makes a change under the lock, then wakes the window: at once, or within a quarter of a second.
  template <class Change>
  void put(bool at_once, const Change& change);

  // The lock is held in all that follow.
  void notify_threads();
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

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::function<void()> wake_;
  PreviewLimits limits_;
  bool stop_ = false;
  bool prefetch_paused_ = false;
  std::uint64_t version_ = 1;  // counts what the threads should look at

  std::optional<PreviewRequest> wanted_;
  Clock::time_point revised_{};
  ContentId input_files_;  // as they were looked at last

  FootageId footage_wanted_;
  ContentId opening_;
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

// Numbers of the frames after the playhead, at most `maximum`, in the order in which they are likely to be wanted: in
// the direction of the request to the end of its range, then, while it plays, on from the other end.
[[nodiscard]] std::vector<int> prefetch_order(const PreviewRequest& wanted, int frame_count, int maximum);

// The preview: opens, decodes and composes on two threads of its own. Every call here returns at once.
class Previewer {
 public:
  // wake  called from another thread whenever there is something new to show
  // Throws std::system_error where the system gives no threads: without them there is no editor.
  Previewer(PreviewLimits limits, std::function<void()> wake);
  ~Previewer() { end(); }
  Previewer(const Previewer&) = delete;
  Previewer& operator=(const Previewer&) = delete;

  void want(const PreviewRequest& wanted) { state_->want(wanted); }
  [[nodiscard]] PreviewOutput shown() const { return state_->shown(); }

  // Bytes that the window holds in textures; the caches keep so much less.
  void set_texture_bytes(std::size_t bytes) { state_->set_texture_bytes(bytes); }

  // While set, nothing is fetched ahead: exporting shares the machine.
  void set_prefetch_paused(bool paused) { state_->set_prefetch_paused(paused); }

 private:
  void end();

  std::shared_ptr<PreviewState> state_;  // footage that is still being opened keeps it too
  std::thread decoder_;
  std::thread renderer_;
};

}  // namespace sigs::editor
