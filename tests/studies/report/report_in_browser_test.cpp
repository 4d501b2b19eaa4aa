// Reports in Chromium, where it is installed: browser_checks.js looks for what is cut off, too wide, too pale, without
// words or without an answer to the mouse, at three widths.

#include "db/rows/fit_store.hpp"
#include "db/rows/result_store.hpp"
#include "db/rows/schema.hpp"
#include "studies/report/report.hpp"
#include "studies/run/sweep.hpp"
#include "studies/text/strict_json.hpp"
#include "studies/text/words.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/source_directory.hpp"
#include "tests/studies/program.hpp"
#include "tests/studies/shell.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers report_look, chart_overlay and html, too.

using namespace rollres;
using Catch::Matchers::Contains;

namespace {

/// The browser as Debian calls it; empty where there is none.
std::string browser() {
  for (const char* const name : {"chromium-headless-shell", "chromium"})
    if (installed(name)) return name;
  return "";
}

class Browser {
 public:
  explicit Browser(const TemporaryDirectory& scratch) : scratch_(scratch) {}

  /// What it prints of a page.
  std::string open(const std::string& options, const std::string& page) const {
    const std::string file = scratch_.write("page.html", page).string();
    return run_shell("cd " + shell_word(scratch_.path.string()) + " && HOME=. timeout 100 " + browser() +
                     " --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --user-data-dir=profile "
                     "--enable-logging=stderr --virtual-time-budget=5000 " +
                     options + " " + shell_word("file://" + file))
        .out;
  }

  /// What the checks find in a report; the first line is "done" if all of them were made.
  std::string faults(const std::string& report, bool dark) const {
    std::string text = Json(report).dump();
    for (std::size_t at = 0; (at = text.find("</", at)) != std::string::npos; at += 3) text.insert(at + 1, "\\");
    const std::string out =
        open(std::string("--dump-dom --blink-settings=preferredColorScheme=") + (dark ? "0" : "1"),
             "<!DOCTYPE html><meta charset=\"utf-8\"><pre id=\"found\"></pre><script>const report = " + text + ";\n" +
                 file_text(source_directory() / "tests/studies/report/browser_checks.js") + "</script>");
    const std::string mark = "<pre id=\"found\">";
    const std::size_t begin = out.find(mark) + mark.size();
    const std::string errors = out.find("CONSOLE") == std::string::npos ? "" : "an error of the script\n";
    return errors + out.substr(begin, out.find("</pre>") - begin);
  }

 private:
  const TemporaryDirectory& scratch_;
};

/// A fit with all that can be drawn of one.
FitRecord drawn_fit() {
  FitRecord fit{};
  fit.name = "felt";
  fit.status = "GOOD";
  fit.deviations_known = true;
  fit.degrees = 4;
  fit.reduced_chi_squared = fit.chi_squared = fit.p_value = fit.rms = 1;
  fit.profile_threshold = 3.84;
  fit.x_name = "speed";
  fit.x_unit = "m/s";
  fit.y_name = "rolling resistance";
  fit.y_unit = "N/m";
  fit.parameters = {{.name = "static_shear_modulus",
                     .unit = "Pa",
                     .value = 3e6,
                     .standard_error = 2e5,
                     .relative_error = 0.07,
                     .linear_lowest = 2.6e6,
                     .linear_highest = 3.4e6},
                    {.name = "creep_time",
                     .unit = "s",
                     .value = 0.25,
                     .standard_error = 0.01,
                     .relative_error = 0.04,
                     .linear_lowest = 0.23,
                     .linear_highest = 0.27}};
  fit.correlations = {{"static_shear_modulus", "creep_time", -0.8}};
  for (int i = 0; i < 6; ++i) {
    const double x = 0.1 * (i + 1);
    const double residual = i == 3 ? 4 : 0.5 * (i % 3 - 1);
    fit.data.push_back({"felt.csv, line 2", 20 + x - residual, 1, 20 + x, residual, 0.2, x, 0});
    fit.curves.push_back({0, "", x, 20 + x, 0.4});
    fit.profiles.push_back({"creep_time", 0.22 + 0.01 * i, 10 * (0.1 * i - 0.3) * (0.1 * i - 0.3)});
  }
  return fit;
}

}  // namespace

