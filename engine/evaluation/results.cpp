// SPDX-License-Identifier: MIT
#include "evaluation/results.h"

namespace sigs {

const ReportedBox* Results::best_at(int) const {
  return nullptr;
}

std::span<const std::string_view> results_format_names() {
  return {};
}

Result<Results> read_results(const std::filesystem::path& path, const FootageTruth&, const ResultsOptions&) {
  return fail(path.string(), "cannot be read yet", ErrorKind::unavailable);
}

std::string results_name(const std::filesystem::path& path) {
  return path.stem().string();
}

}  // namespace sigs
