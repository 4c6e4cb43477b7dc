// SPDX-License-Identifier: MIT
#include "dataset/line_reader.h"
#include "dataset/merge_formats.h"
#include "labels/label_files.h"

namespace sigs {

namespace fs = std::filesystem;

Result<void> merge_csv(const SplitLabels& labels, const fs::path& file) {
  Result<TextFile> out = TextFile::create(file);
  if (!out) return fail(out.error());
  std::optional<std::string> header;
  for (const VideoLabels& video : labels.videos) {
    LineReader lines(video.path);
    const std::optional<std::string> first = lines.next();
    if (!first || (header && *first != *header)) lines.mark_malformed();
    if (!header && first)
      if (const Result<void> put = out->put(*first + "\n"); !put) return put;
    if (!header) header = first;
    while (const std::optional<std::string> line = lines.next())
      if (const Result<void> put = out->put(*line + "\n"); !put) return put;
    if (const Result<void> state = lines.state(); !state) return state;
  }
  return out->close();
}

// {"metadata": {...},
// "samples": {"FLIGHT": {"metadata": {...},
// "entities": [
// {...},
// {...}
// ]}}}
Result<void> merge_aot(const SplitLabels& labels, const fs::path& file) {
  constexpr std::string_view kSamples = "\"samples\": {";
  constexpr std::string_view kEnd = "]}}}";
  Result<TextFile> out = TextFile::create(file);
  if (!out) return fail(out.error());
  std::string before;
  for (const VideoLabels& video : labels.videos) {
    LineReader lines(video.path);
    const std::string metadata = lines.between("{\"metadata\": ", ",");
    const std::string sample = lines.between(kSamples, "");
    before += before.empty() ? "{\"metadata\": " + metadata + ",\n" + std::string(kSamples) : ",\n";
    if (const Result<void> put = out->put(before + sample + "\n"); !put) return put;
    std::optional<std::string> line = lines.next();
    for (; line && *line != kEnd; line = lines.next())
      if (const Result<void> put = out->put(*line + "\n"); !put) return put;
    if (!line) lines.mark_malformed();
    if (const Result<void> state = lines.state(); !state) return state;
    before = "]}";
  }
  const Result<void> end = out->put(std::string(kEnd) + "\n");
  return end ? out->close() : end;
}

}  // namespace sigs
