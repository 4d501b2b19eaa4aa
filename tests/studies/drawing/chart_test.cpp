#include "studies/drawing/chart.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "studies/drawing/chart_frame.hpp"
#include "studies/drawing/colour_map.hpp"
#include "studies/drawing/gnuplot.hpp"
#include "studies/drawing/peak_values.hpp"
#include "tests/catch.hpp"
#include "tests/plain_scene.hpp"
#include "tests/studies/temporary_directory.hpp"

// Covers chart_frame, chart_script and peak_values, too.

using namespace rollres;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

ChartRequest two_loads() {
  return {.title = "speed and load",
          .x = {"speed", "V", "m/s", true},
          .y = {"rolling resistance", "R_r", "N/m"},
          .family = {"load", "P"},
          .curves = {{"10 kN/m", {{0.01, 20}, {0.1, 140}, {1, 60}, {10, 7}}},
                     {"20 kN/m", {{0.01, 60}, {0.1, 370}, {1, none, false}, {10, 20}}}}};
}

/// Writes a program that stands in for gnuplot.
fs::path stand_in(const TemporaryDirectory& folder, const std::string& commands) {
  const fs::path program = folder / "drawer";
  std::ofstream(program) << "#!/bin/sh\n" << commands << "\n";
  fs::permissions(program, fs::perms::owner_all);
  return program;
}

}  // namespace

TEST_CASE("a chart is drawn as SVG and PNG with its script and data beside them", "[studies][chart]") {
  const TemporaryDirectory folder;
  const ChartFiles files = draw_chart(two_loads(), folder / "new" / "chart.svg");

  CHECK(files.svg == folder / "new" / "chart.svg");
  CHECK(file_text(files.png).substr(0, 8) == "\x89PNG\r\n\x1a\n");
  const std::string svg = file_text(files.svg);
  CHECK_THAT(svg, Contains("<svg") && Contains("</svg>"));
  CHECK_THAT(svg, Contains("<title>speed and load</title>") &&
                      Contains("<desc>rolling resistance [N/m] against speed [m/s], one curve for each load: 10 kN/m, "
                               "20 kN/m; peak at 10 kN/m 140 at 0.1</desc>"));
  CHECK_THAT(svg, Contains("speed and load") && Contains("rolling resistance") && Contains("10 kN/m"));
  CHECK_THAT(file_text(files.data), Contains("0.1 140 1 1\n"));

  // The files left behind draw the same picture again.
  fs::remove(files.svg);
  gnuplot::run(files.script);
  const auto pictured = [](const std::string& text) { return text.substr(text.find("</desc>")); };
  CHECK(pictured(file_text(files.svg)) == pictured(svg));
}

TEST_CASE("a point without an answer stays in the data as a gap, with its status", "[studies][chart]") {
  const std::string data = chart_data(two_loads());
  CHECK_THAT(data, Contains("# column 1: speed V [m/s]\n# column 2: rolling resistance R_r [N/m]\n"));
  CHECK_THAT(data, Contains("# load P = 20 kN/m\n0.01 60 1 1\n0.1 370 1 1\n1 NaN 0 1\n10 20 1 1\n"));
}

TEST_CASE("points without an answer are crosses on the lower edge and those not converged are hollow",
          "[studies][chart]") {
  ChartRequest request = two_loads();
  const ChartFiles files = chart_files("chart");
  CHECK_THAT(chart_script(request, files), Contains("at first 1, graph 0.055 point pt 2") && Contains("'no answer'"));
  CHECK_THAT(chart_script(request, files), !Contains("not converged"));

  request.curves[1].points[2] = {1, 90, false};
  CHECK_THAT(chart_script(request, files), Contains("$3 == 0") && Contains("'not converged'"));
  CHECK_THAT(chart_script(request, files), !Contains("'no answer'"));

  request.curves[1].points[2] = {1, none, true};  // not computed: a gap without a sign
  CHECK_THAT(chart_script(request, files), !Contains("'no answer'") && !Contains("not converged"));
}

