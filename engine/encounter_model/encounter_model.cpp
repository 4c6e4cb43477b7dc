// SPDX-License-Identifier: MIT
#include "encounter_model/encounter_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/input_file.h"
#include "base/text.h"

namespace sigs {

namespace {

constexpr std::size_t kMaxVariables = 64;  // the published ones have at most 16
constexpr std::size_t kLongestLabel_bytes = 64;
constexpr double kMaxBins = 10000;
constexpr double kGreatestCount = 1e15;  // below 2^53, so that counts and their sums are exact
constexpr int kMaxLines = 100000;
constexpr std::size_t kMaxShown = 40;  // bytes of a stranger's text in a message

std::string shown(std::string_view text) {
  const std::string line = line_text(text.substr(0, kMaxShown));
  return text.size() > kMaxShown ? line + "..." : line;
}

// Views point into the file's text.
struct SectionLine {
  int number = 0;  // in the file, from 1
  std::string_view text;
};

struct ModelSection {
  std::string_view name;           // "G_initial"
  int line = 0;                    // of the heading
  std::vector<SectionLine> lines;  // those with more than white space
};

// The sections in the file's order, and the file's name: what every part of the reader needs.
class Sections {
 public:
  // Error bad_data: text before the first heading, a section twice.
  static Result<Sections> of(std::string_view text, const std::string& file) {
    Sections sections(file);
    text = without_bom(text);
    for (int number = 1; !text.empty(); ++number) {
      const std::string_view line = trimmed(next_line(text));
      if (line.empty()) continue;
      if (number > kMaxLines)
        return fail(fmt::format("{}: line {}", file, number), "more lines than any encounter model has");
      if (line.front() == '#') {
        const std::string_view name = trimmed(line.substr(1));
        if (sections.find(name))
          return fail(sections.place(number, name), "this section is there twice; each may be there once");
        if (sections.all_.size() >= 100)
          return fail(sections.place(number, name), "more than 100 sections; this is not an encounter model");
        sections.all_.push_back({.name = name, .line = number, .lines = {}});
      } else if (sections.all_.empty()) {
        return fail(
            fmt::format("{}: line {}", file, number),
            fmt::format("expected a section such as \"# labels_initial\", found \"{}\"; this is not an encounter model",
                        shown(line)));
      } else {
        sections.all_.back().lines.push_back({number, line});
      }
    }
    return sections;
  }

  [[nodiscard]] const std::vector<ModelSection>& all() const { return all_; }
  [[nodiscard]] const ModelSection* find(std::string_view name) const {
    const auto found = std::ranges::find(all_, name, &ModelSection::name);
    return found == all_.end() ? nullptr : &*found;
  }
  [[nodiscard]] Result<const ModelSection*> get(std::string_view name) const {
    if (const ModelSection* const section = find(name)) return section;
    return fail(fmt::format("{}: # {}", file_, name), "this section is missing");
  }

  // "FILE: line 7, # N_initial": where an error is.
  [[nodiscard]] std::string place(int line, std::string_view section) const {
    return fmt::format("{}: line {}, # {}", file_, line, shown(section));
  }
  [[nodiscard]] std::string place(const ModelSection& section) const { return place(section.line, section.name); }

  // The numbers of one line. Error bad_data: what is no number, NaN or infinite, or lies outside [low, high].
  [[nodiscard]] Result<std::vector<double>> numbers(const SectionLine& line, std::string_view section, double low,
                                                    double high) const {
    std::vector<double> numbers;
    std::string_view rest = line.text;
    for (std::string_view word = next_token(rest); !word.empty(); word = next_token(rest)) {
      const std::optional<double> number = finite_number(word);
      if (!number) return fail(place(line.number, section), fmt::format("\"{}\" is not a finite number", shown(word)));
      if (*number < low || *number > high)
        return fail(place(line.number, section), fmt::format("{} lies outside {} to {}", shown(word),
                                                             short_number_text(low), short_number_text(high)));
      numbers.push_back(*number);
    }
    return numbers;
  }

  // The numbers of all lines of a section. Error bad_data also where there are not exactly `expected`, which may be any
  // number: memory grows with what is there.
  [[nodiscard]] Result<std::vector<double>> numbers(std::string_view name, double expected, double low,
                                                    double high) const {
    const Result<const ModelSection*> section = get(name);
    if (!section) return fail(section.error());
    std::vector<double> all;
    for (const SectionLine& line : (*section)->lines) {
      const Result<std::vector<double>> more = numbers(line, name, low, high);
      if (!more) return more;
      all.insert(all.end(), more->begin(), more->end());
    }
    if (static_cast<double>(all.size()) != expected)
      return fail(place(**section),
                  fmt::format("expected {} numbers, found {}",
                              expected < 1e15 ? number_text(expected, 0) : short_number_text(expected), all.size()));
    return all;
  }

