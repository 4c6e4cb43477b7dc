// SPDX-License-Identifier: MIT
#include "video/libav/splice_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/ensure.h"

namespace sigs::libav {
namespace {

enum class Fate { left_out, copied, encoded };

// A key packet and those up to the next one.
struct PacketGroup {
  int begin = 0;  // ordinals
  int end = 0;
  int key_frame = 0;    // shown by the key packet
  int first_frame = 0;  // of those shown by its packets; before key_frame in an open group
  int last_frame = -1;
  KeyKind key = KeyKind::refresh;
  Fate fate = Fate::left_out;
  bool keeps_leading = true;  // of a copied group: the frames shown before the key frame

  [[nodiscard]] bool shows_any() const { return last_frame >= first_frame; }
  [[nodiscard]] bool is_open() const { return first_frame < key_frame; }
};

class Layout {
 public:
  Layout(const PacketTable& table, const FrameOrder& order, const ChangedFrames& frames)
      : table_(table), order_(order), frames_(frames), frame_of_(static_cast<std::size_t>(table.size()), -1) {
    for (std::size_t n = 0; n < order.ordinals.size(); ++n)
      frame_of_[static_cast<std::size_t>(order.ordinals[n])] = static_cast<int>(n);
  }

  [[nodiscard]] Result<SpliceLayout> made(const AVCodecParameters& stream, PacketReader& reader) {
    list_groups();
    if (const Result<void> apart = check_apart(); !apart) return fail(apart.error());
    for (PacketGroup& group : groups_) group.fate = fate_of(group);
    if (const Result<void> joints = settle_joints(stream, reader); !joints) return fail(joints.error());
    if (const Result<void> stamps = set_stamps(); !stamps) return fail(stamps.error());
    layout_.ordinals = order_.ordinals;
    layout_.reorder_depth = order_.reorder_depth;
    layout_.is_intra_only = order_.intra_only;
    layout_.first_frame = frames_.first;
    layout_.last_frame = frames_.last();
    layout_.most_bidirectional = most_bidirectional();
    mark_copied();
    list_parts();
    return std::move(layout_);
  }

 private:
  [[nodiscard]] int frame_of(int ordinal) const { return frame_of_[static_cast<std::size_t>(ordinal)]; }

  void list_groups() {
    for (int ordinal = 0; ordinal < table_.size(); ++ordinal) {
      const int frame = frame_of(ordinal);
      const bool begins = order_.intra_only || (table_[ordinal].key && frame >= 0);
      if (groups_.empty() || (begins && groups_.back().shows_any())) {
        if (!groups_.empty()) groups_.back().end = ordinal;
        groups_.push_back({.begin = ordinal});
      }
      PacketGroup& group = groups_.back();
      group.end = ordinal + 1;
      if (frame < 0) continue;
      if (!group.shows_any()) group.key_frame = group.first_frame = group.last_frame = frame;
      group.first_frame = std::min(group.first_frame, frame);
      group.last_frame = std::max(group.last_frame, frame);
    }
  }

  // Each group's frames follow those of the group before.
  [[nodiscard]] Result<void> check_apart() const {
    int behind = -1;
    for (const PacketGroup& group : groups_) {
      if (!group.shows_any()) continue;
      if (group.first_frame != behind + 1)
        return fail("", fmt::format("its groups of pictures are shown interleaved: frame {} after {}",
                                    group.first_frame, behind));
      behind = group.last_frame;
    }
    return {};
  }

  // Whether a range that ends within the group takes the first of its packets and no others.
  [[nodiscard]] bool ends_behind_packet(const PacketGroup& group) const {
    bool beyond = false;
    for (int ordinal = group.begin; ordinal < group.end; ++ordinal) {
      const int frame = frame_of(ordinal);
      if (frame < 0) continue;
      if (frame <= frames_.last() && beyond) return false;
      beyond = beyond || frame > frames_.last();
    }
    return true;
  }

  [[nodiscard]] Fate fate_of(const PacketGroup& group) const {
    if (!group.shows_any() || group.last_frame < frames_.first || group.first_frame > frames_.last())
      return Fate::left_out;
    if (group.key_frame < frames_.first || group.key_frame > frames_.last()) return Fate::encoded;
    if (group.last_frame > frames_.last() && !ends_behind_packet(group)) return Fate::encoded;
    for (int frame = std::max(group.first_frame, frames_.first); frame <= std::min(group.last_frame, frames_.last());
         ++frame)
      if (frames_.changed[static_cast<std::size_t>(frame - frames_.first)]) return Fate::encoded;
    return Fate::copied;
  }