TEST_CASE("the peak of a curve lies between lower converged points", "[studies][chart]") {
  CHECK(peak({"", {{1, 1}, {2, 3}, {3, 2}}}) == 1);
  CHECK_FALSE(peak({"", {{1, 1}, {2, 2}, {3, 3}}}));
  CHECK_FALSE(peak({"", {{1, 3}, {2, 2}, {3, 1}}}));
  CHECK_FALSE(peak({"", {{1, 1}, {2, 3}, {3, none, false}}}));
  CHECK(peak({"", {{1, 1}, {2, 3}, {3, 2}, {4, 9, false}}}) == 1);
  CHECK_FALSE(peak({"", {}}));

  const std::string script = chart_script(two_loads(), chart_files("chart"));
  CHECK_THAT(script, Contains("set label '140' at graph 0.333"));
  CHECK_THAT(script, Contains("set label '' at first 0.1, first 140 point pt 6"));  // the points allow no better
  CHECK(script.find("point pt 6") == script.rfind("point pt 6"));
}

TEST_CASE("a peak between smooth points is found on the scale of the axis, with the digits that they support",
          "[studies][chart]") {
  ChartRequest request = two_loads();
  request.curves = {{"", {}}};
  const auto bell = [](double speed) { return 6.14 / (1 + 0.5 * std::pow(std::log(speed / 0.9), 2)); };
  for (const double speed : {0.1, 0.18, 0.33, 0.6, 1.08, 1.95, 3.5})
    request.curves[0].points.push_back({speed, bell(speed)});
  const auto top = curve_peak(request.curves[0], chart_spans(request));
  REQUIRE(top);
  CHECK(std::abs(top->y - 6.14) < 0.5 * std::abs(bell(1.08) - 6.14));
  CHECK(std::abs(std::log(top->x / 0.9)) < 0.1 * std::log(1.08 / 0.9));
  CHECK(std::abs(std::stod(top->y_text()) - 6.14) < 0.1);
  CHECK(top->y_text().size() <= 4);

  request.curves[0].points = {{0.1, 1}, {0.3, 1.1}, {1, 5}, {3, 3}, {10, 2.9}};  // a corner: the largest point
  const auto corner = curve_peak(request.curves[0], chart_spans(request));
  REQUIRE(corner);
  CHECK(corner->x == 1);
  CHECK(corner->y == 5);
  CHECK(corner->y_text() == "5");
}

TEST_CASE("a plot with an edge of its own keeps room for the numbers and the label of its y axis", "[studies][chart]") {
  CHECK(left_edge_for({-6, 0}) == 84);
  const double left = left_edge_for({-0.32, 0.05});
  CHECK(left > 84);
  const auto script = [&](const Span& x) {
    PictureBuilder picture("map", chart_files("map"), {"along", "x", "m"}, x, {"force over load"}, {-0.32, 0.05});
    picture.plot("data index 0 using 1:2 with lines notitle");
    return picture.finished("map", {.left = left, .right = 424}).script;
  };
  CHECK_THAT(script({0, 5}), Contains("unset ylabel\nset label 'force over load'") && !Contains("set xtics"));
  CHECK_THAT(script({-240, 240}), Contains("set xtics 100\n"));  // those of gnuplot, 50 apart, would touch
}

TEST_CASE("names of charts that end as other pictures or documents do are refused", "[studies][chart]") {
  CHECK_THROWS_WITH(chart_files("z.pdf"), "z.pdf: .pdf cannot be written; possible: .svg, .png, .gp, .dat");
  CHECK_THROWS_WITH(chart_files("z.JPG"), Contains(".jpg cannot be written"));
  CHECK(chart_files("load 1.5").svg == "load 1.5.svg");
}

TEST_CASE("the value of a peak has as many digits as its axis tells apart", "[studies][chart]") {
  ChartRequest request = two_loads();
  request.curves = {{"", {{0.01, 1.0371}, {0.1, 1.0853}, {1, 1.0371}}}};
  CHECK_THAT(chart_script(request, chart_files("chart")), Contains("set label '1.085'"));
  request.curves = {{"", {{0.01, 0}, {0.1, 1.0853}, {1, 0}}}};
  CHECK_THAT(chart_script(request, chart_files("chart")), Contains("set label '1.09'"));
}

