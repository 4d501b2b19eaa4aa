#include "studies/program/completion.hpp"

namespace rollres {

namespace {

constexpr const char* fish_script = R"sh(# Completion of rollres for fish, written by `rollres completion fish`.

set -g __rollres_inputs @INPUTS@
set -g __rollres_keys @KEYS@

# Whether the line's command is this one; without an argument: whether it has none yet.
function __rollres_command_is
    for word in (commandline -opc)[2..]
        string match -q -- '-*' $word; and continue
        contains -- $word $argv
        return
    end
    test (count $argv) = 0
end

# Values of an input that takes one of some names.
function __rollres_names
    switch $argv[1]
@NAMES@    end
end

# Several of these words, with commas between.
function __rollres_list
    set -l before (string match -r '.*,' -- (commandline -ct))
    printf "$before%s\n" $argv
end

# KEY=VALUE with one of these keys.
function __rollres_pairs
    set -l key (string match -r '(?:^|=)([a-z_0-9]+)=[^=]*$' -- (commandline -ct))[2]
    if test -n "$key"
        printf "$key=%s\n" (__rollres_names $key)
    else
        printf '%s=\n' $argv
    end
end

# Studies of the database on the command line.
function __rollres_studies
    set -l words (commandline -opc)
    set -l place (contains -i -- --db $words); or return
    rollres @STUDIES@ (string replace -r '^~' $HOME -- $words[(math $place + 1)]) 2>/dev/null | tail -n +2
end

complete -c rollres -f
@COMPLETE@)sh";

/// A text in single quotes, as fish reads it.
std::string fish_word(std::string_view text) {
  std::string word = "'";
  for (const char letter : text) {
    if (letter == '\'' || letter == '\\') word += '\\';
    word += letter;
  }
  return word + "'";
}

/// Switches of `complete` for a value.
std::string fish_action(const OptionWords& option) {
  switch (word_kind(option)) {
    case WordKind::choice:
      return " -x -a " + fish_word(one_line_of(option.choices));
    case WordKind::key:
      return " -x -a '(__rollres_list $__rollres_keys)'";
    case WordKind::assignment:
      return " -x -a '(__rollres_pairs $__rollres_inputs)'";
    case WordKind::filter:
      return " -x -a '(__rollres_pairs $__rollres_keys)'";
    case WordKind::stored:
      return " -x -a '(__rollres_studies)'";
    case WordKind::folder:
      return " -x -a '(__fish_complete_directories (commandline -ct))'";
    case WordKind::file:
      return " -r -F";
    case WordKind::anything:
      break;
  }
  return " -x";
}

/// @param command empty: the program itself
std::string line(const std::string& command, const OptionWords& option) {
  std::string text = "complete -c rollres -n '__rollres_command_is" + (command.empty() ? "" : " " + command) + "'";
  if (option.positional) return text + (word_kind(option) == WordKind::file ? " -F" : fish_action(option)) + "\n";
  for (const std::string& name : option.names)
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  return text + (option.value.empty() ? "" : fish_action(option)) + " -d " + fish_word(option.meaning) + "\n";
}

}  // namespace

std::string fish_completion(const CommandWords& program) {
  std::string names, lines;
  for (const NamedInput& input : named_inputs())
    names += "        case " + input.key + "\n            printf '%s\\n' " + one_line_of(input.names) + "\n";
  for (const OptionWords& option : program.options) lines += line("", option);
  for (const CommandWords& command : program.commands)
    lines +=
        "complete -c rollres -n __rollres_command_is -a " + command.name + " -d " + fish_word(command.meaning) + "\n";
  for (const CommandWords& command : program.commands)
    for (const OptionWords& option : command.options) lines += line(command.name, option);
  return filled(fish_script, {{"INPUTS", words_of_inputs()},
                              {"KEYS", words_of_all_keys()},
                              {"NAMES", names},
                              {"STUDIES", std::string(list_stored)},
                              {"COMPLETE", lines}});
}

}  // namespace rollres
