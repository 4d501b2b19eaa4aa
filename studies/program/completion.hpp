#pragma once

/// Completion of a command line by bash, zsh and fish: commands, options and their values, keys of scenes and
/// solutions, studies and fits of a database, files of the kind
/// that is asked for. The program itself tells what may follow, of what its commands declare
/// (`rollres complete WORD...`, which no help text names); a shell reads a script of a few lines that asks it.

#include <string>
#include <vector>

#include "studies/program/command_line.hpp"

namespace rollres {

/// What may stand in place of the last of these words, which may be empty; the program's own name is left out. The
/// first line is the kind: `words`; `open`, words that go on without a blank; `files` or `folders`, which the shell
/// knows itself. Each further line is a word that begins as the last one does, for some with a tabulator and its
/// meaning.
std::string completions(const CommandWords& program, const std::vector<std::string>& words);

/// The script of a shell: "bash", "zsh" or "fish".
std::string completion_script(const std::string& shell);

}  // namespace rollres
