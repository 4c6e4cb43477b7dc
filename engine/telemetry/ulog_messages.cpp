// SPDX-License-Identifier: MIT
#include "telemetry/log_messages.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "base/text.h"
#include "telemetry/binary_numbers.h"
#include "telemetry/log_formats.h"

namespace sigs {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kMagic = "ULog\x01\x12\x35"sv;
constexpr std::string_view kSync = "\x08\x00S\x2F\x73\x13\x20\x25\x0C\xBB\x12"sv;  // with its header
constexpr std::string_view kTypes = "BFIMPQARDLCSO";
constexpr std::size_t kUlogHeader_bytes = 16;
constexpr std::size_t kMessageHeader_bytes = 3;
constexpr int kMaxNesting = 8;
constexpr std::size_t kMaxTopic_bytes = 65535;  // a message has no more
constexpr std::size_t kMaxFormats = 4096;
constexpr std::size_t kMaxNamedTopics = 10;  // warnings of one kind

struct FieldType {
  std::string_view name;
  NumberType type;
};
constexpr FieldType kFieldTypes[] = {
    {"int8_t", kNumberType<std::int8_t>},   {"uint8_t", kNumberType<std::uint8_t>},
    {"int16_t", kNumberType<std::int16_t>}, {"uint16_t", kNumberType<std::uint16_t>},
    {"int32_t", kNumberType<std::int32_t>}, {"uint32_t", kNumberType<std::uint32_t>},
    {"int64_t", kNumberType<std::int64_t>}, {"uint64_t", kNumberType<std::uint64_t>},
    {"float", kNumberType<float>},          {"double", kNumberType<double>},
    {"bool", kNumberType<std::uint8_t>},    {"char", kNumberType<std::uint8_t>},
};

struct MessagePlace {
  std::size_t offset = 0;
  NumberType type;
};

using Formats = std::map<std::string, std::string, std::less<>>;  // name -> "type name;type name;"

// "float[4]" -> "float", 4. Count 0: not an array type that makes sense.
std::pair<std::string_view, std::size_t> array_type(std::string_view type) {
  const std::size_t bracket = type.find('[');
  if (bracket == std::string_view::npos) return {type, 1};
  std::size_t count = 0;
  const std::string_view digits = type.substr(bracket + 1);
  std::from_chars(digits.data(), digits.data() + digits.size(), count);
  return {type.substr(0, bracket), count <= kMaxTopic_bytes ? count : 0};
}

// Finds where the wanted fields of a topic lie.
class Layout {
 public:
  Layout(const Formats& formats, const std::vector<std::string>& wanted) : formats_(formats), wanted_(wanted) {
    places_.resize(wanted.size());
  }

  // False: a type that is not known, nesting without end, or a topic larger than a message.
  bool add_topic(std::string_view topic, const std::string& prefix = "", int depth = 0) {
    const auto format = formats_.find(topic);
    if (format == formats_.end() || depth > kMaxNesting) return false;
    std::string_view fields = format->second;
    while (!fields.empty()) {
      const std::size_t end = std::min(fields.find(';'), fields.size());
      if (!add_field(trimmed(fields.substr(0, end)), prefix, depth)) return false;
      fields.remove_prefix(std::min(end + 1, fields.size()));
    }
    return true;
  }

  [[nodiscard]] const std::vector<std::optional<MessagePlace>>& places() const { return places_; }

 private:
  bool add_field(std::string_view field, const std::string& prefix, int depth) {
    if (field.empty()) return true;
    const std::string_view type_text = next_token(field);
    const std::string name = prefix + std::string(trimmed(field));
    const auto [type, count] = array_type(type_text);
    const bool is_array = type.size() != type_text.size();
    if (count == 0 || ++fields_ > kMaxTopic_bytes) return false;
    const FieldType* const number = std::ranges::find(kFieldTypes, type, &FieldType::name);
    const bool is_number = number != std::end(kFieldTypes);
    for (std::size_t i = 0; i < count; ++i) {
      const std::string element = is_array ? name + "[" + std::to_string(i) + "]" : name;
      if (!is_number) {
        if (++fields_ > kMaxTopic_bytes || !add_topic(type, element + ".", depth + 1)) return false;
        continue;
      }
      note(element, number->type);
      size_ += number->type.bytes;
      if (size_ > kMaxTopic_bytes) return false;
    }
    return true;
  }

  void note(const std::string& name, NumberType type) {
    for (std::size_t i = 0; i < wanted_.size(); ++i)
      if (wanted_[i] == name) places_[i] = MessagePlace{.offset = size_, .type = type};
  }

