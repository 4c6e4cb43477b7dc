// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "editor/preview/scoring.h"
#include "editor/views/context.h"
#include "editor/views/results/results_view.h"
#include "editor/views/timeline/lanes.h"
#include "editor/views/timeline/ruler.h"

namespace sigs::editor {

// Buttons for playing and stepping, the playhead's time and frame, in and out. Where there is little room the less
// needed ones are left out; their keys work all the same.
class TransportBar {
 public:
  // One line high.
  void draw(const ViewContext& context);

 private:
  void draw_frame_field(const ViewContext& context, float width);

  std::array<char, 32> entry_{};  // what is typed into the frame field
  bool typing_ = false;
};

// The frame that a person means who types into the frame field: "133"; "+10" and "-5" from the playhead; a time with a
// colon, "0:05.32" or "1:02:03.4", for the frame nearest to it in time (times_s: of each frame, ascending). Clamped to
// the footage; times_s empty: to 0 and above. None for what is no number.
[[nodiscard]] std::optional<int> frame_from_entry(std::string_view entry, int playhead,
                                                  std::span<const double> times_s);

// One row for each intruder: its waypoints as keys in time, and red where it flies as no such aircraft could. A drag
// moves a key in time, by whole frames unless Alt is held, as one undo step; a double click adds a waypoint on the
// curve; the right button opens a menu.
class KeyRows {
 public:
  // In screen pixels.
  [[nodiscard]] static float row_height();

  // At the cursor, one row below the other; takes the mouse on them.
  void draw(const ViewContext& context, const TimelineStrip& strip);

 private:
  // A key that the mouse holds.
  struct Held {
    int intruder = 0;
    int waypoint = 0;
    double offset = 0;  // frames from the mouse to the key
    // Of the key when it was pressed.
    double frame_before = 0;
    DragGesture gesture;
  };
  // Where the right button was pressed; waypoint -1: on the row itself.
  struct Menu {
    int intruder = 0;
    int waypoint = -1;
    double frame = 0;
    double typed = 0;  // what is typed into "set frame"
  };
  struct Row;

  void draw_row(const ViewContext& context, const TimelineStrip& strip, int intruder);
  // Notes where the keys are, for tests.
  static void probe_places(const ViewContext& context, const Row& row);
  void handle_mouse(const ViewContext& context, const Row& row);
  void drag(const ViewContext& context, const Row& row);
  // Goes on with the drag of the held key; drops it after Escape or another change of the project.
  void hold(const ViewContext& context, const Row& row);
  // under: the waypoint below the mouse, -1: none.
  void open_menu(const ViewContext& context, const Row& row, int under);
  void draw_menu(const ViewContext& context);
  void draw_key_menu(const ViewContext& context);

  std::optional<Held> held_;
  Menu menu_;
  bool menu_asked_ = false;  // the menu is to be opened in this update
};

// Frames of the footage, both included, in which a tracker had lost its target or said nothing.
struct LostStretch {
  int first_frame = 0;
  int last_frame = 0;
  TrackerMoment moment = TrackerMoment::lost;  // lost or silent
};

// What the lane of centre errors shows of one tracker.
struct ErrorCurve {
  int color = 0;  // of its result file, for result_color()
  // From the middle of the truth's box to that of the tracker's, in pixels of the image: one a frame of the scores, NaN
  // where there is nothing to compare.
  std::vector<double> errors_px;
  std::vector<LostStretch> lost;
};

// The curves of all trackers that are shown, on one scale.
struct ErrorCurves {
  int first_frame = 0;
  std::vector<ErrorCurve> curves;
  LaneScale scale;
  double max_px = 0;  // the largest of all errors; 0: there is none
};

// Of the trackers that are shown and have a score. The scale is logarithmic and begins at 0.
[[nodiscard]] ErrorCurves error_curves(const Scored& scored);

// How far the middles of trackers' boxes are from the truth's, frame by frame: a curve each, with gaps where nothing is
// reported; below them bars where the target was lost. Takes no room while no results are loaded.
class ErrorLane {
 public:
  // Whether results are loaded. draw() may be called only then.
  [[nodiscard]] static bool has_any(const ViewContext& context) { return context.scored != nullptr; }
  static constexpr const char* kTitle = "Centre error";

