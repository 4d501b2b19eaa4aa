#include "studies/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>
#include <stdexcept>

namespace rollres {

CommandOption* CommandOption::required() { return option_->required(), this; }
CommandOption* CommandOption::between(int lowest, int highest) {
  return option_->check(CLI::Range(lowest, highest)), this;
}
CommandOption* CommandOption::positive() { return option_->check(CLI::PositiveNumber), this; }
CommandOption* CommandOption::not_negative() { return option_->check(CLI::NonNegativeNumber), this; }
CommandOption* CommandOption::one_of(std::span<const std::string_view> names) {
  return option_->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end()))), this;
}
CommandOption* CommandOption::one_of(std::initializer_list<std::string_view> names) {
  return one_of(std::span<const std::string_view>(names.begin(), names.size()));
}
CommandOption* CommandOption::option_text(const std::string& word) { return option_->option_text(word), this; }
CommandOption* CommandOption::delimiter(char letter) { return option_->delimiter(letter), this; }
CommandOption* CommandOption::one_value_each() { return option_->allow_extra_args(false), this; }
CommandOption* CommandOption::expected(int fewest, int most) { return option_->expected(fewest, most), this; }
CommandOption* CommandOption::excludes(const CommandOption* other) { return option_->excludes(other->option_), this; }
CommandOption* CommandOption::needs(const CommandOption* other) { return option_->needs(other->option_), this; }
bool CommandOption::given() const { return option_->count() > 0; }

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
  options_.push_back(std::make_unique<CommandOption>(*app_->add_option(name, value, meaning)));
  return options_.back().get();
}

template CommandOption* Command::add_option(const std::string&, std::string&, const std::string&);
template CommandOption* Command::add_option(const std::string&, std::vector<std::string>&, const std::string&);
template CommandOption* Command::add_option(const std::string&, std::vector<double>&, const std::string&);
template CommandOption* Command::add_option(const std::string&, std::filesystem::path&, const std::string&);
template CommandOption* Command::add_option(const std::string&, int&, const std::string&);
template CommandOption* Command::add_option(const std::string&, std::uint64_t&, const std::string&);
template CommandOption* Command::add_option(const std::string&, double&, const std::string&);
template CommandOption* Command::add_option(const std::string&, std::optional<int>&, const std::string&);
template CommandOption* Command::add_option(const std::string&, std::optional<std::int64_t>&, const std::string&);
template CommandOption* Command::add_option(const std::string&, std::optional<std::uint64_t>&, const std::string&);
template CommandOption* Command::add_option(const std::string&, std::optional<double>&, const std::string&);

CommandOption* Command::add_flag(const std::string& name, bool& value, const std::string& meaning) {
  options_.push_back(std::make_unique<CommandOption>(*app_->add_flag(name, value, meaning)));
  return options_.back().get();
}

void Command::footer(const std::string& text) { app_->footer(text); }
void Command::callback(std::function<void()> act) { app_->callback(std::move(act)); }
std::string Command::name() const { return app_->get_name(); }

void Command::parse(std::vector<std::string> words, std::ostream& out, std::ostream& err) {
  try {
    std::reverse(words.begin(), words.end());  // as CLI11 wants them
    app_->parse(words);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw std::invalid_argument(error.what());
    app_->exit(error, out, err);  // help or version
  }
}

}  // namespace rollres
