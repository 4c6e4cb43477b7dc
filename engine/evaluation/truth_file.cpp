// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <pugixml.hpp>
#include <utility>

#include "base/partial_file.h"
#include "base/text_pieces.h"
#include "evaluation/numbers.h"
#include "evaluation/truth.h"

namespace sigs {

namespace {

// Reads attributes and remembers the first that is wrong, so that the story need not ask after each.
class Reading {
 public:
  Reading(const std::filesystem::path& path, const std::string& text) : path_(path), text_(text) {}

  [[nodiscard]] bool failed() const { return error_.has_value(); }
  [[nodiscard]] const Error& error() const { return *error_; }

  void wrong(pugi::xml_node node, const std::string& what) {
    if (error_) return;
    const int line = line_at(text_, static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0)));
    error_ = Error{path_.string() + ": line " + std::to_string(line), what};
  }

  std::string_view text(pugi::xml_node node, const char* name) {
    const pugi::xml_attribute attribute = node.attribute(name);
    if (!attribute) wrong(node, std::string(node.name()) + " has no attribute " + name);
    return attribute.value();
  }

  double number(pugi::xml_node node, const char* name) {
    const std::string_view value = text(node, name);
    const std::optional<double> number = number_of(trimmed(value));
    if (!number || !std::isfinite(*number))
      wrong(node, std::string(node.name()) + " " + name + ": " + in_quotes(value) + " is no number");
    return number.value_or(0);
  }

  int integer(pugi::xml_node node, const char* name, int least, int most = std::numeric_limits<int>::max()) {
    const std::string_view value = text(node, name);
    const std::optional<int> number = integer_of(trimmed(value));
    if (!number || *number < least || *number > most)
      wrong(node, std::string(node.name()) + " " + name + ": " + in_quotes(value) + " is no whole number from " +
                      std::to_string(least) +
                      (most == std::numeric_limits<int>::max() ? " on" : " to " + std::to_string(most)));
    return number.value_or(least);
  }

 private:
  const std::filesystem::path& path_;
  const std::string& text_;
  std::optional<Error> error_;
};

constexpr int kLeastInt = std::numeric_limits<int>::min();
constexpr int kMostPixels = 1 << 20;    // a side of a picture; keeps sums of a box within an int
constexpr double kFarthest_px = 1e100;  // of a silhouette; keeps areas finite

HorizonSide horizon_of(Reading& reading, pugi::xml_node intruder) {
  if (!intruder.attribute("horizon")) return HorizonSide::unknown;  // files of before there was one
  const std::string_view name = reading.text(intruder, "horizon");
  for (const HorizonSide side : {HorizonSide::below, HorizonSide::on, HorizonSide::above, HorizonSide::unknown})
    if (name == name_of(side)) return side;
  reading.wrong(intruder, "intruder horizon: " + in_quotes(name) + " is not above, on or below, nor unknown");
  return HorizonSide::unknown;
}

std::optional<Box> visible_of(Reading& reading, pugi::xml_node box) {
  if (!box) return std::nullopt;
  return box_of({reading.integer(box, "x", -kMostPixels, kMostPixels),
                 reading.integer(box, "y", -kMostPixels, kMostPixels), reading.integer(box, "width", 1, kMostPixels),
                 reading.integer(box, "height", 1, kMostPixels)});
}

std::optional<Box> silhouette_of(Reading& reading, pugi::xml_node node) {
  if (!node) return std::nullopt;
  const Box box{reading.number(node, "x"), reading.number(node, "y"), reading.number(node, "width"),
                reading.number(node, "height")};
  if (box.width < 0 || box.height < 0) reading.wrong(node, "silhouette width and height must not be negative");
  for (const double number : {box.x, box.y, box.width, box.height})
    if (std::abs(number) > kFarthest_px) reading.wrong(node, "silhouette reaches beyond 1e100 pixels");
  return box;
}