  [[nodiscard]] Result<KeyKind> kind_of(const PacketGroup& group, const AVCodecParameters& stream,
                                        PacketReader& reader) const {
    if (order_.intra_only) return KeyKind::refresh;
    if (const Result<void> gone = reader.go_to(group.begin); !gone) return fail(gone.error());
    const PacketPtr packet = new_packet();
    const Result<std::optional<int>> read = reader.next(*packet);
    if (!read) return fail(read.error());
    if (!*read) return KeyKind::none;
    return key_kind_of({packet->data, static_cast<std::size_t>(packet->size)}, stream.codec_id,
                       nal_length_bytes(stream));
  }

  // Copying begins, or begins again, only where decoding can.
  [[nodiscard]] Result<void> settle_joints(const AVCodecParameters& stream, PacketReader& reader) {
    const PacketGroup* before = nullptr;
    for (PacketGroup& group : groups_) {
      const bool begins_file = group.begin == 0 && group.first_frame >= frames_.first;
      if (group.fate == Fate::copied && !begins_file && (before == nullptr || before->fate != Fate::copied)) {
        const Result<KeyKind> kind = kind_of(group, stream, reader);
        if (!kind) return fail(kind.error());
        group.key = *kind;
        group.keeps_leading = !group.is_open();
        if (*kind == KeyKind::none) group.fate = Fate::encoded;
      }
      if (group.shows_any()) before = &group;
    }
    return {};
  }

  // AVI has no times of presentation; there each packet is shown as it comes.
  [[nodiscard]] std::int64_t stamp_of(int ordinal) const {
    const PacketMark& mark = table_[ordinal];
    return mark.pts == AV_NOPTS_VALUE && order_.intra_only ? mark.dts : mark.pts;
  }

  [[nodiscard]] Result<void> set_stamps() {
    for (const int ordinal : order_.ordinals) layout_.pts.push_back(stamp_of(ordinal));
    for (int i = 0; i < table_.size(); ++i) layout_.bytes.push_back(table_[i].size);
    if (std::find(layout_.pts.begin(), layout_.pts.end(), AV_NOPTS_VALUE) != layout_.pts.end())
      return fail("", "its packets lack time stamps");
    for (int i = 0; i < table_.size(); ++i)
      if (frame_of(i) < 0 && table_[i].size > 0 && table_[i].pts > layout_.pts.front())
        return fail("", "its edit list leaves out pictures in the middle");
    for (int i = 0; i < table_.size(); ++i) layout_.dts.push_back(table_[i].dts);
    bool rising = true;
    for (std::size_t i = 0; i < layout_.dts.size(); ++i)
      rising = rising && layout_.dts[i] != AV_NOPTS_VALUE && (i == 0 || layout_.dts[i] > layout_.dts[i - 1]);
    if (!rising) make_decoding_times();
    if (frames_.first > 0) layout_.shift = layout_.pts[static_cast<std::size_t>(frames_.first)];
    return {};
  }

  // Those of presentation, in order, as much earlier as images are reordered.
  void make_decoding_times() {
    std::vector<std::int64_t> stamps;
    for (int i = 0; i < table_.size(); ++i) stamps.push_back(stamp_of(i));
    std::sort(stamps.begin(), stamps.end());
    const auto depth = static_cast<std::size_t>(order_.reorder_depth);
    for (std::size_t i = 0; i < stamps.size(); ++i)
      layout_.dts[i] = i >= depth ? stamps[i - depth] : stamps[0] - static_cast<std::int64_t>(depth - i);
  }

  // The most pictures in a row, in the order of the file, that are shown before one that came earlier.
  [[nodiscard]] int most_bidirectional() const {
    int most = 0;
    int latest = -1;
    int run = 0;
    for (int ordinal = 0; ordinal < table_.size(); ++ordinal) {
      const int frame = frame_of(ordinal);
      if (frame < 0) continue;
      run = frame < latest ? run + 1 : 0;
      most = std::max(most, run);
      latest = std::max(latest, frame);
    }
    return most;
  }

  void mark_copied() {
    layout_.is_copied.assign(static_cast<std::size_t>(table_.size()), false);
    for (const PacketGroup& group : groups_)
      for (int ordinal = group.begin; group.fate == Fate::copied && ordinal < group.end; ++ordinal) {
        const int frame = frame_of(ordinal);
        const bool is_leading = frame >= 0 && frame < group.key_frame;
        const bool is_beyond = frame > frames_.last();
        layout_.is_copied[static_cast<std::size_t>(ordinal)] = !is_beyond && (group.keeps_leading || !is_leading);
      }
  }

  void list_parts() {
    EncodedPart part;
    for (const PacketGroup& group : groups_) {
      if (!group.shows_any()) continue;
      if (group.fate == Fate::copied) {
        close(part, &group);
        part = {};
      } else if (group.fate == Fate::encoded) {
        add_to(part, group);
      }
    }
    close(part, nullptr);
  }

