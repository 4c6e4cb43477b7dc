// SPDX-License-Identifier: MIT
#include "encounter_model/encounter_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "base/input_file.h"
#include "base/text.h"
#include "encounter_model/model_sections.h"

namespace sigs {

namespace {

constexpr std::size_t kMaxVariables = 64;  // the published ones have at most 16
constexpr std::size_t kLongestLabel_bytes = 64;
constexpr double kMaxBins = 10000;
constexpr double kGreatestCount = 1e15;  // below 2^53, so that counts and their sums are exact

// The sections and the file's name: what every part of the reader needs.
class Sections {
 public:
  Sections(std::vector<ModelSection> sections, std::string file)
      : sections_(std::move(sections)), file_(std::move(file)) {}

  [[nodiscard]] const ModelSection* find(std::string_view name) const {
    const auto found = std::find_if(sections_.begin(), sections_.end(),
                                    [&](const ModelSection& section) { return section.name == name; });
    return found == sections_.end() ? nullptr : &*found;
  }

  [[nodiscard]] Result<const ModelSection*> get(std::string_view name) const {
    if (const ModelSection* const section = find(name)) return section;
    return fail(fmt::format("{}: # {}", file_, name), "this section is missing");
  }

  [[nodiscard]] Result<std::vector<double>> numbers(std::string_view name, double expected, double low,
                                                    double high) const {
    const Result<const ModelSection*> section = get(name);
    if (!section) return fail(section.error());
    return numbers_in(**section, file_, expected, low, high);
  }

  [[nodiscard]] const std::vector<ModelSection>& all() const { return sections_; }
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] std::string place(const ModelSection& section) const {
    return place_in(file_, section.line, section.name);
  }

 private:
  std::vector<ModelSection> sections_;
  std::string file_;
};

using Labels = std::vector<std::string>;

Result<void> check_label(const Labels& before, std::string_view label, const std::string& place) {
  if (label.empty()) return fail(place, "a label is empty");
  if (label.size() > kLongestLabel_bytes) return fail(place, "a label has more than 64 bytes");
  if (std::find(before.begin(), before.end(), label) != before.end())
    return fail(place, fmt::format("the label {} is there twice", line_text(label)));
  return {};
}

Result<Labels> labels_in(const Sections& sections, std::string_view name) {
  const Result<const ModelSection*> section = sections.get(name);
  if (!section) return fail(section.error());
  const std::string place = sections.place(**section);
  Labels labels;
  for (const SectionLine& line : (*section)->lines) {
    for (const std::string_view label : csv_fields(line.text)) {
      if (const Result<void> good = check_label(labels, label, place); !good) return fail(good.error());
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
  for (bool is_found = true; is_found;) {
    is_found = false;
    for (std::size_t variable = 0; variable < parents.size() && !is_found; ++variable) {
      if (!is_next(variable)) continue;
      is_placed[variable] = true;
      order.push_back(static_cast<int>(variable));
      is_found = true;
    }
  }
  return order;
}

// Names of the sections of one of the two networks.
struct NetworkNames {
  std::string_view edges;
  std::string_view counts;
};

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

Result<CountNetwork> network_in(const Sections& sections, const NetworkNames& names, const std::vector<int>& bins,
                                std::size_t first) {
  Result<std::vector<std::vector<int>>> parents = parents_in(sections, names.edges, bins.size());
  if (!parents) return fail(parents.error());
  const std::string place = sections.place(*sections.find(names.edges));
  for (std::size_t i = 0; i < first; ++i)
    if (!(*parents)[i].empty())
      return fail(place, fmt::format("column {}: only labels with (t+1) have parents", i + 1));
  CountNetwork network;
  network.order = order_of(*parents);
  if (network.order.size() < bins.size()) return fail(place, "a variable is its own ancestor");
  Result<std::vector<CountTable>> tables = tables_in(sections, names.counts, bins, std::move(*parents), first);
  if (!tables) return fail(tables.error());
  network.tables = std::move(*tables);
  return network;
}

Result<std::vector<double>> boundaries_in(const SectionLine& line, const std::string& file, int bins) {
  if (line.text == "*") return std::vector<double>();
  Result<std::vector<double>> limits = numbers_in(line, "boundaries", file, -1e9, 1e9);
  if (!limits) return limits;
  const std::string place = place_in(file, line.number, "boundaries");
  if (limits->size() != static_cast<std::size_t>(bins) + 1)
    return fail(place, fmt::format("expected {} limits of {} bins, or *; found {}", bins + 1, bins, limits->size()));
  for (std::size_t i = 1; i < limits->size(); ++i)
    if ((*limits)[i] <= (*limits)[i - 1]) return fail(place, "the limits do not increase");
  return limits;
}

std::optional<int> bin_around_zero(const std::vector<double>& boundaries) {
  if (boundaries.size() <= 2) return std::nullopt;
  for (std::size_t i = 1; i < boundaries.size(); ++i)
    if (boundaries[i - 1] < 0 && boundaries[i] > 0) return static_cast<int>(i) - 1;
  return std::nullopt;
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

Result<std::optional<int>> zero_bin_in(const SectionLine& line, const std::string& file, int bins) {
  if (line.text == "*") return std::optional<int>();
  const Result<std::vector<double>> number = numbers_in(line, "zero_bins", file, 1, bins);
  if (!number) return fail(number.error());
  if (number->size() != 1 || number->front() != std::floor(number->front()))
    return fail(place_in(file, line.number, "zero_bins"), "expected one bin, from 1, or *");
  return std::optional<int>(static_cast<int>(number->front()) - 1);
}

Result<void> read_zero_bins(const Sections& sections, std::vector<ModelVariable>& variables) {
  if (!sections.find("zero_bins")) {
    for (ModelVariable& variable : variables) variable.zero_bin = bin_around_zero(variable.boundaries);
    return {};
  }
  const auto lines = line_for_each(sections, "zero_bins", variables.size());
  if (!lines) return fail(lines.error());
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const Result<std::optional<int>> bin = zero_bin_in((**lines)[i], sections.file(), variables[i].bins);
    if (!bin) return fail(bin.error());
    variables[i].zero_bin = *bin;
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
    Result<std::vector<double>> limits = boundaries_in((**lines)[i], sections.file(), (*bins)[i]);
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
    const auto now = std::find_if(variables.begin(), variables.end(),
                                  [&](const ModelVariable& variable) { return labels[i] == variable.label + "(t+1)"; });
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
  Result<CountNetwork> network = network_in(sections, {"G_transition", "N_transition"}, *bins, count);
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
  Result<std::vector<ModelSection>> parts = model_sections(text, name);
  if (!parts) return fail(parts.error());
  const Sections sections(std::move(*parts), name);
  EncounterModel model;
  Result<std::vector<ModelVariable>> variables = variables_in(sections);
  if (!variables) return fail(variables.error());
  model.variables = std::move(*variables);
  std::vector<int> bins;
  for (const ModelVariable& variable : model.variables) bins.push_back(variable.bins);
  Result<CountNetwork> initial = network_in(sections, {"G_initial", "N_initial"}, bins, 0);
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
