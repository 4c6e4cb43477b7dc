// SPDX-License-Identifier: MIT
#include "video/libav/encoding.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "base/ensure.h"

namespace sigs::libav {

namespace {

// Code words, from the highest bit of each byte down. Its owner sees to it that there is room.
struct CodeWriter {
  std::uint8_t* next = nullptr;
  std::uint64_t pending = 0;  // the lowest `count` bits are still to be written
  int count = 0;              // below 32

  // length: 1 to 32 bits, the higher ones of the code are 0
  [[gnu::always_inline]] inline void put(int length, std::uint32_t code) {
    pending = pending << length | code;
    count += length;
    if (count < 32) return;
    count -= 32;
    const auto word = static_cast<std::uint32_t>(pending >> count);
    for (int shift = 24; shift >= 0; shift -= 8) *next++ = static_cast<std::uint8_t>(word >> shift);
  }

  // The last byte is filled up with zeros.
  void flush() {
    for (; count > 0; count -= 8)
      *next++ = static_cast<std::uint8_t>(count >= 8 ? pending >> (count - 8) : pending << (8 - count));
    count = 0;
  }
};

// What has been coded in one context so far: RFC 9043, 3.8.2.4 and 3.8.2.5.
struct ContextState {
  int drift = 0;
  int error_sum = 4;
  int bias = 0;
  int count = 1;
};

constexpr int kContextCount = (11 * 11 * 11 + 1) / 2;
using ContextStates = std::array<ContextState, kContextCount>;

// The parameter of the Golomb-Rice code: the lowest k for which count * 2^k reaches the sum of errors.
int rice_parameter(const ContextState& state) {
  const int widths =
      std::bit_width(static_cast<unsigned>(state.error_sum)) - std::bit_width(static_cast<unsigned>(state.count));
  const int k = std::max(widths, 0);
  return k + static_cast<int>(state.count << k < state.error_sum);
}

// Without branches where they could not be predicted.
void update(ContextState& state, int difference) {
  constexpr int kMaxCount = 128;
  state.drift += difference;
  state.error_sum += std::abs(difference);
  if (state.count == kMaxCount) {
    state.count /= 2;
    state.drift >>= 1;
    state.error_sum >>= 1;
  }
  const int count = ++state.count;
  const bool is_low = state.drift <= -count;
  const bool is_high = state.drift > 0;
  state.bias = std::clamp(state.bias + static_cast<int>(is_high) - static_cast<int>(is_low), -128, 127);
  const int raised = std::max(state.drift + count, 1 - count);
  const int lowered = std::min(state.drift - count, 0);
  state.drift = is_low ? raised : is_high ? lowered : state.drift;
}

// 3.8.2.1 and 3.8.2.2: the difference from the context's bias as a signed Golomb-Rice code.
[[gnu::always_inline]] inline void put_difference(CodeWriter& writer, ContextState& state, int difference) {
  constexpr unsigned kMaxPrefix = 12;
  constexpr int kEscape_bits = 12 + 8;
  const int v = static_cast<std::int8_t>(difference - state.bias);
  const int k = rice_parameter(state);
  const unsigned is_flipped = 2 * state.drift + state.count < 0 ? 1 : 0;
  const unsigned number = static_cast<unsigned>((v << 1) ^ (v >> 31)) ^ is_flipped;  // 0, -1, 1, -2 ... as 0, 1, 2, 3
  const unsigned prefix = number >> k;
  if (prefix < kMaxPrefix)
    writer.put(static_cast<int>(prefix) + k + 1, 1U << k | (number & ((1U << k) - 1)));
  else
    writer.put(kEscape_bits, number - kMaxPrefix + 1);
  update(state, v);
}

// 3.8.2.2.1: the exponent of the run that the next bit stands for.
constexpr std::array<std::uint8_t, 41> kRunExponents{0,  0,  0,  0,  1,  1,  1,  1,  2,  2,  2,  2,  3,  3,
                                                     3,  3,  4,  4,  5,  5,  6,  6,  7,  7,  8,  9,  10, 11,
                                                     12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24};

// Samples as predicted, one after the other.
struct Run {
  int index = 0;  // in kRunExponents
  int length = 0;

  void put_whole_steps(CodeWriter& writer) {
    for (; length >= 1 << kRunExponents[static_cast<std::size_t>(index)]; ++index) {
      length -= 1 << kRunExponents[static_cast<std::size_t>(index)];
      writer.put(1, 1);
    }
  }

  // Before a sample that is not as predicted.
  void put_broken(CodeWriter& writer) {
    put_whole_steps(writer);
    writer.put(1 + kRunExponents[static_cast<std::size_t>(index)], static_cast<std::uint32_t>(length));
    index = std::max(index - 1, 0);
    length = 0;
  }

  void put_to_end_of_row(CodeWriter& writer) {
    put_whole_steps(writer);
    if (length > 0) writer.put(1, 1);
    length = 0;
  }
};

// Two rows, each with one more sample on either side (3.1), and what they say of each sample of the lower one.
struct Rows {
  explicit Rows(int width_px)
      : width(width_px),
        samples(2 * (static_cast<std::size_t>(width_px) + 2)),
        contexts(static_cast<std::size_t>(width_px)),
        differences(static_cast<std::size_t>(width_px)) {}

  int width;
  std::vector<std::uint8_t> samples;
  std::uint8_t* above = samples.data() + 1;
  std::uint8_t* current = above + width + 2;
  bool is_above_black = true;  // with the samples on either side
  bool is_black = true;
  std::vector<std::int16_t> contexts;     // 0 to kContextCount - 1
  std::vector<std::int16_t> differences;  // from what is predicted, -128 to 127; negated where the context was

