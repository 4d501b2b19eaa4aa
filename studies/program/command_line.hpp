#pragma once

/// The words of a command line: what the files command_NAME.cpp declare. CLI11 parses them; it stays behind this
/// header, because each source that includes it takes seconds to compile.

#include <functional>
#include <initializer_list>
#include <iosfwd>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace rollres {

struct Session;

/// The database of a command that needs one and is given none: of this environment variable, or else this file of the
/// current folder.
constexpr const char *database_variable = "ROLLRES_DB", *usual_database_file = "rollres.db";
std::string usual_database();

/// An option or a positional word, as a manual page or a shell's completion tells it.
struct OptionWords {
  std::vector<std::string> names;  ///< {"-h", "--help"}, {"--set"}; a positional word's own: {"scene"}
  std::string value;               ///< the word for its value, "KEY=VALUE"; empty for a flag
  std::string meaning;
  std::vector<std::string> choices;  ///< the values that it takes; empty: any
  bool positional = false, required = false;
  bool many = false;  ///< takes several values
};

/// The program or one of its commands, likewise.
struct CommandWords {
  std::string name, meaning;
  std::string footer;  ///< what the help text ends with
  std::vector<OptionWords> options;
  std::vector<CommandWords> commands;
};

/// An option or a positional word of a command. Its functions return the option, so that they can be chained.
class CommandOption {
 public:
  /// @param value the word that the help text shows for the value; empty for a flag
  CommandOption(CLI::Option& option, std::string value);

  /// It must be given; a database may be by the environment, too.
  CommandOption* required();
  /// A database that is needed: ROLLRES_DB, or else rollres.db, where none is given.
  CommandOption* or_usual_database();
  /// What the value must be; the help text and the refusal name it. Both ends of `between` are included.
  CommandOption* between(int lowest, int highest);
  CommandOption* positive();
  CommandOption* not_negative();
  CommandOption* one_of(std::span<const std::string_view> names);
  CommandOption* one_of(std::initializer_list<std::string_view> names);
  /// Takes a list apart at this letter.
  CommandOption* delimiter(char letter);
  /// Takes one value each time it is given, no more.
  CommandOption* one_value_each();
  CommandOption* excludes(const CommandOption* other);
  CommandOption* needs(const CommandOption* other);

  OptionWords words() const;

 private:
  CLI::Option* option_;
  std::string value_;
  std::vector<std::string> choices_;
};

/// The program, or one of its commands.
class Command {
 public:
  /// The program itself; `version` is what --version prints.
  Command(const std::string& name, const std::string& meaning, const std::string& version);
  ~Command();

  Command* add_subcommand(const std::string& name, const std::string& meaning);

  /// A command whose words are read into `Arguments`, the second of the pair; then `act(arguments, session)` is called.
  template <class Arguments, class Act>
  std::pair<Command*, Arguments&> add(const std::string& name, const std::string& meaning, Session& session, Act act) {
    const auto arguments = std::make_shared<Arguments>();
    Command* const command = add_subcommand(name, meaning);
    command->callback([arguments, act, &session] { act(*arguments, session); });
    return {command, *arguments};
  }

  /// @param name "--name VALUE", or "name VALUE" for a positional word. VALUE is the word that the help text shows for
  ///             the value; completion goes by it: for DIR it offers folders, for KEY the keys of scenes and solutions
  ///             (completion.cpp has the list)
  /// @param value takes what is given, as its type demands; must outlive the parsing. command_line.cpp lists the types.
  template <class T>
  CommandOption* add_option(const std::string& name, T& value, const std::string& meaning);
  CommandOption* add_flag(const std::string& name, bool& value, const std::string& meaning);

  /// Heading of the help text under which the program lists this command.
  void group(const std::string& heading);
  /// What the help text ends with.
  void footer(const std::string& text);
  /// What the command does once its words are read.
  void callback(std::function<void()> act);

  std::string name() const;
  /// All that was declared up to now.
  CommandWords words() const;
  const std::vector<std::unique_ptr<Command>>& subcommands() const { return subcommands_; }

  /// Reads the words and calls the command's callback; prints the help text or the version if they ask for it.
  /// @throws std::invalid_argument for words that do not fit
  void parse(std::vector<std::string> words, std::ostream& out, std::ostream& err);

 private:
  explicit Command(CLI::App& app);
  void refuse_unknown_options(std::span<const std::string> words) const;

  std::unique_ptr<CLI::App> program_;  // of the program itself, which holds those of its commands
  CLI::App* app_;
  std::vector<std::unique_ptr<Command>> subcommands_;
  std::vector<std::unique_ptr<CommandOption>> options_;
};

}  // namespace rollres
