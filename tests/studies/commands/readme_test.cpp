#include <algorithm>
#include <regex>
#include <set>

#include "studies/text/strict_json.hpp"
#include "studies/text/words.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/same_picture.hpp"
#include "tests/studies/shell.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers main and, as far as the processor of this machine has all it asks for, processor_check, too.

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

constexpr const char* pages[] = {"README.md", "studies/guide.md", "studies/recipes.md"};

/// The README, the guide and the recipes.
const std::string& all_pages() {
  static const std::string text = [] {
    std::string all;
    for (const char* page : pages) all += file_text(source_directory() / page);
    return all;
  }();
  return text;
}

/// A block between lines of three back quotes.
struct Block {
  std::string language;
  std::vector<std::string> lines;

  std::string text() const {
    std::string all;
    for (const std::string& line : lines) all += line + "\n";
    return all;
  }
};

std::vector<Block> blocks() {
  std::vector<Block> found;
  std::istringstream stream(all_pages());
  bool inside = false;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("```")) {
      inside = !inside;
      if (inside) found.push_back({line.substr(3), {}});
    } else if (inside) {
      found.back().lines.push_back(line);
    }
  }
  CHECK_FALSE(inside);
  return found;
}

/// Lines of a shell; one whose quotes are open goes on.
std::vector<std::string> commands(const Block& block) {
  std::vector<std::string> found;
  bool open = false;
  for (const std::string& line : block.lines) {
    if (open)
      found.back() += "\n" + line;
    else
      found.push_back(line);
    open ^= std::count(line.begin(), line.end(), '"') % 2 == 1;
  }
  return found;
}

/// Commands that this test leaves out.
struct LeftOut {
  const char *begin, *reason;
};
constexpr LeftOut left_out[] = {
    {"sh studies/quickstart.sh", "installs packages, and builds for minutes"},
    {"sh tests/run.sh", "runs this test"},
    {"rollres verify ", "runs below, as the table that the pages show"},
    {"cmake --install build/release", "another test installs"},
    {"cmake --workflow --preset package", "builds for minutes"},
    {"cmake --workflow --preset dev", "builds for minutes"},
    {"cmake --workflow --preset release", "builds for minutes"},
};

/// Programs that a command needs besides; without them it is left out.
bool can_run(const std::string& program, const std::string& probe) {
  if (run_shell(probe).status == 0) return true;
  WARN(program << " is not there: not tried");
  return false;
}

}  // namespace

TEST_CASE("every command of the README, the guide and the recipes runs, and every file that they name is there",
          "[studies][readme][long]") {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory / "bin");
  std::filesystem::create_directory(directory / "out");  // quickstart.sh makes it
  std::filesystem::create_symlink(rollres_program(), directory / "bin" / "rollres");
  std::filesystem::create_directory_symlink(source_directory() / "studies", directory / "studies");
  const std::string here =
      "cd " + shell_word(directory.path.string()) + " && PATH=\"$PWD/bin:$PATH\" && export PATH && ";

#ifdef ROLLRES_PYTHON
  const std::string own_python = "PYTHONPATH=" + shell_word(ROLLRES_PYTHON_FOLDER) + " " + shell_word(ROLLRES_PYTHON);
#else
  const std::string own_python = "false";
#endif
  std::set<std::string> unused, once;
  for (const LeftOut& entry : left_out) unused.insert(entry.begin);
  int ran = 0;
  for (const Block& block : blocks()) {
    if (block.language == "sh")
      for (const std::string& command : commands(block)) {
        const auto skipped = std::find_if(std::begin(left_out), std::end(left_out),
                                          [&](const LeftOut& entry) { return command.starts_with(entry.begin); });
        if (skipped != std::end(left_out)) {
          unused.erase(skipped->begin);
          continue;
        }
        if (!once.insert(command).second) continue;  // the README's, in the guide again
        if (command.starts_with("sqlite3 ") && !can_run("sqlite3", "command -v sqlite3")) continue;
        const ShellRun run = run_shell("{ " + here + command + "\n}");
        INFO(command << "\n" << run.out);
        CHECK(run.status == 0);
        ++ran;
      }
    if (block.language == "python") {
      const bool own = block.text().find("import rollres") != std::string::npos;
      const std::string python = own ? own_python : "/usr/bin/env python3";
      if (!can_run(own ? "the Python package" : "pandas", python + " -c 'import " + (own ? "rollres" : "pandas") + "'"))
        continue;
      directory.write("read.py", block.text());
      const ShellRun run = run_shell(here + python + " read.py");
      INFO(run.out);
      CHECK(run.status == 0);
    }
    if (block.language == "r" && can_run("R with RSQLite", "Rscript -e 'library(RSQLite)'")) {
      directory.write("read.r", block.text());
      const ShellRun run = run_shell(here + "Rscript read.r");
      INFO(run.out);
      CHECK(run.status == 0);
    }
  }
  CHECK(unused.empty());
  CHECK(ran > 15);

  // What these commands drew is what the pages show.
  for (const char* name : {"speed_resistance", "conveyor_belt", "caster_wheel", "ball_on_mat", "paper_cylinder_sketch",
                           "figure_04_tractions", "skewed_idler_resistance", "crowned_wheel_force", "roller_shoulders_pressure",
                           "warm_wheel", "pavement", "cooled_nip"}) {
    const std::string picture = std::string(name) + ".svg";
    INFO(picture << ": draw it anew by the command of the README, and copy it from out/ to studies/examples/");
    CHECK(difference_of_pictures(file_text(directory / "out" / picture), file_text(example(picture))) == "");
  }

  // The table of verification, but for differences, which rounding makes.
  const ShellRun table = run_shell(here + "rollres verify --summary --format markdown");
  INFO(table.out << "rollres verify shows each case");
  CHECK(table.status == 0);  // the program reproduces the paper, the closed forms and the tables of others
  const std::regex difference(R"(\| [0-9.e+-]+ +\|( [0-9.e+-]+ +\|)$)");
  std::istringstream lines(table.out);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("| ") && line.find("| difference") == std::string::npos)
      CHECK_THAT(std::regex_replace(all_pages(), std::regex(R"(\| [0-9.e+-]+ +\|( [0-9.e+-]+ +\|)\n)"), "$1\n"),
                 Contains(std::regex_replace(line, difference, "$1") + "\n"));
  const std::regex count("([0-9]+) of [0-9]+ pass");
  std::smatch match;
  REQUIRE(std::regex_search(table.out, match, count));
  for (const char* page : {"README.md", "studies/guide.md"})
    CHECK_THAT(file_text(source_directory() / page), Contains("solves " + match[1].str() + " cases"));
}