  void advance(const std::uint8_t* row);
  void compare();
};

void Rows::advance(const std::uint8_t* row) {
  std::swap(above, current);
  std::memcpy(current, row, static_cast<std::size_t>(width));
  current[-1] = above[0];
  above[width] = above[width - 1];
  is_above_black =
      std::exchange(is_black, current[-1] == 0 && current[0] == 0 &&
                                  std::memcmp(current, current + 1, static_cast<std::size_t>(width) - 1) == 0);
}

// A difference between neighbours in eleven steps, those of FFmpeg's encoder for samples of 8 bits.
std::int16_t quantised(std::int16_t difference) {
  const auto size = static_cast<std::int16_t>(difference < 0 ? -difference : difference);
  const auto step = static_cast<std::int16_t>((size > 0) + (size > 1) + (size > 4) + (size > 11) + (size > 34));
  return static_cast<std::int16_t>(difference < 0 ? -step : step);
}

// 3.3 (median predictor) and 3.5 (context). The compiler makes vector instructions of it.
[[gnu::always_inline]] inline void Rows::compare() {
  const std::uint8_t* const up = above;
  const std::uint8_t* const here = current;
  std::int16_t* const context_out = contexts.data();
  std::int16_t* const difference_out = differences.data();
  for (int x = 0; x < width; ++x) {
    const std::int16_t l = here[x - 1];
    const std::int16_t tl = up[x - 1];
    const std::int16_t t = up[x];
    const std::int16_t tr = up[x + 1];
    const auto context = static_cast<std::int16_t>(quantised(static_cast<std::int8_t>(l - tl)) +
                                                   11 * quantised(static_cast<std::int8_t>(tl - t)) +
                                                   121 * quantised(static_cast<std::int8_t>(t - tr)));
    const auto gradient = static_cast<std::int16_t>(l + t - tl);
    const std::int16_t median = std::max(std::min(l, t), std::min(std::max(l, t), gradient));
    const auto difference = static_cast<std::int8_t>(here[x] - median);
    const auto sign = static_cast<std::int16_t>(context < 0 ? -1 : 0);
    context_out[x] = static_cast<std::int16_t>((context ^ sign) - sign);
    difference_out[x] = static_cast<std::int8_t>((difference ^ sign) - sign);
  }
}

[[gnu::always_inline]] inline CodeWriter with_row(CodeWriter writer, const Rows& rows, ContextStates& states,
                                                  Run& run_of_plane) {
  Run run = run_of_plane;
  bool is_in_run = false;
  for (int x = 0; x < rows.width; ++x) {
    const int context = rows.contexts[static_cast<std::size_t>(x)];
    int difference = rows.differences[static_cast<std::size_t>(x)];
    is_in_run |= context == 0;
    if (is_in_run) {
      if (difference == 0) {
        ++run.length;
        continue;
      }
      run.put_broken(writer);
      is_in_run = false;
      if (difference > 0) --difference;  // 0 cannot end a run
    }
    put_difference(writer, states[static_cast<std::size_t>(context)], difference);
  }
  if (is_in_run) run.put_to_end_of_row(writer);
  run_of_plane = run;
  return writer;
}

CodeWriter with_black_row(CodeWriter writer, int width, Run& run) {
  run.length = width;
  run.put_to_end_of_row(writer);
  return writer;
}

// Bytes that a row cannot exceed: a sample takes up to 25 bits for the run before it and 20 of its own.
std::size_t max_row_bytes(int width) {
  return 6 * static_cast<std::size_t>(width) + 16;
}

[[gnu::always_inline]] inline void append_samples(std::vector<std::uint8_t>& bytes, std::span<const cv::Mat> planes) {
  std::array<ContextStates, 2> states;  // of luma and of chroma
  CodeWriter writer;
  std::size_t used = bytes.size();
  for (std::size_t p = 0; p < planes.size(); ++p) {
    const cv::Mat& plane = planes[p];
    ENSURE(plane.type() == CV_8UC1 && !plane.empty());
    Rows rows(plane.cols);
    Run run;
    for (int y = 0; y < plane.rows; ++y) {
      if (bytes.size() < used + max_row_bytes(plane.cols)) bytes.resize(2 * used + max_row_bytes(plane.cols));
      writer.next = bytes.data() + used;
      rows.advance(plane.ptr(y));
      if (rows.is_black && rows.is_above_black) {
        writer = with_black_row(writer, plane.cols, run);
      } else {
        rows.compare();
        writer = with_row(writer, rows, states[p == 0 ? 0 : 1], run);
      }
      used = static_cast<std::size_t>(writer.next - bytes.data());
    }
  }
  writer.flush();
  bytes.resize(static_cast<std::size_t>(writer.next - bytes.data()));
}

#ifdef __x86_64__
// The same bytes, with the instructions for shifts and vectors that most processors since 2013 have.
[[gnu::target("avx2,bmi,bmi2,lzcnt")]] void append_samples_since_2013(std::vector<std::uint8_t>& bytes,
                                                                      std::span<const cv::Mat> planes) {
  append_samples(bytes, planes);
}
#endif

}  // namespace

void append_ffv1_samples(std::vector<std::uint8_t>& bytes, std::span<const cv::Mat> planes) {
#ifdef __x86_64__
  static const bool is_since_2013 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("bmi2") != 0;
  if (is_since_2013) return append_samples_since_2013(bytes, planes);
#endif
  append_samples(bytes, planes);
}

}  // namespace sigs::libav
