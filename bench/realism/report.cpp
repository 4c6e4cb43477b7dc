// SPDX-License-Identifier: MIT
#include "realism/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <optional>

#include "accuracy/csv.h"
#include "base/statistics.h"
#include "base/text.h"
#include "base/threads.h"
#include "realism/classifier.h"

namespace sigs::bench {

namespace {

// Measures that a classifier may use together.
struct Columns {
  std::string name;
  std::vector<int> columns;
};

std::vector<Columns> column_sets() {
  std::vector<Columns> sets{{.name = "all"}};
  for (const LookGroup group : kLookGroups) sets.push_back({.name = std::string(name_of(group))});
  for (int i = 0; i < static_cast<int>(look_measures().size()); ++i) {
    sets[0].columns.push_back(i);
    sets[1 + static_cast<std::size_t>(look_measures()[static_cast<std::size_t>(i)].group)].columns.push_back(i);
  }
  return sets;
}

std::vector<float> measures_of(const TargetLook& look) {
  std::vector<float> measures;
  for (const LookMeasure& measure : look_measures())
    measures.push_back(static_cast<float>((look.*measure.value).value_or(std::numeric_limits<double>::quiet_NaN())));
  return measures;
}

// The real and the inserted target of each sample that has both, one after the other.
struct Pairs {
  std::vector<const Sample*> samples;
  std::vector<Example> examples;
  std::map<int, bool> is_tuning;  // by clip
};

Pairs pairs_of(const std::vector<Sample>& samples, const std::string& kind) {
  Pairs pairs;
  std::map<std::string, int> clips;
  for (const Sample& sample : samples) {
    const int clip = clips.emplace(sample.clip, static_cast<int>(clips.size())).first->second;
    const Target* const inserted = target_of(sample, kind);
    if (inserted == nullptr) continue;
    pairs.samples.push_back(&sample);
    pairs.is_tuning[clip] = sample.is_tuning;
    pairs.examples.push_back({clip, true, measures_of(sample.targets.front().look)});
    pairs.examples.push_back({clip, false, measures_of(inserted->look)});
  }
  return pairs;
}

struct Row {
  std::string kind, group, classifier, clips;
  Auc auc;
};

// Scores of one kind by one set of measures, and what they are worth.
struct Scored {
  std::vector<double> scores;
  std::vector<Row> rows;
};

Scored scored(const Pairs& pairs, const std::string& kind, const Columns& set, ClassifierKind classifier) {
  Scored result{.scores = scores_without_clip(pairs.examples, set.columns, classifier)};
  const std::string name = classifier == ClassifierKind::random_forest ? "forest" : "regression";
  for (const auto& [clips, tuning] :
       {std::pair("held out", std::optional(false)), std::pair("tuning", std::optional(true)),
        std::pair("all", std::optional<bool>())})
    result.rows.push_back({kind, set.name, name, clips,
                           auc_of(pairs.examples, result.scores, [&, tuning = tuning](const Example& example) {
                             return !tuning || pairs.is_tuning.at(example.clip) == *tuning;
                           })});
  return result;
}

ByCertainty by_certainty(const Pairs& pairs, const std::vector<double>& scores) {
  std::vector<std::size_t> order(pairs.samples.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto gap = [&](std::size_t i) { return scores[2 * i] - scores[2 * i + 1]; };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return gap(a) > gap(b); });
  ByCertainty sorted;
  for (const std::size_t i : order) sorted.push_back(pairs.samples[i]);
  return sorted;
}

void write_auc_table(const std::vector<Row>& rows, const std::vector<std::string>& kinds,
                     const std::filesystem::path& file) {
  std::ofstream out(file);
  for (const std::string clips : {"held out", "tuning", "all"}) {
    out << "\nClips: " << clips << "\n\n| measures |";
    for (const std::string& kind : kinds) out << ' ' << kind << " |";
    out << "\n|---|";
    for (std::size_t k = 0; k < kinds.size(); ++k) out << "---|";
    out << '\n';
    for (const Columns& set : column_sets()) {
      out << "| " << set.name << " |";
      for (const std::string& kind : kinds) {
        const Row* best = nullptr;  // of the two classifiers the one that tells them better
        for (const Row& row : rows)
          if (row.kind == kind && row.group == set.name && row.clips == clips &&
              (best == nullptr || row.auc.value > best->auc.value))
            best = &row;
        if (best != nullptr)
          out << fmt::format(" **{:.2f}** ({:.2f} to {:.2f}) |", best->auc.value, best->auc.low, best->auc.high);
      }
      out << '\n';
    }
  }
}

}  // namespace

