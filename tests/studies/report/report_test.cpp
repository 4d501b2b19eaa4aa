#include "studies/report/report.hpp"

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <stdexcept>

#include "db/rows/fit_store.hpp"
#include "db/rows/schema.hpp"
#include "studies/report/chart_overlay.hpp"
#include "studies/report/html.hpp"
#include "studies/report/report_look.hpp"
#include "studies/run/sweep.hpp"
#include "studies/text/readable_number.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers report_slices, html, xml_text, chart_overlay, report_look, report_summary, report_tables, report_model,
// report_optimum, report_pictures and command_report, too.

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

/// What is wrong with the nesting of the tags, or nothing.
std::string fault_of(const std::string& page) {
  const std::set<std::string> without_end{"meta", "img", "polyline", "polygon"};
  std::vector<std::string> open;
  for (std::size_t at = page.find('<'); at != std::string::npos; at = page.find('<', at + 1)) {
    const std::size_t end = page.find('>', at);
    if (end == std::string::npos) return "a tag without an end";
    const std::string tag = page.substr(at + 1, end - at - 1), name = tag.substr(0, tag.find_first_of(" \n"));
    if (name == "!DOCTYPE" || without_end.contains(name)) continue;
    if (name == "script") at = page.find("</script>", at) - 1;  // in it < is a sign
    if (name.front() != '/')
      open.push_back(name);
    else if (open.empty() || open.back() != name.substr(1))
      return name + " closes " + (open.empty() ? "nothing" : open.back());
    else
      open.pop_back();
  }
  return open.empty() ? "" : open.back() + " stays open";
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

RollingSolution with_evidence(const RollingScene& scene) {
  RollingSolution solution = closed_form(scene);
  if (scene.speed > 50) {
    solution = RollingSolution();
    solution.status = Status::no_steady_state;
    solution.reason = "friction <too> small & slow";
    return solution;
  }
  solution.viscous_loss = 0.8 * solution.rolling_resistance * scene.speed;
  solution.frictional_loss = 0.2 * solution.rolling_resistance * scene.speed;
  solution.error_estimate = 0.05;
  solution.model = scene.speed > 5 ? "inertia left out" : "friction as given";
  solution.assumptions = {"no inertia (ρV²/|G| = 0.1): without it R_r +2 %", "plane strain"};
  solution.model_error = 0.02;
  solution.warnings = {"strain d/H = 0.2"};
  return solution;
}

Study speed_and_load(const std::string& name) {
  return {.name = name,
          .base = plain_scene(),
          .axes = {{.key = "load", .values = {1e4, 2e4, 3e4, 4e4}},
                   {.key = "speed", .values = {0.01, 0.1, 1, 10, 100}, .logarithmic = true}}};
}

std::string stored(const TemporaryDirectory& scratch, Study study) {
  study.definition = R"({"study": "x", "comment": "<script>alert(1)</script>"})";
  run_sweep(study, with_evidence, scratch / "results.db");
  return (scratch / "results.db").string();
}

}  // namespace

