#include <map>
#include <ostream>
#include <stdexcept>
#include <string_view>

#include "studies/program/commands.hpp"
#include "studies/text/files.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// Files of studies/starts, KIND_NAME each, and the table of moduli of the belt, by their names.
const std::map<std::string_view, std::string_view> starting_files{
#include "starting_files.inc"
};
constexpr std::string_view moduli_of_belt = "fit_rubber.csv";

struct NewArguments {
  std::string kind, folder;
};

/// The names that files of a kind have in its folder, and their texts.
std::map<std::string, std::string_view> files_of(std::string_view kind) {
  std::map<std::string, std::string_view> files;
  for (const auto& [name, text] : starting_files)
    if (name.starts_with(kind) && name.substr(kind.size()).starts_with('_'))
      files.emplace(name.substr(kind.size() + 1), text);
  if (kind == "belt") files.emplace("cover.csv", starting_files.at(moduli_of_belt));
  return files;
}

void make_new(const NewArguments& arguments, Session& session) {
  const std::filesystem::path folder = arguments.folder.empty() ? arguments.kind : arguments.folder;
  const auto files = files_of(arguments.kind);
  for (const auto& [name, text] : files)
    if (std::filesystem::exists(folder / name))
      throw std::invalid_argument((folder / name).string() + ": is there already, and is kept; name another folder");
  make_directory(folder);
  for (const auto& [name, text] : files) {
    write_file(folder / name, text);
    session.out << "written: " << (folder / name).string() << '\n';
  }
  const auto at = [&](const char* name) {
    constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./-";
    const std::string path = (folder / name).string();
    return path.find_first_not_of(plain) == std::string::npos ? path : shell_word(path);
  };
  const std::string database = " --db " + at("results.db");
  session.out << "\nchange them as their comments say, and go on with\n";
  if (files.contains("fit.json"))
    session.out << "  rollres fit " << at("fit.json") << database << " --scene " << at("fitted.json")
                << "\n  rollres fit rig --predict " << at("predict.csv") << database << '\n';
  else
    session.out << "  rollres solve " << at("scene.json") << '\n';
  session.out << "  rollres sweep " << at("study.json") << database << "\n  rollres chart" << database << " --out "
              << at("chart") << "\n  rollres report" << database << " --out " << at("report.html") << '\n';
}

}  // namespace

void add_new(Command& program, Session& session) {
  const auto [command, arguments] = program.add<NewArguments>(
      "new", "Write a scene and a study to start from, with comments: belt, wheel, nip, ball or lab", session,
      make_new);
  command
      ->add_option(
          "kind KIND", arguments.kind,
          "belt: a belt over a roll; wheel: a wheel with a tyre; nip: a covered roller on a hard one; ball: a ball "
          "on a mat; lab: a rig's forces and the fit of its material")
      ->required()
      ->one_of({"belt", "wheel", "nip", "ball", "lab"});
  command->add_option("folder DIR", arguments.folder, "folder for the files; default: the kind");
  command->footer(
      "Files that are there already are kept. studies/recipes.md goes on from each kind to its picture.\n"
      "Example: rollres new belt first_belt");
}

}  // namespace rollres