void write_measures(const std::vector<Sample>& samples, const std::filesystem::path& file) {
  std::string header = "clip,tuning,frame,model,kind,x,y,width,height,area_px,background,background_sd";
  for (const LookMeasure& measure : look_measures()) header.append(",").append(measure.name);
  accuracy::Csv table(file, header);
  for (const Sample& sample : samples)
    for (const Target& target : sample.targets) {
      std::string values;
      for (const LookMeasure& measure : look_measures())
        values.append(values.empty() ? "" : ",").append(exact_text(target.look.*measure.value));
      const TargetLook& look = target.look;
      table.row(sample.clip, sample.is_tuning, sample.frame, sample.model, target.kind, look.box.x, look.box.y,
                look.box.width, look.box.height, look.area_px, look.background, look.background_sd, values);
    }
}

std::vector<ByCertainty> write_aucs(const std::vector<Sample>& samples, const std::vector<std::string>& kinds,
                                    const std::filesystem::path& folder) {
  const std::vector<Columns> sets = column_sets();
  std::vector<Pairs> pairs;
  for (const std::string& kind : kinds) pairs.push_back(pairs_of(samples, kind));
  const int sets_count = static_cast<int>(sets.size()), jobs = static_cast<int>(kinds.size()) * sets_count * 2;
  std::vector<Scored> results(static_cast<std::size_t>(jobs));
  parallel_for(jobs, 2, [&](int job) {
    const auto kind = static_cast<std::size_t>(job / (2 * sets_count)),
               set = static_cast<std::size_t>(job / 2 % sets_count);
    if (pairs[kind].examples.empty()) return;
    results[static_cast<std::size_t>(job)] =
        scored(pairs[kind], kinds[kind], sets[set],
               job % 2 == 0 ? ClassifierKind::random_forest : ClassifierKind::logistic_regression);
  });
  std::vector<Row> rows;
  accuracy::Csv table(folder / "auc.csv", "kind,measures,classifier,clips,auc,low,high,real,inserted");
  for (const Scored& result : results)
    for (const Row& row : result.rows) {
      table.row(row.kind, row.group, row.classifier, row.clips, row.auc.value, row.auc.low, row.auc.high, row.auc.real,
                row.auc.inserted);
      rows.push_back(row);
    }
  write_auc_table(rows, kinds, folder / "auc.md");
  std::vector<ByCertainty> certain;
  for (std::size_t k = 0; k < kinds.size(); ++k)
    certain.push_back(by_certainty(pairs[k], results[k * 2 * sets.size()].scores));
  return certain;
}

void write_medians(const std::vector<Sample>& samples, const std::vector<std::string>& kinds,
                   const std::filesystem::path& file) {
  std::ofstream out(file);
  for (const bool tuning : {false, true}) {
    out << "\nClips: " << (tuning ? "tuning" : "held out") << "\n\n| measure | unit | real |";
    for (const std::string& kind : kinds) out << ' ' << kind << " |";
    out << "\n|---|---|---|";
    for (std::size_t k = 0; k < kinds.size(); ++k) out << "---|";
    out << '\n';
    for (const LookMeasure& measure : look_measures()) {
      out << "| " << measure.name << " | " << measure.unit << " |";
      std::vector<std::string> all{"real"};
      all.insert(all.end(), kinds.begin(), kinds.end());
      for (const std::string& kind : all) {
        std::vector<double> values;
        for (const Sample& sample : samples) {
          const Target* const target = sample.is_tuning == tuning ? target_of(sample, kind) : nullptr;
          if (target == nullptr) continue;
          if (const auto value = target->look.*measure.value) values.push_back(*value);
        }
        out << ' ' << fixed_text(median(values), 3) << " |";
      }
      out << '\n';
    }
  }
}

}  // namespace sigs::bench
