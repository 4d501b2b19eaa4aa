#include "studies/program/completion.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <span>
#include <string_view>

#include "core/scene/solution.hpp"
#include "db/rows/fit_store.hpp"
#include "db/rows/result_store.hpp"
#include "studies/scene_io/scene_inputs.hpp"

namespace rollres {

namespace {

/// The scripts of this folder by their endings: ".bash".
const std::map<std::string_view, std::string_view> scripts{
#include "completion_scripts.inc"
};

bool has(std::span<const std::string_view> names, std::string_view name) { return contains(names, name); }

struct Completion {
  std::string kind = "words";
  std::vector<std::string> words = {}, meanings = {};

  void add(std::string word, std::string meaning = "") {
    words.push_back(std::move(word));
    meanings.push_back(std::move(meaning));
  }
};

std::vector<std::string> keys_of_inputs() {
  std::vector<std::string> keys;
  for (const InputKind& kind : written_kinds()) keys.emplace_back(kind.quantity.key);
  return keys;
}

std::vector<std::string> all_keys() {
  std::vector<std::string> keys = keys_of_inputs();
  const RollingSolution solution;
  visit_outputs(solution, [&](const Quantity& quantity, const auto&) {
    if (!contains(keys, quantity.key)) keys.emplace_back(quantity.key);
  });
  return keys;
}

/// "~/results" as the shell hands it over.
std::string in_home(std::string path) {
  if (const char* const home = std::getenv("HOME"); home && path.starts_with("~/")) path.replace(0, 1, home);
  return path;
}

/// Several of these, with commas between.
Completion list_of(const std::vector<std::string>& keys, const std::string& begun) {
  Completion completion{.kind = "open"};
  const std::string before = begun.substr(0, begun.rfind(',') + 1);
  for (const std::string& key : keys) completion.add(before + key);
  return completion;
}

/// KEY=VALUE with one of these; values are known of inputs that take one of some names.
Completion assignments(const std::vector<std::string>& keys, const std::string& begun) {
  Completion completion;
  if (const std::size_t sign = begun.find('='); sign != std::string::npos) {
    if (const InputKind* const input = find_input(begun.substr(0, sign)))
      for (const std::string_view name : input->choices) completion.add(begun.substr(0, sign + 1) + std::string(name));
    return completion;
  }
  completion.kind = "open";
  for (const std::string& key : keys) completion.add(key + "=");
  return completion;
}

/// Folders, and those files that are wanted, whose paths begin like this. While a folder is among them the word goes
/// on.
Completion paths(const std::string& begun, bool (*wanted)(const std::filesystem::path& file)) {
  Completion completion;
  const std::string before = begun.substr(0, begun.rfind('/') + 1), start = begun.substr(before.size());
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(before.empty() ? "." : in_home(before), none)) {
    const std::string name = entry.path().filename().string();
    const bool hidden = name.starts_with('.') && !start.starts_with('.'), folder = entry.is_directory(none);
    if (hidden || !name.starts_with(start) || !(folder || wanted(entry.path()))) continue;
    completion.add(before + name + (folder ? "/" : ""));
    if (folder) completion.kind = "open";
  }
  std::sort(completion.words.begin(), completion.words.end());
  return completion;
}

bool is_database(const std::filesystem::path& file) {
  constexpr std::string_view begin = "SQLite format 3";
  std::string text(begin.size(), ' ');
  std::ifstream(file, std::ios::binary).read(text.data(), static_cast<std::streamsize>(text.size()));
  return text == begin;
}

bool is_json(const std::filesystem::path& file) { return file.extension() == ".json"; }

/// Studies of the database that --db names among these words, or else the environment; its fits, too, where a command
/// takes them.
Completion stored_names(std::span<const std::string> words, bool with_fits) {
  Completion completion;
  std::string file;
  for (std::size_t i = 0; i < words.size(); ++i)
    if (words[i].starts_with("--db="))
      file = words[i].substr(5);
    else if (words[i] == "--db" && i + 1 < words.size())
      file = words[i + 1];
  if (file.empty()) file = usual_database();
  if (!std::filesystem::exists(in_home(file))) return completion;
  ResultStore store(in_home(file), Access::read);
  for (const std::string& study : store.study_names()) completion.add(study);
  if (with_fits)
    for (const auto& fit : stored_fits(store.database())) completion.add(fit.name);
  return completion;
}

/// What may be the value of an option or a positional word: told by its choices, else by the word for its value; of all
/// other words nothing is known.
Completion values(const CommandWords& command, const OptionWords& option, std::span<const std::string> words,
                  const std::string& begun) {
  static const std::map<std::string, std::string, std::less<>> kinds{
      {"KEY", "key"},       {"KEY,...", "key"},
      {"FILTER", "filter"}, {"KEY=VALUE", "assignment"},
      {"NAME", "stored"},   {"KEY=FROM:TO[:logarithmic]", "assignment"},
      {"FILE", "files"},    {"NAME|ID", "stored"},
      {"PATH", "files"},    {"SCENE", "json"},
      {"STUDY", "json"},    {"SCENE|STUDY", "json"},
      {"FIT", "json"},      {"DIR", "folders"},
      {"SCENES", "files"}};
  static constexpr std::array<std::string_view, 3> of_databases{"--db", "--with", "sources"};
  static constexpr std::array<std::string_view, 5> with_fits{"report", "show", "export", "chart", "compare"};
  Completion completion;
  for (const std::string& choice : option.choices) completion.add(choice);
  const auto kind = kinds.find(option.value);
  if (!option.choices.empty() || kind == kinds.end()) return completion;
  if (kind->second == "key") return list_of(all_keys(), begun);
  if (kind->second == "filter") return assignments(all_keys(), begun);
  if (kind->second == "assignment") return assignments(keys_of_inputs(), begun);
  if (kind->second == "stored") return stored_names(words, has(with_fits, command.name));
  if (kind->second == "json") {
    completion = paths(begun, is_json);
    return completion.words.empty() ? Completion{.kind = "files"} : completion;
  }
  if (has(of_databases, option.names.front())) return paths(begun, is_database);
  return {.kind = kind->second};
}

Completion names_of(const CommandWords& command) {
  Completion completion;
  for (const OptionWords& option : command.options)
    if (!option.positional)
      for (const std::string& name : option.names) completion.add(name, option.meaning);
  return completion;
}

const OptionWords* find_option(const CommandWords& command, const std::string& name) {
  for (const OptionWords& option : command.options)
    if (!option.positional && contains(option.names, name)) return &option;
  return nullptr;
}

Completion words_of(const CommandWords& command, std::span<const std::string> words) {
  const std::string& begun = words.back();
  if (const std::size_t sign = begun.find('='); begun.starts_with("--") && sign != std::string::npos) {
    const OptionWords* const option = find_option(command, begun.substr(0, sign));
    if (option == nullptr) return {};
    Completion completion = values(command, *option, words, begun.substr(sign + 1));
    for (std::string& word : completion.words) word.insert(0, begun, 0, sign + 1);
    return completion;
  }
  const OptionWords* const option = words.size() > 1 ? find_option(command, words[words.size() - 2]) : nullptr;
  if (option != nullptr && !option->value.empty()) return values(command, *option, words, begun);
  if (begun.starts_with('-')) return names_of(command);
  for (const OptionWords& positional : command.options)
    if (positional.positional) return values(command, positional, words, begun);
  return {};
}

Completion words_of_program(const CommandWords& program, const std::string& begun) {
  if (begun.starts_with('-')) return names_of(program);
  Completion completion;
  for (const CommandWords& command : program.commands) completion.add(command.name, command.meaning);
  return completion;
}

}  // namespace

std::string completions(const CommandWords& program, const std::vector<std::string>& words) {
  if (words.empty()) return "words\n";
  const auto named =
      std::find_if(words.begin(), words.end() - 1, [](const auto& word) { return !word.starts_with('-'); });
  const auto command = find_if(program.commands, [&](const CommandWords& one) { return one.name == *named; });
  Completion completion;
  if (named == words.end() - 1)
    completion = words_of_program(program, words.back());
  else if (command != program.commands.end())
    completion = words_of(*command, std::span(words).subspan(static_cast<std::size_t>(named - words.begin()) + 1));
  std::string text = completion.kind + "\n";
  for (std::size_t i = 0; i < completion.words.size(); ++i)
    if (completion.words[i].starts_with(words.back()))
      text += completion.words[i] + (completion.meanings[i].empty() ? "" : "\t" + completion.meanings[i]) + "\n";
  return text;
}

std::string completion_script(const std::string& shell) { return std::string(scripts.at("." + shell)); }

}  // namespace rollres