 private:
  explicit Sections(std::string file) : file_(std::move(file)) {}

  std::vector<ModelSection> all_;
  std::string file_;
};

using Labels = std::vector<std::string>;

Result<Labels> labels_in(const Sections& sections, std::string_view name) {
  const Result<const ModelSection*> section = sections.get(name);
  if (!section) return fail(section.error());
  const std::string place = sections.place(**section);
  Labels labels;
  for (const SectionLine& line : (*section)->lines) {
    for (const std::string_view label : csv_fields(line.text)) {
      if (label.empty()) return fail(place, "a label is empty");
      if (label.size() > kLongestLabel_bytes) return fail(place, "a label has more than 64 bytes");
      if (std::ranges::find(labels, label) != labels.end())
        return fail(place, fmt::format("the label {} is there twice", line_text(label)));
      labels.emplace_back(line_text(label));
      if (labels.size() > kMaxVariables) return fail(place, "more than 64 labels");
    }
  }
  if (labels.empty()) return fail(place, "there are no labels");
  return labels;
}

Result<std::vector<int>> bins_in(const Sections& sections, std::string_view name, std::size_t count) {
  const Result<std::vector<double>> numbers = sections.numbers(name, static_cast<double>(count), 1, kMaxBins);
  if (!numbers) return fail(numbers.error());
  std::vector<int> bins;
  for (const double number : *numbers) {
    if (number != std::floor(number))
      return fail(sections.place(*sections.find(name)), "a number of bins is not a whole number");
    bins.push_back(static_cast<int>(number));
  }
  return bins;
}

// Parents of each variable, from a square of rows of parents and columns of children.
Result<std::vector<std::vector<int>>> parents_in(const Sections& sections, std::string_view name, std::size_t count) {
  const Result<std::vector<double>> edges = sections.numbers(name, static_cast<double>(count * count), 0, 1);
  if (!edges) return fail(edges.error());
  std::vector<std::vector<int>> parents(count);
  for (std::size_t i = 0; i < edges->size(); ++i) {
    const double edge = (*edges)[i];
    if (edge != 0 && edge != 1) return fail(sections.place(*sections.find(name)), "expected only 0 and 1");
    if (edge == 1) parents[i % count].push_back(static_cast<int>(i / count));
  }
  return parents;
}

// Variables after their parents; shorter than `parents` where some are their own ancestors.
std::vector<int> order_of(const std::vector<std::vector<int>>& parents) {
  std::vector<int> order;
  std::vector<bool> is_placed(parents.size(), false);
  const auto is_next = [&](std::size_t variable) {
    return !is_placed[variable] && std::all_of(parents[variable].begin(), parents[variable].end(),
                                               [&](int parent) { return is_placed[static_cast<std::size_t>(parent)]; });
  };
  while (true) {
    std::size_t next = 0;
    while (next < parents.size() && !is_next(next)) ++next;
    if (next == parents.size()) return order;
    is_placed[next] = true;
    order.push_back(static_cast<int>(next));
  }
}

// A double, since it may be beyond any integer.
double table_size(const std::vector<int>& bins, const std::vector<int>& parents, std::size_t variable) {
  double size = bins[variable];
  for (const int parent : parents) size *= bins[static_cast<std::size_t>(parent)];
  return size;
}

// Cuts the section's counts into the tables of the variables from `first` on.
Result<std::vector<CountTable>> tables_in(const Sections& sections, std::string_view name, const std::vector<int>& bins,
                                          std::vector<std::vector<int>> parents, std::size_t first) {
  double expected = 0;
  for (std::size_t i = first; i < bins.size(); ++i) expected += table_size(bins, parents[i], i);
  const Result<std::vector<double>> counts = sections.numbers(name, expected, 0, kGreatestCount);
  if (!counts) return fail(counts.error());
  std::vector<CountTable> tables(bins.size());
  auto begin = counts->begin();
  for (std::size_t i = first; i < bins.size(); ++i) {
    const auto end = begin + static_cast<std::ptrdiff_t>(table_size(bins, parents[i], i));
    tables[i] = {.bins = bins[i], .parents = std::move(parents[i]), .counts = {begin, end}};
    begin = end;
  }
  return tables;
}

// By the names of the sections of its edges and counts.
Result<CountNetwork> network_in(const Sections& sections, std::string_view edges, std::string_view counts,
                                const std::vector<int>& bins, std::size_t first) {
  Result<std::vector<std::vector<int>>> parents = parents_in(sections, edges, bins.size());
  if (!parents) return fail(parents.error());
  const std::string place = sections.place(*sections.find(edges));
  for (std::size_t i = 0; i < first; ++i)
    if (!(*parents)[i].empty())
      return fail(place, fmt::format("column {}: only labels with (t+1) have parents", i + 1));
  std::vector<int> order = order_of(*parents);
  if (order.size() < bins.size()) return fail(place, "a variable is its own ancestor");
  Result<std::vector<CountTable>> tables = tables_in(sections, counts, bins, std::move(*parents), first);
  if (!tables) return fail(tables.error());
  return CountNetwork{.tables = std::move(*tables), .order = std::move(order)};
}

Result<std::vector<double>> boundaries_in(const Sections& sections, const SectionLine& line, int bins) {
  if (line.text == "*") return std::vector<double>();
  Result<std::vector<double>> limits = sections.numbers(line, "boundaries", -1e9, 1e9);
  if (!limits) return limits;
  const std::string place = sections.place(line.number, "boundaries");
  if (limits->size() != static_cast<std::size_t>(bins) + 1)
    return fail(place, fmt::format("expected {} limits of {} bins, or *; found {}", bins + 1, bins, limits->size()));
  for (std::size_t i = 1; i < limits->size(); ++i)
    if ((*limits)[i] <= (*limits)[i - 1]) return fail(place, "the limits do not increase");
  return limits;
}

std::optional<int> bin_around_zero(const std::vector<double>& boundaries) {
  const auto low = std::ranges::adjacent_find(boundaries, [](double a, double b) { return a < 0 && b > 0; });
  if (boundaries.size() <= 2 || low == boundaries.end()) return std::nullopt;
  return static_cast<int>(low - boundaries.begin());
}

// The lines of a section that has one for each variable.
Result<const std::vector<SectionLine>*> line_for_each(const Sections& sections, std::string_view name,
                                                      std::size_t count) {
  const Result<const ModelSection*> section = sections.get(name);
  if (!section) return fail(section.error());
  if ((*section)->lines.size() != count)
    return fail(sections.place(**section),
                fmt::format("expected {} lines, one for each label, found {}", count, (*section)->lines.size()));
  return &(*section)->lines;
}

Result<void> read_zero_bins(const Sections& sections, std::vector<ModelVariable>& variables) {
  if (!sections.find("zero_bins")) {
    for (ModelVariable& variable : variables) variable.zero_bin = bin_around_zero(variable.boundaries);
    return {};
  }
  const auto lines = line_for_each(sections, "zero_bins", variables.size());
  if (!lines) return fail(lines.error());
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const SectionLine& line = (**lines)[i];
    if (line.text == "*") continue;
    const Result<std::vector<double>> number = sections.numbers(line, "zero_bins", 1, variables[i].bins);
    if (!number) return fail(number.error());
    if (number->size() != 1 || number->front() != std::floor(number->front()))
      return fail(sections.place(line.number, "zero_bins"), "expected one bin, from 1, or *");
    variables[i].zero_bin = static_cast<int>(number->front()) - 1;
  }
  return {};
}

Result<std::vector<ModelVariable>> variables_in(const Sections& sections) {
  const Result<Labels> labels = labels_in(sections, "labels_initial");
  if (!labels) return fail(labels.error());
  const Result<std::vector<int>> bins = bins_in(sections, "r_initial", labels->size());
  if (!bins) return fail(bins.error());
  const auto lines = line_for_each(sections, "boundaries", labels->size());
  if (!lines) return fail(lines.error());
  const Result<std::vector<double>> rates =
      sections.numbers("resample_rates", static_cast<double>(labels->size()), 0, 1);
  if (!rates) return fail(rates.error());
  std::vector<ModelVariable> variables;
  for (std::size_t i = 0; i < labels->size(); ++i) {
    Result<std::vector<double>> limits = boundaries_in(sections, (**lines)[i], (*bins)[i]);
    if (!limits) return fail(limits.error());
    variables.push_back({(*labels)[i], (*bins)[i], std::move(*limits), std::nullopt, (*rates)[i]});
  }
  if (const Result<void> zeros = read_zero_bins(sections, variables); !zeros) return fail(zeros.error());
  return variables;
}

// Which variable each label with (t+1) is a second later.
Result<std::vector<int>> next_of(const Sections& sections, const std::vector<ModelVariable>& variables,
                                 const Labels& labels) {
  const std::string place = sections.place(*sections.find("labels_transition"));
  if (labels.size() < variables.size())
    return fail(place, fmt::format("expected at least the {} labels of # labels_initial, found {}", variables.size(),
                                   labels.size()));
  std::set<std::string> changing;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const std::string& label = variables[i].label;
    if (labels[i] == label + "(t)")
      changing.insert(label + "(t+1)");
    else if (labels[i] != label)
      return fail(place, fmt::format("label {}: expected {} or {}(t), found {}", i + 1, label, label, labels[i]));
  }
  std::vector<int> next;
  for (std::size_t i = variables.size(); i < labels.size(); ++i) {
    if (changing.erase(labels[i]) == 0)
      return fail(place, fmt::format("{}: there is no such label with (t) in place of (t+1)", labels[i]));
    // Without its "(t+1)".
    const auto now = std::ranges::find(variables, labels[i].substr(0, labels[i].size() - 5), &ModelVariable::label);
    next.push_back(static_cast<int>(now - variables.begin()));
  }
  if (!changing.empty()) return fail(place, fmt::format("{} is missing", *changing.begin()));
  return next;
}

