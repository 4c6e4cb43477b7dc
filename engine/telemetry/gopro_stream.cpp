// SPDX-License-Identifier: MIT
#include "telemetry/gopro_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/statistics.h"

namespace sigs {
namespace {

// More numbers than a recording of ten hours has; a file that claims more is no recording.
constexpr std::size_t kMaxNumbers = std::size_t{1} << 26;
constexpr std::int64_t kElementHead_bytes = 8;

// What one STRM says about its samples.
struct Description {
  std::vector<double> scale = {};
  std::string structure = {};
  std::optional<double> total = {};
  GoproBlock block = {};
  GoproStream stream = {};  // names and axes
};

std::optional<double> first_number(const GpmfElement& element) {
  const std::optional<GpmfNumbers> numbers = gpmf_numbers(element);
  if (!numbers || numbers->values.empty() || !std::isfinite(numbers->values[0])) return {};
  return numbers->values[0];
}

std::vector<double> all_numbers(const GpmfElement& element) {
  const std::optional<GpmfNumbers> numbers = gpmf_numbers(element);
  return numbers ? numbers->values : std::vector<double>();
}

// Takes an element that describes the samples which follow it. False: it is of another kind.
bool describe(Description& description, const GpmfElement& element) {
  static const std::set<std::string_view> kUnused = {"SIUN", "UNIT", "TICK", "TOCK", "EMPT",
                                                     "TMPC", "RMRK", "GPSP", "DVID", "DVNM"};
  const std::string_view key = element.key;
  std::string* const text = key == "TYPE"   ? &description.structure
                            : key == "STNM" ? &description.stream.name
                            : key == "ORIN" ? &description.stream.axes_in
                            : key == "ORIO" ? &description.stream.axes_out
                            : key == "GPSA" ? &description.stream.height_of
                            : key == "GPSU" ? &description.block.utc
                                            : nullptr;
  if (text != nullptr)
    *text = gpmf_text(element);
  else if (key == "SCAL")
    description.scale = all_numbers(element);
  else if (key == "MTRX")
    description.stream.matrix = all_numbers(element);
  else if (key == "TSMP")
    description.total = first_number(element);
  else if (key == "TIMO")
    description.block.delay_s = first_number(element).value_or(0);
  else if (key == "GPSF")
    description.block.fix = first_number(element);
  else if (key != "STMP")
    return kUnused.contains(key);
  else if ((description.block.stamp_s = first_number(element)))
    *description.block.stamp_s *= 1e-6;
  return true;
}

void scale(GpmfNumbers& numbers, const std::vector<double>& divisors) {
  if (divisors.empty()) return;
  const std::size_t columns = static_cast<std::size_t>(numbers.columns);
  if (divisors.size() != 1 && divisors.size() < columns) return;
  for (std::size_t i = 0; i < numbers.values.size(); ++i)
    numbers.values[i] /= divisors.size() == 1 ? divisors[0] : divisors[i % columns];
}

class Collector {
 public:
  Collector(GoproStreams& into, const std::vector<std::string>& keys) : into_(into), keys_(keys) {}

  void add_payload(const DataPacket& payload) {
    payload_ = &payload;
    for (const GpmfElement& device : level(payload.bytes, 0)) {
      if (device.type == 0 && device.key == "DEVC") add_device(device);
    }
  }

 private:
  std::vector<GpmfElement> level(std::string_view value, std::int64_t at) {
    const GpmfLevel level = gpmf_level(value, at);
    if (level.broken_at) report("is broken or cut off", *level.broken_at);
    return level.elements;
  }

  void report(const std::string& what, std::int64_t at) {
    const std::string place = payload_->file_offset >= 0
                                  ? fmt::format("byte {} of the file", payload_->file_offset + at)
                                  : fmt::format("byte {} of its payload", at);
    into_.broken.emplace_back(what + " at " + place, payload_->time_s);
  }

  void add_device(const GpmfElement& device) {
    std::string name;
    for (const GpmfElement& element : level(device.value, device.at + kElementHead_bytes)) {
      if (element.key == "DVNM") {
        name = gpmf_text(element);
        if (std::ranges::find(into_.devices, name) == into_.devices.end() && into_.devices.size() < 64)
          into_.devices.push_back(name);
      }
      if (element.key == "STRM" && element.type == 0) add_stream(element, name);
    }
  }

