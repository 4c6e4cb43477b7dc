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

#include "editor/preview/composer.h"
#include "editor/preview/footage_opening.h"
#include "editor/preview/frame_cache.h"
#include "editor/preview/picture_names.h"
#include "editor/preview/previewer.h"

namespace sigs::editor {

// A footage by the number that its name has in the book.
struct FootageId {
  std::uint64_t id = 0;  // 0: none yet
  std::filesystem::path path;
};

// What the composing thread finds when it looks up.
struct Turn {
  std::uint64_t version = 0;
  std::optional<Wanted> wanted;
  FootageId footage;                              // that is open
  std::shared_ptr<const Footage> opened_footage;  // null: none yet
  std::optional<FrameKey> fresh;                  // what was decoded last because it was wanted then
  bool ahead = false;                             // whether now is a time to fetch ahead
};

// What the decoding thread is to do next.
struct DecodingTask {
  std::optional<FootageId> open;
  std::unique_ptr<FrameSource> source;  // in place of the one before
  bool adopt = false;                   // source counts, also where it is null
  std::optional<FrameKey> decode;
};

// Where the window, the decoding and the composing thread put things down for each other. All calls may come from any
// thread and none takes long, but for those that say that they wait. Frames of pictures are kept by the number of
// their project's picture name ("state"), those of the footage by the footage's.
class Board {
 public:
  Board(PreviewLimits limits, std::function<void()> wake);

  // The window's side.
  void want(const Wanted& wanted);
  [[nodiscard]] Shown shown() const;
  void set_texture_bytes(std::size_t bytes);
  void set_modest(bool modest);
  void stop();

  // The decoding thread's side. Waits; nothing: stop.
  [[nodiscard]] std::optional<DecodingTask> next_decoding();
  void put_opened(const FootageId& footage, OpenedFootage opened);
  void put_decoded(FrameKey key, std::shared_ptr<const Decoded> decoded);

  // The composing thread's side. Nothing: stop.
  [[nodiscard]] std::optional<Turn> turn();
  // Waits until something is new since that turn, or for so long.
  void rest(std::uint64_t version, std::chrono::milliseconds at_most);
  void name_revision(std::uint64_t revision, std::uint64_t state, const FootageId& footage);
  [[nodiscard]] std::shared_ptr<const Decoded> decoded(FrameKey key) const;
  [[nodiscard]] bool has_picture(FrameKey key) const;
  // The next frame worth composing ahead that is decoded; grey footage always is.
  [[nodiscard]] std::optional<int> next_ahead(const Turn& turn, std::uint64_t state, int frame_count) const;
  void put_scene(std::shared_ptr<const OpenedScene> scene);
  void put_picture(FrameKey key, std::shared_ptr<const Picture> picture, double took_ms, bool was_wanted);
  void put_untouched(FrameKey key, std::shared_ptr<const cv::Mat> bgr);
  void put_staged(FrameKey key, std::shared_ptr<const Picture> picture);
  void put_compared(FrameKey key, std::shared_ptr<const Picture> picture);
  [[nodiscard]] bool has_untouched(FrameKey key) const;
  [[nodiscard]] bool has_staged(FrameKey key) const;
  // staged: with its stages; what could not be composed has none.
  [[nodiscard]] bool has_compared(FrameKey key, MethodChoice method, bool staged) const;
  void put_surveys(std::vector<std::shared_ptr<const Survey>> surveys);
  void put_model(std::shared_ptr<const ModelPicture> model);

 private:
  using Clock = std::chrono::steady_clock;
  template <class T>
  struct Kept {
    FrameKey key;
    std::shared_ptr<const T> value;  // null: nothing yet
    [[nodiscard]] bool is(FrameKey other) const { return value && key == other; }
  };

  // Changes something under the lock, then tells the window: at once, or soon.
  template <class Change>
  void put(bool at_once, const Change& change);

  // All below under the lock.
  void look_up();  // the threads
  [[nodiscard]] bool tells_now(bool at_once);
  [[nodiscard]] std::optional<FrameKey> wanted_key() const;
  [[nodiscard]] int clamped(int frame) const;
  [[nodiscard]] std::shared_ptr<const Picture> found(FrameKey key) const;
  [[nodiscard]] bool is_decoded(FrameKey key) const;
  [[nodiscard]] bool may_fetch_ahead() const;
  [[nodiscard]] std::optional<FrameKey> next_to_decode() const;
  void follow_playhead();
  [[nodiscard]] std::size_t shown_bytes(bool also_cached) const;
  [[nodiscard]] MemoryUse memory() const;
  void share_memory();
  void remember_name(std::uint64_t revision, std::uint64_t state);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::function<void()> wake_;
  PreviewLimits limits_;
  bool stop_ = false;
  bool modest_ = false;
  std::uint64_t version_ = 1;  // counts what the threads should look at

  std::optional<Wanted> wanted_;
  Clock::time_point revised_{};
  struct NamedRevision {
    std::uint64_t state = 0;
    std::uint64_t named = 0;  // when, counted: what was named last is known longest
  };
  std::map<std::uint64_t, NamedRevision> revisions_;
  std::map<std::uint64_t, std::uint64_t> revision_named_;  // by `named`: the oldest comes first
  std::uint64_t namings_ = 0;

  FootageId footage_wanted_;
  std::uint64_t opening_ = 0;
  FootageId footage_;
  std::shared_ptr<const Footage> opened_footage_;
  std::optional<std::unique_ptr<FrameSource>> arrived_;
  FrameCache<Decoded> decoded_;
  Kept<Decoded> fresh_;
  std::size_t decoded_bytes_ = 0;  // of one

  std::shared_ptr<const OpenedScene> scene_;
  FrameCache<Picture> pictures_;
  std::size_t picture_bytes_ = 0;  // of one
  std::size_t texture_bytes_ = 0;  // the window's
  Kept<Picture> newest_;
  Kept<cv::Mat> untouched_;
  Kept<Picture> staged_;
  Kept<Picture> compared_;
  std::vector<std::shared_ptr<const Survey>> surveys_;
  std::shared_ptr<const ModelPicture> model_;
  double compose_ms_ = 0;

  bool composing_ = false;
  bool decoding_ = false;
  bool news_ = false;  // that the window has not been told of
  Clock::time_point told_{};
};

// Frames after the playhead in the order in which they are likely to be wanted: within the range, and round to its
// other end while it is played.
[[nodiscard]] std::vector<int> frames_ahead(const Wanted& wanted, int frame_count, int most);

}  // namespace sigs::editor