TEST_CASE("reports are read on a phone, in the dark and on paper, and their charts zoom",
          "[studies][report][browser][long]") {
  if (browser().empty()) {
    WARN("Chromium is not installed");
    return;
  }
  const TemporaryDirectory scratch;
  const std::string file = (scratch / "results.db").string();
  run_sweep(Study{.name = "speed and load",
                  .base = plain_scene(),
                  .axes = {{.key = "load", .values = {1e4, 2e4, 3e4}},
                           {.key = "speed", .values = {0.01, 0.1, 1, 10}, .logarithmic = true}}},
            closed_form, file);
  save_fit(open_database(file, Access::write), drawn_fit());
  ResultStore store(file, Access::read);
  const Browser chromium(scratch);
  const std::string study = study_report(store, {.study = "speed and load"}).html;
  const std::string found = chromium.faults(study, false);
  CHECK_THAT(found, Contains("\ndone\n") && !Contains("fault") && !Contains("error of the script"));
  for (const char* const width : {"400", "768", "1200"})
    CHECK_THAT(found, Contains(std::string(width) + " px: 1 charts zoom, 2 pictures, light"));
  const std::string fit = study_report(store, {.study = "felt"}).html;
  const std::string in_the_dark = chromium.faults(fit, true);
  CHECK_THAT(in_the_dark, Contains("\ndone\n") && !Contains("fault") && !Contains("error of the script"));
  for (const char* const width : {"400", "768", "1200"})
    CHECK_THAT(in_the_dark, Contains(std::string(width) + " px: 6 charts zoom, 6 pictures, dark"));
  chromium.open("--print-to-pdf=report.pdf --no-pdf-header-footer", study);
  const std::string pdf = file_text(scratch / "report.pdf");
  CHECK(pdf.starts_with("%PDF"));
  std::size_t pages = 0;
  for (std::size_t at = 0; (at = pdf.find("/Type /Page\n", at)) != std::string::npos; ++at) ++pages;
  CHECK(pages >= 1);
  CHECK(pages <= 4);
}

TEST_CASE("reports of optimisations and of inputs that scatter are read on a phone and in the dark",
          "[studies][report][browser][long]") {
  if (browser().empty()) {
    WARN("Chromium is not installed");
    return;
  }
  const TemporaryDirectory scratch;
  const std::string scene = R"("scene": {"radius": 0.1, "layer_thickness": 0.01, "static_shear_modulus": 1e6,
    "material": "elastic", "load": 1e4, "speed": 1}, )";
  const auto report = [&](const std::string& command, const std::string& text) {
    const std::string file = (scratch / (command + ".db")).string();
    const auto study = scratch.write(command + ".json", R"({"study": "felt", )" + scene + text + "}");
    REQUIRE(run_rollres({command, study.string(), "--db", file}, closed_form).status == 0);
    ResultStore store(file, Access::read);
    return study_report(store, {}).html;
  };
  const std::string optimum = report("optimise", R"("variables": {"load": {"from": 1e4, "to": 4e4, "start": 3e4},
    "speed": {"from": 0.1, "to": 0.9, "start": 0.5}}, "minimise": "rolling_resistance",
    "constraints": ["load * speed >= 6000"])");
  const std::string scatter = report("scatter", R"("axes": {"speed": [0.5, 1, 2]},
    "uncertain": {"load": {"normal": "5 %"}, "points": 64})");
  const Browser chromium(scratch);
  for (const auto& [page, dark] : {std::pair(optimum, true), {scatter, false}}) {
    const std::string found = chromium.faults(page, dark);
    CHECK_THAT(found, Contains("\ndone\n") && !Contains("fault") && !Contains("error of the script"));
    CHECK_THAT(found, Contains("400 px: ") && Contains("768 px: ") && Contains("1200 px: "));
  }
}
