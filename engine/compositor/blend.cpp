// SPDX-License-Identifier: MIT
#include "compositor/blend.h"

#include <algorithm>

#include "base/ensure.h"
#include "video/color_space.h"

namespace sigs {

namespace {

// First chroma sample, and how many, in which the luma samples begin to end - 1 have weight.
cv::Range chroma_range(const std::vector<ChromaShare>& shares, int begin, int end) {
  const ChromaShare& last = shares[static_cast<size_t>(end - 1)];
  return {shares[static_cast<size_t>(begin)].first, last.first + (last.in_next > 0 ? 2 : 1)};
}

// The highest code of a frame's samples; of 8 bits known when the program is compiled.
template <class Sample>
class TopCode {
 public:
  explicit TopCode(int bit_depth) : top_(static_cast<float>(max_code(bit_depth))) {}
  [[nodiscard]] float value() const { return sizeof(Sample) == 1 ? 255.0F : top_; }

 private:
  float top_;
};

// Where rewritten samples go: into the frame's own planes, rounded.
template <class Sample>
class IntoFrame {
 public:
  explicit IntoFrame(Frame& frame) : frame_(frame), top_(frame.bit_depth) {}

  void put(int plane, int y, int x, float code, float /*opacity*/) const {
    frame_.planes[static_cast<std::size_t>(plane)].ptr<Sample>(y)[x] =
        static_cast<Sample>(std::clamp(code, 0.0F, top_.value()) + 0.5F);
  }

 private:
  Frame& frame_;
  TopCode<Sample> top_;
};

// Into the planes of a patch, as floats.
template <class Sample>
class IntoPatch {
 public:
  IntoPatch(FloatPatch& patch, bool clips) : patch_(patch), top_(patch.bit_depth), clips_(clips) {}

  void put(int plane, int y, int x, float code, float opacity) const {
    PatchPlane& to = patch_.planes[static_cast<std::size_t>(plane)];
    to.after.ptr<float>(y - to.rect.y)[x - to.rect.x] = clips_ ? std::clamp(code, 0.0F, top_.value()) : code;
    to.opacity.ptr<float>(y - to.rect.y)[x - to.rect.x] = std::min(opacity, 1.0F);
  }

 private:
  FloatPatch& patch_;
  TopCode<Sample> top_;
  bool clips_;
};

// Reads single pixels of a frame as R'G'B', in the frame's own planes, and puts what becomes of them into Target. Where
// pixels share chroma, each is read with the chroma that lies between its neighbours' samples, and adds its own to the
// samples that average it.
template <class Sample, class Target>
class PlaneWriter {
 public:
  PlaneWriter(const Frame& frame, const Target& target)
      : frame_(frame), target_(target), map_(code_to_rgb(frame.layout, frame.color, frame.bit_depth)) {}

  // Rewrites the pixels (x, y) of rect that have an opacity above 0; gives back how many. For each row y of rect,
  // pixels.row(y) gives an object with
  //   float opacity(int x)                         how much of what was there goes; 0: the pixel stays as it is
  //   cv::Vec3f over(int x, const cv::Vec3f& rgb)  its colour where rgb was: R'G'B' in 0..1; beyond, the planes clip
  template <class Pixels>
  std::int64_t rewrite(const cv::Rect& rect, const Pixels& pixels) {
    if (rect.empty()) return 0;
    return chroma_step(frame_.layout).area() == 1 ? rewrite_own(rect, pixels) : rewrite_shared(rect, pixels);
  }

 private:
  // Every pixel has samples of its own, or luma alone.
  template <class Pixels>
  std::int64_t rewrite_own(const cv::Rect& rect, const Pixels& pixels) {
    std::int64_t count = 0;
    for (int y = rect.y; y < rect.br().y; ++y) {
      const auto row = pixels.row(y);
      for (int x = rect.x; x < rect.br().x; ++x) {
        const float opacity = row.opacity(x);
        if (!(opacity > 0)) continue;
        const cv::Vec3f code = map_.from_rgb * row.over(x, rgb_of(own_code({x, y}))) + map_.offset;
        for (int plane = 0; plane < frame_.plane_count(); ++plane) target_.put(plane, y, x, code[plane], opacity);
        ++count;
      }
    }
    return count;
  }

