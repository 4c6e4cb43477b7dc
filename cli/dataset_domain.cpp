// SPDX-License-Identifier: MIT
#include "cli/dataset_command.h"

#include <fmt/format.h>

#include <cstdio>

#include "base/staged_outputs.h"
#include "base/text.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/process.h"
#include "dataset/data_sheet.h"
#include "dataset/domain_fill.h"
#include "first_project/first_project.h"
#include "project/fields.h"

namespace sigs::cli {

namespace {

// Words of the domain that no frame tells: mostly a misspelt name of a tag.
void warn_of_untold(const DomainCoverage& coverage) {
  for (std::size_t i = 0; i < coverage.conditions.size(); ++i) {
    const DomainCondition& condition = coverage.domain.conditions[i];
    if (coverage.in_view.frames == 0 || coverage.conditions[i].untold.frames < coverage.in_view.frames) continue;
    const bool is_tag = !domain_number_named(condition.name) && condition.name != kHorizonCondition;
    print_warning({condition.name, is_tag ? "no video has this tag; check its name, or give the recipe's backgrounds, "
                                            "aircraft or groups the tag"
                                          : "no frame tells it"});
  }
}

// What was guessed of the projects that backgrounds of the recipe are taken from, and is not stated by the recipe.
GuessesByBackground guesses_of(const std::filesystem::path& recipe) {
  GuessesByBackground guesses;
  const Result<std::string> text = read_text(recipe);
  const Result<Json> json = text ? parsed_json(*text, recipe.string(), ErrorKind::bad_data) : fail(text.error());
  if (!json || !json->is_object() || !json->contains("backgrounds")) return guesses;
  for (const Json& background : json->at("backgrounds")) {
    const auto has_text = [&](const char* key) { return background.contains(key) && background.at(key).is_string(); };
    if (!has_text("name") || !has_text("project")) continue;
    const std::filesystem::path project = recipe.parent_path() / background.at("project").get<std::string>();
    if (std::error_code code; !std::filesystem::exists(notes_file_of(project), code)) continue;
    std::vector<std::string>& lines = guesses[background.at("name")];
    for (const FirstProjectGuess& guess : guesses_beside(project))
      if (!guess.field.starts_with("intruders") && !background.contains(pointer_of(guess.field)))
        lines.push_back(guess.field + ": " + guess.text);
  }
  return guesses;
}

}  // namespace

Result<DesignDomain> read_domain(const std::filesystem::path& path) {
  Result<ReadDomain> read = read_design_domain(path);
  if (!read) return fail(read.error());
  for (const Warning& warning : read->warnings) print_warning(warning);
  return std::move(read->domain);
}

Result<void> report_domain(const DomainCoverage& coverage, const std::string& title, const DomainFiles& files,
                           const Recipe* recipe, const std::vector<std::string>& settings) {
  if (const Result<void> named =
          check_outputs({{"--json", files.json}, {"--plot", files.plot}, {"--fill", files.fill}}, {});
      !named)
    return named;
  OutputFiles outputs(files.force);
  std::string filled;
  const auto fill = [&]() -> Result<std::string> {
    if (const Result<void> reserved = outputs.reserve(files.fill); !reserved) return fail(reserved.error());
    Result<DomainFill> made = filled_recipe(*recipe, coverage, settings, files.fill, &interrupt_flag());
    if (!made) return fail(made.error());
    filled = fmt::format("{}: {} added\n", files.fill.string(), count_text(made->videos, "video"));
    for (const std::string& line : made->unfilled) filled += "not filled: " + line + "\n";
    return std::move(made->recipe);
  };
  const Result<void> done =
      outputs.write_and_commit({{files.json, [&] { return domain_json(coverage, title); }},
                                {files.plot, [&] { return png_bytes(domain_plot(coverage, title)); }},
                                {recipe != nullptr ? files.fill : std::filesystem::path(), fill}});
  if (!done) return done;
  std::fputs(domain_text(coverage, title).c_str(), stdout);
  warn_of_untold(coverage);
  std::fputs(filled.c_str(), stderr);
  return {};
}

Result<void> write_data_sheet(const std::filesystem::path& dataset, const std::filesystem::path& recipe, bool force) {
  OutputFiles outputs(force);
  const std::filesystem::path text = dataset / "DATASHEET.md", json = dataset / "datasheet.json";
  for (const std::filesystem::path& file : {text, json})
    if (const Result<void> reserved = outputs.reserve(file); !reserved) return reserved;
  const Result<Json> sheet =
      data_sheet_of(dataset, recipe.empty() ? GuessesByBackground{} : guesses_of(recipe), &interrupt_flag());
  if (!sheet) return fail(sheet.error());
  const Result<void> written = outputs.write_and_commit(
      {{text, [&] { return data_sheet_text(*sheet); }}, {json, [&] { return json_text(*sheet); }}});
  if (!written) return written;
  print_written(outputs.final_paths());
  return {};
}

}  // namespace sigs::cli