TEST_CASE("a report holds all that is known of a study in one file that stands by itself", "[studies][report]") {
  const TemporaryDirectory scratch;
  const std::string file = stored(scratch, speed_and_load("speed and load"));
  const ProgramRun run =
      run_rollres({"report", "--db", file, "--out", (scratch / "new" / "report.html").string()}, closed_form);
  CHECK(run.err.empty());
  REQUIRE(run.status == 0);
  CHECK_THAT(run.out, Contains("report.html: speed and load, 5 pictures"));
  const std::string page = file_text(scratch / "new" / "report.html");
  CHECK(fault_of(page).empty());
  for (const char* heading :
       {"Summary", "Charts", "Scene", "Model", "Results", "Failures", "Speed and accuracy", "Provenance"})
    CHECK_THAT(page, Contains("<h2>" + std::string(heading) + "</h2>"));
  CHECK_THAT(page, Contains("<details><summary>Study file</summary>"));
  CHECK(page.find("<h2>Provenance</h2>") > page.find("<h2>Speed and accuracy</h2>"));
  CHECK_THAT(page, Contains("20 scenes of a rolling cylinder: load 10 kN/m, 20 kN/m, 30 kN/m, 40 kN/m; speed from 10 "
                            "mm/s to 100 m/s (5 values). The rolling resistance lies between "));
  CHECK_THAT(page, Contains("16 points converged, 4 have no answer; the estimated relative error"));
  CHECK_THAT(page, Contains("; what the model assumes costs 2 % in the median and 2 % at most."));
  CHECK_THAT(page, Contains("20 points: 16 converged, 4 without an answer, 0 not computed yet"));
  CHECK_THAT(page, Contains("<td>layer thickness</td><td>H</td><td>10 mm</td>"));
  CHECK_THAT(page, Contains("rolling resistance R_r [N/m]"));
  CHECK_THAT(page, Contains("<td>inertia left out</td><td class=\"number\">4</td>"));
  CHECK_THAT(page, Contains("<td>strain d/H = 0.2</td><td class=\"number\">16</td>"));
  CHECK_THAT(page, Contains("<td>plane strain</td><td class=\"number\">16</td>") && Contains("without it R_r +2 %") &&
                       Contains("what the model&#39;s assumptions cost of R_r"));
  CHECK_THAT(page, Contains(" and 200 N/m (load = 40 kN/m, speed = 1 m/s)."));
  // Failures of one reason are one row, with where they lie.
  CHECK_THAT(page, Contains("<td>no steady state: friction &lt;too&gt; small &amp; slow</td><td class=\"number\">4</td>"
                            "<td>load = 10 kN/m to 40 kN/m, speed = 100 m/s</td>"));
  CHECK_THAT(page, Contains(this_program().compiler));
  CHECK(count_of(page, "<img ") == 5);
  CHECK(count_of(page, "<img alt=\"") == 5);
  CHECK(count_of(page, "src=\"data:image/svg+xml") == 5);
  CHECK(count_of(page, "src=") == 5);
  CHECK(count_of(page, "<script>") == 1);
  CHECK(count_of(page, "<h1>") == 1);
  for (const char* outside : {"href=", "<script ", "<link", "<iframe", "@import"}) CHECK_THAT(page, !Contains(outside));
  CHECK(count_of(page, "url(") == count_of(page, "url(#"));  // parts of the page itself
}

TEST_CASE("a report draws slices of a study of five axes, or those that were asked for", "[studies][report]") {
  const TemporaryDirectory scratch;
  Study study{.name = "five axes",
              .base = plain_scene(),
              .axes = {{.key = "load", .values = {1e4, 2e4, 3e4}},
                       {.key = "speed", .values = {0.01, 0.1, 1, 10}, .logarithmic = true},
                       {.key = "layer_thickness", .values = {0.01, 0.02, 0.03}},
                       {.key = "radius", .values = {0.1, 0.2, 0.3}},
                       {.key = "friction_coefficient", .values = {0.1, 0.2, 0.3, 0.4}}}};
  const std::string file = stored(scratch, study);
  const auto report_with = [&](std::vector<std::string> options) {
    const std::string out = (scratch / "report.html").string();
    options.insert(options.begin(), {"report", "--db", file, "--out", out});
    const ProgramRun run = run_rollres(options, closed_form);
    CHECK(run.err.empty());
    REQUIRE(run.status == 0);
    return file_text(out);
  };
  const std::string page = report_with({});
  CHECK(page.size() < 3'000'000);
  CHECK_THAT(page, !Contains("Not drawn"));
  for (const char* along : {"load", "speed", "layer thickness", "radius", "friction coefficient"})
    CHECK_THAT(page, Contains("<figcaption>rolling resistance against " + std::string(along) + ", by "));
  CHECK_THAT(page, Contains("<figcaption>rolling resistance against speed, by friction coefficient at load = 20 kN/m, "
                            "layer thickness = 20 mm, radius = 200 mm</figcaption>"));

  const std::string wished = report_with({"--x", "radius", "--family", "load", "--where", "speed=0.1 m/s"});
  CHECK(count_of(wished, "<figcaption>rolling resistance against ") == 1);
  CHECK_THAT(wished, Contains("<figcaption>rolling resistance against radius, by load at friction coefficient = 0.3, "
                              "layer thickness = 20 mm</figcaption>"));
}

