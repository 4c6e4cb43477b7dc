// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <string_view>

#include "base/image.h"
#include "video/frame.h"

namespace sigs {

// The pixels of one target (an aircraft in the sky, say) in one frame, told from the background around it. Only the
// frame and a loose box are used, no truth, so that a real and an inserted target are treated alike.
struct TargetSilhouette {
  cv::Rect patch;                        // part of the image that all of the following cover
  cv::Mat mask;                          // CV_8UC1 over patch: 255 where the target is
  cv::Mat difference;                    // CV_32FC1 over patch: luma minus the background's, 8-bit code values
  cv::Mat distance_px;                   // CV_32FC1 over patch: from the nearest pixel of the mask; 0 on it
  cv::Mat cb_difference, cr_difference;  // CV_32FC1 over patch, the same of Cb and Cr, at chroma's own resolution but
                                         // read between its samples; empty for gray footage
  cv::Mat cb, cr;                        // CV_32FC1, Cb and Cr themselves; empty for gray footage
  cv::Rect box;                          // smallest box of the mask, in the image
  double background = 0;                 // luma of the background, mean over the mask
  double background_sd = 0;              // robust standard deviation of the luma about the background around the target
  double chroma_sd = 0;                  // the same of Cb and Cr, the larger one
  bool is_cut = false;  // the largest piece touches the given box's edge: the box may not hold the whole target
};

// Tells the target in `box` from the background. The background is a surface of second order through the luma outside
// of the box, fitted without outliers; the target is what differs by more than 4.5 of its standard deviations, 5 code
// values at least, without specks. Chroma is treated by the same surface fit.
// None where less than 12 pixels differ, where the box lies outside the image, or where less than half of the
// surroundings lie within it.
//   box  continuous pixels; may be loose by up to its own size
[[nodiscard]] std::optional<TargetSilhouette> target_silhouette(const Frame& frame, const Box& box);

// Profiles of luma and chroma across a target's outline, from the inside to the outside.
struct EdgeProfiles {
  int count = 0;                    // profiles that could be used
  std::optional<double> width_px;   // 10 to 90 % of the contrast, median
  std::optional<double> slope;      // largest slope over the contrast, 1/px, upper quartile
  std::optional<double> overshoot;  // lowest value of the mean profile beyond 10 %, negated, share of the contrast
  std::optional<double> chroma_width_px;  // 10 to 90 % of Cb and Cr along the target's mean chroma difference, median
};

// At each pixel of the outline one profile along the outline's normal, 6 px to each side, read with bicubic
// interpolation. The contrast is that of the first extremum within the outline. Profiles with little contrast, and
// those that do not come to rest outside, are left out; without 6 usable ones nothing is known.
[[nodiscard]] EdgeProfiles edge_profiles(const TargetSilhouette& target);

// Another place in a frame whose background is like that around a box, for a second target beside the one in the box:
// of the places where a rectangle of size_px and 14 px around it lie within the image and 8 px or more away from the
// box, one of the three whose luma is most alike in mean and standard deviation. None where there is no place.
//   seed  chooses among the three
[[nodiscard]] std::optional<cv::Point2d> similar_place(const Frame& frame, const Box& box, cv::Size size_px,
                                                       std::uint32_t seed);

// What a measure of a target's look is about.
enum class LookGroup { edge, grain, contrast, range, color, chroma_edge, ringing, flicker };

inline constexpr LookGroup kLookGroups[] = {LookGroup::edge,    LookGroup::grain,  LookGroup::contrast,
                                            LookGroup::range,   LookGroup::color,  LookGroup::chroma_edge,
                                            LookGroup::ringing, LookGroup::flicker};

// "edge", "grain", "contrast", "darkest and brightest", "colour", "chroma edge", "ringing", "flicker".
[[nodiscard]] std::string_view name_of(LookGroup group);

// How one target looks in one frame or, for the last group, over successive frames. Code values are 8-bit ones. A
// measure is none where the target does not give it: too small, too faint, gray footage.
struct TargetLook {
  // Which target it is. These serve to compare like with like, not to tell real from inserted.
  cv::Rect box;              // smallest box of its silhouette
  cv::Point2d centroid_px;   // of the luma's absolute difference to the background
  double area_px = 0;        // pixels of its silhouette
  double background = 0;     // luma of the background behind it
  double background_sd = 0;  // its standard deviation around the target
  bool is_cut = false;       // TargetSilhouette::is_cut

  // edge: profiles of luma across the outline.
  std::optional<double> edge_width_px;  // 10 to 90 %, median over the outline; a Gaussian of sigma s has 2.56 s
  std::optional<double> edge_slope;     // largest slope over the contrast, upper quartile, 1/px
  std::optional<double> overshoot;      // of the mean profile beyond the outline, share of the contrast
  // grain: what is finer than 2 px within the silhouette.
  std::optional<double> grain_inside;  // noise by Immerkaer's operator, code values
  std::optional<double> grain_excess;  // ... minus that of the background farther away
  std::optional<double> detail;        // standard deviation of the luma's high frequencies, share of its rms contrast
  // contrast to the background, over the silhouette.
  std::optional<double> weber_mean;  // mean difference / background
  std::optional<double> weber_rms;   // root mean square of it
  // range: percentiles of the luma's difference to the background.
  std::optional<double> darkest_1, darkest_5, brightest_95, brightest_99;
  // color
  std::optional<double> cb_difference, cr_difference;  // mean, to the background
  std::optional<double> saturation;                    // mean distance of (Cb, Cr) from gray
  // chroma_edge
  std::optional<double> chroma_edge_width_px;  // as edge_width_px, of Cb and Cr along their mean difference
  std::optional<double> chroma_spill;          // mean chroma difference 1 to 4 px outside over that inside
  std::optional<double> chroma_detail;  // high frequencies of Cb and Cr on and around the silhouette, code values
  // ringing: 2.5 to 9 px outside of the silhouette, where a codec leaves traces of the edge.
  std::optional<double> ringing;        // noise by Immerkaer's operator there, minus that farther away, code values
  std::optional<double> ringing_waves;  // standard deviation of luma there, minus that farther away, code values
  std::optional<double> block_steps;    // mean step across the borders of 8x8 blocks minus that within blocks
  // flicker: by add_flicker()
  std::optional<double> shake_px;            // rms distance of the centroid from a smooth path
  std::optional<double> brightness_flicker;  // rms deviation of the mean difference from a smooth course, share of it
  std::optional<double> area_flicker;        // likewise of the area
};

// One measure, for tables and classifiers.
struct LookMeasure {
  std::string_view name;  // "edge_width_px"
  LookGroup group;
  std::string_view unit;  // "" where it has none
  std::string_view what;  // for a table's reader
  std::optional<double> TargetLook::*value;
};

// All measures in the order of TargetLook.
[[nodiscard]] std::span<const LookMeasure> look_measures();

// Measures the target in a loose box of a frame. None where target_silhouette() finds none there.
[[nodiscard]] std::optional<TargetLook> target_look(const Frame& frame, const Box& box);
[[nodiscard]] TargetLook target_look(const TargetSilhouette& target);

// Sets the measures of the group flicker in `look` from the same target in successive frames, at equal intervals. The
// smooth course is a polynomial of second order in the frame's number. Needs five frames; fewer leave the measures
// unset.
void add_flicker(TargetLook& look, std::span<const TargetLook> successive);

}  // namespace sigs
