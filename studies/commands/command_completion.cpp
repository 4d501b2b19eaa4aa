#include <ostream>
#include <span>

#include "db/file/provenance.hpp"
#include "studies/fit/fit_keys.hpp"
#include "studies/optimise/design_keys.hpp"
#include "studies/program/commands.hpp"
#include "studies/program/completion.hpp"
#include "studies/program/manual_page.hpp"

namespace rollres {

namespace {

ManualSection keys_in(const std::string& title,
                      std::initializer_list<std::pair<const char*, std::span<const FileKey>>> lists) {
  ManualSection section{title, {}};
  for (const auto& [place, keys] : lists)
    for (const FileKey& key : keys)
      if (key.key != "$schema")
        section.entries.push_back(
            {place + std::string(key.key), std::string(key.meaning) + (key.needed ? " (needed)" : "")});
  return section;
}

std::vector<ManualSection> keys_of_files() {
  return {keys_in("KEYS OF A STUDY FILE", {{"", study_keys},
                                           {"axes.KEY.", interval_keys},
                                           {"axes.NAME.", zip_keys},
                                           {"sample.", sample_keys},
                                           {"sample.ranges.KEY.", range_keys},
                                           {"chart.", chart_keys}}),
          keys_in("KEYS OF AN OPTIMISATION", {{"", design_keys},
                                              {"variables.KEY.", variable_keys},
                                              {"scenes[].", duty_keys},
                                              {"stop.", stop_keys},
                                              {"pareto.", pareto_keys}}),
          keys_in("KEYS OF A FIT OF SCENES",
                  {{"", fit_keys}, {"data.", data_set_keys}, {"parameters.KEY.", fit_parameter_keys}}),
          keys_in("KEYS OF A FIT OF A MATERIAL", {{"", material_fit_keys}}),
          keys_in("KEYS OF A FIT OF A STRAIN SWEEP", {{"", strain_fit_keys}})};
}

}  // namespace

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
  command->callback([&program, &session] {
    session.out << manual_page(program.words(), "rollres " + this_program().version, keys_of_files());
  });
}

}  // namespace rollres