TargetInFrame target_of(Reading& reading, pugi::xml_node intruder) {
  TargetInFrame target{.id = reading.integer(intruder, "id", 0), .name = std::string(reading.text(intruder, "name"))};
  target.frame.visible_fraction = reading.number(intruder, "visible_fraction");
  target.frame.horizon = horizon_of(reading, intruder);
  const pugi::xml_node distance = intruder.child("distance");
  if (!distance) reading.wrong(intruder, "intruder has no element distance");
  target.frame.distance_m = reading.number(distance, "m");
  const pugi::xml_node box = intruder.child("box");
  target.frame.visible = visible_of(reading, box);
  if (box.attribute("pixels")) target.frame.visible_pixels = reading.integer(box, "pixels", 0);
  target.frame.silhouette = silhouette_of(reading, intruder.child("silhouette"));
  return target;
}

// "30000/1001"
void read_rate(Reading& reading, pugi::xml_node node, FootageTruth& footage) {
  const std::string_view rate = reading.text(node, "frame_rate");
  const std::size_t slash = rate.find('/');
  const std::optional<int> num = integer_of(rate.substr(0, slash));
  const std::optional<int> den = slash == std::string_view::npos ? 1 : integer_of(rate.substr(slash + 1));
  if (!num || !den || *num <= 0 || *den <= 0)
    return reading.wrong(node, "footage frame_rate: " + in_quotes(rate) + " is no ratio such as 25/1");
  footage.frame_rate_num = *num;
  footage.frame_rate_den = *den;
}

FootageTruth footage_of(Reading& reading, pugi::xml_node node) {
  FootageTruth footage{
      .video = std::string(reading.text(node, "video")),
      .size_px = {reading.integer(node, "width", 1, kMostPixels), reading.integer(node, "height", 1, kMostPixels)},
      .first_frame = reading.integer(node, "first_frame", 0),
      .last_frame = reading.integer(node, "last_frame", 0)};
  read_rate(reading, node, footage);
  if (footage.last_frame < footage.first_frame) reading.wrong(node, "footage last_frame is before its first_frame");
  return footage;
}

void read_frame(Reading& reading, pugi::xml_node node, FilmTruth& film) {
  const int index = reading.integer(node, "index", kLeastInt);
  const double time_s = reading.number(node, "time_s");
  std::vector<TargetInFrame> targets;
  for (const pugi::xml_node intruder : node.children("intruder")) targets.push_back(target_of(reading, intruder));
  if (reading.failed()) return;
  if (index > film.footage.last_frame)
    return reading.wrong(node, "frame " + std::to_string(index) + " is past the footage's last_frame, " +
                                   std::to_string(film.footage.last_frame));
  const Result<void> added = add_frame(film, index, time_s, targets);
  if (!added) reading.wrong(node, added.error().what);
}

FilmTruth film_of(Reading& reading, const pugi::xml_document& document) {
  FilmTruth film;
  const pugi::xml_node root = document.child("sigs");
  const pugi::xml_node footage = root.child("footage");
  if (!footage) reading.wrong(root, "there is no element footage");
  if (!reading.failed()) film.footage = footage_of(reading, footage);
  for (const pugi::xml_node node : root.children("frame")) {
    if (reading.failed()) return film;
    read_frame(reading, node, film);
  }
  const int next = film.footage.first_frame + film.frames();
  if (!reading.failed() && next <= film.footage.last_frame)
    reading.wrong(film.frames() > 0 ? root.last_child() : footage, "ends before frame " + std::to_string(next) +
                                                                       ", but its footage element says last_frame " +
                                                                       std::to_string(film.footage.last_frame));
  return film;
}

}  // namespace

Result<FilmTruth> read_truth(const std::filesystem::path& path) {
  const Result<std::string> text = read_text(path);
  if (!text) return fail(text.error());
  pugi::xml_document document;
  // A copy is parsed, so that the text still has its lines.
  const pugi::xml_parse_result parsed = document.load_buffer(text->data(), text->size());
  if (!parsed)
    return fail(path.string() + ": line " + std::to_string(line_at(*text, static_cast<std::size_t>(parsed.offset))),
                std::string("is not XML from here on: ") + parsed.description());
  const pugi::xml_node root = document.child("sigs");
  if (!root || std::string_view(root.attribute("version").value()) != "1")
    return fail(path.string(), "is no SIGS annotation file: it does not begin with <sigs version=\"1\">");
  Reading reading(path, *text);
  FilmTruth film = film_of(reading, document);
  if (reading.failed()) return fail(reading.error());
  return film;
}

}  // namespace sigs