  // At a height of the screen: top_y and height in screen pixels. A drag on it moves the playhead, by `ruler`.
  void draw(const ViewContext& context, const TimelineStrip& strip, float top_y, float height, RulerRow& ruler);

 private:
  // Makes the curves anew where the scores or the shown files are others.
  void refresh(const Scored& scored);
  // Left of the strip: the title, and each tracker with its error in `frame`.
  void draw_names(const Scored& scored, const TimelineStrip& strip, float top_y, float height, int frame) const;

  // What a curve was made of.
  struct Drawn {
    std::shared_ptr<const TrackScore> score;
    ResultFile file;
    [[nodiscard]] bool operator==(const Drawn&) const = default;
  };
  std::vector<Drawn> drawn_;
  ErrorCurves curves_;
};

// The lanes of the intruder, and below them those of the camera.
enum class LaneGroup { intruder, camera };
inline constexpr std::size_t kLaneGroups = 2;

// Where the header of one of `count` groups is drawn: at its place in the scrolled rows as long as that is in sight,
// else at the edge of the window beyond which it lies, with the other headers above or below it.
//   natural_y         of the header in the scrolled rows
//   top_y, bottom_y   of the window
[[nodiscard]] float header_y(float natural_y, std::size_t index, std::size_t count, float height, float top_y,
                             float bottom_y);

// Headers of the groups of lanes, always in sight whatever is scrolled away. A press folds a group, or unfolds it;
// where most of an open group is out of sight, it brings it into sight instead.
class LaneGroups {
 public:
  // Of a header, in screen pixels.
  [[nodiscard]] static float height();
  [[nodiscard]] bool is_folded(LaneGroup group) const { return folded_[static_cast<std::size_t>(group)]; }

  // Takes presses: before the lanes are drawn, as what is drawn first has the mouse.
  //   header_y  where the headers are among the scrolled rows; the rows of a group end at the next header or at end_y
  void update(const ViewContext& context, const TimelineStrip& strip, std::array<float, kLaneGroups> header_y,
              float end_y);
  // After the lanes, over them.
  void draw(const TimelineStrip& strip) const;

 private:
  void press(std::size_t group, float share_in_sight);

  std::array<bool, kLaneGroups> folded_{};
  std::array<float, kLaneGroups> shown_y_{};  // in this update
  std::optional<std::size_t> hovered_;
  std::optional<std::size_t> wanted_;  // to be brought into sight in the next update
};

// Shifts the camera's log in time against the footage: while Alt is held, a drag on a curve of the camera moves the
// curve with the mouse by changing camera.track.offset_s, in steps of a millisecond. One drag is one undo step; Escape
// takes it back.
class OffsetDrag {
 public:
  // On the item "lane" that was drawn last, of the camera. True: the mouse is taken, nothing else may use its press.
  bool update_on_item(const ViewContext& context, const TimelineStrip& strip);
  // Between a press and its release.
  [[nodiscard]] bool is_active() const { return held_.has_value(); }

 private:
  struct Held {
    unsigned int item = 0;  // of ImGui, that the mouse was pressed on
    double offset_before_s = 0;
    DragGesture gesture;
    bool is_over = false;  // cancelled or lost; the button is still down
  };
  void drag(const ViewContext& context, const TimelineStrip& strip);

  std::optional<Held> held_;
  int gestures_ = 0;
};

// How far the current intruder is, how large it looks, what hides it and how it flies, frame by frame; above that how
// well trackers follow it, where their results are loaded, and below how the camera turns, where a file turns it: then
// both groups have a header, which is always in sight.
// Pressing or dragging on a lane moves the playhead; with Alt on a lane of the camera it shifts the log in time.
class LaneRows {
 public:
  // Shows the lanes that are shown by default.
  LaneRows();

