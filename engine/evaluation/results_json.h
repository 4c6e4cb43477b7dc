// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "evaluation/results_formats.h"

namespace sigs {

// What the layouts of results in JSON (aot, coco) have in common: a list of entries, which can be too long for a
// document tree, so it is read token by token.

// Reads a list of entries. A derived class follows the structure of its layout and adds the boxes; values of keys that
// it does not read are skipped, however deep they nest. Functions that return bool return false for an error, which
// ends the reading; fails() does so and keeps the error.
class JsonListReader : private nlohmann::json_sax<nlohmann::json> {
 public:
  // first_number: what the file calls the clip's first frame, for messages. The file must outlive the reader.
  JsonListReader(const ResultsFile& file, int first_number) : file_(file), builder_(file, first_number) {}

  // Reads the whole file. Error bad_data.
  [[nodiscard]] Result<Results> read();

 protected:
  // A number or a text, as value of key() or as an element of a list.
  [[nodiscard]] virtual bool on_number(double number) = 0;
  [[nodiscard]] virtual bool on_text(const std::string& text) = 0;

  // The start of an object or list: false where the layout has none there, which is an unexpected value then.
  [[nodiscard]] virtual bool starts_object() = 0;
  [[nodiscard]] virtual bool starts_list() = 0;

  // The end of an object or list that has been started.
  [[nodiscard]] virtual bool on_object_end() = 0;
  virtual void on_list_end() = 0;

  // Whether an object here is the value of a key that is not read.
  [[nodiscard]] virtual bool skips_object() const = 0;

  // A value that the layout does not have here; what: "null", "a number", "a list", ... Returns true where it is the
  // value of a key that is not read, else fails().
  [[nodiscard]] virtual bool unexpected_value(const char* what) = 0;

  // ", [17]": the entry being read, for messages about files of a single line. Empty: none.
  [[nodiscard]] virtual std::string place_in_list() const = 0;

  // Keeps the error with its line, from 1, and what is wrong. Returns false.
  bool fails(int line, const std::string& what);

  [[nodiscard]] bool has_failed() const { return !error_.what.empty(); }

  // Adds a box; track is a number of the file, which must be whole, negative for none.
  [[nodiscard]] bool add_box(int frame, const Box& box, double score, double track, int line);

  [[nodiscard]] const ResultsFile& file() const { return file_; }
  [[nodiscard]] const std::string& key() const { return key_; }  // of the value being read; empty: none yet
  [[nodiscard]] int line() const { return line_; }               // of the file, from 1, at which the parser is
  // The footage's number of an image's frame: by ResultsOptions::images, else the number at the end of its name.
  [[nodiscard]] std::optional<int> frame_named(std::string_view image) const;
  void leave_out(int boxes) { boxes_elsewhere_ += boxes; }  // of an image that the truth does not have
  void set_clip_of_image(const std::string& image);         // Results::clip; the first image that names one counts

 private:
  bool fails(const Error& error);
  bool on_other_value(const char* what) { return skipped_depth_ > 0 || unexpected_value(what); }
  bool on_any_number(double number) { return skipped_depth_ > 0 || on_number(number); }

  // The parser's events, passed on to the functions above where nothing is skipped.
  bool null() override { return on_other_value("null"); }
  bool boolean(bool) override { return on_other_value("true or false"); }
  bool binary(binary_t&) override { return on_other_value("binary"); }
  bool number_integer(number_integer_t number) override { return on_any_number(static_cast<double>(number)); }
  bool number_unsigned(number_unsigned_t number) override { return on_any_number(static_cast<double>(number)); }
  bool number_float(number_float_t number, const string_t&) override { return on_any_number(number); }
  bool string(string_t& text) override { return skipped_depth_ > 0 || on_text(text); }
  bool key(string_t& name) override;
  bool start_object(std::size_t) override;
  bool end_object() override;
  bool start_array(std::size_t) override;
  bool end_array() override;
  bool parse_error(std::size_t position, const std::string& token, const nlohmann::json::exception&) override;

  const ResultsFile& file_;
  int line_ = 1;
  bool is_one_line_ = file_.text.find('\n') >= file_.text.find_last_not_of(" \r\n");
  std::string clip_;
  int boxes_elsewhere_ = 0;
  ResultsBuilder builder_;
  Error error_;
  int skipped_depth_ = 0;  // number of open objects and lists of keys that are not read
  std::string key_;
};

// An image's name without folder and extension.
[[nodiscard]] std::string_view stem_of_image(std::string_view image);

// The frame number at the end of an image's name without extension: 123 of "flight/frame_000123.png". nullopt: there
// are no digits, or more than an int has.
[[nodiscard]] std::optional<int> frame_of_image(std::string_view image);

}  // namespace sigs