  void add_stream(const GpmfElement& stream, const std::string& device) {
    Description description;
    description.stream.device = device;
    for (const GpmfElement& element : level(stream.value, stream.at + kElementHead_bytes)) {
      if (describe(description, element)) continue;
      const std::string key(element.key);
      if (std::ranges::find(keys_, key) == keys_.end()) {
        if (into_.unused.size() < 1000 || into_.unused.contains(key)) ++into_.unused[key];
      } else {
        add_samples(description, element);
      }
    }
  }

  void add_samples(const Description& description, const GpmfElement& element) {
    if (element.repeat == 0) return;
    std::optional<GpmfNumbers> numbers = gpmf_numbers(element, description.structure);
    GoproStream& stream = stream_of(description, std::string(element.key));
    if (!numbers || (stream.samples.columns != 0 && stream.samples.columns != numbers->columns))
      return report(std::string(element.key) + " has samples of a type that does not fit", element.at);
    numbers_ += numbers->values.size();
    if (numbers_ > kMaxNumbers) return report("has more samples than any recording has,", element.at);
    scale(*numbers, description.scale);
    GoproBlock block = description.block;
    block.time_s = payload_->time_s;
    block.duration_s = payload_->duration_s;
    block.first_row = stream.samples.rows();
    block.rows = numbers->rows();
    // TSMP counts the samples with those of this payload. One that is too small is not believed.
    const double counted = stream.blocks.empty() ? 0 : stream.blocks.back().first_index + stream.blocks.back().rows;
    block.first_index = std::max(counted, description.total.value_or(0) - block.rows);
    stream.samples.columns = numbers->columns;
    stream.samples.values.insert(stream.samples.values.end(), numbers->values.begin(), numbers->values.end());
    stream.blocks.push_back(block);
  }

  GoproStream& stream_of(const Description& description, const std::string& key) {
    for (GoproStream& stream : into_.streams)
      if (stream.key == key && stream.device == description.stream.device) return stream;
    into_.streams.push_back(description.stream);
    into_.streams.back().key = key;
    return into_.streams.back();
  }

  GoproStreams& into_;
  const std::vector<std::string>& keys_;
  const DataPacket* payload_ = nullptr;
  std::size_t numbers_ = 0;
};

struct Line {
  double at_zero_s = 0;
  double period_s = 0;
  double residual_s = 0;  // root mean square

  [[nodiscard]] double at(double index) const { return at_zero_s + period_s * index; }
};

// Least squares over the blocks that are marked.
std::optional<Line> line_through(const std::vector<GoproBlock>& blocks, const std::vector<bool>& used) {
  double n = 0, sum_i = 0, sum_t = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    if (used[b]) n += 1, sum_i += blocks[b].first_index, sum_t += blocks[b].time_s;
  if (n < 3) return {};
  double ii = 0, it = 0, tt = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const double i = blocks[b].first_index - sum_i / n;
    const double t = blocks[b].time_s - sum_t / n;
    if (used[b]) ii += i * i, it += i * t, tt += t * t;
  }
  if (!(ii > 0) || !(it > 0)) return {};
  const double period_s = it / ii;
  return Line{.at_zero_s = sum_t / n - period_s * sum_i / n,
              .period_s = period_s,
              .residual_s = std::sqrt(std::max(tt - it * it / ii, 0.0) / n)};
}

// Fitted twice: the second time without the blocks that are off by more than three times the median deviation.
std::optional<Line> robust_line(const std::vector<GoproBlock>& blocks) {
  std::vector<bool> used(blocks.size(), true);
  const std::optional<Line> first = line_through(blocks, used);
  if (!first) return {};
  std::vector<double> off_s;
  for (const GoproBlock& block : blocks) off_s.push_back(std::abs(block.time_s - first->at(block.first_index)));
  const double limit_s = 3 * median(off_s) + 1e-9;
  for (std::size_t b = 0; b < blocks.size(); ++b) used[b] = off_s[b] <= limit_s;
  const std::optional<Line> second = line_through(blocks, used);
  return second ? second : first;
}

// The time from one block to the next, or of the last one.
double length_of(const std::vector<GoproBlock>& blocks, std::size_t b) {
  if (blocks[b].duration_s > 0) return blocks[b].duration_s;
  if (b + 1 < blocks.size()) return std::max(blocks[b + 1].time_s - blocks[b].time_s, 0.0);
  return b > 0 ? std::max(blocks[b].time_s - blocks[b - 1].time_s, 0.0) : 0.0;
}

void make_ordered(std::vector<double>& times_s) {
  for (std::size_t i = 1; i < times_s.size(); ++i) times_s[i] = std::max(times_s[i], times_s[i - 1]);
}

}  // namespace