TEST_CASE("a report shows a master curve as a picture and in short", "[studies][report]") {
  const TemporaryDirectory scratch;
  Study study = speed_and_load("rubber");
  study.base.material = MaterialModel::master_curve;
  study.base.frequencies = {1, 10, 100, 1e3, 1e4, 1e5, 1e6};
  study.base.storage_moduli = {4.5e6, 5e6, 6e6, 1e7, 3e7, 1e8, 3.94e8};
  study.base.loss_moduli = {1e5, 2e5, 5e5, 2e6, 1e7, 4e7, 8e7};
  ResultStore store(stored(scratch, study), Access::read);
  const std::string page = study_report(store, {}).html;
  CHECK_THAT(page, Contains("<td>7 values, 4.5 MPa to 394 MPa</td>"));
  CHECK(count_of(page, "<figcaption>The master curve of the layer, 7 values</figcaption>") == 1);
}

TEST_CASE("a chart of a report tells the numbers of its points and shows one curve alone", "[studies][report][long]") {
  const TemporaryDirectory scratch;
  ResultStore store(stored(scratch, speed_and_load("speed and load")), Access::read);
  const std::string page = study_report(store, {}).html;
  CHECK_THAT(page,
             Contains("<title>rolling resistance 200 N/m\nspeed 1 m/s\nload 40 kN/m\nestimated error ± 10</title>"));
  CHECK(count_of(page, "aria-pressed=\"false\" data-curve=\"3\"") >= 1);
  CHECK_THAT(page, Contains("</i>40 kN/m</button>"));
  // The point lies where gnuplot drew it: at the ring of the peak.
  const ChartRequest request{
      .title = "t", .x = {.name = "x"}, .y = {.name = "y"}, .curves = {{"", {{0, 0}, {1, 2}, {4, 1}}}}};
  const std::string svg = file_text(draw_chart(request, scratch / "chart").svg);
  const std::string layer = chart_overlay(request, svg).layer;
  std::smatch ring, point;
  const std::regex ring_of("transform='translate\\(([0-9.]+),([0-9.]+)\\) scale\\(8"),
      point_of("<circle cx=\"([0-9.]+)\" cy=\"([0-9.]+)\" r=\"6\"><title>y 2\nx 1</title>");
  REQUIRE(std::regex_search(svg, ring, ring_of));
  REQUIRE(std::regex_search(layer, point, point_of));
  CHECK(std::stod(point[1]) == Approx(std::stod(ring[1])).margin(0.3));
  CHECK(std::stod(point[2]) == Approx(std::stod(ring[2])).margin(0.3));
}

TEST_CASE("letters of a report have a contrast of 4.5 on light and dark screens", "[studies][report]") {
  const std::string style(html::style());
  const std::size_t dark = style.find("prefers-color-scheme: dark");
  REQUIRE(dark != std::string::npos);
  const auto luminance = [&](const std::string& name, std::size_t from) {
    const std::size_t at = style.find("--" + name + ": #", from);
    REQUIRE(at != std::string::npos);
    std::string hex = style.substr(at + name.size() + 5, 6);
    if (hex.find(';') == 3) hex = {hex[0], hex[0], hex[1], hex[1], hex[2], hex[2]};
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double part = std::stoi(hex.substr(2 * i, 2), nullptr, 16) / 255.0, weights[] = {0.2126, 0.7152, 0.0722};
      sum += weights[i] * (part <= 0.03928 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4));
    }
    return sum;
  };
  for (const std::size_t from : {std::size_t{0}, dark})
    for (const auto& [letters, ground] :
         {std::pair("text", "page"), std::pair("soft", "page"), std::pair("accent", "page"), std::pair("text", "card"),
          std::pair("text", "mark"), std::pair("page", "accent")}) {
      CAPTURE(letters, ground, from);
      const double a = luminance(letters, from), b = luminance(ground, from);
      CHECK((std::max(a, b) + 0.05) / (std::min(a, b) + 0.05) >= 4.5);
    }
}

TEST_CASE("a long table is folded, a short one is not", "[studies][report][long]") {
  const TemporaryDirectory scratch;
  Study study = speed_and_load("long");
  study.axes[1].values.clear();
  for (int i = 1; i <= 10; ++i) study.axes[1].values.push_back(0.1 * i);
  ResultStore store(stored(scratch, study), Access::read);
  CHECK_THAT(study_report(store, {}).html, Contains("<details><summary>Table of 40 points</summary>"));
  CHECK_THAT(study_report(store, {.most_rows = 10}).html, !Contains("<details><summary>Table of"));
}

