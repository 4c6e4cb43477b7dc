// SPDX-License-Identifier: MIT
#include "telemetry/log_messages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "base/text.h"
#include "telemetry/binary_numbers.h"
#include "telemetry/log_formats.h"

namespace sigs {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kHead = "\xA3\x95"sv;
constexpr std::size_t kHeader_bytes = 3;
constexpr std::size_t kFormat_bytes = 89;
constexpr unsigned kFormatType = 128;
constexpr std::size_t kMaxNamed = 10;  // places with skipped bytes that a warning names

// What the letters of a format stand for: numbers, texts and arrays.
constexpr LetterType kLetters[] = {
    {'a', {64}},
    {'b', kNumberType<std::int8_t>},
    {'B', kNumberType<std::uint8_t>},
    {'M', kNumberType<std::uint8_t>},
    {'h', kNumberType<std::int16_t>},
    {'H', kNumberType<std::uint16_t>},
    {'c', kNumberType<std::int16_t>, 0.01},
    {'C', kNumberType<std::uint16_t>, 0.01},
    {'i', kNumberType<std::int32_t>},
    {'I', kNumberType<std::uint32_t>},
    {'e', kNumberType<std::int32_t>, 0.01},
    {'E', kNumberType<std::uint32_t>, 0.01},
    {'L', kNumberType<std::int32_t>, 1e-7},
    {'f', kNumberType<float>},
    {'d', kNumberType<double>},
    {'q', kNumberType<std::int64_t>},
    {'Q', kNumberType<std::uint64_t>},
    {'n', {4}},
    {'N', {16}},
    {'Z', {64}},
};

// The text up to its first zero byte.
std::string_view text_of(std::string_view bytes) {
  return bytes.substr(0, bytes.find('\0'));
}

struct Column {
  std::string name;
  std::size_t offset = 0;
  NumberType type;
  double scale = 1;
};

struct MessageType {
  std::size_t bytes = 0;  // with its header; 0: not defined
  std::string name;
  std::string definition;  // the bytes of its FMT message
  std::vector<Column> columns;
  std::string multipliers;                    // letters, one for each column; empty: none stated
  std::vector<std::optional<Column>> wanted;  // those of the reader, with the scale that it wants
  bool is_placed = false;
};

// The type that a FMT message defines; nothing where it contradicts itself.
std::optional<MessageType> defined_type(std::string_view body) {
  MessageType type;
  type.bytes = static_cast<unsigned char>(body[1]);
  type.name = text_of(body.substr(2, 4));
  type.definition = body;
  const std::string_view letters = text_of(body.substr(6, 16));
  std::string_view labels = text_of(body.substr(22, 64));
  std::size_t offset = kHeader_bytes;
  for (const char c : letters) {
    const std::size_t comma = std::min(labels.find(','), labels.size());
    const LetterType letter = type_of_letter(kLetters, c);
    if (letter.type.bytes == 0) return {};
    type.columns.push_back({std::string(trimmed(labels.substr(0, comma))), offset, letter.type, letter.scale});
    labels.remove_prefix(std::min(comma + 1, labels.size()));
    offset += letter.type.bytes;
  }
  if (offset != type.bytes || type.name.empty()) return {};
  return type;
}

class Walk {
 public:
  Walk(std::string_view bytes, const DataflashReader& reader) : bytes_(bytes), reader_(reader) {
    types_[kFormatType].bytes = kFormat_bytes;
  }

  DataflashContents contents() {
    while (at_ < bytes_.size()) {
      const std::size_t size = message_bytes(at_);
      if (size == 0 || size > bytes_.size() - at_) {
        if (!skip()) break;
        continue;
      }
      take(static_cast<unsigned char>(bytes_[at_ + 2]), bytes_.substr(at_, size));
      at_ += size;
    }
    if (skips_ > kMaxNamed)
      contents_.warnings.push_back(
          {"", count_text(skips_ - kMaxNamed, "more place") + " with bytes that are no message"});
    return std::move(contents_);
  }

 private:
  // The length of the message that begins here; 0: none of a known type does.
  [[nodiscard]] std::size_t message_bytes(std::size_t at) const {
    if (bytes_.size() - at < kHeader_bytes || bytes_.substr(at, 2) != kHead) return 0;
    return types_[static_cast<unsigned char>(bytes_[at + 2])].bytes;
  }

  // Whether something that begins here is a message beyond doubt: another one, or the end, follows.
  [[nodiscard]] bool is_followed(std::size_t at) const {
    const std::size_t size = message_bytes(at);
    if (size == 0 || size > bytes_.size() - at) return false;
    const std::size_t next = at + size;
    return next == bytes_.size() ||
           bytes_.substr(next, 2) == kHead.substr(0, std::min<std::size_t>(2, bytes_.size() - next));
  }

