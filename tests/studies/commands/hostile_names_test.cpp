/// Names of studies that mean something to a shell, gnuplot, HTML, SVG, SQL, a terminal or a file system, from the file
/// to every command that prints them. Covers printable, too.

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "db/rows/result_store.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/shell.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;
using Catch::Contains;
using Catch::StartsWith;

namespace {

const std::vector<std::string> hostile_names{"'",
                                             "''",
                                             "a'b''c",
                                             "\"",
                                             "\\",
                                             "\\\\n",
                                             "`touch hacked`",
                                             "$(touch hacked)",
                                             "${HOME}",
                                             "; touch hacked",
                                             "a|touch hacked",
                                             "&",
                                             "<script>alert(1)</script>",
                                             "a]]>b",
                                             "<!--",
                                             "-->",
                                             "&amp;",
                                             "%s%n",
                                             "%d.db",
                                             "@x ^y _z {w}",
                                             "~",
                                             "--help",
                                             "-",
                                             "*",
                                             "?",
                                             "a/b/../../c",
                                             "/etc/passwd",
                                             "...",
                                             "con: aux",
                                             "two  blanks",
                                             "#",
                                             "!x",
                                             "DROP TABLE study;--",
                                             "' OR ''='",
                                             "null",
                                             "1",
                                             "é漢字🛞",
                                             "[2J",
                                             std::string(300, 'x'),
                                             "a\u202eb"};
const std::vector<std::string> refused_names{
    ".", "..", "", std::string("a\0b", 3), "\x1b[2J", "a\nb", "a\tb", "\x7f", " a", "a ", "\xc2\x9b"};

bool is_printable(const std::string& text) {
  return std::none_of(text.begin(), text.end(),
                      [](unsigned char letter) {
                        return (letter < 0x20 && letter != '\n' && letter != '\t') || letter == 0x7f;
                      }) &&
         text.find("\xc2\x9b") == std::string::npos;
}

/// Whether a name has letters that HTML, SVG, a script or gnuplot may take for more than letters.
bool means_something_on_a_page(const std::string& name) {
  return std::any_of(name.begin(), name.end(), [](unsigned char letter) {
    return letter > 0x7e ||
           std::string_view("<>&'\"\\`$%@^_{}[]").find(static_cast<char>(letter)) < std::string_view::npos;
  });
}

/// What no SVG may have between its tags.
bool is_escaped(const std::string& svg) {
  for (std::size_t at = svg.find('&'); at != std::string::npos; at = svg.find('&', at + 1))
    if (svg.find(';', at) > at + 8) return false;
  std::size_t sections = 0;
  for (std::size_t at = svg.find("<![CDATA["); at != std::string::npos; at = svg.find("<![CDATA[", at + 1)) ++sections;
  for (std::size_t at = svg.find("]]>"); at != std::string::npos; at = svg.find("]]>", at + 1)) --sections;
  return sections == 0 && svg.find("<script>alert") == std::string::npos && svg.find("<!-- ") == svg.find("<!--");
}

}  // namespace

TEST_CASE("forty hostile names pass every command, and no control character is printed", "[studies][hostile]") {
  REQUIRE(hostile_names.size() == 40);
  for (std::size_t i = 0; i < hostile_names.size(); i += hostile_names.size() / thinned(40)) {
    const std::string& name = hostile_names[i];
    INFO(name);
    const TemporaryDirectory folder;
    nlohmann::json study = nlohmann::json::parse(R"({"scene": {"indenter": "cylinder", "radius": 0.1,
      "layer_thickness": 0.01, "static_shear_modulus": 1e6, "stiffening": 2, "creep_time": 0.1,
      "friction_coefficient": 0.3, "speed": 1, "load": 1e4}, "axes": {"speed": [1, 2, 3]}})");
    study["study"] = name;
    const std::string file = folder.write("study.json", study.dump()).string(), database = (folder / "a.db").string();
    const auto runs = [&](std::vector<std::string> words) {
      const ProgramRun run = run_rollres(words, closed_form);
      INFO(words.front() << ": " << run.out << run.err);
      CHECK(run.status == 0);
      CHECK((is_printable(run.out) && is_printable(run.err)));
    };
    runs({"sweep", file, "--db", database});
    runs({"status", "--db", database});
    runs({"list", "--db", database});
    runs({"show", "--db", database, "--", name});
    runs({"query", "--db", database, "study=" + name});
    if (means_something_on_a_page(name)) {
      runs({"chart", "--db", database, "--study=" + name, "--out", (folder / "chart").string()});
      CHECK(is_escaped(file_text(folder / "chart.svg")));
      runs({"report", "--db", database, "--study=" + name, "--out", (folder / "report.html").string()});
      const std::string page = file_text(folder / "report.html");
      CHECK(page.find("<script>alert") == std::string::npos);
      CHECK(page.find("\xc2\x9b") == std::string::npos);
    }
    runs({"export", "--db", database, "--study=" + name, "--out", (folder / "exported").string()});
    runs({"slurm", file, "--tasks", "2", "--db", database, "--out", (folder / "slurm").string()});
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path))
      if (entry.path().extension() == ".sh") CHECK(run_shell("sh -n '" + entry.path().string() + "'").status == 0);
    CHECK(!std::filesystem::exists("hacked"));
  }
}