GoproStreams gopro_streams(const std::vector<DataPacket>& payloads, const std::vector<std::string>& keys) {
  GoproStreams streams;
  Collector collector(streams, keys);
  for (const DataPacket& payload : payloads) collector.add_payload(payload);
  return streams;
}

GoproTimes gopro_times(const GoproStream& stream) {
  GoproTimes times;
  const std::optional<Line> line = robust_line(stream.blocks);
  times.is_fit = line && line->residual_s < kMaxResidual_s;
  if (times.is_fit) times.residual_s = line->residual_s;
  for (std::size_t b = 0; b < stream.blocks.size(); ++b) {
    const GoproBlock& block = stream.blocks[b];
    const double step_s = length_of(stream.blocks, b) / block.rows;
    for (int row = 0; row < block.rows; ++row)
      times.times_s.push_back((times.is_fit ? line->at(block.first_index + row) : block.time_s + step_s * row) -
                              block.delay_s);
  }
  make_ordered(times.times_s);
  return times;
}

bool is_stamped(const GoproStream& stream) {
  double last_s = -1;
  for (const GoproBlock& block : stream.blocks) {
    if (!block.stamp_s || *block.stamp_s <= last_s) return false;
    last_s = *block.stamp_s;
  }
  return stream.blocks.size() >= 2;
}

GoproTimes gopro_stamped_times(const GoproStream& stream, double offset_s) {
  GoproTimes times;
  double step_s = 0;
  for (std::size_t b = 0; b < stream.blocks.size(); ++b) {
    const GoproBlock& block = stream.blocks[b];
    if (b + 1 < stream.blocks.size()) step_s = (*stream.blocks[b + 1].stamp_s - *block.stamp_s) / block.rows;
    for (int row = 0; row < block.rows; ++row) times.own_times_s.push_back(*block.stamp_s + step_s * row);
  }
  for (const double own_s : times.own_times_s) times.times_s.push_back(own_s + offset_s);
  make_ordered(times.times_s);
  return times;
}

std::optional<ClockOffset> clock_offset(const std::vector<const GoproStream*>& streams, int column) {
  double low_s = -INFINITY;
  double high_s = INFINITY;
  std::vector<double> middles_s;
  for (const GoproStream* stream : streams) {
    if (column >= stream->samples.columns) continue;
    for (std::size_t b = 0; b < stream->blocks.size(); ++b) {
      const GoproBlock& block = stream->blocks[b];
      const double end_s = block.time_s + length_of(stream->blocks, b);
      for (int row = block.first_row; row < block.first_row + block.rows; ++row) {
        const double own_s = stream->samples.at(row, column);
        if (!std::isfinite(own_s)) continue;
        low_s = std::max(low_s, block.time_s - own_s);
        high_s = std::min(high_s, end_s - own_s);
        middles_s.push_back((block.time_s + end_s) / 2 - own_s);
      }
    }
  }
  if (middles_s.empty()) return {};
  if (low_s <= high_s) return ClockOffset{(low_s + high_s) / 2, (high_s - low_s) / 2, true};
  const double offset_s = median(middles_s);
  for (double& middle_s : middles_s) middle_s = std::abs(middle_s - offset_s);
  return ClockOffset{offset_s, median(middles_s), false};
}

}  // namespace sigs
