#include "studies/program/completion.hpp"

#include <algorithm>
#include <array>

#include "core/scene/solution.hpp"
#include "studies/scene_io/scene_inputs.hpp"

namespace rollres {

namespace {

/// Words for a value of which something is known; all others are numbers and the like.
constexpr std::array<std::pair<std::string_view, WordKind>, 14> known_words{{
    {"KEY", WordKind::key},
    {"KEY,...", WordKind::key},
    {"KEY=VALUE", WordKind::assignment},
    {"KEY=FROM:TO[:logarithmic]", WordKind::assignment},
    {"FILTER", WordKind::filter},
    {"NAME", WordKind::stored},
    {"NAME|ID", WordKind::stored},
    {"DIR", WordKind::folder},
    {"FILE", WordKind::file},
    {"PATH", WordKind::file},
    {"SCENE", WordKind::file},
    {"STUDY", WordKind::file},
    {"SCENE|STUDY", WordKind::file},
    {"FIT", WordKind::file},
}};

}  // namespace

WordKind word_kind(const OptionWords& option) {
  if (!option.choices.empty()) return WordKind::choice;
  const auto known = std::find_if(known_words.begin(), known_words.end(),
                                  [&](const auto& entry) { return entry.first == option.value; });
  return known == known_words.end() ? WordKind::anything : known->second;
}

std::string one_line_of(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + word;
  return line;
}

std::string words_of_inputs() {
  const auto keys = input_keys();
  return one_line_of({keys.begin(), keys.end()});
}

std::string words_of_all_keys() {
  const auto inputs = input_keys();
  std::vector<std::string> keys(inputs.begin(), inputs.end());
  const RollingSolution solution;
  visit_outputs(solution, [&](const Quantity& quantity, const auto&) {
    if (std::find(keys.begin(), keys.end(), quantity.key) == keys.end()) keys.emplace_back(quantity.key);
  });
  return one_line_of(keys);
}

std::string filled(std::string text, const std::vector<std::pair<std::string, std::string>>& parts) {
  for (const auto& [name, part] : parts) {
    const std::string mark = "@" + name + "@";
    for (std::size_t place = text.find(mark); place != std::string::npos; place = text.find(mark, place + part.size()))
      text.replace(place, mark.size(), part);
  }
  return text;
}

std::vector<NamedInput> named_inputs() {
  std::vector<NamedInput> inputs;
  for (const InputKind& kind : input_kinds())
    if (!kind.choices.empty())
      inputs.push_back({std::string(kind.quantity.key), {kind.choices.begin(), kind.choices.end()}});
  return inputs;
}

}  // namespace rollres