TEST_CASE("forty hostile names are variants of one study, and its comment", "[studies][hostile]") {
  const TemporaryDirectory folder;
  nlohmann::json study = nlohmann::json::parse(R"({"study": "s", "comment": "", "scene": {"indenter": "cylinder",
    "radius": 0.1, "layer_thickness": 0.01, "static_shear_modulus": 1e6, "stiffening": 2, "creep_time": 0.1,
    "friction_coefficient": 0.3, "speed": 1, "load": 1e4}, "axes": {"speed": [1, 2, 3], "variant": {}}})");
  double load = 1e4;
  for (const std::string& name : hostile_names) {
    study["axes"]["variant"][name] = {{"load", load += 100}};
    study["comment"] = study["comment"].get<std::string>() + " " + name;
  }
  const std::string file = folder.write("study.json", study.dump()).string(), database = (folder / "a.db").string();
  const auto runs = [&](std::vector<std::string> words) {
    const ProgramRun run = run_rollres(words, closed_form);
    INFO(words.front() << ": " << run.out << run.err);
    CHECK(run.status == 0);
    CHECK((is_printable(run.out) && is_printable(run.err)));
    return run.out;
  };
  runs({"sweep", file, "--db", database});
  for (const std::string& name : hostile_names) {
    INFO(name);
    const std::string rows = runs({"query", "--db", database, "--format", "csv", "variant=" + name});
    CHECK(std::count(rows.begin(), rows.end(), '\n') == 4);  // the names of the columns, three speeds
  }
  runs({"show", "--db", database, "s"});
  std::vector<std::string> chart{"chart", "--db", database, "--x", "speed", "--out", (folder / "chart").string()};
  CHECK_THAT(run_rollres(chart, closed_form).err, Contains("would need 40 curves"));
  std::vector<std::string> of_bodies = chart;
  of_bodies.insert(of_bodies.end(), {"--where", "load<=12 kN"});
  CHECK_THAT(run_rollres(of_bodies, closed_form).err,
             Contains("no point matches; a value in N finds spheres and cylinders with a width"));
  chart.insert(chart.end(), {"--where", "load<=12 kN/m"});  // the first twenty
  runs(chart);
  CHECK(is_escaped(file_text(folder / "chart.svg")));
  runs({"report", "--db", database, "--out", (folder / "report.html").string()});
  CHECK(file_text(folder / "report.html").find("<script>alert") == std::string::npos);
  runs({"export", "--db", database, "--study=s", "--out", (folder / "exported").string()});
  runs({"slurm", file, "--tasks", "2", "--db", database, "--out", (folder / "slurm").string()});
  CHECK(!std::filesystem::exists("hacked"));
}

