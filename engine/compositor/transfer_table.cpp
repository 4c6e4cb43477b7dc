// SPDX-License-Identifier: MIT
#include "compositor/transfer_table.h"

namespace sigs {

TransferTable::TransferTable()
    : decode_([](double display) { return std::pow((display + 0.055) / 1.055, 2.4); }),
      encode_([](double linear) { return 1.055 * std::pow(linear, 1 / 2.4) - 0.055; }) {}

const TransferTable& transfer_table() {
  static const TransferTable table;
  return table;
}

}  // namespace sigs
