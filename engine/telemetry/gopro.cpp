// SPDX-License-Identifier: MIT
#include "telemetry/gopro.h"

namespace sigs {

bool is_gopro(const DataStream& stream) {
  return stream.kind == DataKind::gpmf;
}

Result<Track> read_gopro(const std::filesystem::path& file, const DataStream&, const ReadTrackOptions&) {
  return fail(file.string(), "is not read");
}

}  // namespace sigs