TEST_CASE("every peak has its value, clear of the curves and of each other, with a line where it stands apart",
          "[studies][chart]") {
  ChartRequest request = two_loads();
  request.curves = {{"a", {{0.01, 10}, {0.1, 100}, {1, 10}}},
                    {"b", {{0.01, 11}, {0.1, 101}, {1, 11}}},
                    {"c", {{0.01, 12}, {0.1, 102}, {1, 12}}}};
  const std::string script = chart_script(request, chart_files("chart"));
  CHECK_THAT(script, Contains("set label '102'") && Contains("set label '101'") && Contains("set label '100'"));
  CHECK_THAT(script, !Contains("set arrow from first 0.1"));
  for (int i = 3; i < 14; ++i)
    request.curves.push_back({std::to_string(i), {{0.01, 10.0 + i}, {0.1, 100.0 + i}, {1, 10.0 + i}}});
  const std::string crowded = chart_script(request, chart_files("chart"));
  for (int i = 0; i < 14; ++i) CHECK_THAT(crowded, Contains("set label '" + std::to_string(100 + i) + "' at graph"));
  CHECK_THAT(crowded, Contains("set arrow from first 0.1, first 1"));
}

TEST_CASE("curves in an order go from dark to light, and many of them bear label and peak at their ends",
          "[studies][chart]") {
  ChartRequest request = two_loads();
  request.ordered = true;
  request.curves.clear();
  for (int i = 1; i <= 3; ++i)
    request.curves.push_back({std::to_string(i) + " kN/m", {{0.01, 1.0 * i}, {0.1, 4.0 * i}, {1, 2.0 * i}}});
  CHECK_THAT(chart_script(request, chart_files("chart")),
             Contains("set linetype 1 lc rgb '#440154'") && Contains("title '{/:Italic P} = 1 kN/m"));
  for (int i = 4; i <= 12; ++i)
    request.curves.push_back({std::to_string(i) + " kN/m", {{0.01, 1.0 * i}, {0.1, 4.0 * i}, {1, 2.0 * i}}});
  const std::string script = chart_script(request, chart_files("chart"));
  CHECK_THAT(script, !Contains("keyentry with linespoints"));
  CHECK_THAT(script, Contains("set label '{/:Italic P}: peak") && Contains("set label '12 kN/m: 48"));
  std::istringstream lines(script);
  std::vector<double> heights;
  for (std::string line; std::getline(lines, line);)
    if (const auto at = line.find(" at graph 1.06, graph "); at != std::string::npos && line.find(" kN/m") < at)
      heights.push_back(std::stod(line.substr(at + 22)));
  REQUIRE(heights.size() == 12);
  for (std::size_t i = 1; i < heights.size(); ++i) CHECK(heights[i] - heights[i - 1] > 0.06);
  CHECK(heights.front() >= 0);
  CHECK(heights.back() <= 1);
}

TEST_CASE("colours of curves and letters have the contrast that eyes need", "[studies][chart]") {
  const auto luminance = [](const std::string& colour) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
      const double part = std::stoi(colour.substr(1 + 2 * static_cast<std::size_t>(i), 2), nullptr, 16) / 255.0;
      const double weights[] = {0.2126, 0.7152, 0.0722};
      sum += weights[i] * (part <= 0.03928 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4));
    }
    return sum;
  };
  const auto contrast = [&](const std::string& colour) { return 1.05 / (luminance(colour) + 0.05); };
  for (std::size_t i = 0; i < 7; ++i) {
    CHECK(contrast(std::string(curve_colour(i))) >= 3);
    CHECK(contrast(letter_colour(curve_colour(i))) >= 4.5);
  }
  for (std::size_t i = 0; i < 12; ++i) {
    CHECK(contrast(ordered_colour(i, 12)) >= 2.5);
    CHECK(contrast(letter_colour(ordered_colour(i, 12))) >= 4.5);
    if (i > 0) CHECK(luminance(ordered_colour(i, 12)) > luminance(ordered_colour(i - 1, 12)));
  }
  CHECK(letter_colour("#000000") == "#000000");
}

