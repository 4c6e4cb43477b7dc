// SPDX-License-Identifier: MIT
#include "realism/classifier.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/ml.hpp>
#include <set>

namespace sigs::bench {

namespace {

constexpr int kParts = 10;
constexpr int kTrees = 120;
constexpr int kBootstraps = 1000;
constexpr float kLargestDeviate = 4;  // of a measure in standard deviations: outliers do not decide

// Measures of a table as the training examples have them: without gaps, and for the regression with mean 0 and
// standard deviation 1.
class Scaling {
 public:
  explicit Scaling(const cv::Mat& training) {
    for (int c = 0; c < training.cols; ++c) {
      std::vector<float> known;
      for (int r = 0; r < training.rows; ++r)
        if (!std::isnan(training.at<float>(r, c))) known.push_back(training.at<float>(r, c));
      if (known.empty()) known.push_back(0);
      std::sort(known.begin(), known.end());
      const std::size_t count = known.size();
      medians_.push_back(known[count / 2]);
      // From the quartiles, so that outliers do not count.
      scales_.push_back(std::max(1e-6F, (known[count * 3 / 4] - known[count / 4]) / 1.35F));
    }
  }

  [[nodiscard]] cv::Mat applied(const cv::Mat& table) const {
    cv::Mat scaled(table.size(), CV_32FC1);
    for (int r = 0; r < table.rows; ++r)
      for (int c = 0; c < table.cols; ++c) {
        const auto i = static_cast<std::size_t>(c);
        const float value = table.at<float>(r, c);
        scaled.at<float>(r, c) =
            std::isnan(value) ? 0 : std::clamp((value - medians_[i]) / scales_[i], -kLargestDeviate, kLargestDeviate);
      }
    return scaled;
  }

