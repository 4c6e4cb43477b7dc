// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace sigs::test {

// The transition network of a published file, read line by line as the publishers' own program does, without the
// engine: the sections stand in a fixed order, and each table is a matrix with a column for each configuration.
struct PublishedTransition {
  std::vector<std::string> labels;
  std::vector<std::vector<int>> graph;  // [parent][child]
  std::vector<int> bins;
  std::vector<std::vector<std::vector<double>>> tables;  // [variable][column][bin]; none for the first `now`
  std::size_t now = 0;                                   // number of variables at t

  // Column of a variable's table: the first parent changes fastest.
  [[nodiscard]] std::size_t column(std::size_t child, const std::vector<int>& state) const {
    std::size_t at = 0;
    for (std::size_t parent = labels.size(); parent-- > 0;)  // Horner's scheme from the last parent
      if (graph[parent][child]) at = at * bins[parent] + state[parent];
    return at;
  }

  // The variable at t that a label with (t+1) follows.
  [[nodiscard]] std::size_t before(std::size_t next) const {
    const std::string begin = labels[next].substr(0, labels[next].find("(t+1)")) + "(t)";
    for (std::size_t i = 0; i < now; ++i)
      if (labels[i] == begin) return i;
    return labels.size();
  }

  // P(variables at t + 1 | variables at t); `state` has both. A column without counts keeps the bin.
  [[nodiscard]] double probability(const std::vector<int>& state) const {
    double product = 1;
    for (std::size_t i = now; i < labels.size(); ++i) {
      const std::vector<double>& counts = tables[i][column(i, state)];
      double sum = 0;
      for (const double count : counts) sum += count;
      product *= sum > 0 ? counts[state[i]] / sum : state[i] == state[before(i)] ? 1.0 : 0.0;
    }
    return product;
  }
};

inline PublishedTransition published_transition(const std::filesystem::path& file) {
  std::ifstream in(file);
  PublishedTransition all;
  const auto skip_to = [&](const std::string& heading) {
    for (std::string line; std::getline(in, line) && line.substr(0, heading.size()) != heading;) {
    }
  };
  const auto next_numbers = [&] {
    std::string line;
    std::getline(in, line);
    std::istringstream words(line);
    std::vector<double> numbers;
    for (double number = 0; words >> number;) numbers.push_back(number);
    return numbers;
  };
  skip_to("# r_initial");
  all.now = next_numbers().size();
  skip_to("# labels_transition");
  std::string line;
  std::getline(in, line);
  for (std::size_t quote = line.find('"'); quote != std::string::npos; quote = line.find('"', quote)) {
    const std::size_t end = line.find('"', quote + 1);
    all.labels.push_back(line.substr(quote + 1, end - quote - 1));
    quote = end + 1;
  }
  skip_to("# G_transition");
  for (std::size_t i = 0; i < all.labels.size(); ++i) {
    const std::vector<double> row = next_numbers();
    all.graph.emplace_back(row.begin(), row.end());
  }
  skip_to("# r_transition");
  const std::vector<double> bins = next_numbers();
  all.bins.assign(bins.begin(), bins.end());
  skip_to("# N_transition");
  const std::vector<double> counts = next_numbers();
  std::size_t at = 0;
  all.tables.resize(all.labels.size());
  for (std::size_t i = all.now; i < all.labels.size(); ++i) {
    std::size_t columns = 1;
    for (std::size_t parent = 0; parent < all.labels.size(); ++parent)
      if (all.graph[parent][i]) columns *= all.bins[parent];
    for (std::size_t column = 0; column < columns; ++column, at += all.bins[i])
      all.tables[i].emplace_back(counts.begin() + at, counts.begin() + at + all.bins[i]);
  }
  return all;
}

}  // namespace sigs::test