TEST_CASE("texts of a study cannot become markup of its report", "[studies][report]") {
  const TemporaryDirectory scratch;
  const std::string name = "<b onclick='x()'>\"A&B\"</b>";
  const std::string file = stored(scratch, speed_and_load(name));
  ResultStore store(file, Access::read);
  const std::string page = study_report(store, {.study = name}).html;
  CHECK(fault_of(page).empty());
  CHECK_THAT(page, Contains("<title>&lt;script&gt;alert(1)&lt;/script&gt;</title>") && Contains("&lt;b onclick=") &&
                       Contains("&quot;A&amp;B&quot;&lt;/b&gt;"));
  CHECK_THAT(page, !Contains("<b onclick"));
  CHECK_THAT(page, Contains("friction &lt;too&gt; small &amp; slow"));
  CHECK_THAT(page, Contains("&lt;script&gt;alert(1)&lt;/script&gt;"));
  CHECK(count_of(page, "<script") == 1);
}

TEST_CASE("escaped text is UTF-8 without control characters", "[studies][report]") {
  CHECK(html::text("a<b>&\"'") == "a&lt;b&gt;&amp;&quot;&#39;");
  CHECK(html::text("τ µm² 𝛼") == "τ µm² 𝛼");
  CHECK(html::text("a\x01\x7f\n\tb") == "a  \n\tb");
  CHECK(html::text("\xff") == "\uFFFD");
  CHECK(html::text("\xc0\xaf") == "\uFFFD\uFFFD");            // longer than need be
  CHECK(html::text("\xed\xa0\x80") == "\uFFFD\uFFFD\uFFFD");  // half of a pair
  CHECK(html::text("\xe2\x82") == "\uFFFD\uFFFD");            // cut off
}

TEST_CASE("the table of a long study shows every n-th point and says so", "[studies][report][long]") {
  const TemporaryDirectory scratch;
  ResultStore store(stored(scratch, speed_and_load("long")), Access::read);
  const std::string page = study_report(store, {.most_rows = 7}).html;
  CHECK_THAT(page, Contains("Shown is one of every 3 points, of 20."));
  CHECK(count_of(page, "<td>converged</td></tr>") + count_of(page, "<td>no steady state</td></tr>") == 7);
}

TEST_CASE("a fit of the study's name is in its report, and has one of its own without a study", "[studies][report]") {
  const TemporaryDirectory scratch;
  const std::string file = stored(scratch, speed_and_load("rubber"));
  FitRecord fit{};
  fit.name = "rubber";
  fit.kind = "resistance";
  fit.definition = R"({"fit": "rubber"})";
  fit.status = "usable_with_warnings";
  fit.warnings = "creep_time < start";
  FitParameterRecord& parameter = fit.parameters.emplace_back();
  parameter.name = "creep_time";
  parameter.unit = "s";
  parameter.value = 0.25;
  parameter.flag = "<flag>";
  fit.data = {{"data.csv, line 2", 100, 1, 101, 1, 0.5}, {"data.csv, line 3", 120, 1, 116, -4, 0.5}};
  save_fit(open_database(file, Access::write), fit);
  fit.name = "alone";
  parameter.flag.clear();
  save_fit(open_database(file, Access::write), fit);

  ResultStore store(file, Access::read);
  const StudyReport both = study_report(store, {.study = "rubber"});
  CHECK(fault_of(both.html).empty());
  CHECK(both.pictures == 7);
  CHECK_THAT(both.html,
             Contains("<h2>Results</h2>") && Contains("<h2>Fit</h2>") && Contains("<summary>Fit file</summary>"));
  CHECK_THAT(both.html, Contains("<td>creep time</td><td class=\"number\">250 ms</td>") && Contains("<th>flag</th>") &&
                            Contains("&lt;flag&gt;"));
  CHECK_THAT(both.html, Contains("<tr class=\"marked\"><td>data.csv, line 3</td>"));  // four deviations away
  const StudyReport alone = study_report(store, {.study = "alone"});
  CHECK(fault_of(alone.html).empty());
  CHECK_THAT(alone.html, Contains("The fit of 2 measurements is usable with warnings: creep time = 250 ms") &&
                             !Contains("<h2>Results</h2>") && !Contains("<th>flag</th>"));
}

