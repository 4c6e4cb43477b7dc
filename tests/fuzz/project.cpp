// SPDX-License-Identifier: MIT
#include "base/ensure.h"
#include "fuzz/fuzz_input.h"
#include "project/json.h"
#include "project/validate.h"

namespace sigs::fuzz {

void try_project(const FuzzInput& input) {
  const std::filesystem::path path = input.folder / "p.json";
  const Result<ReadProject> read = parse_project(std::string(input.bytes), path);
  if (!read) return check_message(read.error());
  check_messages(read->warnings);
  for (const Problem& problem : validate(read->project)) check_message(error_of(read->project, problem));
  // What is written reads back as the same.
  const std::string text = text_of(read->project);
  const Result<ReadProject> again = parse_project(text, path);
  ENSURE(again.has_value());
  ENSURE(text_of(again->project) == text);
}

}  // namespace sigs::fuzz