TEST_CASE("pictures are the same but for rounding", "[studies][readme]") {
  const std::string svg = R"(<path d='M10.1,20.5 L30,40'/><text x='3'>peak 5.93 N/m</text>)";
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string other = svg;
    other.replace(other.find(from), from.size(), to);
    return difference_of_pictures(svg, other);
  };
  CHECK(difference_of_pictures(svg, svg) == "");
  CHECK(changed("20.5", "20.6") == "");
  CHECK(changed("5.93", "5.94") == "");
  CHECK(changed("20.5", "22.5") != "");
  CHECK(changed("5.93", "5.62") != "");
  CHECK(changed("peak", "least") != "");
  CHECK(changed(" L30,40", "") != "");
}

TEST_CASE("links, pictures, paths, options and files of the README, the guide and the recipes are as they say",
          "[studies][readme]") {
  const std::string& text = all_pages();
  const auto each = [](const std::string& all, const std::string& pattern, const auto& act) {
    const std::regex expression(pattern);
    for (std::sregex_iterator at(all.begin(), all.end(), expression), end; at != end; ++at) act((*at)[1].str());
  };
  const auto check_there = [&](const std::string& path) {
    INFO(path);
    CHECK(std::filesystem::exists(source_directory() / path));
  };
  for (const std::filesystem::path page : pages)
    each(file_text(source_directory() / page), R"(\]\(([^):#]+)[^):]*\))",
         [&](const std::string& link) { check_there((page.parent_path() / link).string()); });
  each(text, R"((?:^|[^A-Za-z0-9_/.])((?:core|db|fitting|studies|tests)/[A-Za-z0-9_./-]*[A-Za-z0-9_]))", check_there);

  // In the text: commands with options as they are declared.
  std::string prose;
  std::istringstream stream(text);
  bool inside = false;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("```"))
      inside = !inside;
    else if (!inside)
      prose += line + " ";
  }
  int commands = 0;
  each(prose, "`(rollres [^`]+)`", [&](const std::string& command) {
    INFO(command);
    std::istringstream words(command);
    std::string word, name;
    words >> word >> name;
    if (name == "--version") {  // which is no command
      words >> word;
      CHECK(run_rollres({name, word}, closed_form).status == 0);
      return;
    }
    const ProgramRun help = run_rollres({name, "--help"}, closed_form);
    CHECK(help.status == 0);
    while (words >> word && word != "|")
      if (word.starts_with("--")) CHECK_THAT(help.out, Contains("  " + word.substr(0, word.find('='))));
    ++commands;
  });
  CHECK(commands > 10);

  // Scenes and studies that stand there whole, a study of the scene before it, too.
  const TemporaryDirectory directory;
  std::filesystem::copy(source_directory() / "studies/examples/paper_cylinder.json", directory.path);
  int whole = 0;
  for (const Block& block : blocks()) {
    if (block.language != "json" || block.lines.front() != "{") continue;
    const bool study = parse_object(block.text(), "README.md").contains("study");
    const std::string file = directory.write(study ? "study.json" : "wheel.json", block.text()).string();
    const ProgramRun run = run_rollres({study ? "plan" : "solve", file}, closed_form);
    INFO(block.text() << run.err);
    CHECK(run.status == 0);
    ++whole;
  }
  CHECK(whole == 3);
}
