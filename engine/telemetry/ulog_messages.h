// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace sigs {

// The messages of a PX4 ULog file (https://docs.px4.io/main/en/dev_log/ulog_file_format): formats, subscriptions, data,
// dropouts, whatever the topics mean. ulog.cpp turns them into a Track.

// Whether the file begins as a ULog does.
[[nodiscard]] bool has_ulog_magic(std::string_view bytes);

// Which topics a reader wants, and what it does with them. Only the first instance (multi_id 0) of a topic is read.
struct UlogReader {
  // Names of the fields that are wanted of a topic, "timestamp", "q[0]", "device.x"; empty: not wanted. The
  // first is "timestamp".
  std::function<std::vector<std::string>(std::string_view topic)> wanted;
  // One data message: the values of the wanted fields, in their order; NaN for a field that the topic has not.
  std::function<void(std::string_view topic, std::span<const double> values)> take;
};

// What was lost: the logger could not write as fast as the data came.
struct UlogDropout {
  double after_s = 0;     // stamp of the last data message before it, since boot
  double duration_s = 0;  // 0..65.535
};

struct UlogContents {
  double start_s = 0;    // the file's own stamp, since boot
  std::string hardware;  // "ver_hw"; empty: not stated
  std::string software;  // "ver_sw_branch", else "ver_sw"; empty: not stated
  std::vector<UlogDropout> dropouts;
  std::vector<Warning> warnings;  // `where` is a byte of the file or the topic
  bool damaged = false;           // bytes had to be skipped, or the file is cut off
};

// Reads all messages in the order of the file. After bytes that are no message, it goes on at the next synchronisation
// message; where there is none, the reading ends with what it has.
//   name  of the file, for errors
// Errors: bad_data (no ULog, a version or a flag that changes the format in a way that is not known).
[[nodiscard]] Result<UlogContents> read_ulog_messages(std::string_view bytes, const std::string& name,
                                                      const UlogReader& reader);

}  // namespace sigs
