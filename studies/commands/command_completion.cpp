#include <ostream>

#include "db/file/provenance.hpp"
#include "studies/program/commands.hpp"
#include "studies/program/completion.hpp"
#include "studies/program/manual_page.hpp"

namespace rollres {

void add_completion(Command& program, Session& session) {
  const auto [command, shell] = program.add<std::string>(
      "completion", "Print what a shell reads to complete commands, options, keys and files", session,
      [](const std::string& name, Session& to) { to.out << completion_script(name); });
  command->add_option("shell SHELL", shell, "bash, zsh or fish")->required()->one_of({"bash", "zsh", "fish"});
  command->footer(
      "An installed rollres needs none of these commands: its shells find what was installed with it.\n"
      "Examples: rollres completion bash > ~/.local/share/bash-completion/completions/rollres\n"
      "          rollres completion zsh > ~/.zfunc/_rollres\n"
      "          rollres completion fish > ~/.config/fish/completions/rollres.fish");
}

void add_manual(Command& program, Session& session) {
  Command* const command = program.add_subcommand("manual", "Print the manual page, as man reads it");
  command->footer("Example: rollres manual | man -l -");
  command->callback(
      [&program, &session] { session.out << manual_page(program.words(), "rollres " + this_program().version); });
}

}  // namespace rollres
