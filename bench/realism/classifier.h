// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace sigs::bench {

// One target for a classifier that tells real ones from inserted ones.
struct Example {
  int clip = 0;  // examples of one clip are never on both sides of a division into training and test
  bool is_real = false;
  std::vector<float> measures;  // NaN: not known; takes the median of the training examples
};

// The two classifiers, both of OpenCV's module ml.
enum class ClassifierKind { random_forest, logistic_regression };

// How real each example looks to a classifier that was trained without its clip: the clips are divided into ten parts.
//   columns  which of the measures it may use
[[nodiscard]] std::vector<double> scores_without_clip(const std::vector<Example>& examples,
                                                      const std::vector<int>& columns, ClassifierKind kind);

// Area under the receiver operating characteristic: the probability that a real example has a higher score than an
// inserted one, ties by half. 0.5: they look alike.
struct Auc {
  double value = 0.5;
  double low = 0.5, high = 0.5;  // 95 % of 1000 bootstrap samples of whole clips
  int real = 0, inserted = 0;    // examples
};

// Over the examples that `which` takes.
[[nodiscard]] Auc auc_of(const std::vector<Example>& examples, const std::vector<double>& scores,
                         const std::function<bool(const Example&)>& which);

}  // namespace sigs::bench
