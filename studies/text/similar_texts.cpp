#include "studies/text/similar_texts.hpp"

#include <charconv>
#include <map>

namespace rollres {

namespace {

bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }

/// Where the number that begins at a digit ends: "12", "1.5", "3e-06".
std::size_t end_of_number(const std::string& text, std::size_t at) {
  const auto digits = [&](std::size_t from) {
    while (from < text.size() && is_digit(text[from])) ++from;
    return from;
  };
  at = digits(at);
  if (at + 1 < text.size() && text[at] == '.' && is_digit(text[at + 1])) at = digits(at + 1);
  if (at >= text.size() || text[at] != 'e') return at;
  const std::size_t sign = at + 1 < text.size() && (text[at + 1] == '-' || text[at + 1] == '+') ? at + 2 : at + 1;
  return sign < text.size() && is_digit(text[sign]) ? digits(sign) : at;
}

/// Texts that differ only in their numbers.
struct Kind {
  struct Range {
    double least, greatest;
    std::string least_text, greatest_text;
  };
  std::vector<Range> ranges;
  std::string words;
};

constexpr char number_here = '\x01';

/// The text with its numbers left out, which go into `numbers`.
std::string pattern_of(const std::string& text, std::vector<std::string>& numbers) {
  std::string pattern;
  for (std::size_t at = 0; at < text.size();) {
    if (!is_digit(text[at])) {
      pattern += text[at++];
      continue;
    }
    const std::size_t end = end_of_number(text, at);
    numbers.push_back(text.substr(at, end - at));
    pattern += number_here;
    at = end;
  }
  return pattern;
}

std::string words_of(const std::string& pattern, const std::vector<Kind::Range>& ranges) {
  std::string words;
  std::size_t place = 0;
  for (const char letter : pattern) {
    if (letter != number_here) {
      words += letter;
      continue;
    }
    const Kind::Range& range = ranges[place++];
    words += range.least_text;
    if (range.least_text != range.greatest_text) words += " to " + range.greatest_text;
  }
  return words;
}

}  // namespace

std::vector<std::string> with_ranges(const std::vector<std::string>& texts) {
  std::map<std::string, Kind> kinds;
  std::vector<const Kind*> of_texts;
  for (const std::string& text : texts) {
    std::vector<std::string> numbers;
    Kind& kind = kinds[pattern_of(text, numbers)];
    of_texts.push_back(&kind);
    for (std::size_t place = 0; place < numbers.size(); ++place) {
      const std::string& number = numbers[place];
      double value = 0;
      std::from_chars(number.data(), number.data() + number.size(), value);
      if (place == kind.ranges.size()) kind.ranges.push_back({value, value, number, number});
      Kind::Range& range = kind.ranges[place];
      if (value < range.least) range.least = value, range.least_text = number;
      if (value > range.greatest) range.greatest = value, range.greatest_text = number;
    }
  }
  for (auto& [pattern, kind] : kinds) kind.words = words_of(pattern, kind.ranges);
  std::vector<std::string> all;
  for (const Kind* const kind : of_texts) all.push_back(kind->words);
  return all;
}

}  // namespace rollres