TEST_CASE("a long title is broken into two lines, and what is shown stands below it", "[studies][chart]") {
  ChartRequest request = two_loads();
  request.title = "Rolling resistance of the paper's cylinder against speed, from creeping to glassy";
  request.subtitle = "load = 20 kN/m";
  const std::string script = chart_script(request, chart_files("chart"));
  CHECK_THAT(script, Contains("paper's cylinder") && Contains("set label 'against speed, from") &&
                         Contains("set label 'load = 20 kN/m") && Contains("font ',14'"));
  CHECK_THAT(chart_data(request), Contains("# load = 20 kN/m\n"));
}

TEST_CASE("a curve of one point shows its error as a bar", "[studies][chart]") {
  ChartRequest request = two_loads();
  request.areas = "estimated error";
  request.curves = {{"", {{0.1, 5, true, 4, 6}}}, {"", {{0.1, 3, true, 2, 4}, {1, 3, true, 2, 4}}}};
  const std::string script = chart_script(request, chart_files("chart"));
  CHECK_THAT(script, Contains("data index 0 using 1:2:5:6 with yerrorbars") &&
                         Contains("data index 1 using 1:5:6 with filledcurves"));
}

TEST_CASE("an axis is logarithmic as asked for unless a value is not positive", "[studies][chart]") {
  ChartRequest request = two_loads();
  CHECK_THAT(chart_script(request, chart_files("chart")), Contains("set logscale x") && !Contains("set logscale y"));
  request.y.logarithmic = true;
  CHECK_THAT(chart_script(request, chart_files("chart")), Contains("set logscale y"));
  request.curves[0].points[0].y = 0;
  CHECK_THAT(chart_script(request, chart_files("chart")), !Contains("set logscale y"));
}

TEST_CASE("a short logarithmic axis has numbers between its powers of ten", "[studies][chart]") {
  ChartRequest request = two_loads();
  request.curves = {{"", {{2, 1}, {5, 2}, {9, 1}}}};
  CHECK_THAT(chart_script(request, chart_files("chart")), Contains("set xtics (1, 2, 3, 5, 7)"));
  request.curves = {{"", {{0.0015, 1}, {0.005, 2}, {0.08, 1}}}};
  CHECK_THAT(chart_script(request, chart_files("chart")), Contains("set xtics (0.001, 0.002, 0.005, 0.01, 0.02, 0.05"));
  request.curves = {{"", {{2.1, 1}, {2.2, 2}, {2.4, 1}}}};
  CHECK_THAT(chart_script(request, chart_files("chart")), Contains("set xtics (2.1, 2.15, 2.2, 2.25, 2.3, 2.35, 2.4)"));
}

TEST_CASE("210 curves all look different", "[studies][chart]") {
  ChartRequest request = two_loads();
  const ChartCurve curve = request.curves[0];
  request.curves.assign(210, curve);
  std::istringstream script(chart_script(request, chart_files("chart")));
  std::vector<std::string> looks;
  for (std::string line; std::getline(script, line);)
    if (line.starts_with("set linetype ")) looks.push_back(line.substr(line.find(" lc ")));
  REQUIRE(looks.size() == 210);
  std::sort(looks.begin(), looks.end());
  CHECK(std::adjacent_find(looks.begin(), looks.end()) == looks.end());
}

TEST_CASE("names of studies and files are never read as commands of gnuplot or the shell", "[studies][chart]") {
  const TemporaryDirectory folder;
  ChartRequest request = two_loads();
  const std::string file_name = "<it's `touch here` $(touch here) \"|x\" %d & ~.chart";
  request.title = "it's `touch here` $(touch here) \"q\" %d _{a} ^b @c &{d} \\n <b>\n$E";
  request.curves[0].label = "'.system('touch here').'";
  request.x.name = "\"; system 'touch here'; #";
  request.comment = "one\nsystem('touch here')";
  const ChartFiles files = draw_chart(request, folder / file_name);
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator((folder / "x").parent_path()))
    found.push_back(entry.path().filename().string());
  std::sort(found.begin(), found.end());
  CHECK(found ==
        std::vector<std::string>{file_name + ".dat", file_name + ".gp", file_name + ".png", file_name + ".svg"});
  CHECK_THAT(file_text(files.svg), Contains("'.system('touch here').'"));
  CHECK_THAT(file_text(files.data), Contains("\n# system('touch here')\n"));
}

