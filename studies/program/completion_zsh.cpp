#include "studies/program/completion.hpp"
#include "studies/text/shell_word.hpp"

namespace rollres {

namespace {

constexpr const char* zsh_script = R"sh(#compdef rollres
# Completion of rollres for zsh, written by `rollres completion zsh`.

# Values of an input that takes one of some names.
_rollres_names() {
  case $1 in
@NAMES@  esac
}

# Several of these words, with commas between.
_rollres_list() {
  compset -P '*,'
  compadd -qS , -- $@
}

# KEY=VALUE with one of these keys.
_rollres_pairs() {
  if compset -P '*='; then
    _rollres_names ${${IPREFIX%=}##*=}
  else
    compadd -S = -- $@
  fi
}

# Studies of the database on the command line.
_rollres_studies() {
  local file=${(Q)opt_args[--db]}
  [[ -n $file ]] || return 1
  local -a names=(${(f)"$(rollres @STUDIES@ ${file/#\~/$HOME} 2>/dev/null)"})
  compadd -- ${names[2,-1]}
}

_rollres() {
  local -a _rollres_inputs=(@INPUTS@)
  local -a _rollres_keys=(@KEYS@)
  local context state state_descr line
  typeset -A opt_args
  local -a commands=(
@COMMANDS@  )
  _arguments -C@PROGRAM@ \
    '1:command:->command' \
    '*::word:->word' && return
  if [[ $state == command ]]; then
    _describe command commands
    return
  fi
  case $words[1] in
@ARGUMENTS@  esac
}

_rollres "$@"
)sh";

/// A text inside a specification of _arguments or _describe, where colons part and brackets end.
std::string inside(std::string_view text) {
  std::string out;
  for (const char letter : text) {
    if (letter == ':' || letter == '[' || letter == ']' || letter == '\\') out += '\\';
    out += letter;
  }
  return out;
}

std::string zsh_action(const OptionWords& option) {
  switch (word_kind(option)) {
    case WordKind::choice:
      return "(" + one_line_of(option.choices) + ")";
    case WordKind::key:
      return "_rollres_list $_rollres_keys";
    case WordKind::assignment:
      return "_rollres_pairs $_rollres_inputs";
    case WordKind::filter:
      return "_rollres_pairs $_rollres_keys";
    case WordKind::stored:
      return "_rollres_studies";
    case WordKind::folder:
      return "_files -/";
    case WordKind::file:
      return "_files";
    case WordKind::anything:
      break;
  }
  return " ";
}

/// Arguments of _arguments, each on a line of its own.
std::string specifications(const CommandWords& command, const std::string& indent) {
  std::string text;
  int position = 0;
  const auto add = [&](const std::string& words) { text += " \\\n" + indent + shell_word(words); };
  for (const OptionWords& option : command.options) {
    const std::string value = option.value.empty() ? "" : ":" + inside(option.value) + ":" + zsh_action(option);
    if (option.positional) {
      add((option.many ? "*" : std::to_string(++position)) + (option.required || option.many ? "" : ":") + value);
      continue;
    }
    const std::string others = option.names.size() > 1 ? "(" + one_line_of(option.names) + ")" : "";
    for (const std::string& name : option.names)
      add((option.many ? "*" : others) + name + (value.empty() ? "" : "=") + "[" + inside(option.meaning) + "]" +
          value);
  }
  return text;
}

}  // namespace

std::string zsh_completion(const CommandWords& program) {
  std::string names, commands, arguments;
  for (const NamedInput& input : named_inputs())
    names += "    " + input.key + ") compadd -- " + one_line_of(input.names) + " ;;\n";
  for (const CommandWords& command : program.commands) {
    commands += "    " + shell_word(inside(command.name) + ":" + inside(command.meaning)) + "\n";
    arguments += "    " + command.name + ")\n      _arguments" + specifications(command, "        ") + "\n      ;;\n";
  }
  return filled(zsh_script, {{"NAMES", names},
                             {"STUDIES", std::string(list_stored)},
                             {"INPUTS", words_of_inputs()},
                             {"KEYS", words_of_all_keys()},
                             {"COMMANDS", commands},
                             {"PROGRAM", specifications(program, "    ")},
                             {"ARGUMENTS", arguments}});
}

}  // namespace rollres