  // In an open group the frames before the key frame end the group before it.
  void add_to(EncodedPart& part, const PacketGroup& group) const {
    const int last = std::min(group.last_frame, frames_.last());
    const int key = std::clamp(group.key_frame, frames_.first, last + 1);
    int first = std::max(group.first_frame, frames_.first);
    if (!part.groups.empty()) {
      part.groups.back().last = key - 1;
      first = key;
    }
    if (first <= last) part.groups.push_back({first, last});
  }

  void close(EncodedPart& part, const PacketGroup* next) {
    const bool takes_leading = next != nullptr && !next->keeps_leading && next->key_frame > frames_.first;
    if (part.groups.empty() && !takes_leading) return;
    if (part.groups.empty()) part.groups.push_back({std::max(next->first_frame, frames_.first), next->key_frame - 1});
    if (takes_leading) part.groups.back().last = std::max(part.groups.back().last, next->key_frame - 1);
    part.next = next == nullptr ? table_.size() : next->begin;
    if (next != nullptr && next->key == KeyKind::open_group) layout_.broken_links.insert(part.next);
    for (int frame = part.groups.front().first; frame <= part.groups.back().last; ++frame)
      part.replaced.push_back(order_.ordinals[static_cast<std::size_t>(frame)]);
    std::sort(part.replaced.begin(), part.replaced.end());
    set_decoding_times(part, takes_leading);
    layout_.parts.push_back(std::move(part));
  }

  // Whether the range takes some of a group's frames alone, whose packets then are not those of whole groups.
  [[nodiscard]] bool is_cut(const EncodedPart& part) const {
    const bool at_begin = frames_.first > 0 && part.groups.front().first == frames_.first;
    return at_begin || (part.groups.back().last == frames_.last() && frames_.last() + 1 < frame_count());
  }
  [[nodiscard]] int frame_count() const { return static_cast<int>(order_.ordinals.size()); }

  // By how many frames packets are decoded before they are shown, by their time stamps.
  [[nodiscard]] int delay_in_frames() const {
    int delay = order_.reorder_depth;
    int place = 0;  // in the order of the file, of packets that are shown
    for (int ordinal = 0; ordinal < table_.size(); ++ordinal) {
      if (frame_of(ordinal) < 0) continue;
      const std::int64_t dts = layout_.dts[static_cast<std::size_t>(ordinal)];
      const auto shown = std::upper_bound(layout_.pts.begin(), layout_.pts.end(), dts) - layout_.pts.begin();
      if (shown > 0) delay = std::max(delay, place - static_cast<int>(shown) + 1);
      ++place;
    }
    return delay;
  }

  // Those of presentation, as many frames earlier as packets are decoded ahead, and after the packets before the part.
  [[nodiscard]] std::vector<std::int64_t> decoding_times_of(const EncodedPart& part, int count) const {
    const std::int64_t step = frame_count() > 1 ? std::max<std::int64_t>(1, layout_.pts[1] - layout_.pts[0]) : 1;
    const int before = part.replaced.front() - 1;
    const bool follows = before >= 0 && layout_.is_copied[static_cast<std::size_t>(before)];
    const int delay = delay_in_frames();
    std::vector<std::int64_t> times;
    for (int i = 0; i < count; ++i) {
      const int frame = part.groups.front().first + i - delay;
      std::int64_t time = frame >= 0 ? layout_.pts[static_cast<std::size_t>(frame)] : layout_.pts[0] + frame * step;
      if (i == 0 && follows) time = std::max(time, layout_.dts[static_cast<std::size_t>(before)] + 1);
      if (i > 0) time = std::max(time, times.back() + 1);
      times.push_back(time);
    }
    return times;
  }

  // With the frames shown before the next key frame, its packet comes after them: it gets the latest time.
  void set_decoding_times(EncodedPart& part, bool takes_leading) {
    std::vector<int> ordinals = part.replaced;
    if (takes_leading) ordinals.push_back(part.next);
    if (is_cut(part))
      part.dts = decoding_times_of(part, static_cast<int>(ordinals.size()));
    else
      for (const int ordinal : ordinals) part.dts.push_back(layout_.dts[static_cast<std::size_t>(ordinal)]);
    std::sort(part.dts.begin(), part.dts.end());
    if (!takes_leading) return;
    layout_.dts[static_cast<std::size_t>(part.next)] = part.dts.back();
    part.dts.pop_back();
  }

  const PacketTable& table_;
  const FrameOrder& order_;
  const ChangedFrames& frames_;
  std::vector<int> frame_of_;  // by ordinal; -1: its packet shows none
  std::vector<PacketGroup> groups_;
  SpliceLayout layout_;
};

}  // namespace

Result<SpliceLayout> splice_layout(const PacketTable& table, const FrameOrder& order, const ChangedFrames& frames,
                                   const AVCodecParameters& stream, PacketReader& reader) {
  ENSURE(!frames.changed.empty() && frames.last() < static_cast<int>(order.ordinals.size()));
  return Layout(table, order, frames).made(stream, reader);
}

}  // namespace sigs::libav