TEST_CASE("the report of an optimisation opens with the best design within its constraints, and what holds it back",
          "[studies][report]") {
  const TemporaryDirectory scratch;
  const auto file =
      scratch.write("design.json", R"({"study": "design", "scene": {"radius": 0.1, "layer_thickness": 0.01,
    "static_shear_modulus": 1e6, "material": "elastic", "load": 1e4, "speed": 1}, "variables": {
    "load": {"from": 1e4, "to": 4e4, "start": 3e4}, "speed": {"from": 0.1, "to": 0.9, "start": 0.5}},
    "compute": [{"power": "load * speed"}], "scenes": [{"set": {"radius": 0.1}, "weight": 2}],
    "minimise": "rolling_resistance", "constraints": ["load * speed >= 6000"]})");
  const std::string database = (scratch / "results.db").string();
  REQUIRE(run_rollres({"optimise", file.string(), "--db", database}, closed_form).status == 0);
  ResultStore store(database, Access::read);
  const StudyReport report = study_report(store, {});
  CHECK(fault_of(report.html).empty());
  CHECK_THAT(report.html,
             Contains("The least rolling resistance within the constraints is ") &&
                 Contains("It is held back by load * speed ≥ 6000, where 1 % more room would lower it by ") &&
                 Contains("To first order no design near it is better.") && Contains("<h2>Best design</h2>") &&
                 Contains("<td>load * speed ≥ 6000</td>") && Contains("<td>reached</td>") &&
                 Contains("<td>power</td><td>load * speed</td>") &&
                 Contains("<td>radius = 0.1</td><td class=\"number\">2</td>") &&
                 Contains("The best design, to scale: ") && Contains("1 % more room is worth") &&
                 !Contains("The rolling resistance lies between"));
  CHECK(report.html.find("<h2>Best design</h2>") < report.html.find("<h2>Charts</h2>"));
}

TEST_CASE("the report of a choice names the variant of its best design, and has the best of each",
          "[studies][report]") {
  const TemporaryDirectory scratch;
  const auto file =
      scratch.write("choice.json", R"({"study": "choice", "scene": {"radius": 0.1, "layer_thickness": 0.01,
    "static_shear_modulus": 1e6, "material": "elastic", "speed": 1}, "variables": {
    "variant": {"heavy": {"load": 4e4}, "light": {"load": 1e4}},
    "speed": {"from": 0.1, "to": 0.9, "start": 0.5}},
    "minimise": "rolling_resistance"})");
  const std::string database = (scratch / "results.db").string();
  REQUIRE(run_rollres({"optimise", file.string(), "--db", database}, closed_form).status == 0);
  ResultStore store(database, Access::read);
  const std::string report = study_report(store, {}).html;
  CHECK_THAT(report, Contains("The best design, to scale: variant = light") && !Contains("variant = none"));
  // At the largest distance from the closed form's peak at 1 m/s each choice is best.
  for (const double load : {4e4, 1e4}) {
    const double best = closed_form(plain_scene(0.1, load)).rolling_resistance;
    CHECK_THAT(report, Contains(readable(best, "N/m") + "</td><td class=\"number\">" + readable(0.1, "m/s")));
  }
  CHECK_THAT(report, Contains("What the designs cost against speed"));
}

TEST_CASE("rollres report refuses what it cannot report", "[studies][report]") {
  const TemporaryDirectory scratch;
  const std::string file = stored(scratch, speed_and_load("speed and load"));
  const std::string out = (scratch / "report.html").string();
  const auto run = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "report");
    return run_rollres(words, closed_form);
  };
  CHECK(run({"--db", file, "--study", "sped and load", "--out", out}).status == 2);
  CHECK(run({"--db", file, "--out", out, "--rows", "0"}).status == 2);
  CHECK(run({"--db", file, "--out", ""}).status == 2);
  CHECK_THAT(run({"--db", file, "--out", (scratch / "report.pdf").string()}).err,
             Contains("report.pdf: .pdf cannot be written; possible: .html, .htm"));
  CHECK_THAT(run({"--db", file, "--out", out, "--optimum", "speed and load"}).err, Contains("is no optimisation"));
  CHECK(run({"--db", (scratch / "none.db").string(), "--out", out}).status == 3);
  CHECK(run({"--db", file, "--out", (scratch / "results.db" / "report.html").string()}).status == 3);
  CHECK_FALSE(std::filesystem::exists(out));
}