TEST_CASE("text in gnuplot's quotes and markup says itself", "[studies][gnuplot]") {
  CHECK(gnuplot::quoted("it's\n") == "\"it's \"");
  CHECK(gnuplot::plain("a_b^{c}@d&e~f\\g") == "a\\_b\\^\\{c\\}\\@d\\&e\\~f\\\\g");
  CHECK(gnuplot::symbol("R_r") == "{/:Italic R}_{r}");
  CHECK(gnuplot::symbol("G0") == "{/:Italic G}_{0}");
  CHECK(gnuplot::symbol("RΩ/V") == "{/:Italic RΩ}/{/:Italic V}");
  CHECK(gnuplot::symbol("max|τ_xz|") == "{/:Italic max}|{/:Italic τ}_{xz}|");
}

TEST_CASE("entries of the legend stand in rows inside the picture", "[studies][chart]") {
  for (const std::size_t count : {1U, 3U, 12U})
    for (const char* label : {"1", "10 kN/m", "P = 10 kN/m, μ = 0.25, f = 1"}) {
      ChartRequest request = two_loads();
      request.curves.assign(count, {label, request.curves[0].points});
      std::istringstream script(chart_script(request, chart_files("chart")));
      std::vector<std::pair<double, double>> places;
      for (std::string line; std::getline(script, line);)
        if (const auto at = line.rfind("' at ");
            line.find("keyentry") != std::string::npos && at != std::string::npos) {
          std::istringstream numbers(line.substr(at + 5));
          double x = 0, y = 0;
          char comma = 0;
          numbers >> x >> comma >> y;
          places.emplace_back(x, y);
        }
      REQUIRE(places.size() == count);
      // 560 pixels wide; a letter of this size takes 8.8 pixels on average, the sample 54 to the left of the text.
      const double text = 8.8 * (static_cast<double>(std::string(label).size()) + 4) / 560;
      for (const auto& [x, y] : places) {
        CHECK(x > 54.0 / 560);
        CHECK(x + text < 1.01);
        CHECK(y < 1);
      }
      std::sort(places.begin(), places.end());
      CHECK(std::adjacent_find(places.begin(), places.end()) == places.end());
    }
}

TEST_CASE("of two families one is told by colour, the other by dash and mark", "[studies][chart]") {
  ChartRequest request = two_loads();
  const std::vector<ChartPoint> points = request.curves[0].points;
  request.families = {{{.name = ""}, {"soft", "hard", "filled"}}, {{.name = "share", .unit = ""}, {"0.1", "0.2"}}};
  request.curves.clear();
  for (std::size_t first = 0; first < 3; ++first)
    for (std::size_t second = 0; second < 2; ++second)
      request.curves.push_back({.label = "both", .points = points, .place = {first, second}});
  const std::string script = chart_script(request, chart_files("chart"));
  const auto line_type = [&](std::size_t curve) {
    const std::string mark = "set linetype " + std::to_string(curve + 1) + " ";
    const std::size_t begin = script.find(mark) + mark.size();
    const std::string look = script.substr(begin, script.find('\n', begin) - begin);
    const std::size_t dash = look.find(" lw 2 dt ");
    return std::pair(look.substr(0, dash), look.substr(dash));
  };
  CHECK(line_type(0).first == line_type(1).first);
  CHECK(line_type(0).first != line_type(2).first);
  CHECK(line_type(0).second == line_type(4).second);
  CHECK(line_type(0).second != line_type(1).second);
  std::size_t entries = 0;
  for (std::size_t at = 0; (at = script.find("keyentry", at)) != std::string::npos; ++at) ++entries;
  CHECK(entries == 5);  // three colours, two marks
  CHECK_THAT(script, Contains("'hard  '") && Contains("'share = 0.2  '"));
}

