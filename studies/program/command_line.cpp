#include "studies/program/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <ostream>
#include <stdexcept>

#include "studies/text/words.hpp"

namespace rollres {

namespace {

OptionWords words_of(const CLI::Option& option) {
  OptionWords words;
  words.positional = option.get_positional();
  if (words.positional) words.names.push_back(option.get_name(true));
  for (const std::string& name : option.get_snames()) words.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) words.names.push_back("--" + name);
  words.meaning = option.get_description();
  words.required = option.get_required();
  words.many = option.get_items_expected_max() > 1;
  return words;
}

}  // namespace

std::string usual_database() {
  const char* const named = std::getenv(database_variable);
  return named != nullptr && *named != '\0' ? named : usual_database_file;
}

CommandOption::CommandOption(CLI::Option& option, std::string value) : option_(&option), value_(std::move(value)) {}

CommandOption* CommandOption::required() { return option_->required(), this; }
CommandOption* CommandOption::or_usual_database() {
  return option_->envname(database_variable)->default_val(usual_database_file), this;
}
CommandOption* CommandOption::between(int lowest, int highest) {
  const std::string ends = std::to_string(lowest) + ".." + std::to_string(highest);
  return option_->check(CLI::Range(lowest, highest).description(ends)), this;
}
CommandOption* CommandOption::positive() { return option_->check(CLI::PositiveNumber), this; }
CommandOption* CommandOption::not_negative() { return option_->check(CLI::NonNegativeNumber), this; }
CommandOption* CommandOption::one_of(std::span<const std::string_view> names) {
  choices_.assign(names.begin(), names.end());
  return option_->check(CLI::IsMember(choices_)), this;
}
CommandOption* CommandOption::one_of(std::initializer_list<std::string_view> names) {
  return one_of(std::span<const std::string_view>(names.begin(), names.size()));
}
CommandOption* CommandOption::delimiter(char letter) { return option_->delimiter(letter), this; }
CommandOption* CommandOption::one_value_each() { return option_->allow_extra_args(false), this; }
CommandOption* CommandOption::excludes(const CommandOption* other) { return option_->excludes(other->option_), this; }
CommandOption* CommandOption::needs(const CommandOption* other) { return option_->needs(other->option_), this; }

OptionWords CommandOption::words() const {
  OptionWords words = words_of(*option_);
  words.value = value_;
  words.choices = choices_;
  return words;
}

Command::Command(const std::string& name, const std::string& meaning, const std::string& version)
    : program_(std::make_unique<CLI::App>(meaning, name)), app_(program_.get()) {
  app_->set_version_flag("--version", version);
  app_->set_help_flag("-h,--help", "Print this help");
  app_->require_subcommand(1);
}

Command::Command(CLI::App& app) : app_(&app) {}

Command::~Command() = default;

Command* Command::add_subcommand(const std::string& name, const std::string& meaning) {
  subcommands_.push_back(std::unique_ptr<Command>(new Command(*app_->add_subcommand(name, meaning))));
  return subcommands_.back().get();
}

template <class T>
CommandOption* Command::add_option(const std::string& name, T& value, const std::string& meaning) {
  const std::size_t blank = name.find(' ');
  const std::string word = name.substr(blank + 1);
  CLI::Option* const option = app_->add_option(name.substr(0, blank), value, meaning)->type_name(word);
  options_.push_back(std::make_unique<CommandOption>(*option, word));
  return options_.back().get();
}

template CommandOption* Command::add_option(const std::string&, std::string&, const std::string&);
template CommandOption* Command::add_option(const std::string&, std::vector<std::string>&, const std::string&);
template CommandOption* Command::add_option(const std::string&, std::vector<double>&, const std::string&);
template CommandOption* Command::add_option(const std::string&, std::filesystem::path&, const std::string&);
template CommandOption* Command::add_option(const std::string&, int&, const std::string&);
template CommandOption* Command::add_option(const std::string&, std::uint64_t&, const std::string&);
template CommandOption* Command::add_option(const std::string&, double&, const std::string&);
template CommandOption* Command::add_option(const std::string&, std::optional<std::string>&, const std::string&);
template CommandOption* Command::add_option(const std::string&, std::optional<int>&, const std::string&);
template CommandOption* Command::add_option(const std::string&, std::optional<std::int64_t>&, const std::string&);
template CommandOption* Command::add_option(const std::string&, std::optional<std::uint64_t>&, const std::string&);
template CommandOption* Command::add_option(const std::string&, std::optional<double>&, const std::string&);

CommandOption* Command::add_flag(const std::string& name, bool& value, const std::string& meaning) {
  options_.push_back(std::make_unique<CommandOption>(*app_->add_flag(name, value, meaning), ""));
  return options_.back().get();
}

void Command::group(const std::string& heading) { app_->group(heading); }

void Command::footer(const std::string& text) { app_->footer(text); }
void Command::callback(std::function<void()> act) { app_->callback(std::move(act)); }
std::string Command::name() const { return app_->get_name(); }

CommandWords Command::words() const {
  CommandWords words{app_->get_name(), app_->get_description(), app_->get_footer(), {}, {}};
  for (const auto& option : options_) words.options.push_back(option->words());
  for (const CLI::Option* const option : {app_->get_help_ptr(), app_->get_version_ptr()})
    if (option != nullptr) words.options.push_back(words_of(*option));
  for (const auto& command : subcommands_) words.commands.push_back(command->words());
  return words;
}

/// CLI11 would complain of a missing option first, where one was only misspelt.
void Command::refuse_unknown_options(std::span<const std::string> words) const {
  if (words.empty()) return;
  for (const auto& command : subcommands_)
    if (command->name() == words.front()) return command->refuse_unknown_options(words.subspan(1));
  std::vector<std::string> names;
  for (const OptionWords& option : this->words().options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  for (const std::string& word : words) {
    if (word == "--") return;
    const std::string name = word.substr(0, word.find('='));
    if (!name.starts_with("--") || contains(names, name)) continue;
    throw std::invalid_argument(
        unknown(name + ": unknown option of " + this->name(), names, name, "see rollres help " + this->name()));
  }
}

void Command::parse(std::vector<std::string> words, std::ostream& out, std::ostream& err) {
  refuse_unknown_options(words);
  try {
    std::reverse(words.begin(), words.end());  // as CLI11 wants them
    app_->parse(words);
  } catch (const CLI::ParseError& error) {
    const std::string message = error.what();
    if (error.get_exit_code() != 0) throw std::invalid_argument(message);
    app_->exit(error, out, err);  // help or version
  }
}

}  // namespace rollres
