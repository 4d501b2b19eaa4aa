#include "studies/program/commands.hpp"

#include <algorithm>
#include <exception>
#include <ostream>
#include <stdexcept>

#include "studies/program/completion.hpp"
#include "studies/text/printable.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/words.hpp"

#ifndef ROLLRES_VERSION
#define ROLLRES_VERSION "1.0.0"
#endif

namespace rollres {

namespace {

/// Commands under one heading of the help text.
struct CommandGroup {
  const char* heading;
  std::vector<AddCommand*> commands;
};

/// Every command, in the order of the help text.
const std::vector<CommandGroup>& command_groups() {
  static const std::vector<CommandGroup> groups{
      {"One scene",
       {add_new, add_solve, add_explore, add_draw, add_figures, add_material, add_gradient, add_sensitivity}},
      {"Studies, designs and fits", {add_plan, add_sweep, add_scatter, add_optimise, add_fit}},
      {"What is stored",
       {add_status, add_list, add_show, add_query, add_compare, add_chart, add_characteristic, add_report, add_film}},
      {"Databases and clusters", {add_merge, add_upkeep, add_export, add_import, add_slurm}},
      {"How well it computes", {add_verify, add_accuracy, add_stability}},
      {"For programs and editors", {add_serve, add_schema, add_quantities, add_manual, add_completion}},
  };
  return groups;
}

/// The program, and the libraries that a copy of it hands on (studies/libraries.cmake), as JSON.
std::string version_and_libraries() {
  struct Library {
    const char *name, *version, *licence;
  };
  constexpr Library known[] = {
#include "libraries.inc"
  };
  Json libraries = Json::array();
  for (const Library& library : known)
    libraries.push_back({{"name", library.name}, {"version", library.version}, {"licence", library.licence}});
  const Json all = json_object("program", "rollres", "version", ROLLRES_VERSION, "licence_of_sources", "MIT",
                               "licence_of_binary", "GPL-3.0-or-later", "libraries", libraries);
  return all.dump(2);
}

constexpr const char* unwritable = "standard output: cannot be written";

/// A message as one line, without what a library puts before its own.
int complain(Session& session, std::string message, int status) {
  constexpr std::size_t longest = 4000;
  if (message.size() > longest) message = message.substr(0, longest) + "...";
  for (std::size_t tag; (tag = message.find("[json.exception")) != std::string::npos;)
    message.erase(tag, std::min(message.find("] ", tag), message.size() - 2) + 2 - tag);
  std::replace_if(
      message.begin(), message.end(), [](char letter) { return letter == '\n' || letter == '\r' || letter == '\t'; },
      ' ');
  session.err << "rollres: " << message << std::endl;
  return status;
}

void refuse_unknown_command(const Command& program, const std::vector<std::string>& words) {
  if (words.empty() || words.front().empty() || words.front().front() == '-') return;
  std::vector<std::string> names;
  for (const auto& command : program.subcommands()) names.push_back(command->name());
  if (contains(names, words.front())) return;
  throw std::invalid_argument(unknown(words.front() + ": unknown command", names, words.front(), "see rollres --help"));
}

}  // namespace

int run_program(std::vector<std::string> words, Session session) {
  const PrintableStream printable_out(session.out, false), printable_err(session.err, true);
  constexpr const char* version = "rollres " ROLLRES_VERSION;
  try {
    if (words.empty()) words = {"--help"};
    if (words.front() == "version") words.front() = "--version";
    const bool as_json = words == std::vector<std::string>{"--version", "--json"};
    if (as_json || words == std::vector<std::string>{"--version"}) {  // without declaring all commands first
      session.out << (as_json ? version_and_libraries() : version) << std::endl;
      return session.out ? ExitStatus::answered : complain(session, unwritable, ExitStatus::failure);
    }
    Command program("rollres", "Rolling resistance of a rigid cylinder or sphere over a viscoelastic layer.", version);
    program.footer(
        "Example: rollres solve studies/examples/paper_cylinder.json\n"
        "Exit status: 0 answered; 1 no answer or not converged; 2 wrong input; 3 file or database failed.");
    for (const CommandGroup& group : command_groups())
      for (AddCommand* const add : group.commands) {
        const std::size_t before = program.subcommands().size();
        add(program, session);
        for (std::size_t i = before; i < program.subcommands().size(); ++i)
          program.subcommands()[i]->group(group.heading);
      }
    if (words.front() == "complete") {
      words.erase(words.begin());
      session.out << completions(program.words(), words);
      return ExitStatus::answered;
    }
    if (words.front() == "help") {
      words.erase(words.begin());
      words.emplace_back("--help");
    }
    refuse_unknown_command(program, words);
    program.parse(std::move(words), session.out, session.err);
    session.out.flush();
    if (!session.out) return complain(session, unwritable, ExitStatus::failure);
    return session.status;
  } catch (const std::invalid_argument& error) {
    return complain(session, error.what(), ExitStatus::wrong_input);
  } catch (const std::bad_alloc&) {
    return complain(session, "out of memory", ExitStatus::failure);
  } catch (const std::exception& error) {
    std::string message = error.what();
    if (message == std::string(usual_database_file) + ": no such file")
      message += std::string("; --db FILE, or ") + database_variable + "=FILE in the environment, names the database";
    return complain(session, message, ExitStatus::failure);
  } catch (...) {
    return complain(session, "an unknown error", ExitStatus::failure);
  }
}

}  // namespace rollres