  // A button at the cursor, with a popup in which lanes are switched on and off.
  void draw_chooser(const ViewContext& context);

  // At the cursor. room_px is how much height there is for all of them, in screen pixels; curves take it between a
  // minimum and a maximum height, so all may be higher than that and scroll. Drags move the playhead by `ruler`.
  void draw(const ViewContext& context, const TimelineStrip& strip, float room_px, RulerRow& ruler);

 private:
  // What is kept of a lane from one update to the next.
  struct LaneState {
    LaneStyle style;
    // As it was ticked or unticked; none: by the style, and "Well clear" only where export.encounter names volumes.
    std::optional<bool> is_chosen = {};
    LaneValues values = {};  // of survey_
  };
  struct Row;

  // How many strips show the lane: visibility is shown for each camera of a rig.
  [[nodiscard]] std::size_t rows_of(const LaneState& lane) const;
  // Takes the values of another survey; null: none is known.
  void refresh(std::shared_ptr<const Survey> survey);
  [[nodiscard]] bool shows_errors(const ViewContext& context) const;
  // Of one curve, in screen pixels; with room for all lanes that are drawn, folded groups left out.
  [[nodiscard]] float curve_height(float room_px, bool with_errors) const;
  [[nodiscard]] bool is_shown(const LaneState& lane) const;
  // Hidden are those that are not ticked, of a folded group, and of a camera that nothing turns.
  [[nodiscard]] bool is_drawn(const LaneState& lane) const;
  // Those of one group from y downwards.
  void draw_group(const ViewContext& context, const TimelineStrip& strip, LaneGroup group, float y, float curve,
                  RulerRow& ruler);
  [[nodiscard]] float height_of(LaneGroup group, float curve, bool with_errors) const;
  void draw_lane(const ViewContext& context, const Row& row, RulerRow& ruler);
  // The mouse on the lane "Well clear", ImGui's last item; true where a mark has it.
  bool jumps_to_mark(const ViewContext& context, const TimelineStrip& strip);

  std::vector<LaneState> lanes_;  // one for each of lane_styles(), in its order
  bool shows_errors_ = true;      // where there are any
  ErrorLane errors_;
  std::shared_ptr<const Survey> survey_;  // of the current intruder
  std::size_t cameras_ = 1;               // of the project, in this update
  LaneGroups groups_;                     // have headers where the camera has lanes
  OffsetDrag offset_;
  bool camera_turns_ = false;   // in this update
  bool names_volumes_ = false;  // export.encounter does, in this update
  bool has_jumped_ = false;     // since the press that is held
};

// The timeline: transport and ruler, waypoints as keys, lanes of distance, size and visibility, in and out. The wheel
// over the strip zooms, with Shift it pans; so does the middle button.
class TimelineView {
 public:
  // Once per update, into what is left of the current ImGui window.
  void draw(const ViewContext& context);

 private:
  // Shows all frames when another project or footage is open.
  void fit_to(const ViewContext& context);
  // Brings the playhead into sight when it has moved; while it plays, page by page.
  void follow_playhead(const ViewContext& context);
  // The strip at the cursor.
  [[nodiscard]] TimelineStrip strip_here() const;
  // Buttons that choose lanes and fit the ruler.
  void draw_left_of_ruler(const ViewContext& context, const TimelineStrip& strip);
  void draw_rows(const ViewContext& context, const TimelineStrip& strip);
  void handle_wheel(const TimelineStrip& strip, float low_y, float high_y);

  TransportBar transport_;
  RulerRow ruler_row_;
  KeyRows keys_;
  LaneRows lanes_;

  TimeRuler ruler_;  // which frames are shown; left_x and width are those of strip_here()
  // What the ruler was made for: the number of frames of the footage, and the project.
  int frame_count_ = -1;
  std::filesystem::path file_;
  // Of the update before.
  int playhead_ = -1;
  bool panning_ = false;
};

}  // namespace sigs::editor
