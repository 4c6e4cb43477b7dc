// SPDX-License-Identifier: MIT
#include "cli/dataset_coverage.h"

#include <cerrno>
#include <cstdio>

#include <string_view>
#include <utility>

#include "base/image_codecs.h"
#include "base/paths.h"
#include "base/staged_outputs.h"
#include "base/text.h"
#include "cli/output_files.h"

namespace sigs::cli {

namespace {

Result<void> check_coverage_names(const CoverageOptions& options) {
  if (options.plot.empty()) return {};
  if (lower_extension(options.plot) != ".png")
    return fail("--plot " + options.plot.string(), "is written as PNG; end its name in .png", ErrorKind::usage);
  if (!options.json.empty() && canonical_name(options.json) == canonical_name(options.plot))
    return fail("--plot " + options.plot.string(), "is where --json goes", ErrorKind::usage);
  return {};
}

}  // namespace

Result<void> report_coverage(const Coverage& coverage, const std::string& title, const CoverageOptions& options) {
  if (const Result<void> named = check_coverage_names(options); !named) return named;
  StagedOutputs outputs(options.overwrite ? StagedOutputs::Existing::replace : StagedOutputs::Existing::refuse);
  for (const auto& [path, is_plot] : {std::pair(options.json, false), std::pair(options.plot, true)}) {
    if (path.empty()) continue;
    const Result<std::filesystem::path> staged = outputs.add_file(path);
    if (!staged) return fail(staged.error());
    std::string bytes;
    if (is_plot) {
      std::vector<unsigned char> png;
      image_codecs::imencode(".png", coverage_plot(coverage, title), png);
      bytes.assign(png.begin(), png.end());
    } else {
      bytes = coverage_json(coverage, title);
    }
    if (const Result<void> written = write_bytes(*staged, bytes); !written)
      return fail(outputs.with_final_names(written.error()));
  }
  if (const Result<void> done = outputs.commit(); !done) return done;
  std::fputs(coverage_text(coverage, title).c_str(), stdout);
  return {};
}

}  // namespace sigs::cli
