#include "studies/explore/explorer.hpp"

#include <chrono>
#include <set>
#include <thread>

#include "core/numerics/solution_limits.hpp"
#include "studies/run/sweep.hpp"
#include "studies/scene_io/scene_file.hpp"
#include "studies/scene_io/solution_json.hpp"
#include "studies/text/words.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/shell.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers command_explore, explored_scene, explored_studies, study_runs, http_server, httplib_server and the page, too.

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

const std::atomic<bool> goes_on = false;

/// An explorer at a port, without a network.
struct Page {
  TemporaryDirectory folder;
  Explorer explorer;
  std::map<std::string, std::string> nothing;
  int wishes = 0;

  explicit Page(const Evaluate& evaluate, const std::string& scene = "")
      : explorer({.scene = scene, .database = folder / "results.db", .folder = folder.path, .stop = goes_on},
                 evaluate) {
    explorer.be_at(8000);
  }
  HttpReply get(const std::string& what, const std::map<std::string, std::string>& query = {}) {
    return explorer({"GET", "/" + explorer.token() + "/" + what, query, "127.0.0.1:8000", "", ""});
  }
  Json read(const std::string& what, const std::map<std::string, std::string>& query = {}) {
    return Json::parse(get(what, query).body);
  }
  Json post(const std::string& what, Json body) {
    if (!body.contains("wish")) body["wish"] = {{"page", "one"}, {"view", what}, {"number", ++wishes}};
    const HttpReply reply = explorer(
        {"POST", "/" + explorer.token() + "/" + what, {}, "127.0.0.1:8000", "http://127.0.0.1:8000", body.dump()});
    CHECK(reply.status == 200);
    return Json::parse(reply.body);
  }
};

const Json plain = {{"radius", 0.1},         {"layer_thickness", "1 cm"},
                    {"material", "elastic"}, {"static_shear_modulus", "1 MPa"},
                    {"load", "10 kN/m"},     {"speed", "36 km/h"}};

Json without_seconds(Json answer) {
  answer.erase("seconds");
  return answer;
}

}  // namespace

TEST_CASE("a page is opened by its address alone, and by no page of another host", "[studies][explore]") {
  Page page(closed_form);
  const std::string token = page.explorer.token(), path = "/" + token + "/start";
  CHECK(token.size() == 32);
  CHECK(Page(closed_form).explorer.token() != token);
  const auto status = [&](const std::string& asked, const std::string& host, const std::string& origin) {
    return page.explorer({"GET", asked, {}, host, origin, ""}).status;
  };
  CHECK(status(path, "127.0.0.1:8000", "") == 200);
  CHECK(status(path, "localhost:8000", "http://localhost:8000") == 200);
  for (const char* const host : {"evil.example:8000", "127.0.0.1", "127.0.0.1:8001", ""})
    CHECK(status(path, host, "") == 403);
  for (const char* const origin : {"http://evil.example", "null", "https://127.0.0.1:8000"})
    CHECK(status(path, "127.0.0.1:8000", origin) == 403);
  std::string wrong = token;
  wrong.back() = wrong.back() == '0' ? '1' : '0';
  for (const std::string& asked :
       {std::string("/"), std::string(""), "/" + wrong + "/start", "/" + token.substr(0, 31) + "/start",
        "/" + token + "0/start", std::string("//start")})
    CHECK(status(asked, "127.0.0.1:8000", "") == 403);
  CHECK(status("/" + token + "/../../etc/passwd", "127.0.0.1:8000", "") == 404);
  const HttpReply refused = page.explorer({"GET", "/", {}, "evil.example", "", ""});
  CHECK(refused.body.find(token) == std::string::npos);
  CHECK_THAT(page.get("").headers.at("Content-Security-Policy"), Contains("default-src 'none'") && !Contains("unsafe"));
}