TEST_CASE("a number without symbol and unit bears its name in the legend", "[studies][chart]") {
  ChartRequest request = two_loads();
  request.ordered = true;
  request.family = {.name = "payne drop"};
  request.curves[0].label = "0.5";
  CHECK_THAT(chart_script(request, chart_files("chart")), Contains("'payne drop = 0.5  '"));
  request.family.unit = "K";
  CHECK_THAT(chart_script(request, chart_files("chart")), Contains("'0.5  '"));
}

TEST_CASE("the files of a chart share its name whatever suffix it is given", "[studies][chart]") {
  for (const char* name : {"out/a.b", "out/a.b.svg", "out/a.b.png", "out/a.b.gp", "out/a.b.dat"}) {
    const ChartFiles files = chart_files(name);
    CHECK(files.svg == "out/a.b.svg");
    CHECK(files.png == "out/a.b.png");
    CHECK(files.script == "out/a.b.gp");
    CHECK(files.data == "out/a.b.dat");
  }
  for (const char* name : {"", "out/", ".", "out/..", "a\nb"})
    CHECK_THROWS_AS(chart_files(name), std::invalid_argument);
}

TEST_CASE("a chart that cannot be drawn says why", "[studies][chart]") {
  const TemporaryDirectory folder;
  const fs::path chart = folder / "chart";

  CHECK_THROWS_WITH(draw_chart(two_loads(), chart, "no-such-gnuplot"),
                    Contains("no-such-gnuplot: cannot be started") && Contains("gnuplot-nox"));
  CHECK_THROWS_WITH(draw_chart(two_loads(), chart, stand_in(folder, "echo first; echo 'line 7: no font' >&2; exit 4")),
                    Contains("chart.gp") && Contains("exit status 4") && Contains("line 7: no font"));
  CHECK_THROWS_WITH(draw_chart(two_loads(), chart, stand_in(folder, "kill -9 $$")), Contains("signal 9"));
  CHECK_THROWS_WITH(draw_chart(two_loads(), chart, stand_in(folder, "exit 0")),
                    Contains("chart.svg") && Contains("drew nothing"));
  CHECK_THROWS_AS(draw_chart(two_loads(), folder / "drawer" / "chart"), std::runtime_error);  // a file, no folder

  std::ofstream(folder / "wrong.gp") << "plot no_such_function(x)\n";
  CHECK_THROWS_WITH(gnuplot::run(folder / "wrong.gp"), Contains("undefined function"));

  ChartRequest empty = two_loads();
  for (ChartCurve& curve : empty.curves)
    for (ChartPoint& point : curve.points) point.y = none;
  CHECK_THROWS_AS(draw_chart(empty, chart), std::invalid_argument);
}

TEST_CASE("a chart of a single point, and of points of one height, is drawn", "[studies][chart]") {
  const TemporaryDirectory folder;
  ChartRequest request = two_loads();
  request.curves = {{"", {{0.1, 5}}}};
  CHECK_NOTHROW(draw_chart(request, folder / "one"));
  request.curves = {{"", {{0.1, 0}, {1, 0}}}};
  CHECK_NOTHROW(draw_chart(request, folder / "flat"));
  request.curves = {{"", {{-1, -2}, {1, -1e-7}}}, {"empty", {}}};
  CHECK_NOTHROW(draw_chart(request, folder / "negative"));
}

TEST_CASE("a long subtitle is broken into lines and not cut", "[studies][chart]") {
  ChartRequest request = two_loads();
  request.subtitle =
      "layer thickness of coating [0] = 12 mm, static shear modulus of coating [0] = 2 MPa, radius = 50 mm";
  const std::string script = chart_script(request, chart_files("chart"));
  CHECK_THAT(script, Contains("static shear modulus  '") && Contains("radius = 50 mm  '"));
  CHECK_THAT(script, !Contains("…"));
}
