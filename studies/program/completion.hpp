#pragma once

/// What a shell reads to complete the words of the command line: commands, options, the values of options, keys of
/// scenes and solutions, studies of a database, file names. All is taken from what the commands declare.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "studies/program/command_line.hpp"

namespace rollres {

/// What may stand at a place of the command line.
enum class WordKind {
  anything,    ///< nothing can be offered
  choice,      ///< one of OptionWords::choices
  key,         ///< keys of scenes and solutions, with commas between
  assignment,  ///< KEY=VALUE, an input of a scene
  filter,      ///< KEY=VALUE, an input or an output
  stored,      ///< name of a study in the database that --db names
  folder,
  file,
};

/// Told by the choices, else by the word for the value; `anything` for a flag.
WordKind word_kind(const OptionWords& option);

/// Keys of all inputs of a scene, with blanks between.
std::string words_of_inputs();
/// Keys of all inputs and outputs, likewise.
std::string words_of_all_keys();
/// The command that lists what `stored` stands for, one to a line below a heading; the database is yet to follow.
inline constexpr std::string_view list_stored = "query --format csv --sql 'SELECT name FROM study' --db";

/// Words with blanks between.
std::string one_line_of(const std::vector<std::string>& words);

/// The text with each @NAME@ replaced by what `parts` has for NAME.
std::string filled(std::string text, const std::vector<std::pair<std::string, std::string>>& parts);

/// An input that takes one of some names.
struct NamedInput {
  std::string key;
  std::vector<std::string> names;
};
std::vector<NamedInput> named_inputs();

/// The script of a shell that completes `program`.
std::string bash_completion(const CommandWords& program);
std::string zsh_completion(const CommandWords& program);
std::string fish_completion(const CommandWords& program);

}  // namespace rollres