  template <class Pixels>
  std::int64_t rewrite_shared(const cv::Rect& rect, const Pixels& pixels) {
    SubsampledChroma chroma(frame_, rect);
    std::int64_t count = 0;
    for (int y = rect.y; y < rect.br().y; ++y) {
      const auto row = pixels.row(y);
      const cv::Range covered = covered_part(row, {rect.x, rect.br().x});
      if (covered.empty()) continue;
      chroma.start_row(y, covered.start, covered.end);
      count += rewrite_row(y, covered, row, chroma);
      chroma.finish_row();
    }
    chroma.write(
        [this](int plane, int y, int x, float code, float opacity) { target_.put(plane, y, x, code, opacity); });
    return count;
  }

  template <class Row>
  std::int64_t rewrite_row(int y, const cv::Range& columns, const Row& row, SubsampledChroma& chroma) const {
    const Sample* const luma = frame_.planes[0].template ptr<Sample>(y);
    std::int64_t count = 0;
    for (int x = columns.start; x < columns.end; ++x) {
      const float opacity = row.opacity(x);
      if (!(opacity > 0)) continue;
      const cv::Vec3f old_code(luma[x], chroma.cb_at(x), chroma.cr_at(x));
      const cv::Vec3f code = map_.from_rgb * row.over(x, rgb_of(old_code)) + map_.offset;
      target_.put(0, y, x, code[0], opacity);
      chroma.add(x, code[1] - old_code[1], code[2] - old_code[2], opacity);
      ++count;
    }
    return count;
  }

  // From the first covered column to the last.
  template <class Row>
  [[nodiscard]] static cv::Range covered_part(const Row& row, cv::Range columns) {
    while (columns.start < columns.end && !(row.opacity(columns.start) > 0)) ++columns.start;
    while (columns.start < columns.end && !(row.opacity(columns.end - 1) > 0)) --columns.end;
    return columns;
  }

  [[nodiscard]] cv::Vec3f rgb_of(const cv::Vec3f& code) const { return map_.to_rgb * (code - map_.offset); }

  [[nodiscard]] cv::Vec3f own_code(const cv::Point& pixel) const {
    const float luma = frame_.planes[0].template at<Sample>(pixel);
    if (frame_.plane_count() == 1) return {luma, map_.offset[1], map_.offset[2]};
    return {luma, static_cast<float>(frame_.planes[1].template at<Sample>(pixel)),
            static_cast<float>(frame_.planes[2].template at<Sample>(pixel))};
  }

  const Frame& frame_;
  Target target_;
  CodeToRgb map_;
};

cv::Vec3f over_in_linear_light(const cv::Vec4f& layer, const cv::Vec3f& below, const TransferCurve& curve) {
  const float through = 1 - layer[3];
  cv::Vec3f out;
  for (int c = 0; c < 3; ++c) out[c] = curve.display_of_linear(layer[c] + through * curve.linear_of_display(below[c]));
  return out;
}

// The layer's own colour is made a display value first, then mixed by opacity.
cv::Vec3f over_in_display_values(const cv::Vec4f& layer, const cv::Vec3f& below, const TransferCurve& curve) {
  const float opacity = layer[3];
  cv::Vec3f out;
  for (int c = 0; c < 3; ++c) out[c] = opacity * curve.display_of_linear(layer[c] / opacity) + (1 - opacity) * below[c];
  return out;
}

template <BlendChoice space>
struct LayerRow {
  const cv::Vec4f* colors;
  int left;
  const TransferCurve& curve;

  [[nodiscard]] float opacity(int x) const { return colors[x - left][3]; }

  [[nodiscard]] cv::Vec3f over(int x, const cv::Vec3f& below) const {
    const cv::Vec4f& color = colors[x - left];
    return space == BlendChoice::linear ? over_in_linear_light(color, below, curve)
                                        : over_in_display_values(color, below, curve);
  }
};

template <BlendChoice space>
struct LayerPixels {
  const cv::Mat& color;  // in the footage's primaries
  const cv::Rect& rect;
  const TransferCurve& curve;

  [[nodiscard]] LayerRow<space> row(int y) const { return {color.ptr<cv::Vec4f>(y - rect.y), rect.x, curve}; }
};

template <class Sample, class Target>
std::int64_t blend_into(const Target& target, const Frame& frame, const Layer& layer, BlendChoice space) {
  PlaneWriter<Sample, Target> planes(frame, target);
  const cv::Mat color = in_footage_primaries(layer.color, frame.color);
  const TransferCurve curve =
      space == BlendChoice::heat ? TransferCurve(TransferFunction::srgb) : transfer_curve_of(frame.color);
  return space == BlendChoice::linear
             ? planes.rewrite(layer.rect, LayerPixels<BlendChoice::linear>{color, layer.rect, curve})
             : planes.rewrite(layer.rect, LayerPixels<BlendChoice::display>{color, layer.rect, curve});
}

struct MixedRow {
  const cv::Vec3b* bgr;
  const float* weights;
  int left;

