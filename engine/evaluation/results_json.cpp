// SPDX-License-Identifier: MIT
// What the layouts in JSON have in common: which of them a file has, and what an image's name tells.
#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "evaluation/numbers.h"
#include "evaluation/results_formats.h"

namespace sigs {

namespace {

// Looks at the keys of the list's first entry and stops.
class FirstKeys : public nlohmann::json_sax<nlohmann::json> {
 public:
  [[nodiscard]] std::optional<ResultsFormat> format() const { return format_; }
  [[nodiscard]] bool has_other_keys() const { return has_other_keys_; }

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool start_object(std::size_t) override { return ++depth_ > 1; }  // an object outside of a list is no results
  bool end_object() override { return --depth_ > 1; }               // the first entry alone
  bool start_array(std::size_t) override {
    ++depth_;
    return true;
  }
  bool end_array() override { return --depth_ > 0; }
  bool key(string_t& name) override {
    if (depth_ != 2) return true;
    if (name == "img_name" || name == "detections") format_ = ResultsFormat::aot;
    if (name == "image_id" || name == "bbox") format_ = ResultsFormat::coco;
    has_other_keys_ = true;
    return !format_;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override {
    has_other_keys_ = false;  // the reader of the layout says what is wrong, and where
    return false;
  }

 private:
  int depth_ = 0;
  std::optional<ResultsFormat> format_;
  bool has_other_keys_ = false;
};

}  // namespace

Result<ResultsFormat> json_format(const ResultsFile& file) {
  FirstKeys keys;
  static_cast<void>(nlohmann::json::sax_parse(file.text, &keys));
  if (keys.format()) return *keys.format();
  if (!keys.has_other_keys()) return ResultsFormat::aot;
  return file.wrong(1,
                    "is of no known layout: its first entry has neither img_name and detections (aot) nor image_id and "
                    "bbox (coco)");
}

std::optional<int> frame_of_image(std::string_view image) {
  std::string_view name = image.substr(image.find_last_of("/\\") + 1);  // npos + 1 is 0
  name = name.substr(0, name.find_last_of('.'));
  const auto is_digit = [](char letter) { return std::isdigit(static_cast<unsigned char>(letter)) != 0; };
  const auto begin = std::find_if_not(name.rbegin(), name.rend(), is_digit).base();
  const std::string_view digits = name.substr(static_cast<std::size_t>(begin - name.begin()));
  return digits.empty() ? std::nullopt : integer_of(digits);
}

std::string folder_of_image(const std::string& image) {
  std::string folder = image.substr(0, image.find_last_of("/\\") + 1);  // npos + 1 is 0
  if (!folder.empty()) folder.pop_back();
  return folder.substr(folder.find_last_of("/\\") + 1);
}

}  // namespace sigs