 private:
  std::vector<float> medians_, scales_;
};

std::vector<double> forest_scores(const cv::Mat& training, const cv::Mat& labels, const cv::Mat& test) {
  cv::theRNG().state = 12345;  // OpenCV's forests draw from it
  const auto forest = cv::ml::RTrees::create();
  forest->setMaxDepth(8);
  forest->setMinSampleCount(4);
  forest->setActiveVarCount(0);  // square root of their number
  forest->setTermCriteria({cv::TermCriteria::MAX_ITER, kTrees, 0});
  forest->train(cv::ml::TrainData::create(training, cv::ml::ROW_SAMPLE, labels));
  cv::Mat results;
  forest->predict(test, results);  // labels are numbers: the mean of the trees
  return {results.begin<float>(), results.end<float>()};
}

std::vector<double> regression_scores(const cv::Mat& training, const cv::Mat& labels, const cv::Mat& test) {
  const auto regression = cv::ml::LogisticRegression::create();
  regression->setLearningRate(0.1);
  regression->setIterations(400);
  regression->setRegularization(cv::ml::LogisticRegression::REG_L2);
  regression->setTrainMethod(cv::ml::LogisticRegression::BATCH);
  regression->train(cv::ml::TrainData::create(training, cv::ml::ROW_SAMPLE, labels));
  const cv::Mat theta = regression->get_learnt_thetas();  // the constant first
  std::vector<double> scores;
  for (int r = 0; r < test.rows; ++r) scores.push_back(theta.colRange(1, theta.cols).dot(test.row(r)));
  return scores;
}

// Which of the parts a clip is in, by its rank among the clips.
std::map<int, int> parts_of(const std::vector<Example>& examples) {
  std::set<int> clips;
  for (const Example& example : examples) clips.insert(example.clip);
  std::map<int, int> parts;
  for (const int clip : clips) parts.emplace(clip, static_cast<int>(parts.size()) % kParts);
  return parts;
}

cv::Mat table_of(const std::vector<Example>& examples, const std::vector<std::size_t>& rows,
                 const std::vector<int>& columns) {
  cv::Mat table(static_cast<int>(rows.size()), static_cast<int>(columns.size()), CV_32FC1);
  for (int r = 0; r < table.rows; ++r)
    for (int c = 0; c < table.cols; ++c)
      table.at<float>(r, c) = examples[rows[static_cast<std::size_t>(r)]]
                                  .measures[static_cast<std::size_t>(columns[static_cast<std::size_t>(c)])];
  return table;
}

// Share of pairs (real, inserted) in which the real one has the higher score, by ranks; weights count examples.
double area_under(const std::vector<std::pair<double, bool>>& sorted) {
  double above = 0, inserted = 0, real = 0;
  for (std::size_t i = 0; i < sorted.size();) {
    double tied_real = 0, tied_inserted = 0;
    const double score = sorted[i].first;
    for (; i < sorted.size() && sorted[i].first == score; ++i) (sorted[i].second ? tied_real : tied_inserted) += 1;
    above += tied_real * (inserted + 0.5 * tied_inserted);
    inserted += tied_inserted;
    real += tied_real;
  }
  return inserted > 0 && real > 0 ? above / (inserted * real) : 0.5;
}

}  // namespace

std::vector<double> scores_without_clip(const std::vector<Example>& examples, const std::vector<int>& columns,
                                        ClassifierKind kind) {
  const std::map<int, int> parts = parts_of(examples);
  std::vector<double> scores(examples.size(), 0);
  for (int part = 0; part < kParts; ++part) {
    std::vector<std::size_t> training_rows, test_rows;
    for (std::size_t i = 0; i < examples.size(); ++i)
      (parts.at(examples[i].clip) == part ? test_rows : training_rows).push_back(i);
    if (training_rows.empty() || test_rows.empty()) continue;
    const cv::Mat training = table_of(examples, training_rows, columns);
    cv::Mat labels(training.rows, 1, CV_32FC1);
    for (int r = 0; r < labels.rows; ++r)
      labels.at<float>(r) = examples[training_rows[static_cast<std::size_t>(r)]].is_real ? 1 : 0;
    const Scaling scaling(training);
    const cv::Mat scaled = scaling.applied(training), test = scaling.applied(table_of(examples, test_rows, columns));
    const std::vector<double> part_scores = kind == ClassifierKind::random_forest
                                                ? forest_scores(scaled, labels, test)
                                                : regression_scores(scaled, labels, test);
    for (std::size_t i = 0; i < test_rows.size(); ++i) scores[test_rows[i]] = part_scores[i];
  }
  return scores;
}

Auc auc_of(const std::vector<Example>& examples, const std::vector<double>& scores,
           const std::function<bool(const Example&)>& which) {
  std::map<int, std::vector<std::pair<double, bool>>> by_clip;
  Auc auc;
  for (std::size_t i = 0; i < examples.size(); ++i)
    if (which(examples[i])) {
      by_clip[examples[i].clip].emplace_back(scores[i], examples[i].is_real);
      ++(examples[i].is_real ? auc.real : auc.inserted);
    }
  std::vector<int> clips;
  for (const auto& [clip, ignored] : by_clip) clips.push_back(clip);
  if (clips.empty()) return auc;
  const auto area_of = [&](const std::vector<int>& chosen) {
    std::vector<std::pair<double, bool>> all;
    for (const int clip : chosen) all.insert(all.end(), by_clip[clip].begin(), by_clip[clip].end());
    std::sort(all.begin(), all.end());
    return area_under(all);
  };
  auc.value = area_of(clips);
  cv::RNG random(99);
  std::vector<double> areas;
  for (int n = 0; n < kBootstraps; ++n) {
    std::vector<int> drawn;
    for (std::size_t i = 0; i < clips.size(); ++i)
      drawn.push_back(clips[static_cast<std::size_t>(random.uniform(0, static_cast<int>(clips.size())))]);
    areas.push_back(area_of(drawn));
  }
  std::sort(areas.begin(), areas.end());
  auc.low = areas[kBootstraps / 40];
  auc.high = areas[kBootstraps - 1 - kBootstraps / 40];
  return auc;
}

}  // namespace sigs::bench