TEST_CASE("files and folders of hostile names are read and written, and named so that a shell takes them",
          "[studies][hostile]") {
  for (const std::string& name : hostile_names) {
    if (name.find('/') != std::string::npos || name.size() > 200) continue;  // no name of a file
    INFO(name);
    const TemporaryDirectory folder;
    std::filesystem::create_directory(folder / name);
    const auto inside = [&](const std::string& ending) { return (folder / name / (name + ending)).string(); };
    folder.write("scene.json", R"({"indenter": "cylinder", "radius": 0.1, "layer_thickness": 0.01,
      "static_shear_modulus": 1e6, "stiffening": 2, "creep_time": 0.1, "friction_coefficient": 0.3, "speed": 1,
      "load": 1e4})");
    std::filesystem::rename(folder / "scene.json", inside(".scene"));
    const nlohmann::json study{{"study", "s"}, {"scene", name + ".scene"}, {"axes", {{"speed", {1, 2}}}}};
    std::filesystem::rename(folder.write("study.json", study.dump()), inside(".json"));
    const auto runs = [&](std::vector<std::string> words) {
      const ProgramRun run = run_rollres(words, closed_form);
      INFO(words.front() << ": " << run.out << run.err);
      CHECK(run.status == 0);
      return run.out;
    };
    runs({"solve", inside(".scene")});
    runs({"sweep", inside(".json"), "--db", inside(".db")});
    runs({"query", "--db", inside(".db"), "--format", "csv"});
    const std::string said =
        runs({"slurm", inside(".json"), "--tasks", "2", "--db", inside(".db"), "--out", inside("")});
    const std::string next = said.substr(said.find("next: ") + 6);
    CHECK(run_shell("set -- " + next.substr(0, next.size() - 1) + "; sh -n \"$2\"").status == 0);
    CHECK(!std::filesystem::exists("hacked"));
  }
}

TEST_CASE("hostile names of a fit reach the store, its pictures, pages and folders, and are only names",
          "[studies][hostile]") {
  for (const std::string name : {"a'b''c; $(touch hacked)", "<script>alert(1)</script>]]>", "@x ^y %s%n {w} \\"}) {
    INFO(name);
    const TemporaryDirectory folder;
    nlohmann::json fit = nlohmann::json::parse(file_text(example("fit_shift.json")));
    fit["fit"] = name;
    fit["data"] = example("fit_shift.csv");
    const std::string file = folder.write("fit.json", fit.dump()).string(), database = (folder / "a.db").string();
    const auto runs = [&](std::vector<std::string> words) {
      const ProgramRun run = run_rollres(words, closed_form);
      INFO(words.front() << ": " << run.out << run.err);
      CHECK(run.status == 0);
      CHECK((is_printable(run.out) && is_printable(run.err)));
      return run.out;
    };
    runs({"fit", file, "--db", database});
    runs({"list", "--db", database});
    runs({"show", "--db", database, "--", name});
    CHECK_THAT(runs({"query", "--db", database, "--fits", "--format", "json", "name=" + name}), Contains("wlf_c1"));
    runs({"compare", "--db", database, "--", name, name});
    runs({"complete", "rollres", "show", "--db", database, ""});
    runs({"chart", "--db", database, "--fit=" + name, "--chart", "data", "--out", (folder / "chart").string()});
    CHECK(is_escaped(file_text(folder / "chart.svg")));
    runs({"report", "--db", database, "--study=" + name, "--out", (folder / "report.html").string()});
    CHECK(file_text(folder / "report.html").find("<script>alert") == std::string::npos);
    runs({"export", "--db", database, "--study=" + name, "--out", (folder / "exported").string()});
    CHECK(!std::filesystem::exists("hacked"));
  }
}

TEST_CASE("a signal ends a command that has nothing to bring home with a line and the status of signals",
          "[studies][hostile]") {
  // Sent as soon as the program catches it, while it solves for many seconds.
  const std::string caught =
      "for n in $(seq 3000); do set -- $(sed -n \"s/^Name:\\t//p; s/^SigCgt:\\t//p\" /proc/$p/status); "
      "[ \"$1\" = rollres ] && [ $((0x$2 & 0x4002)) -eq 16386 ] && break; sleep 0.01; done; ";
  for (const auto& [signal, status, said] :
       {std::tuple{"INT", 130, "rollres: interrupted\n"}, {"TERM", 143, "rollres: terminated\n"}}) {
    const ShellRun run =
        run_shell("exec bash -c 'set -m; \"$0\" solve \"$1\" --set spacing=0.02e-3 & p=$!; " + caught + "kill -" +
                  signal + " $p; wait $p' '" + rollres_program() + "' '" + example("paper_sphere.json") + "'");
    CHECK(run.status == status);
    CHECK_THAT(run.out, StartsWith(said));  // the shell may add its own word
  }
}

