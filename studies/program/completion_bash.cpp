#include <map>

#include "studies/program/completion.hpp"
#include "studies/text/shell_word.hpp"

namespace rollres {

namespace {

constexpr const char* bash_script = R"sh(# Completion of rollres for bash, written by `rollres completion bash`.

_rollres_inputs=@INPUTS@
_rollres_keys=@KEYS@

# Values of an input that takes one of some names.
_rollres_names() {
  case $1 in
@NAMES@  esac
}

_rollres_words() { COMPREPLY=($(compgen -W "$1" -- "$word")); }
_rollres_nothing() { compopt +o default +o bashdefault; }
_rollres_folders() { compopt -o dirnames +o default +o bashdefault; }

# Several of these words, with commas between.
_rollres_list() {
  local before=
  [[ $word != *,* ]] || before=${word%,*},
  COMPREPLY=($(compgen -P "$before" -W "$1" -- "${word#"$before"}"))
  compopt -o nospace
}

# KEY=VALUE with one of these keys.
_rollres_pairs() {
  if [[ -n $key ]]; then
    _rollres_nothing
    _rollres_words "$(_rollres_names "$key")"
  else
    COMPREPLY=($(compgen -S = -W "$1" -- "$word"))
    compopt -o nospace
  fi
}

# Studies of the database on the command line.
_rollres_studies() {
  local i file= name
  _rollres_nothing
  for ((i = 1; i < ${#COMP_WORDS[@]}; i++)); do
    [[ ${COMP_WORDS[i]} == --db ]] || continue
    file=${COMP_WORDS[i + 1]}
    [[ $file != = ]] || file=${COMP_WORDS[i + 2]}
  done
  [[ -n $file ]] || return
  while IFS= read -r name; do
    [[ $name == "$word"* ]] && COMPREPLY+=("$(printf %q "$name")")
  done < <("${COMP_WORDS[0]}" @STUDIES@ "${file/#\~/$HOME}" 2>/dev/null | tail -n +2)
}

_rollres() {
  local word=${COMP_WORDS[COMP_CWORD]} at=$COMP_CWORD command= option= key= i
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; i++)); do
    [[ ${COMP_WORDS[i]} == -* ]] || { command=${COMP_WORDS[i]}; break; }
  done
  # Bash takes KEY=VALUE and --option=value apart at the sign.
  if [[ $word == = ]]; then
    word= at=$((at - 1)) key=${COMP_WORDS[at]}
  elif [[ ${COMP_WORDS[at - 1]} == = ]]; then
    at=$((at - 2)) key=${COMP_WORDS[at]}
  fi
  if [[ $key == -* ]]; then
    option=$key key=
  else
    option=${COMP_WORDS[at - 1]}
    [[ $option != = ]] || option=${COMP_WORDS[at - 2]}
  fi

  case "$command $option" in
@VALUES@    *)
      if [[ $word == -* ]]; then
        case $command in
@OPTIONS@        esac
      else
        case $command in
@WORDS@        esac
      fi ;;
  esac
}

complete -o bashdefault -o default -F _rollres rollres
)sh";

std::string bash_action(const OptionWords& option) {
  switch (word_kind(option)) {
    case WordKind::choice:
      return "_rollres_words " + shell_word(one_line_of(option.choices));
    case WordKind::key:
      return "_rollres_list \"$_rollres_keys\"";
    case WordKind::assignment:
      return "_rollres_pairs \"$_rollres_inputs\"";
    case WordKind::filter:
      return "_rollres_pairs \"$_rollres_keys\"";
    case WordKind::stored:
      return "_rollres_studies";
    case WordKind::folder:
      return "_rollres_folders";
    case WordKind::file:
      return ":";  // readline offers files by itself
    case WordKind::anything:
      break;
  }
  return "_rollres_nothing";
}

using Branches = std::map<std::string, std::vector<std::string>>;  // patterns by action

std::string text_of(const Branches& branches, const std::string& indent) {
  std::string text;
  for (const auto& [act, patterns] : branches) {
    text += indent;
    for (const std::string& pattern : patterns) text += (&pattern == &patterns.front() ? "" : " | ") + pattern;
    text += ") " + act + " ;;\n";
  }
  return text;
}

}  // namespace

std::string bash_completion(const CommandWords& program) {
  Branches values, options, words;
  std::vector<std::string> names_of_program, commands;
  for (const OptionWords& option : program.options)
    names_of_program.insert(names_of_program.end(), option.names.begin(), option.names.end());
  for (const CommandWords& command : program.commands) {
    commands.push_back(command.name);
    std::vector<std::string> names;
    std::string of_words = "_rollres_nothing";
    for (const OptionWords& option : command.options) {
      if (option.positional) {
        of_words = bash_action(option);
        continue;
      }
      names.insert(names.end(), option.names.begin(), option.names.end());
      if (option.value.empty()) continue;
      for (const std::string& name : option.names)
        values[bash_action(option)].push_back(shell_word(command.name + " " + name));
    }
    options["_rollres_words " + shell_word(one_line_of(names))].push_back(command.name);
    words[of_words].push_back(command.name);
  }
  options["_rollres_words " + shell_word(one_line_of(names_of_program))].push_back("''");
  words["_rollres_words " + shell_word(one_line_of(commands))].push_back("''");

  std::string names;
  for (const NamedInput& input : named_inputs())
    names += "    " + input.key + ") echo " + shell_word(one_line_of(input.names)) + " ;;\n";
  return filled(bash_script, {{"INPUTS", shell_word(words_of_inputs())},
                              {"KEYS", shell_word(words_of_all_keys())},
                              {"NAMES", names},
                              {"STUDIES", std::string(list_stored)},
                              {"VALUES", text_of(values, "    ")},
                              {"OPTIONS", text_of(options, "          ")},
                              {"WORDS", text_of(words, "          ")}});
}

}  // namespace rollres