Result<void> read_transition(const Sections& sections, EncounterModel& model) {
  const Result<Labels> labels = labels_in(sections, "labels_transition");
  if (!labels) return fail(labels.error());
  Result<std::vector<int>> next = next_of(sections, model.variables, *labels);
  if (!next) return fail(next.error());
  model.next_of = std::move(*next);
  const Result<std::vector<int>> bins = bins_in(sections, "r_transition", labels->size());
  if (!bins) return fail(bins.error());
  const std::size_t count = model.variables.size();
  for (std::size_t i = 0; i < bins->size(); ++i) {
    const std::size_t same = i < count ? i : static_cast<std::size_t>(model.next_of[i - count]);
    if ((*bins)[i] != model.variables[same].bins)
      return fail(sections.place(*sections.find("r_transition")),
                  fmt::format("{} has {} bins here and {} in # r_initial", (*labels)[i], (*bins)[i],
                              model.variables[same].bins));
  }
  Result<CountNetwork> network = network_in(sections, "G_transition", "N_transition", *bins, count);
  if (!network) return fail(network.error());
  model.transition = std::move(*network);
  return {};
}

std::vector<Warning> unknown_sections(const Sections& sections) {
  static const std::set<std::string_view> kKnown{"labels_initial",    "G_initial",      "r_initial",    "N_initial",
                                                 "labels_transition", "G_transition",   "r_transition", "N_transition",
                                                 "boundaries",        "resample_rates", "zero_bins"};
  std::vector<Warning> warnings;
  for (const ModelSection& section : sections.all())
    if (!kKnown.contains(section.name))
      warnings.push_back({sections.place(section), "a section that is not known; it is left out"});
  return warnings;
}

}  // namespace

