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

// The footage of a project in one version of its files: the same path with another stamp on disk is other footage.
struct FootageId {
  // Of the file's stamp, of whether frames are read with their quantisers, and of the times of footage in images;
  // ContentId(): none is known yet.
  ContentId id;
  // A project with this footage, to open it by. Null where the id is that of nothing.
  std::shared_ptr<const Project> project;
};

// What the rendering thread works by: a copy of the state at one moment. It may be out of date at any time after; what
// is rendered by it is kept under its own key and therefore never shown as something else.
struct PreviewSnapshot {
  std::uint64_t version = 0;             // number of this state, for wait_for_changes()
  std::optional<PreviewRequest> wanted;  // none: nothing was asked for yet
  // The footage that is open, and what is known of it; null: none yet.
  FootageId footage;
  std::shared_ptr<const Footage> opened_footage;
  // The last frame that was decoded because it was wanted, by the id of its footage. None: no frame yet.
  std::optional<FrameKey> fresh;
  // Whether frames may be composited ahead: not while paused, and not within 200 ms after an edit.
  bool ahead = false;
};

// What the decoding thread is to do next; exactly one of the three.
struct DecodeTask {
  std::optional<FootageId> open;  // open this footage on a thread of its own and report it by put_opened()
  // Where adopt is set: read from this source from now on, in place of the one before. Null: the footage has no video.
  std::unique_ptr<FrameSource> source;
  bool adopt = false;
  std::optional<FrameKey> decode;  // decode this frame, by the id of its footage, and report it by put_decoded()
};

// The state that the window, the decoding and the rendering thread share: requests one way, results the other. All
// calls may come from any thread; each holds one lock for a short time, and only those that say so wait for something.
// Images are kept by the combined_id() of their project's settings and files, frames of the footage by the FootageId,
// so that undo and files that come back find what was made before. What is handed in or out is never changed
// afterwards: it is shared as pointers to const.
class PreviewState {
 public:
  // wake  called without the lock, on the thread that brought the news; it must be quick and may be empty
  PreviewState(PreviewLimits limits, std::function<void()> wake);

  // For the window. Texture bytes and the pause are as in Previewer. A request equal to the last one changes nothing.
  // Extra images that the request no longer asks for are dropped at once.
  void want(const PreviewRequest& wanted);
  // Copies pointers, not images. An image that is in memory for the wanted frame is there at once, also after undo.
  [[nodiscard]] PreviewOutput shown() const;
  void set_texture_bytes(std::size_t bytes) { set_bytes(texture_bytes_, bytes); }
  // PreviewLimits::cache_bytes from now on.
  void set_cache_bytes(std::size_t bytes) { set_bytes(limits_.cache_bytes, bytes); }
  void set_prefetch_paused(bool paused);
  // From then on snapshot() and next_decoding() return none, those that wait included, and wake is not called any more.
  void stop();

  // For the decoding thread. Waits until there is something to do; none: stop. First comes a source to adopt, then
  // footage to open, then the wanted frame, then frames ahead of it.
  [[nodiscard]] std::optional<DecodeTask> next_decoding();
  // Called by the thread that opened the footage. Dropped where other footage is wanted by then.
  void put_opened(const FootageId& footage, OpenedFootage opened);
  // key: by the footage's id. Does not wake the window, which shows composited frames; it wakes the rendering thread.
  void put_decoded(FrameKey key, std::shared_ptr<const DecodedFrame> decoded);