TEST_CASE("names with control characters are refused, and shown escaped", "[studies][hostile]") {
  const TemporaryDirectory folder;
  for (const std::string& name : refused_names) {
    nlohmann::json study{{"study", name}, {"scene", "none.json"}, {"axes", {{"speed", {1}}}}};
    const std::string file = folder.write("study.json", study.dump()).string();
    const ProgramRun run = run_rollres({"sweep", file, "--db", (folder / "a.db").string()}, closed_form);
    CHECK(run.status == 2);
    CHECK_THAT(run.err, Contains("study"));
    CHECK(is_printable(run.err));
    study["study"] = "s";
    study["axes"] = {{"variant", {{name, {{"speed", 1}}}, {"other", {{"speed", 2}}}}}};
    const ProgramRun variant = run_rollres(
        {"sweep", folder.write("study.json", study.dump()).string(), "--db", (folder / "a.db").string()}, closed_form);
    CHECK(variant.status == 2);
    CHECK(is_printable(variant.err));
  }
}

TEST_CASE("what a file holds is printed with its control characters escaped", "[studies][hostile]") {
  const TemporaryDirectory folder;
  const ProgramRun missing = run_rollres({"solve", "\x1b[2J\r\x7f.json"}, closed_form);
  CHECK_THAT(missing.err, Contains("\\x1b[2J"));
  CHECK(is_printable(missing.err));
  const std::string database = (folder / "a.db").string();
  CHECK(run_rollres({"query", "--db", database, "--sql", "SELECT 1"}, closed_form).status == 3);
  { ResultStore store(database); }
  const ProgramRun selected =
      run_rollres({"query", "--db", database, "--sql", "SELECT char(27) || '[2J' || char(155) AS a"}, closed_form);
  CHECK(selected.status == 0);
  CHECK_THAT(selected.out, Contains("\\x1b[2J\\x9b"));
}

TEST_CASE("a program that gets too little memory says so", "[studies][hostile]") {
  if (address_sanitizer()) return;  // which takes all addresses: with fewer it ends before the program begins
  for (const int megabytes : {60, 80, 100, 120, 150, 200}) {
    const ShellRun run = run_shell("ulimit -v " + std::to_string(1000 * megabytes) + "; exec '" + rollres_program() +
                                   "' solve '" + example("paper_sphere.json") + "' --set 'spacing=0.04 mm'");
    INFO(megabytes << " MB: " << run.out);
    CHECK((run.status == 0 || run.status == 1 || run.status == 3 || run.status == 127));  // 127: not even loaded
  }
}

TEST_CASE("an optimisation needs no more stack than 256 kB", "[studies][hostile]") {
  if (address_sanitizer()) return;  // whose frames are several times as large
  const TemporaryDirectory folder;
  const ShellRun run = run_shell("ulimit -s 256; exec '" + rollres_program() + "' optimise '" +
                                 example("optimise_layer.json") + "' --db '" + (folder / "a.db").string() + "' 2>&1");
  INFO(run.out);
  CHECK(run.status == 0);
}

TEST_CASE("a fit by a program that was copied without its library says what is missing", "[studies][hostile]") {
  const TemporaryDirectory folder;
  std::filesystem::copy_file(rollres_program(), folder / "rollres");
  const ShellRun run = run_shell("'" + (folder / "rollres").string() + "' fit '" + example("fit_cylinder.json") +
                                 "' --db '" + (folder / "f.db").string() + "' 2>&1");
  CHECK(run.status == 3);
  CHECK_THAT(run.out, Contains("librollres_ceres.so: cannot open shared object file"));
}

TEST_CASE("a database that is deleted during a sweep ends it with status 3 and what is lost", "[studies][hostile]") {
  const TemporaryDirectory folder;
  const std::string database = (folder / "a.db").string();
  const auto study = folder.write("study.json", R"({"study": "s", "scene": {"indenter": "cylinder", "radius": 0.1,
      "layer_thickness": 0.01, "static_shear_modulus": 1e6, "stiffening": 2, "creep_time": 0.1,
      "friction_coefficient": 0.3, "speed": 1, "load": 1e4}, "axes": {"speed": {"from": 1, "to": 2, "points": 40}}})");
  const auto deleting = [&](const RollingScene& scene) {
    if (scene.speed > 1.5) std::filesystem::remove(database);
    return closed_form(scene);
  };
  const ProgramRun run = run_rollres({"sweep", study.string(), "--db", database, "--jobs", "1"}, deleting);
  CHECK(run.status == 3);
  CHECK_THAT(run.err, Contains("a.db: was deleted or replaced") && Contains("lost"));
  CHECK(run.out.find("40 of 40") == std::string::npos);
}
