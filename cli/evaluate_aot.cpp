// SPDX-License-Identifier: MIT
#include "cli/evaluate_aot.h"

#include <cstdio>
#include <optional>
#include <utility>

#include "base/text.h"
#include "cli/evaluation_folder.h"
#include "cli/options.h"
#include "cli/process.h"
#include "evaluation/reports/report.h"

namespace sigs::cli {

namespace {

namespace fs = std::filesystem;

Result<void> write_aot(EvaluationFolder& folder, const AotTruth& truth, const AotScore& score) {
  const Result<WrittenReport> written = write_report(folder.staging_path(), truth, score);
  if (!written) return fail(written.error());
  const Result<std::vector<fs::path>> kept = folder.commit(written->files);
  if (!kept) return fail(kept.error());
  for (const fs::path& file : *kept) std::printf("%s\n", file.c_str());
  return {};
}

}  // namespace

Result<void> evaluate_by_aot_rules(const std::vector<fs::path>& truth_files, const std::vector<fs::path>& result_files,
                                   const AotPolicy& policy, const fs::path& folder, bool force) {
  if (truth_files.size() != 1 || result_files.size() != 1)
    return fail("--rules aot", "takes one groundtruth.json and one result.json", ErrorKind::usage);
  if (policy.target_fppi && policy.target_hfar)
    return fail("--target-fppi", "and --target-hfar exclude each other", ErrorKind::usage);
  defer_interrupts();
  std::optional<EvaluationFolder> out;
  if (!folder.empty()) {
    Result<EvaluationFolder> reserved =
        EvaluationFolder::reserved(folder, force, {truth_files.front(), result_files.front()});
    if (!reserved) return fail(reserved.error());
    out.emplace(std::move(*reserved));
  }
  const Result<AotTruth> truth = read_aot_truth(truth_files.front());
  if (!truth) return fail(truth.error());
  const Result<std::vector<AotReport>> reports = read_aot_reports(result_files.front());
  if (!reports) return fail(reports.error());
  const Result<AotScore> score = aot_score(*truth, *reports, policy);
  if (!score) return fail(result_files.front().string(), score.error().what);
  if (score->unknown_images > 0)
    print_warning({result_files.front().string(),
                   count_text(score->unknown_images, "box") + " of images that the truth does not have: ignored"});
  std::printf("%s", aot_table(*score).c_str());
  return out ? write_aot(*out, *truth, *score) : Result<void>();
}

}  // namespace sigs::cli