  // For the rendering thread, at the start of each of its steps. None: stop.
  [[nodiscard]] std::optional<PreviewSnapshot> snapshot();
  // Waits until something has changed since the snapshot of that version, or for at_most. Before that it tells the
  // window of all that it has not heard of: the rendering thread calls this when it has nothing to do.
  void wait_for_changes(std::uint64_t version, std::chrono::milliseconds at_most);
  // How the files of the wanted revision lie on disk: input_files_id_of() and the footage among them. Until the next
  // call this counts for every revision that is wanted, so that undo finds its images without the rendering thread.
  // Another footage than the open one is opened.
  void set_input_files(const ContentId& input_files, const FootageId& footage);
  // key: by the footage's id. Null where the frame is not in memory.
  [[nodiscard]] std::shared_ptr<const DecodedFrame> decoded(FrameKey key) const;
  // Whether there is a composited frame, by the project's own method, in a cache or shown.
  [[nodiscard]] bool has_image(FrameKey key) const;
  // The next frame to composite ahead: the first of prefetch_order() that is not there, if its footage is decoded (grey
  // footage always is) and the cache would keep it.
  [[nodiscard]] std::optional<int> next_prefetch(const PreviewSnapshot& snapshot, const ContentId& content,
                                                 int frame_count) const;
  // A revision was opened: the window shows its scene from now on. Surveys stay until others come, unless the number of
  // intruders is another one.
  void put_scene(std::shared_ptr<const OpenedScene> scene);
  // A composited frame by the project's own method.
  //   took_ms     time that composing it took; reported for wanted frames only
  //   was_wanted  shown at once. Otherwise it was composited ahead: it goes to the cache alone, and the window may hear
  //               of it up to 0.25 s later
  void put_image(FrameKey key, std::shared_ptr<const PreviewImage> image, double took_ms, bool was_wanted);
  // Extra images of the wanted frame. Each is dropped where the window no longer asks for its kind. The key of the
  // untouched frame is by the footage's id, the others by combined_id().
  void put_untouched(FrameKey key, std::shared_ptr<const ShownImage> image);
  void put_staged(FrameKey key, std::shared_ptr<const PreviewImage> image);
  void put_compared(FrameKey key, std::shared_ptr<const PreviewImage> image);
  [[nodiscard]] bool has_untouched(FrameKey key) const {
    const std::lock_guard lock(mutex_);
    return untouched_.is(key);
  }
  [[nodiscard]] bool has_staged(FrameKey key) const {
    const std::lock_guard lock(mutex_);
    return staged_.is(key);
  }
  // staged: with its stages; a frame that could not be composed has none.
  [[nodiscard]] bool has_compared(FrameKey key, MethodChoice method, bool staged) const;
  // One for each of the project's intruders; null: not made yet.
  void put_surveys(std::vector<std::shared_ptr<const Survey>> surveys);
  void put_model(std::shared_ptr<const ModelImage> model);

 private:
  using Clock = std::chrono::steady_clock;
  // One image outside of the caches, with what it is an image of.
  template <class T>
  struct Slot {
    FrameKey key;
    std::shared_ptr<const T> value;  // null: nothing yet
    [[nodiscard]] bool is(FrameKey other) const { return value && key == other; }
  };

  void set_bytes(std::size_t& place, std::size_t bytes);
  // Makes a change under the lock, shares out the memory anew, then wakes the window without the lock: at once, or
  // within a quarter of a second.
  template <class Change>
  void put(bool at_once, const Change& change);

  // The lock is held in all that follow. This one has the two threads look at the state again.
  void notify_threads();
  // Whether wake_ is to be called, once the lock is released. Otherwise has_news_ remembers it.
  [[nodiscard]] bool should_wake(bool at_once);
  // Under which the wanted image is kept; none: nothing is wanted.
  [[nodiscard]] std::optional<FrameKey> wanted_key() const;
  [[nodiscard]] int clamped(int frame) const;  // into the frames of the scene that is open; unchanged without one
  [[nodiscard]] std::shared_ptr<const PreviewImage> found(FrameKey key) const;
  [[nodiscard]] bool is_decoded(FrameKey key) const;
  [[nodiscard]] std::optional<FrameKey> next_to_decode() const;
  // Whether frames are decoded and composited ahead of the playhead.
  [[nodiscard]] bool is_time_for_more() const;
  // Tells the caches where the playhead is, and shows the wanted image where a cache holds it.
  void follow_playhead();
  [[nodiscard]] std::size_t shown_bytes(bool also_cached) const;
  [[nodiscard]] MemoryUse memory() const;
  // Sets the limits of both caches by what textures and shown images leave of PreviewLimits::cache_bytes.
  void share_memory();

  // Guards all that follows but wake_, which never changes.
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::function<void()> wake_;
  PreviewLimits limits_;
  bool stop_ = false;
  bool prefetch_paused_ = false;
  std::uint64_t version_ = 1;  // counts what the threads should look at