  [[nodiscard]] float opacity(int x) const { return weights[x - left]; }

  [[nodiscard]] cv::Vec3f over(int x, const cv::Vec3f& below) const {
    const cv::Vec3b& pixel = bgr[x - left];
    const cv::Vec3f rgb(pixel[2] / 255.0F, pixel[1] / 255.0F, pixel[0] / 255.0F);
    const float share = weights[x - left];
    return rgb * share + below * (1 - share);
  }
};

struct MixedPixels {
  const cv::Rect& rect;
  const cv::Mat& bgr;
  const cv::Mat& weight;

  [[nodiscard]] MixedRow row(int y) const {
    return {bgr.ptr<cv::Vec3b>(y - rect.y), weight.ptr<float>(y - rect.y), rect.x};
  }
};

}  // namespace

SubsampledChroma::SubsampledChroma(const Frame& frame, const cv::Rect& part) : frame_(frame) {
  const cv::Size step = chroma_step(frame.layout);
  const cv::Size size = frame.size_px();
  const bool on_column = chroma_on_luma_column(frame.color.chroma_site);
  const bool on_row = chroma_on_luma_row(frame.color.chroma_site);
  column_taps_ = chroma_taps(size.width, step.width, on_column);
  row_taps_ = chroma_taps(size.height, step.height, on_row);
  column_shares_ = chroma_shares(size.width, step.width, on_column);
  row_shares_ = chroma_shares(size.height, step.height, on_row);
  const cv::Range across = chroma_range(column_shares_, part.x, part.br().x);
  const cv::Range down = chroma_range(row_shares_, part.y, part.br().y);
  window_ = {across.start, down.start, across.size(), down.size()};
  sums_ = cv::Mat::zeros(window_.size(), CV_32FC3);
  row_sums_.resize(static_cast<size_t>(window_.width) + 1);
}

void SubsampledChroma::start_row(int y, int begin, int end) {
  row_ = y;
  read_from_ = column_taps_[static_cast<size_t>(begin)].first;
  const int count = column_taps_[static_cast<size_t>(end - 1)].second + 1 - read_from_;
  with_sample_type(frame_.bit_depth, [&](auto sample) {
    read_row<decltype(sample)>(frame_.planes[1], count, read_cb_);
    read_row<decltype(sample)>(frame_.planes[2], count, read_cr_);
  });
  std::fill(row_sums_.begin(), row_sums_.end(), cv::Vec3f(0, 0, 0));
}

template <class Sample>
void SubsampledChroma::read_row(const cv::Mat& plane, int count, std::vector<float>& samples) const {
  const ChromaTap& tap = row_taps_[static_cast<size_t>(row_)];
  const Sample* const first = plane.ptr<Sample>(tap.first) + read_from_;
  const Sample* const second = plane.ptr<Sample>(tap.second) + read_from_;
  samples.resize(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i)
    samples[static_cast<size_t>(i)] =
        static_cast<float>(first[i]) + tap.share * static_cast<float>(second[i] - first[i]);
}

void SubsampledChroma::finish_row() {
  const ChromaShare& share = row_shares_[static_cast<size_t>(row_)];
  add_row_sums(share.first, share.in_first);
  if (share.in_next > 0) add_row_sums(share.first + 1, share.in_next);
}

void SubsampledChroma::add_row_sums(int chroma_row, float weight) {
  cv::Vec3f* const sums = sums_.ptr<cv::Vec3f>(chroma_row - window_.y);
  for (int i = 0; i < window_.width; ++i) sums[i] += weight * row_sums_[static_cast<size_t>(i)];
}

std::vector<SubsampledChroma::Averaging> SubsampledChroma::averaging(const std::vector<ChromaTap>& taps,
                                                                     const std::vector<ChromaShare>& shares,
                                                                     int count) {
  std::vector<Averaging> all(static_cast<size_t>(count), {0, 0, 0});
  const auto add = [&](int chroma, const ChromaTap& tap, float weight) {
    if (weight == 0) return;
    Averaging& weights = all[static_cast<size_t>(chroma)];
    weights[static_cast<size_t>(tap.first - chroma + 1)] += weight * (1 - tap.share);
    weights[static_cast<size_t>(tap.second - chroma + 1)] += weight * tap.share;
  };
  for (size_t i = 0; i < taps.size(); ++i) {
    add(shares[i].first, taps[i], shares[i].in_first);
    add(shares[i].first + 1, taps[i], shares[i].in_next);
  }
  return all;
}

cv::Mat SubsampledChroma::with_border(const cv::Mat& plane, const cv::Rect& window) {
  cv::Mat samples(window.height + 2, window.width + 2, CV_32FC1);
  for (int y = 0; y < samples.rows; ++y) {
    const int row = std::clamp(window.y + y - 1, 0, plane.rows - 1);
    float* const out = samples.ptr<float>(y);
    const auto copy = [&](const auto* const in) {
      for (int x = 0; x < samples.cols; ++x) out[x] = in[std::clamp(window.x + x - 1, 0, plane.cols - 1)];
    };
    if (plane.depth() == CV_8U)
      copy(plane.ptr<uchar>(row));
    else
      copy(plane.ptr<ushort>(row));
  }
  return samples;
}

Layer clipped(const Layer& layer, const cv::Rect& bounds) {
  const cv::Rect rect = layer.rect & bounds;
  if (rect.empty()) return {};
  const cv::Rect inside(rect.tl() - layer.rect.tl(), rect.size());
  return {rect, layer.color(inside), layer.coverage(inside)};
}

cv::Mat coverage_over(const cv::Rect& target, const Layer& layer) {
  cv::Mat coverage = cv::Mat::zeros(target.size(), CV_32FC1);
  const cv::Rect both = target & layer.rect;
  if (!both.empty()) layer.coverage(both - layer.rect.tl()).copyTo(coverage(both - target.tl()));
  return coverage;
}

Layer occluded_by_body(const Layer& layer, const cv::Mat& own_body) {
  if (own_body.empty() || layer.empty()) return layer;
  return occluded_by(layer, part_round(own_body, layer.rect));
}

Layer occluded_by(const Layer& layer, const cv::Mat& mask) {
  if (layer.empty()) return layer;
  ENSURE(mask.size() == layer.rect.size());
  Layer out{layer.rect, layer.color.clone(), layer.coverage.clone()};
  for (int j = 0; j < out.rect.height; ++j)
    for (int i = 0; i < out.rect.width; ++i) {
      const float visible = 1.0F - mask.at<float>(j, i);
      out.color.at<cv::Vec4f>(j, i) *= visible;
      out.coverage.at<float>(j, i) *= visible;
    }
  return out;
}

std::int64_t blend_over(Frame& frame, const Layer& layer, BlendChoice space) {
  if (layer.empty()) return 0;
  ENSURE((layer.rect & cv::Rect({0, 0}, frame.size_px())) == layer.rect);
  return with_sample_type(frame.bit_depth, [&](auto sample) {
    using Sample = decltype(sample);
    return blend_into<Sample>(IntoFrame<Sample>(frame), frame, layer, space);
  });
}

FloatPatch blended_patch(const Frame& frame, const Layer& layer, BlendChoice space, int margin_px,
                         const cv::Mat& own_body) {
  ENSURE((layer.rect & cv::Rect({0, 0}, frame.size_px())) == layer.rect);
  FloatPatch patch = patch_of(frame, layer.rect, margin_px, own_body);
  if (layer.empty()) return patch;
  with_sample_type(frame.bit_depth, [&](auto sample) {
    using Sample = decltype(sample);
    blend_into<Sample>(IntoPatch<Sample>(patch, space != BlendChoice::heat), frame, layer, space);
  });
  return patch;
}

std::int64_t replace_pixels(Frame& frame, const cv::Rect& rect, const cv::Mat& bgr, const cv::Mat& weight) {
  ENSURE((rect & cv::Rect({0, 0}, frame.size_px())) == rect);
  ENSURE(bgr.type() == CV_8UC3 && bgr.size() == rect.size());
  ENSURE(weight.type() == CV_32FC1 && weight.size() == rect.size());
  return with_sample_type(frame.bit_depth, [&](auto sample) {
    using Sample = decltype(sample);
    const IntoFrame<Sample> target(frame);
    return PlaneWriter<Sample, IntoFrame<Sample>>(frame, target).rewrite(rect, MixedPixels{rect, bgr, weight});
  });
}

std::int64_t replace_pixels(Frame& frame, const cv::Mat& bgr, const cv::Mat& weight) {
  return replace_pixels(frame, {{0, 0}, frame.size_px()}, bgr, weight);
}

}  // namespace sigs