TEST_CASE("a request that no page makes is a bad one, and a refused value is an answer", "[studies][explore]") {
  Page page(closed_form);
  const auto status = [&](const std::string& what, const std::string& body) {
    return page.explorer({"POST", "/" + page.explorer.token() + "/" + what, {}, "127.0.0.1:8000", "", body}).status;
  };
  const std::string wish = R"("wish": {"page": "one", "view": "answer", "number": 1})";
  CHECK(status("nowhere", "{}") == 404);
  for (const std::string body : {"", "[1]", "{\"scene\"", "{}", "\xff\xfe"}) CHECK(status("answer", body) == 400);
  CHECK(status("answer", "{" + wish + "}") == 400);
  CHECK(status("answer", R"({"scene": {"load": -1}, )" + wish + "}") == 200);
  CHECK(status("answer", "{\"scene\": " + plain.dump() + ", " + wish + "}") == 200);
}

TEST_CASE("a page is told what the program answers to the same file, to the last digit", "[studies][explore]") {
  Page page(solve);
  Json layered = plain;
  layered["stiffening"] = 1;
  layered["creep_time"] = "5 ms";
  layered["material"] = "zener";
  layered["lower_layers"] = {
      {{"layer_thickness", "10 mm"}, {"static_shear_modulus", "10 MPa"}, {"material", "elastic"}}};
  for (const Json& scene :
       {read_object((source_directory() / "studies/examples/paper_cylinder.json").string()), layered}) {
    const RollingScene read = parse_scene(scene.dump(), "scene");
    const Json reply = page.post("answer", {{"scene", scene}});
    REQUIRE(!reply.contains("error"));
    CHECK(without_seconds(reply["answer"]) == without_seconds(Json::parse(solution_json(read, solve(read)))));
    // The pressure under the sketch bears the load.
    double load = 0;
    const Json& x = reply["surface"]["x"];
    for (std::size_t i = 1; i < x.size(); ++i)
      load += 0.5 * (x[i].get<double>() - x[i - 1].get<double>()) *
              (reply["surface"]["pressure"][i].get<double>() + reply["surface"]["pressure"][i - 1].get<double>());
    CHECK(load == Approx(reply["answer"]["load"].get<double>()).epsilon(0.03));  // of few nodes
  }
}

TEST_CASE("a curve has the answers of its points", "[studies][explore]") {
  Page page(closed_form);
  const Json curve = {{"x", "speed"}, {"y", "rolling_resistance"}, {"from", 0.1}, {"to", 10},
                      {"points", 5},  {"logarithmic", true}};
  const Json found = page.post("curve", {{"scene", plain}, {"curve", curve}});
  RollingScene scene = parse_scene(plain.dump(), "scene");
  REQUIRE(found["x"].size() == 5);
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(found["x"][i].get<double>() == Approx(std::pow(10.0, -1 + 0.5 * static_cast<double>(i))));
    scene.speed = found["x"][i].get<double>();
    CHECK(found["y"][i].get<double>() == closed_form(scene).rolling_resistance);
  }
  const auto refusal = [&](const char* key, const Json& value) {
    Json wrong = curve;
    wrong[key] = value;
    return page.post("curve", {{"scene", plain}, {"curve", wrong}})["error"].get<std::string>();
  };
  CHECK_THAT(refusal("x", "indenter"), Contains("x = \"indenter\": must be a number of a scene"));
  CHECK_THAT(refusal("y", "status"), Contains("must be a number of an answer"));
  CHECK_THAT(refusal("from", -1), Contains("from = -1: must be > 0"));
  CHECK_THAT(refusal("to", 0.01), Contains("must be above from"));
  CHECK_THAT(refusal("points", 100000), Contains("points"));
}