  const Formats& formats_;
  const std::vector<std::string>& wanted_;
  std::vector<std::optional<MessagePlace>> places_;
  std::size_t size_ = 0;
  std::size_t fields_ = 0;
};

struct Subscription {
  std::string topic;
  std::vector<std::optional<MessagePlace>> places;  // empty: not wanted
};

class MessageWalk {
 public:
  MessageWalk(std::string_view bytes, const UlogReader& reader) : bytes_(bytes), reader_(reader) {}

  Result<UlogContents> contents(const std::string& name) {
    if (!is_ulog(bytes_) || bytes_.size() < kUlogHeader_bytes) return fail(name, "is no ULog");
    const int version = static_cast<unsigned char>(bytes_[7]);
    if (version > 1) return fail(name + ": byte 7", "ULog version " + std::to_string(version) + ", known are 0 and 1");
    contents_.start_s = number_at(bytes_, 8, kNumberType<std::uint64_t>) * 1e-6;
    at_ = kUlogHeader_bytes;
    while (at_ < bytes_.size()) {
      if (!next_message()) break;
      if (!refused_.empty()) return fail(name + ": byte " + std::to_string(kUlogHeader_bytes), refused_);
    }
    finish();
    return std::move(contents_);
  }

 private:
  // One message, or the way to the next one. False: the reading ends.
  bool next_message() {
    const std::string_view rest = bytes_.substr(at_);
    const std::size_t size = rest.size() < kMessageHeader_bytes ? 0 : little_endian(rest.substr(0, 2));
    const bool fits = rest.size() >= kMessageHeader_bytes && rest.size() - kMessageHeader_bytes >= size;
    const char type = fits ? rest[2] : '\0';
    const std::size_t section = next_section();
    if (section > at_ && at_ + kMessageHeader_bytes + size > section) return go_to(section);
    if (!fits || size == 0 || kTypes.find(type) == std::string_view::npos) return synchronise(fits);
    take(type, rest.substr(kMessageHeader_bytes, size));
    at_ += kMessageHeader_bytes + size;
    return true;
  }

  // Where appended data begin, if that lies ahead; 0: nowhere.
  [[nodiscard]] std::size_t next_section() const {
    std::size_t next = 0;
    for (const std::uint64_t offset : appended_)
      if (offset > at_ && offset < bytes_.size() && (next == 0 || offset < next)) next = offset;
    return next;
  }

  bool go_to(std::size_t section) {
    contents_.warnings.push_back(
        {"byte " + std::to_string(at_), "a message that was not written to its end, before appended data"});
    at_ = section;
    return true;
  }

  bool synchronise(bool inside) {
    contents_.damaged = true;
    const std::size_t found = bytes_.find(kSync, at_ + 1);
    const std::string where = "byte " + std::to_string(at_);
    if (found == std::string_view::npos) {
      contents_.warnings.push_back(
          {where, inside ? "is no message; the rest of the file is not read" : "the file is cut off within a message"});
      return false;
    }
    if (++skips_ <= kMaxNamedTopics)
      contents_.warnings.push_back({where, "is no message; " + count_text(found - at_, "byte") +
                                               " skipped up to the next synchronisation message, after " +
                                               short_number_text(last_s_) + " s since boot"});
    at_ = found;
    return true;
  }

  void take(char type, std::string_view body) {
    switch (type) {
      case 'B':
        return flags(body);
      case 'F':
        return format(body);
      case 'I':
        return info(body);
      case 'A':
        return subscribe(body);
      case 'R':
        if (body.size() >= 2) subscriptions_.erase(little_endian(body.substr(0, 2)));
        return;
      case 'D':
        return data(body);
      case 'O':
        if (body.size() >= 2)
          contents_.dropouts.push_back(
              {.after_s = last_s_, .duration_s = 1e-3 * static_cast<double>(little_endian(body.substr(0, 2)))});
        return;
      default:
        return;  // parameters, texts and tags have nothing that a Track has
    }
  }

  // Flag bits: 8 bytes of compatible flags, 8 of incompatible ones, three offsets of appended data.
  void flags(std::string_view body) {
    if (body.size() < 40) return;
    const std::uint64_t incompatible = little_endian(body.substr(8, 8));
    if ((incompatible & ~std::uint64_t{1}) != 0) {
      refused_ = "the log has a flag that SIGS does not know and that changes how it is to be read";
      return;
    }
    if ((incompatible & 1) == 0) return;
    for (std::size_t i = 0; i < appended_.size(); ++i) appended_[i] = little_endian(body.substr(16 + 8 * i, 8));
  }