  std::optional<PreviewRequest> wanted_;
  Clock::time_point revised_{};  // when another revision was wanted than before
  Clock::time_point jumped_{};   // when another frame was wanted than the one before or after, while nothing played
  ContentId input_files_;        // the files of the wanted revision as they were looked at last (set_input_files)

  // The footage that the wanted revision names, the last that was given out to be opened, and the one that is open.
  FootageId footage_wanted_;
  ContentId opening_;
  FootageId footage_;
  std::shared_ptr<const Footage> opened_footage_;
  // Opened, and not yet taken by the decoding thread; the inner pointer is null where there is no video.
  std::optional<std::unique_ptr<FrameSource>> arrived_;
  FrameCache<DecodedFrame> decoded_;
  Slot<DecodedFrame> last_decoded_;  // kept beside the cache, whose limit may be too small for even one frame
  std::size_t decoded_bytes_ = 0;    // of one frame, the last that came: by it the room for the next one is judged

  std::shared_ptr<const OpenedScene> scene_;
  FrameCache<PreviewImage> images_;
  std::size_t image_bytes_ = 0;    // of one image, likewise
  std::size_t texture_bytes_ = 0;  // held by the window, as it says
  // What the window shows: the wanted frame, or the last that was wanted before it. The other three are its extra
  // images.
  Slot<PreviewImage> newest_;
  Slot<ShownImage> untouched_;
  Slot<PreviewImage> staged_;
  Slot<PreviewImage> compared_;
  std::vector<std::shared_ptr<const Survey>> surveys_;
  std::shared_ptr<const ModelImage> model_;
  double compose_ms_ = 0;

  // A thread is at work, or was since the rendering thread last waited: PreviewOutput::busy.
  bool rendering_ = false;
  bool decoding_ = false;
  bool has_news_ = false;  // there is something to show that the window has not been told of
  Clock::time_point last_wake_{};
};

// Numbers of the frames after the playhead, at most `maximum`, in the order in which they are likely to be wanted: in
// the direction of the request to the end of its range, then, while it plays, on from the other end. The wanted frame
// is not among them. frame_count: of the footage, at least 1; the range is clamped to it.
[[nodiscard]] std::vector<int> prefetch_order(const PreviewRequest& wanted, int frame_count, int maximum);

// The preview: opens, decodes and composes on two threads of its own. The window's thread calls it; every call returns
// at once. Each call hands over the whole of what is wanted, and the newest replaces those before, so nothing queues
// up.
class Previewer {
 public:
  // wake  called from another thread whenever there is something new to show
  // Throws std::system_error where the system gives no threads: without them there is no editor.
  Previewer(PreviewLimits limits, std::function<void()> wake);
  // Stops both threads and waits for the step that each is at. Footage that is being opened is not waited for.
  ~Previewer() { end(); }
  Previewer(const Previewer&) = delete;
  Previewer& operator=(const Previewer&) = delete;

  // Once per update of the window.
  void want(const PreviewRequest& wanted) { state_->want(wanted); }
  // What there is to show by now; it may be of an earlier request.
  [[nodiscard]] PreviewOutput shown() const { return state_->shown(); }

  // Bytes that the window holds in textures; the caches keep so much less.
  void set_texture_bytes(std::size_t bytes) { state_->set_texture_bytes(bytes); }

  // PreviewLimits::cache_bytes from now on: several previews share the memory.
  void set_cache_bytes(std::size_t bytes) { state_->set_cache_bytes(bytes); }

  // While set, nothing is decoded or composited ahead: exporting shares the machine. The wanted frame is made as ever.
  void set_prefetch_paused(bool paused) { state_->set_prefetch_paused(paused); }

 private:
  void end();

  std::shared_ptr<PreviewState> state_;  // footage that is still being opened keeps it too
  std::thread decoder_;
  std::thread renderer_;
};

// The decoding thread's work, until the preview state says stop: opens footage, decodes what is wanted and what lies
// ahead. Opening goes on by itself, so that other footage can be wanted meanwhile, and may outlive this call: it cannot
// be broken off.
void run_decoder(const std::shared_ptr<PreviewState>& preview_state);
// That of the rendering thread, at kPreviewNiceness. Where it has nothing to do, it still looks at the project's files
// once a second.
void run_renderer(PreviewState& preview_state);

}  // namespace sigs::editor
