// SPDX-License-Identifier: MIT
#include "video/libav/ffv1_slice.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace sigs::libav {
namespace {

class BitWriter {
 public:
  // The lowest bits of value, highest first; count <= 32.
  void put(int count, uint32_t value) {
    held_ = held_ << count | value;
    held_bits_ += count;
    for (; held_bits_ >= 8; held_bits_ -= 8) bytes_.push_back(static_cast<uint8_t>(held_ >> (held_bits_ - 8)));
  }

  // Fills the last byte with zeros.
  [[nodiscard]] std::vector<uint8_t> finished() {
    if (held_bits_ > 0) put(8 - held_bits_, 0);
    return std::move(bytes_);
  }

 private:
  std::vector<uint8_t> bytes_;
  uint64_t held_ = 0;
  int held_bits_ = 0;
};

// Differences between neighbours in 11 steps (quantization table set 0 in FFmpeg's configuration records).
constexpr int kSteps = 11;
constexpr int kContexts = (kSteps * kSteps * kSteps + 1) / 2;

constexpr std::array<int8_t, 256> step_table() {
  constexpr std::array<int, 5> kFrom{1, 2, 5, 12, 35};
  std::array<int8_t, 256> table{};
  for (int difference = -128; difference < 128; ++difference) {
    int step = 0;
    for (const int from : kFrom)
      if ((difference < 0 ? -difference : difference) >= from) ++step;
    table[static_cast<size_t>(difference & 255)] = static_cast<int8_t>(difference < 0 ? -step : step);
  }
  return table;
}
constexpr std::array<int8_t, 256> kStepOf = step_table();

int step_of(int difference) {
  return kStepOf[static_cast<size_t>(difference & 255)];
}

// Logarithms of run lengths (section 3.8.2.2).
constexpr std::array<int, 41> kLogOfRun{0, 0, 0, 0, 1, 1,  1,  1,  2,  2,  2,  2,  3,  3,  3,  3,  4,  4,  5,  5, 6,
                                        6, 7, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24};

int signed_byte(int value) {
  return static_cast<int8_t>(static_cast<uint8_t>(value & 255));
}

// The adaptive Golomb-Rice code of one context (section 3.8.2.3 and 3.8.2.4).
class AdaptiveCode {
 public:
  void put(BitWriter& bits, int difference) {
    const int value = signed_byte(difference - bias_);
    int k = 0;
    for (int i = count_; i < error_sum_; i += i) ++k;
    put_signed(bits, 2 * drift_ + count_ < 0 ? ~value : value, k);
    learn(value);
  }

 private:
  static void put_signed(BitWriter& bits, int value, int k) {
    constexpr uint32_t kLongestUnary = 12;
    const auto mapped = static_cast<uint32_t>(value >= 0 ? 2 * value : -2 * value - 1);
    const uint32_t high = mapped >> k;
    if (high < kLongestUnary)
      bits.put(static_cast<int>(high) + 1 + k, (1U << k) + (mapped & ((1U << k) - 1)));
    else
      bits.put(kLongestUnary + 8, mapped - kLongestUnary + 1);
  }

  void learn(int value) {
    drift_ += value;
    error_sum_ += std::abs(value);
    if (count_ == 128) {
      count_ >>= 1;
      drift_ >>= 1;
      error_sum_ >>= 1;
    }
    ++count_;
    if (drift_ <= -count_) {
      bias_ = std::max(bias_ - 1, -128);
      drift_ = std::max(drift_ + count_, 1 - count_);
    } else if (drift_ > 0) {
      bias_ = std::min(bias_ + 1, 127);
      drift_ = std::min(drift_ - count_, 0);
    }
  }

  int drift_ = 0;
  int error_sum_ = 4;
  int bias_ = 0;
  int count_ = 1;
};

int median_of(int a, int b, int c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

// Runs of samples that are as predicted, from row to row of a slice.
class Runs {
 public:
  void end_at_difference(BitWriter& bits, int length) {
    length = put_whole(bits, length);
    bits.put(1 + kLogOfRun[index_], static_cast<uint32_t>(length));
    if (index_ > 0) --index_;
  }

  void end_at_row_end(BitWriter& bits, int length) {
    if (put_whole(bits, length) > 0) bits.put(1, 1);
  }

 private:
  int put_whole(BitWriter& bits, int length) {
    while (length >= 1 << kLogOfRun[index_]) {
      length -= 1 << kLogOfRun[index_];
      ++index_;
      bits.put(1, 1);
    }
    return length;
  }

  size_t index_ = 0;
};

class SliceCoder {
 public:
  explicit SliceCoder(int width) : width_(width), above_(static_cast<size_t>(width) + 2), row_(above_) {}

  void put_row(const uint8_t* samples) {
    begin_row(samples);
    int run = -1;  // samples in the current run; none: there is none
    for (size_t x = 1; x <= static_cast<size_t>(width_); ++x) {
      const int left = row_[x - 1];
      const int corner = above_[x - 1];
      const int top = above_[x];
      const int context =
          kSteps * kSteps * step_of(top - above_[x + 1]) + kSteps * step_of(corner - top) + step_of(left - corner);
      const int ahead = row_[x] - median_of(left, left + top - corner, top);
      const int difference = signed_byte(context < 0 ? -ahead : ahead);
      if (context == 0 && run < 0) run = 0;
      if (run >= 0 && difference == 0) {
        ++run;
        continue;
      }
      if (run >= 0) runs_.end_at_difference(bits_, run);
      // What ends a run is not 0.
      const int shift = run >= 0 && difference > 0 ? 1 : 0;
      codes_[static_cast<size_t>(std::abs(context))].put(bits_, difference - shift);
      run = -1;
    }
    if (run >= 0) runs_.end_at_row_end(bits_, run);
  }

  // A row of zeros, where all that it is predicted from is 0 too.
  void put_zeros() { runs_.end_at_row_end(bits_, width_); }

  [[nodiscard]] std::vector<uint8_t> finished() { return bits_.finished(); }

 private:
  // Beyond the borders: the sample above, and above its left one the one before that (section 3.1).
  void begin_row(const uint8_t* samples) {
    std::swap(above_, row_);
    above_.back() = above_[above_.size() - 2];
    row_.front() = above_[1];
    std::memcpy(row_.data() + 1, samples, static_cast<size_t>(width_));
  }

  int width_;
  std::vector<uint8_t> above_;  // with one more at either end
  std::vector<uint8_t> row_;
  BitWriter bits_;
  Runs runs_;
  std::array<AdaptiveCode, kContexts> codes_;
};

}  // namespace

bool is_zero_row(const cv::Mat& samples, int row) {
  const uint8_t* first = samples.ptr(row);
  const auto length = static_cast<size_t>(samples.cols);
  return length == 0 || (*first == 0 && std::memcmp(first, first + 1, length - 1) == 0);
}

std::vector<uint8_t> ffv1_slice_samples(const cv::Mat& samples) {
  SliceCoder coder(samples.cols);
  int zero_rows = 3;  // above the slice all is 0
  for (int y = 0; y < samples.rows; ++y) {
    zero_rows = is_zero_row(samples, y) ? zero_rows + 1 : 0;
    // Two rows above, the first sample stands in for what lies left of the row above.
    if (zero_rows > 3)
      coder.put_zeros();
    else
      coder.put_row(samples.ptr(y));
  }
  return coder.finished();
}

}  // namespace sigs::libav