  void format(std::string_view body) {
    const std::size_t colon = body.find(':');
    if (colon == std::string_view::npos || formats_.size() >= kMaxFormats) return;
    formats_.insert_or_assign(std::string(body.substr(0, colon)), std::string(body.substr(colon + 1)));
  }

  void info(std::string_view body) {
    const std::size_t key_size = static_cast<unsigned char>(body[0]);
    if (body.size() - 1 < key_size) return;
    const std::string_view key = body.substr(1, key_size);
    std::string text;
    for (const char c : body.substr(1 + key_size))
      if (c >= ' ' && c <= '~') text += c;
    if (!key.starts_with("char[")) return;
    if (key.ends_with(" ver_hw")) contents_.hardware = text;
    if (key.ends_with(" ver_sw_branch") || (key.ends_with(" ver_sw") && contents_.software.empty()))
      contents_.software = text;
  }

  void subscribe(std::string_view body) {
    if (body.size() < 4) return;
    const int instance = static_cast<unsigned char>(body[0]);
    Subscription subscription{.topic = std::string(body.substr(3)), .places = {}};
    const std::vector<std::string> wanted = reader_.wanted(subscription.topic);
    if (!wanted.empty() && instance == 0) {
      subscription.places = places_of(subscription.topic, wanted);
      if (subscription.places.empty())
        contents_.warnings.push_back(
            {printable(subscription.topic), "its format is not defined, or makes no sense; left out"});
    }
    if (!wanted.empty() && instance > 0)
      contents_.warnings.push_back({printable(subscription.topic),
                                    "instance " + std::to_string(instance) + " is not read, only the first one (0)"});
    subscriptions_.insert_or_assign(little_endian(body.substr(1, 2)), std::move(subscription));
  }

  // Empty: the format is not defined, or makes no sense. Laid out once for each topic: a file can have many thousand
  // subscriptions.
  const std::vector<std::optional<MessagePlace>>& places_of(const std::string& topic,
                                                            const std::vector<std::string>& wanted) {
    const auto [entry, is_first] = layouts_.try_emplace(topic);
    if (!is_first) return entry->second;
    Layout layout(formats_, wanted);
    if (layout.add_topic(topic)) entry->second = layout.places();
    return entry->second;
  }

  void data(std::string_view body) {
    const auto found = body.size() < 2 ? subscriptions_.end() : subscriptions_.find(little_endian(body.substr(0, 2)));
    if (found == subscriptions_.end()) {
      ++without_subscription_;
      return;
    }
    body.remove_prefix(2);
    const Subscription& subscription = found->second;
    if (subscription.places.empty()) return;
    values_.clear();
    for (const std::optional<MessagePlace>& place : subscription.places)
      values_.push_back(place ? number_at(body, place->offset, place->type) : std::numeric_limits<double>::quiet_NaN());
    if (std::isfinite(values_.front())) last_s_ = values_.front() * 1e-6;
    reader_.take(subscription.topic, values_);
  }

  void finish() {
    if (skips_ > kMaxNamedTopics)
      contents_.warnings.push_back(
          {"", count_text(skips_ - kMaxNamedTopics, "more place") + " with bytes that are no message"});
    if (without_subscription_ > 0)
      contents_.warnings.push_back(
          {"", count_text(without_subscription_, "data message") + " of no known topic left out"});
  }

  static std::string printable(std::string_view text) {
    std::string shown;
    for (const char c : text.substr(0, 60)) shown += c >= ' ' && c <= '~' ? c : '?';
    return shown;
  }

  std::string_view bytes_;
  const UlogReader& reader_;
  UlogContents contents_;
  std::size_t at_ = 0;
  std::array<std::uint64_t, 3> appended_{};
  Formats formats_;
  std::map<std::uint64_t, Subscription> subscriptions_;
  std::map<std::string, std::vector<std::optional<MessagePlace>>> layouts_;
  std::vector<double> values_;
  double last_s_ = 0;
  std::size_t skips_ = 0;
  std::size_t without_subscription_ = 0;
  std::string refused_;
};

}  // namespace

bool is_ulog(std::string_view head) {
  return head.starts_with(kMagic);
}

Result<UlogContents> read_ulog_messages(std::string_view bytes, const std::string& name, const UlogReader& reader) {
  return MessageWalk(bytes, reader).contents(name);
}

}  // namespace sigs
