// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace sigs {

// The logs of autopilots as messages, before anything is made of them.

// The messages of an ArduPilot dataflash log
// (https://ardupilot.org/dev/docs/code-overview-adding-a-new-log-message.html, AP_Logger's README): each begins with A3
// 95 and the number of its type; messages of type 128, FMT, say how the others are laid out. dataflash.cpp turns them
// into a Track.

struct DataflashColumn {
  std::string name;        // "Lat"
  bool is_scaled = false;  // true: in the unit of the documentation (degrees, metres); false: the number as stored
};

// Which messages a reader wants, and what it does with them.
struct DataflashReader {
  // The columns that are wanted of a message type, "GPS"; empty: not wanted.
  std::function<std::vector<DataflashColumn>(std::string_view name)> wanted;
  // One message: the values of the wanted columns, in their order; NaN for a column that the type has not, or a text.
  std::function<void(std::string_view name, std::span<const double> values)> take;
  // A text of the autopilot (MSG), "ArduCopter V4.5.7 (2a3dc4b7)".
  std::function<void(std::string_view text)> take_text;
};

struct DataflashContents {
  std::vector<Warning> warnings;  // `where` is a byte of the file or a message type
  bool damaged = false;           // bytes had to be skipped, or the file is cut off within a message
};

// Reads all messages in the order of the file. Bytes that are no message are skipped up to the next A3 95 of a known
// type that another message, or the end of the file, follows.
//   name  of the file, for errors
// A scaled column is the stored number times the multiplier that FMTU and MULT messages state, where they do, and else
// what the format's letter says (c C e E: 0.01, L: 1e-7).
// Error bad_data: no dataflash log.
[[nodiscard]] Result<DataflashContents> read_dataflash_messages(std::string_view bytes, const std::string& name,
                                                                const DataflashReader& reader);

// The messages of a PX4 ULog file (https://docs.px4.io/main/en/dev_log/ulog_file_format): formats, subscriptions, data,
// dropouts, whatever the topics mean. ulog.cpp turns them into a Track.

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
