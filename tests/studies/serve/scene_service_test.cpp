#include "studies/serve/scene_service.hpp"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "core/numerics/solution_limits.hpp"
#include "studies/serve/unix_socket.hpp"
#include "studies/text/words.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/shell.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers descriptor_buffer and command_serve, too.

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

const std::string cylinder = (source_directory() / "studies/examples/paper_cylinder.json").string();

std::vector<Json> lines_of(const std::string& text) {
  std::vector<Json> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(Json::parse(line));
  return lines;
}

/// What a service answers whose lines replace inputs of the paper's cylinder.
std::vector<Json> served(const std::string& questions, int jobs = 4) {
  StoredEvaluations evaluations(closed_form);
  SceneService service(evaluations, replacing_inputs_of(cylinder), jobs);
  std::istringstream in(questions);
  std::ostringstream out;
  service.serve(in, out);
  return lines_of(out.str());
}

/// What a program hears that connects, says these lines and ends.
std::string heard(const std::filesystem::path& socket, const std::string& lines) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strcpy(address.sun_path, socket.c_str());
  const int connection = ::socket(AF_UNIX, SOCK_STREAM, 0);
  while (::connect(connection, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) ::usleep(1000);
  CHECK(::write(connection, lines.data(), lines.size()) == static_cast<ssize_t>(lines.size()));
  ::shutdown(connection, SHUT_WR);
  std::string text;
  char buffer[4096];
  for (ssize_t got; (got = ::read(connection, buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(got));
  ::close(connection);
  return text;
}

ServeStream served_by(SceneService& service) {
  return [&](std::istream& in, std::ostream& out, const std::atomic<bool>& gone) { service.serve(in, out, gone); };
}

/// Solves as long as the wish to stop, which it asks for as solvers do, lets it; then `released` if nobody wishes.
Evaluate endless(std::atomic<int>& begun, const std::atomic<bool>& released) {
  return [&](const RollingScene& scene) {
    if (scene.speed < 1) return closed_form(scene);
    ++begun;
    const SolutionLimits limits(1e9);
    while (!released) {
      require_time(1);  // asks at once
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return closed_form(scene);
  };
}

}  // namespace

TEST_CASE("each line has an answer with its id, an error where it cannot be read", "[studies][serve]") {
  const auto answers = served(
      "{\"id\": \"a\", \"speed\": 0.5}\n\n{\"speed\": \"1 m/s\"}\r\n{\"speed\": -1, \"id\": [7]}\nno JSON\n[1]\n"
      "{\"speeed\": 1}\n{\"approach\": 1e-4, \"load\": 1}\n{\"speed\": 1, \"speed\": 2}\n{}");
  REQUIRE(answers.size() == 9);
  CHECK(answers[0]["id"] == "a");
  RollingScene scene;
  scene.speed = 0.5;
  scene.load = 20e3;
  CHECK(answers[0]["rolling_resistance"].get<double>() == closed_form(scene).rolling_resistance);
  CHECK(answers[0]["half_width"].is_null());
  CHECK(answers[1]["id"] == 3);
  CHECK(answers[1]["status"] == "converged");
  CHECK(answers[2].dump() == R"({"id":[7],"line":4,"error":"line 4: speed = -1: must be > 0"})");
  CHECK(answers[3]["id"].is_null());
  CHECK_THAT(answers[3]["error"].get<std::string>(), Contains("line 5: line 1, column 2: syntax error"));
  CHECK(answers[4]["error"] == "line 6: [1]: must be an object { ... }");
  CHECK(answers[5]["error"] == "line 7: speeed = 1: unknown key; did you mean speed?");
  CHECK_THAT(answers[6]["error"].get<std::string>(), Contains("give load or approach, not both"));
  CHECK_THAT(answers[7]["error"].get<std::string>(), Contains("key given twice"));
  CHECK(answers[8]["id"] == 10);
  CHECK(served(std::string(2'000'000, 'x') + "\n{}")[0]["error"] == "line 1: longer than 1 MB");
  CHECK(served("").empty());
}

TEST_CASE("ten thousand lines, five hundred of them bad, are answered in their order by four threads",
          "[studies][serve]") {
  std::string questions;
  for (int line = 1; line <= 10'000; ++line)
    questions += line % 20 == 7 ? "{\"speed\": \"fast\"}\n" : "{\"speed\": " + std::to_string(line) + "}\n";
  const std::vector<Json> answers = served(questions);
  REQUIRE(answers.size() == 10'000);
  int errors = 0, wrong = 0;
  for (int line = 1; line <= 10'000; ++line) {
    const Json& answer = answers[static_cast<std::size_t>(line - 1)];
    wrong += answer["id"] != line;
    if (const auto error = answer.find("error"); error != answer.end()) {
      ++errors;
      wrong += answer["line"] != line || error->get<std::string>().find("\"fast\": must be") == std::string::npos;
    } else {
      const double speed = line, resistance = 0.01 * 20e3 * speed / (1 + speed * speed);
      wrong += answer["rolling_resistance"].get<double>() != resistance;
    }
  }
  CHECK(errors == 500);
  CHECK(wrong == 0);
}

TEST_CASE("what is stored is recalled, and a store that cannot be opened ends the service", "[studies][serve]") {
  const TemporaryDirectory folder;
  int solved = 0;
  for (int run = 0; run < 2; ++run) {
    StoredEvaluations evaluations(
        [&](const RollingScene& scene) {
          ++solved;
          return closed_form(scene);
        },
        folder / "results.db");
    SceneService service(evaluations, replacing_inputs_of(cylinder), 1);
    std::istringstream in("{\"speed\": 1}\n{\"speed\": 2}\n{\"speed\": 1}\n");
    std::ostringstream out;
    service.serve(in, out);
    CHECK(lines_of(out.str()).size() == 3);
    CHECK(solved == 2);
  }
  const std::string service = shell_word(rollres_program()) + " serve " + shell_word(cylinder) + " --db ";
  const ShellRun run = run_shell("echo '{\"speed\": 1}' | " + service + "/dev/full/x.db");
  CHECK(run.status == 3);
  CHECK_THAT(run.out, Contains("/dev/full/x.db"));
}

TEST_CASE("a service that is killed has stored whatever it answered", "[studies][serve]") {
  const TemporaryDirectory folder;
  const std::string program = shell_word(rollres_program()), here = "cd " + shell_word(folder.path.string()) + " && ";
  const std::string service = program + " serve " + shell_word(cylinder) + " --db results.db --jobs 2 <&3 >answers";
  run_shell(here + ": >answers; seq 1 50000 | sed 's/.*/{\"speed\": &e-4, \"tolerance\": 1e-3}/' | { exec 3<&0; " +
            service + " & while [ $(grep -c . answers) -lt 50 ] && kill -0 $!; do sleep 0.05; done; kill -KILL $!; }");
  const ShellRun stored = run_shell(here + program + " query --db results.db --aggregate count --format csv");
  const std::string text = file_text(folder / "answers");
  const long answered = std::count(text.begin(), text.end(), '\n');
  CHECK(answered >= 50);
  CHECK(answered < 50000);
  INFO(stored.out);
  CHECK(std::stol(stored.out.substr(stored.out.find('\n') + 1)) >= answered);
}

TEST_CASE("programs that connect to a socket are served side by side until the service is stopped",
          "[studies][serve]") {
  const TemporaryDirectory folder;
  const std::filesystem::path socket = folder / "rollres.socket";
  StoredEvaluations evaluations(closed_form);
  SceneService service(evaluations, replacing_inputs_of(cylinder), 2);
  std::atomic<bool> stop = false;
  std::jthread listening([&] { serve_socket(socket, stop, served_by(service)); });
  std::string first, second;
  {
    const std::jthread one([&] { first = heard(socket, "{\"id\": 1, \"speed\": 1}\n{\"id\": 2}\n"); });
    const std::jthread other([&] { second = heard(socket, "x\n{\"id\": 4}\n"); });
  }
  CHECK(lines_of(first).size() == 2);
  CHECK(lines_of(first)[1]["id"] == 2);
  CHECK(lines_of(second)[0].contains("error"));
  CHECK(lines_of(second)[1]["id"] == 4);
  CHECK_THAT(message_of([&] { serve_socket(socket, stop, served_by(service)); }),
             Contains(socket.string() + ": cannot be listened at: Address already in use"));
  stop = true;
  listening.join();
  CHECK_FALSE(std::filesystem::exists(socket));
}

TEST_CASE("a client whose scenes take long holds up no other, and they end with it", "[studies][serve]") {
  std::atomic<int> begun = 0;
  std::atomic<bool> released = false, gone = false;
  StoredEvaluations evaluations(endless(begun, released));
  SceneService service(evaluations, replacing_inputs_of(cylinder), 1);
  std::istringstream dear_lines("{\"speed\": 1}\n{\"speed\": 2}\n{\"speed\": 3}\n"), cheap_line("{\"speed\": 0.1}\n");
  std::ostringstream none, answers;
  std::jthread dear([&] { service.serve(dear_lines, none, gone); });
  while (begun == 0) std::this_thread::yield();
  service.serve(cheap_line, answers);
  CHECK(lines_of(answers.str()).at(0)["status"] == "converged");
  gone = true;
  dear.join();
  CHECK(none.str().empty());
  CHECK(begun == 1);  // neither of the other two lines
}

TEST_CASE("a server that is stopped ends what it solves and removes its socket, a dead socket is replaced",
          "[studies][serve]") {
  const TemporaryDirectory folder;
  const std::filesystem::path socket = folder / "rollres.socket";
  {
    sockaddr_un address{};  // what a server left behind that was killed
    address.sun_family = AF_UNIX;
    std::strcpy(address.sun_path, socket.c_str());
    const int dead = ::socket(AF_UNIX, SOCK_STREAM, 0);
    REQUIRE(::bind(dead, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
    ::close(dead);
  }
  std::atomic<int> begun = 0;
  const std::atomic<bool> never = false;
  std::atomic<bool> stop = false;
  StoredEvaluations evaluations(endless(begun, never));
  SceneService service(evaluations, replacing_inputs_of(cylinder), 1);
  std::jthread listening([&] { serve_socket(socket, stop, served_by(service)); });
  std::jthread client([&] { heard(socket, "{\"speed\": 1}\n"); });
  while (begun == 0) std::this_thread::yield();
  stop = true;
  listening.join();
  client.join();
  CHECK_FALSE(std::filesystem::exists(socket));
  folder.write("rollres.socket", "no socket");  // any other file stays
  CHECK_THAT(message_of([&] { serve_socket(socket, stop, served_by(service)); }), Contains("Address already in use"));
  CHECK(file_text(socket) == "no socket");
}

TEST_CASE("a line names files of the folder that is given, and no other", "[studies][serve]") {
  const TemporaryDirectory folder;
  folder.write("secret.csv", "the secret");
  const auto files = folder.path / "files";
  std::filesystem::create_directory(files);
  std::ofstream(files / "rubber.csv")
      << "frequency [Hz],storage_young_modulus [MPa],loss_young_modulus [MPa]\n1,1,0.2\n10,2,0.5\n";
  std::filesystem::create_symlink(folder / "secret.csv", files / "link.csv");
  REQUIRE(::mkfifo((files / "pipe.csv").c_str(), 0600) == 0);
  const auto read = [](const ReadScene& reader, const std::string& name) {
    return message_of([&] {
      reader({{"indenter", "cylinder"},
              {"radius", 0.1},
              {"layer_thickness", 0.01},
              {"speed", 1},
              {"load", 1000},
              {"material", "master_curve"},
              {"master_curve_file", name}},
             "line 1");
    });
  };
  CHECK(read(whole_scenes(files), "rubber.csv") == "nothing");
  CHECK(read(whole_scenes(files), (files / "rubber.csv").string()) == "nothing");
  for (const std::string& name :
       {(folder / "secret.csv").string(), std::string("../secret.csv"), std::string("link.csv"),
        std::string("pipe.csv"), std::string("absent.csv"), std::string("/dev/zero")})
    CHECK(read(whole_scenes(files), name) ==
          "line 1: master_curve_file = \"" + name + "\": must be a file in the folder of --files");
  CHECK_THAT(read(whole_scenes(), "rubber.csv"), Contains("only where --files gives a folder"));
  const Json coated{{"coating_layers", {{{"material", "master_curve"}, {"master_curve_file", "/etc/passwd"}}}}};
  for (const ReadScene& reader : {whole_scenes(files), whole_scenes()})
    CHECK_THAT(message_of([&] { reader(coated, "line 1"); }),
               Contains("line 1: coating_layers[0].master_curve_file = \"/etc/passwd\": ") && Contains("--files"));
  CHECK_THROWS_WITH(whole_scenes(folder.path / "nowhere"), Contains("--files = ") && Contains("must be a folder"));
}

TEST_CASE("Dakota's batch of parameters comes back as its results file, in the order of the batch",
          "[studies][serve][examples]") {
  if (!installed("python3")) {
    WARN("python3 is not installed");
    return;
  }
  const TemporaryDirectory folder;
  std::filesystem::create_symlink(rollres_program(), folder / "rollres");
  const auto set = [](const std::string& thickness, int number) {
    return "      2 variables\n " + thickness +
           " layer_thickness\n 3.0e+06 static_shear_modulus\n      2 functions\n"
           "      1 ASV_1:rolling_resistance\n      1 ASV_2:peak_pressure\n      2 derivative_variables\n"
           "      1 DVV_1:layer_thickness\n      2 DVV_2:static_shear_modulus\n      0 analysis_components\n      1:" +
           std::to_string(number) + " eval_id\n      0 metadata\n";
  };
  folder.write("params.in", set("5.000000000000000e-03", 1) + set("-1.0e+00", 2) + set("1.0e-02", 3));
  const std::string driver = (source_directory() / "studies/examples/dakota/driver.py").string();
  const ShellRun run =
      run_shell("cd " + shell_word(folder.path.string()) + " && PATH=\"$PWD:$PATH\" python3 " + shell_word(driver) +
                " " + shell_word(cylinder) + " tolerance=1e-6 params.in results.out");
  INFO(run.out);
  REQUIRE(run.status == 0);
  const Json alone = Json::parse(run_rollres({"solve", cylinder, "--set", "tolerance=1e-6", "--json"},
                                             static_cast<RollingSolution (*)(const RollingScene&)>(solve))
                                     .out);
  std::istringstream results(file_text(folder / "results.out"));
  double resistance, pressure;
  std::string name, fail, separator;
  results >> resistance >> name >> pressure >> name >> separator >> fail;
  CHECK(resistance == alone["rolling_resistance"].get<double>());
  CHECK(pressure == alone["peak_pressure"].get<double>());
  CHECK(separator + fail == "#FAIL");
  results >> separator >> resistance >> name;
  CHECK(name == "rolling_resistance");
  CHECK(resistance > alone["rolling_resistance"].get<double>());
}
