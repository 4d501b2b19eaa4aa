#include "studies/program/manual_page.hpp"

#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// A text that stands for itself: no escapes of groff in it, no quotes and dashes made prettier.
std::string plain(std::string_view text) {
  const std::string out = replaced(
      text,
      {{'\\', "\\e"}, {'-', "\\-"}, {'\'', "\\(aq"}, {'"', "\\(dq"}, {'`', "\\(ga"}, {'^', "\\(ha"}, {'~', "\\(ti"}});
  return out.starts_with('.') ? "\\&" + out : out;
}

std::string bold(std::string_view text) { return "\\fB" + plain(text) + "\\fR"; }
std::string slanted(std::string_view text) { return "\\fI" + plain(text) + "\\fR"; }

std::string section(const std::string& name) { return ".SH " + name + "\n"; }

/// An entry of a list with a hanging text.
std::string entry(const std::string& head, const std::string& text) { return ".TP\n" + head + "\n" + text + "\n"; }

/// Prose is filled anew; from "Example" on, and where a line is indented, lines stay as they are.
std::string closing_words(const std::string& footer) {
  std::istringstream lines(footer);
  std::string text, line;
  bool as_it_stands = false;
  for (bool first = true; std::getline(lines, line); first = false) {
    const bool example = line.starts_with("Example") || line.starts_with(' ');
    if (first || example != as_it_stands) text += as_it_stands ? ".EE\n" : "";
    if (first || (example && !as_it_stands)) text += ".PP\n";
    if (example && !as_it_stands) text += ".EX\n";
    if (!example && as_it_stands) text += ".PP\n";
    as_it_stands = example;
    text += plain(line) + "\n";
  }
  return text + (as_it_stands ? ".EE\n" : "");
}

std::string synopsis(const std::string& program, const CommandWords& command) {
  std::string text = bold(program + " " + command.name);
  bool optional = false;
  for (const OptionWords& option : command.options) {
    optional |= !option.required && !option.positional;
    if (!option.required || option.positional) continue;
    text += " " + bold(option.names.front());
    if (!option.value.empty()) text += " " + slanted(option.value);
  }
  if (optional) text += " [" + slanted("options") + "]";
  for (const OptionWords& option : command.options)
    if (option.positional)
      text += std::string(" ") + (option.required ? "" : "[") + slanted(option.value) + (option.many ? " ..." : "") +
              (option.required ? "" : "]");
  return text;
}

std::string option_entry(const OptionWords& option) {
  std::string head = option.positional ? "" : joined(option.names, ", ", bold);
  if (!option.value.empty()) head += (head.empty() ? "" : " ") + slanted(option.value);
  std::string text = plain(option.meaning);
  // Most meanings name the choices in words that say more.
  bool told = true;
  for (const std::string& choice : option.choices) told &= option.meaning.find(choice) != std::string::npos;
  if (!told) text += " (" + joined(option.choices, ", ", plain) + ")";
  return entry(head, text);
}

std::string inputs() {
  std::string text =
      section("INPUTS OF A SCENE") +
      "Keys of a scene file and of\n.BR \\-\\-set .\nNumbers are SI, or texts with a unit: \\(dq5 mm\\(dq.\n" +
      bold("rollres quantities") + "\ntells ranges and defaults as well, and the keys of the answer.\n";
  for (const InputKind& kind : written_kinds()) {
    const Quantity& quantity = kind.quantity;
    const std::string_view line = quantity.unit_for(Indenter::cylinder), point = quantity.unit_for(Indenter::sphere);
    std::string head = bold(quantity.key);
    if (!quantity.symbol.empty()) head += " " + slanted(quantity.symbol);
    if (!point.empty() && point != "1") head += " [" + plain(line) + (line == point ? "" : " or " + plain(point)) + "]";
    text +=
        entry(head, plain(quantity.meaning) + (kind.choices.empty() ? "" : ": ") + joined(kind.choices, ", ", bold));
  }
  return text;
}

}  // namespace

std::string manual_page(const CommandWords& program, const std::string& version,
                        const std::vector<ManualSection>& files) {
  std::string title;
  for (const char letter : program.name) title += static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  std::string summary = program.meaning;
  if (summary.ends_with('.')) summary.pop_back();
  summary.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(summary.front())));

  std::string text = ".\\\" Written by `" + program.name + " manual`.\n.TH " + title + " 1 \"\" \"" + plain(version) +
                     "\" \"User Commands\"\n" + section("NAME") + plain(program.name) + " \\- " + plain(summary) +
                     "\n" + section("SYNOPSIS") + bold(program.name) + " " + slanted("command") + " [" +
                     slanted("options") + "]\n" + closing_words(program.footer);
  text += section("DESCRIPTION") +
          plain(
              "What it costs to roll a cylinder or a sphere over layers of rubber, at a speed, a load and a friction "
              "coefficient, by steady-state frictional rolling contact with viscoelastic layers. A scene is a JSON "
              "file with the inputs below; a study varies some of them, and its answers are kept in an SQLite "
              "database, from which they are listed, drawn and reported. Other files describe optimisations and fits "
              "of materials to measurements.") +
          "\n" + section("OPTIONS");
  for (const OptionWords& option : program.options) text += option_entry(option);
  text += section("COMMANDS");
  for (const CommandWords& command : program.commands) {
    text += ".SS " + plain(command.name) + "\n" + plain(command.meaning) + ".\n.PP\n" +
            synopsis(program.name, command) + "\n";
    for (const OptionWords& option : command.options)
      if (option.names.back() != "--help") text += option_entry(option);
    text += closing_words(command.footer);
  }
  text += inputs();
  for (const ManualSection& file : files) {
    text += section(plain(file.title));
    for (const ManualEntry& one : file.entries) text += entry(bold(one.head), plain(one.text));
  }
  text += section("ENVIRONMENT") +
          entry(bold(database_variable), "the database of a command that needs " + bold("--db") +
                                             " and is given none; left out: " + usual_database_file);
  text += section("EXIT STATUS");
  for (const auto& [status, meaning] :
       {std::pair("0", "answered"), std::pair("1", "a scene has no answer or did not converge; the output says why"),
        std::pair("2", "the input or the command is wrong; the message names file, key, value and rule"),
        std::pair("3", "a file, the database or the disk failed")})
    text += entry(bold(status), plain(meaning));
  return text + section("SEE ALSO") + ".BR gnuplot (1),\n.BR sqlite3 (1)\n";
}

}  // namespace rollres
