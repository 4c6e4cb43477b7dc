// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace sigs {

// The messages of an ArduPilot dataflash log
// (https://ardupilot.org/dev/docs/code-overview-adding-a-new-log-message.html, AP_Logger's README): each begins with A3
// 95 and the number of its type; messages of type 128, FMT, say how the others are laid out. dataflash.cpp turns them
// into a Track.

// Whether the file begins with the FMT message that describes FMT messages.
[[nodiscard]] bool has_dataflash_magic(std::string_view bytes);

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

}  // namespace sigs
