#include "studies/text/strict_json.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <set>
#include <stdexcept>
#include <vector>

#include "studies/text/files.hpp"
#include "studies/text/printable.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// Follows the parser: notices a key that one object gives twice (nlohmann_json would silently keep the last value) and
/// the NUL character, which ends a text for many a library, and knows the last key for messages.
class KeyWatch {
 public:
  explicit KeyWatch(std::string place) : place_(std::move(place)) {}

  bool operator()(int depth, Json::parse_event_t event, Json& parsed) {
    using Event = Json::parse_event_t;
    if (twice_ && event != Event::key) {
      const std::string value = event == Event::object_start  ? "{...}"
                                : event == Event::array_start ? "[...]"
                                                              : shown(parsed);
      throw std::invalid_argument(place_ + ": " + last_key_ + " = " + value + ": key given twice");
    }
    constexpr int deepest = 100;  // the parser and what reads its values call themselves for each level
    if ((event == Event::object_start || event == Event::array_start) && depth > deepest)
      throw std::invalid_argument(place_ + ": nested more than " + std::to_string(deepest) + " levels deep");
    if (event == Event::object_start) seen_.emplace_back();
    if (event == Event::object_end) seen_.pop_back();
    if ((event == Event::key || event == Event::value) && parsed.is_string() &&
        parsed.get_ref<const std::string&>().find('\0') != std::string::npos)
      throw std::invalid_argument(place_ + ": " + shown(parsed) + ": must have no NUL character");
    if (event == Event::key) {
      constexpr std::size_t most_keys = 10'000;  // they are kept in their order, and found one by one
      if (seen_.back().size() >= most_keys) throw std::invalid_argument(place_ + ": an object has too many keys");
      last_key_ = parsed.get<std::string>();
      twice_ = !seen_.back().insert(last_key_).second;
    }
    return true;
  }

  const std::string& last_key() const { return last_key_; }

 private:
  std::string place_, last_key_;
  std::vector<std::set<std::string>> seen_;
  bool twice_ = false;
};

/// "[json.exception.parse_error.101] parse error at line 3, column 5: syntax error while parsing ..." without its tags.
std::string syntax_message(std::string text) {
  if (const auto tag = text.find("] "); text.starts_with("[json.exception") && tag != std::string::npos)
    text.erase(0, tag + 2);
  for (const std::string_view prefix : {"parse error at ", "parse error: "})
    if (text.starts_with(prefix)) text.erase(0, prefix.size());
  return text;
}

/// The text with a mark for each byte that is no letter of UTF-8: the parser's messages end in the middle of one.
std::string whole_letters(const std::string& text) {
  const std::string quoted = Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
  return Json::parse(quoted).get<std::string>();
}

/// The letter in UTF-8 that begins at a place of a text.
std::string_view letter_at(std::string_view text, std::size_t at) {
  std::size_t size = 1;
  while (at + size < text.size() && (static_cast<unsigned char>(text[at + size]) & 0xC0) == 0x80) ++size;
  return text.substr(at, size);
}

/// What people mean by what is no JSON; empty if that is not known.
/// @param read  how many letters of the text the parser has read
std::string plain_cause(std::string_view text, std::size_t read) {
  if (read == 0 || read > text.size()) return "";
  const std::size_t last = read - 1;
  constexpr std::array<std::string_view, 8> quotes{"“", "”", "„", "‟", "‘", "’", "«", "»"};
  const std::string letter(letter_at(text, last));
  if (std::find(quotes.begin(), quotes.end(), letter) != quotes.end())
    return letter + " is a quote of typography: names and texts stand between straight ones, \"";
  const auto before = [&](std::size_t at) { return text.find_last_not_of(" \t\r\n", at - 1); };
  if ((text[last] == '}' || text[last] == ']') && last > 0)
    if (const std::size_t comma = before(last); comma != std::string_view::npos && text[comma] == ',')
      return std::string("a comma stands before ") + text[last] + ", and nothing follows it: leave it out";
  constexpr const char* of_numbers = "0123456789.eE+-";
  const std::size_t comma = text.find_last_not_of(of_numbers, last);
  if (comma == std::string_view::npos || comma == 0 || comma == last || text[comma] != ',') return "";
  const std::size_t end = text.find_first_not_of(of_numbers, comma + 1),
                    whole = text.find_last_not_of(of_numbers, comma - 1);
  if (whole == std::string_view::npos || whole + 1 == comma || text[comma + 1] < '0' || text[comma + 1] > '9')
    return "";
  const std::string front(text.substr(whole + 1, comma - whole - 1)), back(text.substr(comma + 1, end - comma - 1));
  return shortened(front + "," + back) + " has a decimal comma: write " + shortened(front + "." + back);
}