TEST_CASE("a refused value is said at its field, in the program's words", "[studies][explore]") {
  Page page(closed_form);
  Json wrong = plain;
  wrong["load"] = "-1 N/m";
  const Json reply = page.post("answer", {{"scene", wrong}});
  CHECK(reply["key"] == "load");
  CHECK_THAT(reply["error"].get<std::string>(), Contains("load = \"-1 N/m\": must be > 0"));
  Json missing = plain;
  missing.erase("speed");
  CHECK(page.post("answer", {{"scene", missing}})["key"] == "speed");
  Json file = plain;
  file["master_curve_file"] = "/etc/passwd";
  const std::string words = page.post("answer", {{"scene", file}})["error"];
  CHECK_THAT(words, Contains("master_curve_file") && !Contains("root:"));
}

TEST_CASE("tables below the folder are offered, no hidden ones", "[studies][explore]") {
  Page page(closed_form);
  std::filesystem::create_directories(page.folder / "lab/.secret");
  page.folder.write("rubber.csv", "");
  page.folder.write("rubber.txt", "");
  page.folder.write("lab/sheet.csv", "");
  page.folder.write("lab/.secret/other.csv", "");
  CHECK(page.read("files")["files"] == Json{"lab/sheet.csv", "rubber.csv"});
}