  // Goes on to the next message. False: there is none.
  bool skip() {
    contents_.damaged = true;
    std::size_t found = bytes_.find(kHead, at_ + 1);
    while (found != std::string_view::npos && !is_followed(found)) found = bytes_.find(kHead, found + 1);
    const bool is_end = found == std::string_view::npos;
    const std::string skipped = count_text(static_cast<std::int64_t>((is_end ? bytes_.size() : found) - at_), "byte");
    if (is_end)
      contents_.warnings.push_back({"byte " + std::to_string(at_),
                                    "the log is cut off or broken: the last " + skipped + " are no whole message"});
    else if (++skips_ <= kMaxNamed)
      contents_.warnings.push_back({"byte " + std::to_string(at_), skipped + " skipped that are no message"});
    at_ = found;
    return !is_end;
  }

  void take(unsigned number, std::string_view message) {
    if (number == kFormatType) return define(message.substr(kHeader_bytes));
    MessageType& type = types_[number];
    if (type.name == "FMTU") return take_multipliers(type, message);
    if (type.name == "MULT") return take_multiplier(type, message);
    if (type.name == "MSG") return take_text(type, message);
    if (!type.is_placed) place(type);
    if (type.wanted.empty()) return;
    values_.clear();
    for (const std::optional<Column>& c : type.wanted)
      values_.push_back(c ? number_at(message, c->offset, c->type) * c->scale
                          : std::numeric_limits<double>::quiet_NaN());
    reader_.take(type.name, values_);
  }

  void define(std::string_view body) {
    const unsigned number = static_cast<unsigned char>(body[0]);
    if (number == kFormatType || types_[number].definition == body) return;
    std::optional<MessageType> type = defined_type(body);
    if (type)
      types_[number] = std::move(*type);
    else if (++refused_ <= kMaxNamed)
      contents_.warnings.push_back(
          {"byte " + std::to_string(at_),
           "the definition of message type " + std::to_string(number) + " contradicts itself; left out"});
  }

  static const Column* column(const MessageType& type, std::string_view name) {
    const auto found = std::ranges::find(type.columns, name, &Column::name);
    return found != type.columns.end() ? &*found : nullptr;
  }

  // FMTU: the type that it is about, the letters of the units, and those of the multipliers.
  void take_multipliers(const MessageType& type, std::string_view message) {
    const Column* const about = column(type, "FmtType");
    const Column* const letters = column(type, "MultIds");
    if (!about || !letters || about->type.bytes != 1) return;
    MessageType& described = types_[static_cast<unsigned char>(message[about->offset])];
    described.multipliers = text_of(message.substr(letters->offset, letters->type.bytes));
    described.is_placed = false;
  }

  void take_multiplier(const MessageType& type, std::string_view message) {
    const Column* const letter = column(type, "Id");
    const Column* const value = column(type, "Mult");
    if (!letter || !value || value->type != kNumberType<double>) return;
    const double multiplier = number_at(message, value->offset, value->type);
    if (!std::isfinite(multiplier) || multiplier == 0) return;
    multipliers_[message[letter->offset]] = multiplier;
    for (MessageType& other : types_) other.is_placed = false;
  }

  void take_text(const MessageType& type, std::string_view message) {
    if (const Column* const text = column(type, "Message"); text && reader_.take_text)
      reader_.take_text(text_of(message.substr(text->offset, text->type.bytes)));
  }

  void place(MessageType& type) {
    type.is_placed = true;
    type.wanted.clear();
    for (const DataflashColumn& wanted : reader_.wanted(type.name)) {
      std::optional<Column>& place = type.wanted.emplace_back();
      for (std::size_t i = 0; i < type.columns.size(); ++i) {
        if (type.columns[i].name != wanted.name || !type.columns[i].type.number_of) continue;
        place = type.columns[i];
        place->scale = wanted.is_scaled ? scale_of(type, i) : 1;
      }
    }
  }

  // '?' is the letter of multipliers that nobody has stated, '-' of columns without any.
  [[nodiscard]] double scale_of(const MessageType& type, std::size_t index) const {
    const char letter = index < type.multipliers.size() ? type.multipliers[index] : '-';
    const auto stated = multipliers_.find(letter);
    return letter == '-' || letter == '?' || stated == multipliers_.end() ? type.columns[index].scale : stated->second;
  }

  std::string_view bytes_;
  const DataflashReader& reader_;
  DataflashContents contents_;
  std::size_t at_ = 0;
  std::array<MessageType, 256> types_;
  std::map<char, double> multipliers_;
  std::vector<double> values_;
  std::size_t skips_ = 0;
  std::size_t refused_ = 0;
};

}  // namespace

// It begins with the FMT message that describes FMT messages.
bool is_dataflash(std::string_view head) {
  return head.size() >= kFormat_bytes && head.starts_with(
                                             "\xA3\x95\x80\x80\x59"
                                             "FMT\0"sv);
}

Result<DataflashContents> read_dataflash_messages(std::string_view bytes, const std::string& name,
                                                  const DataflashReader& reader) {
  if (!is_dataflash(bytes)) return fail(name, "does not begin as a dataflash log does");
  return Walk(bytes, reader).contents();
}

}  // namespace sigs