std::optional<int> EncounterModel::find(const std::string& label) const {
  for (std::size_t i = 0; i < variables.size(); ++i)
    if (variables[i].label == label) return static_cast<int>(i);
  return std::nullopt;
}

Result<EncounterModel> encounter_model_of(std::string_view text, const std::string& name) {
  const Result<Sections> parts = Sections::of(text, name);
  if (!parts) return fail(parts.error());
  const Sections& sections = *parts;
  Result<std::vector<ModelVariable>> variables = variables_in(sections);
  if (!variables) return fail(variables.error());
  EncounterModel model{.variables = std::move(*variables)};
  std::vector<int> bins;
  for (const ModelVariable& variable : model.variables) bins.push_back(variable.bins);
  Result<CountNetwork> initial = network_in(sections, "G_initial", "N_initial", bins, 0);
  if (!initial) return fail(initial.error());
  model.initial = std::move(*initial);
  if (const Result<void> rest = read_transition(sections, model); !rest) return fail(rest.error());
  model.warnings = unknown_sections(sections);
  return model;
}

Result<EncounterModel> read_encounter_model(const std::filesystem::path& file) {
  const Result<std::string> text = read_text(file, kEncounterModelLimit_bytes);
  if (!text) return fail(text.error());
  return encounter_model_of(*text, file.string());
}

}  // namespace sigs