TEST_CASE("a newer wish ends the solution of an older one", "[studies][explore]") {
  std::atomic<int> begun = 0;
  Page page([&](const RollingScene& scene) {
    if (scene.speed > 1) return closed_form(scene);
    ++begun;
    const SolutionLimits limits(1e9);
    for (;;) require_time();  // until somebody interrupts it
  });
  Json slow = plain;
  slow["speed"] = 0.5;
  const auto wish = [](int number) { return Json{{"page", "one"}, {"view", "answer"}, {"number", number}}; };
  Json first;
  std::thread other([&] { first = page.post("answer", {{"scene", slow}, {"wish", wish(1)}}); });
  while (begun == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const Json second = page.post("answer", {{"scene", plain}, {"wish", wish(2)}});
  other.join();
  CHECK(first["superseded"] == true);
  CHECK(second["answer"]["status"] == "converged");
  CHECK(page.post("answer", {{"scene", slow}, {"wish", wish(1)}})["superseded"] == true);  // too late
  CHECK(begun == 1);
}

TEST_CASE("a sphere is answered coarsely first", "[studies][explore]") {
  Page page(solve);
  Json scene = read_object((source_directory() / "studies/examples/paper_sphere.json").string());
  scene.erase("friction_coefficient");
  const Json first = page.post("answer", {{"scene", scene}, {"coarse", true}}),
             last = page.post("answer", {{"scene", scene}});
  CHECK(first["coarse"] == true);
  CHECK(last["coarse"] == false);
  CHECK(first["answer"]["contact_nodes"] < last["answer"]["contact_nodes"]);
  const double coarse = first["answer"]["rolling_resistance"], error = first["answer"]["rolling_resistance_error"];
  CHECK(std::abs(coarse - last["answer"]["rolling_resistance"].get<double>()) < 2 * error);
}

TEST_CASE("every input and output of the program is on the page, each in a group", "[studies][explore]") {
  const Json list = Page(closed_form).read("start")["quantities"];
  std::set<std::string> keys;
  for (const Json& input : list["inputs"]) {
    CHECK(!input["group"].get<std::string>().empty());
    keys.insert(input["key"]);
  }
  const RollingScene scene;
  visit_inputs(scene, [&](const Quantity& quantity, const auto&, const auto&...) {
    CHECK(keys.count(std::string(quantity.key)) == 1);
  });
  CHECK(list["outputs"].front()["key"] == "rolling_resistance");
}

TEST_CASE("stored studies are charts, rows a screen at a time, points and reports", "[studies][explore]") {
  Page page(closed_form);
  CHECK(page.read("studies")["studies"].empty());
  const Study study{.name = "two loads",
                    .base = plain_scene(),
                    .axes = {{.key = "load", .values = {1e4, 2e4}}, {.key = "speed", .values = {0.1, 0.2, 0.3, 0.4}}}};
  run_sweep(study, closed_form, page.folder / "results.db");
  CHECK(page.read("studies")["studies"][0]["answered"] == 8);
  const Json chart = page.read("chart", {{"study", "two loads"}, {"x", "speed"}});
  CHECK(chart["curves"].size() == 2);
  CHECK(chart["curves"][0]["points"].size() == 4);
  CHECK(page.read("chart", {{"study", "two loads"}})["keys"] == Json{{"x", "speed"}, {"families", {"load"}}});
  const Json rows = page.read("rows", {{"study", "two loads"}, {"offset", "5"}, {"limit", "2"}, {"sort", "-speed"}});
  CHECK(page.read("count", {{"study", "two loads"}})["all"] == 8);
  CHECK(rows["rows"].size() == 2);
  const Json all = page.read("rows", {{"study", "two loads"}, {"sort", "-speed"}});
  CHECK(rows["rows"][0] == all["rows"][5]);
  CHECK(page.read("count", {{"study", "two loads"}, {"where", "load=20 kN/m\nspeed>0.25"}})["all"] == 2);
  CHECK(page.read("rows", {{"study", "two loads"}, {"where", "load=20 kN/m\nspeed>0.25"}})["rows"].size() == 2);
  const Json point = page.read("point", {{"id", all["rows"][0][0].dump()}});
  CHECK(point["scene"]["speed"] == 0.4);
  CHECK_THAT(page.read("point", {{"id", "99"}})["error"].get<std::string>(), Contains("id = 99: no evaluation has it"));
  CHECK_THAT(page.read("rows", {{"study", "two loads"}, {"offset", "-1"}})["error"].get<std::string>(),
             Contains("offset = -1"));
  const HttpReply report = page.get("report", {{"study", "two loads"}});
  CHECK_THAT(report.body, Contains("<!DOCTYPE html>"));
  CHECK_THAT(report.headers.at("Content-Security-Policy"), Contains("sandbox") && !Contains("'self';"));
}

TEST_CASE("a study of a page names no files and takes no other study's file", "[studies][explore]") {
  Page page(closed_form);
  const auto refusal = [&](const Json& study) {
    return page.post("run", {{"study", study}})["error"].get<std::string>();
  };
  const Json good = {{"study", "explored"}, {"scene", plain}, {"axes", {{"load", {"10 kN/m", "20 kN/m"}}}}};
  const auto with = [&](const char* key, const Json& value) {
    Json study = good;
    study[key] = value;
    return study;
  };
  CHECK_THAT(refusal(with("study", "../explored")), Contains("without /"));
  CHECK_THAT(refusal(with("scene", "/etc/passwd")), !Contains("root:"));
  CHECK_THAT(refusal(with("variants", Json::array({{{"name", "a"}}}))), Contains("variants"));
  CHECK_THAT(refusal(with("axes", {{"master_curve_file", {"/etc/passwd"}}})), Contains("must be an input of a scene"));
  CHECK_THAT(refusal(with("axes", {{"load", {-1}}})), Contains("load"));
  CHECK(!std::filesystem::exists(page.folder / "explored.json"));
  page.folder.write("explored.json", "{}");
  CHECK_THAT(refusal(good), Contains("holds another study"));
  CHECK(page.read("runs") == Json::array());
}

TEST_CASE("the page is used by hand in a browser", "[studies][explore][browser][long]") {
  std::string browser;
  for (const char* const name : {"chromium", "chromium-headless-shell"})
    if (installed(name)) browser = name;
  if (browser.empty() || !installed("python3")) {
    WARN("Chromium or Python is not installed");
    return;
  }
  const TemporaryDirectory folder;
  const ShellRun run =
      run_shell("cd " + shell_word(folder.path.string()) + " && PYTHONDONTWRITEBYTECODE=1 timeout 170 python3 " +
                shell_word((source_directory() / "tests/studies/explore/explore_page.py").string()) + " " +
                shell_word(rollres_program()) + " " + browser);
  INFO(run.out);
  CHECK(run.status == 0);
}