/// Where something stands: "line 3, column 12".
std::string line_and_column(const std::string& message) { return message.substr(0, message.find(": ")); }

}  // namespace

Json parse_object(std::string_view text, const std::string& place) {
  KeyWatch watch(place);
  Json parsed;
  try {
    parsed = Json::parse(text.begin(), text.end(), std::ref(watch));
  } catch (const Json::out_of_range& error) {
    throw std::invalid_argument(place + ": " + watch.last_key() + ": must be a finite number (" +
                                syntax_message(error.what()) + ")");
  } catch (const Json::parse_error& error) {
    const std::string message = syntax_message(error.what()), cause = plain_cause(text, error.byte);
    throw std::invalid_argument(place + ": " +
                                (cause.empty() ? whole_letters(message) : line_and_column(message) + ": " + cause));
  } catch (const Json::exception& error) {
    throw std::invalid_argument(place + ": " + syntax_message(error.what()));
  }
  if (!parsed.is_object()) throw std::invalid_argument(place + ": " + shown(parsed) + ": must be an object { ... }");
  return parsed;
}

Json read_object(const std::string& path) { return parse_object(whole_file(path, largest_json), path); }

std::string shown(const Json& value) { return shortened(value.dump(-1, ' ', false, Json::error_handler_t::replace)); }

void refuse(const std::string& place, std::string_view key, const Json& value, const std::string& rule) {
  throw std::invalid_argument(place + ": " + std::string(key) + " = " + shown(value) + ": " + rule);
}

void refuse_unknown_keys(const Json& object, std::span<const std::string_view> known, const std::string& place) {
  constexpr std::size_t few = 10;  // of which all are told
  const std::string all = known.size() <= few ? "known are " + joined(known) : "";
  for (const auto& [key, value] : object.items())
    if (find_name(known, key) < 0) refuse(place, key, value, unknown("unknown key", known, key, all));
}

const Json& needed(const Json& object, const std::string& key, const std::string& place, const std::string& rule) {
  const auto found = object.find(key);
  if (found == object.end()) throw std::invalid_argument(place + ": " + key + " is missing: " + rule);
  return *found;
}

std::string needed_text(const Json& object, const std::string& key, const std::string& place, const std::string& rule) {
  const Json& value = needed(object, key, place, rule);
  if (!value.is_string() || value.get_ref<const std::string&>().empty()) refuse(place, key, value, rule);
  return value.get<std::string>();
}

std::string needed_name(const Json& object, const std::string& key, const std::string& place, const std::string& rule) {
  std::string name = needed_text(object, key, place, rule);
  if (const std::string broken = broken_by_name(name); !broken.empty()) refuse(place, key, object.at(key), broken);
  return name;
}

std::string broken_by_name(std::string_view name) {
  for (std::size_t at = 0; at < name.size(); ++at)
    if (is_control(name.substr(at))) return "must have no control characters";
  if (name.starts_with(' ') || name.ends_with(' ')) return "must not begin or end with a blank";
  return name == "." || name == ".." ? "must not be . or .." : "";
}

std::vector<std::string> names_or_none(const Json& object, const std::string& key, const std::string& place) {
  const auto found = object.find(key);
  if (found == object.end()) return {};
  constexpr const char* rule = "must be a list of names";
  if (!found->is_array()) refuse(place, key, *found, rule);
  std::vector<std::string> names;
  for (const Json& name : *found) {
    if (!name.is_string() || name.get_ref<const std::string&>().empty()) refuse(place, key, *found, rule);
    names.push_back(name.get<std::string>());
  }
  return names;
}

int whole_number(const Json& value, std::string_view key, int lowest, int highest, const std::string& place) {
  if (!value.is_number_integer() || value < lowest || value > highest)
    refuse(place, key, value,
           "must be a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest));
  return value.get<int>();
}

int whole_number_or(const Json& object, const std::string& key, int usual, int lowest, int highest,
                    const std::string& place) {
  const auto found = object.find(key);
  return found == object.end() ? usual : whole_number(*found, key, lowest, highest, place);
}

}  // namespace rollres
