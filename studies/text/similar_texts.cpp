#include "studies/text/similar_texts.hpp"

#include <map>
#include <regex>

namespace rollres {

std::vector<std::string> with_ranges(const std::vector<std::string>& texts) {
  static const std::regex number(R"([0-9]+(\.[0-9]+)?(e[-+]?[0-9]+)?)");
  struct Range {
    std::string least, greatest;
  };
  std::map<std::string, std::vector<Range>> kinds;
  std::vector<std::string> patterns;
  for (const std::string& text : texts) {
    const std::string pattern = patterns.emplace_back(std::regex_replace(text, number, "\x01"));
    std::vector<Range>& ranges = kinds[pattern];
    std::size_t place = 0;
    for (std::sregex_iterator found(text.begin(), text.end(), number), end; found != end; ++found, ++place) {
      const std::string value = found->str();
      if (place == ranges.size()) ranges.push_back({value, value});
      if (std::stod(value) < std::stod(ranges[place].least)) ranges[place].least = value;
      if (std::stod(value) > std::stod(ranges[place].greatest)) ranges[place].greatest = value;
    }
  }
  for (std::string& pattern : patterns) {
    std::string text;
    std::size_t place = 0;
    for (const char letter : pattern) {
      if (letter != '\x01') {
        text += letter;
        continue;
      }
      const auto& [least, greatest] = kinds[pattern][place++];
      text += least == greatest ? least : least + " to " + greatest;
    }
    pattern = text;
  }
  return patterns;
}

}  // namespace rollres
