#include "studies/evidence/stability_map.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <sstream>

#include "studies/drawing/chart_frame.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

constexpr std::size_t outcomes = ChoiceNames<Outcome>::names.size();

/// gnuplot's point types and the colours of Okabe and Ito (2008), in the order of Outcome. What is well is pale and
/// small, and the smaller the more scenes there are; what is not stands out.
struct Mark {
  std::string_view colour;
  int type;
  double size;
};
constexpr std::array<Mark, outcomes> marks{{{"#56B4E9", 7, 0.3},     // disc
                                            {"#555555", 8, 0.5},     // triangle
                                            {"#E69F00", 11, 0.8},    // filled triangle on its point
                                            {"#D55E00", 2, 0.8},     // cross
                                            {"#CC79A7", 5, 0.7},     // filled square
                                            {"#000000", 13, 0.9}}};  // filled diamond

double size_among(Outcome outcome, std::size_t scenes) {
  const double size = marks[static_cast<std::size_t>(outcome)].size;
  if (is_failure(outcome)) return size;
  constexpr double few = 1000, smallest = 0.15;
  return size * std::clamp(std::pow(few / static_cast<double>(scenes), 0.4), smallest, 1.0);
}

std::array<std::size_t, outcomes> numbers_of(const std::vector<Trial>& trials) {
  std::array<std::size_t, outcomes> numbers{};
  for (const Trial& trial : trials) ++numbers[static_cast<std::size_t>(trial.outcome)];
  return numbers;
}

std::string words_of(std::size_t outcome) {
  std::string name(ChoiceNames<Outcome>::names[outcome]);
  for (char& letter : name)
    if (letter == '_') letter = ' ';
  return name;
}

std::string title_of(const std::vector<Trial>& trials) {
  assert(!trials.empty());
  const RollingScene& scene = trials.front().scene;
  return std::string(name_of(scene.method)) + ", " + std::string(name_of(scene.indenter)) + ": " +
         std::to_string(trials.size()) + (trials.size() == 1 ? " random scene" : " random scenes");
}

ChartAxis axis_of(std::string_view key, std::string_view name) {
  ChartAxis axis{.name = std::string(name), .logarithmic = true};
  const RollingScene scene;
  visit_inputs(scene, [&](const Quantity& quantity, const auto&) {
    if (quantity.key != key) return;
    axis.symbol = quantity.symbol;
    if (quantity.unit != "1") axis.unit = quantity.unit;
  });
  return axis;
}

}  // namespace

std::string stability_map_data(const std::vector<Trial>& trials) {
  std::ostringstream data;
  data << "# " << title_of(trials) << "\n# column 1: speed V [m/s]\n# column 2: friction coefficient\n"
       << "# column 3: number of the scene\n";
  for (std::size_t outcome = 0; outcome < outcomes; ++outcome) {
    if (outcome > 0) data << "\n\n";
    data << "# " << words_of(outcome) << "\n";
    bool any = false;
    for (const Trial& trial : trials) {
      if (static_cast<std::size_t>(trial.outcome) != outcome) continue;
      data << short_number(trial.scene.speed, 15) << " " << short_number(trial.scene.friction_coefficient, 15) << " "
           << trial.number << "\n";
      any = true;
    }
    if (!any) data << "NaN NaN NaN\n";  // keeps the count of the blocks
  }
  return data.str();
}

std::string stability_map_script(const std::vector<Trial>& trials, const ChartFiles& files) {
  Span speed{.logarithmic = true}, friction{.logarithmic = true};
  for (const Trial& trial : trials) {
    speed.include(trial.scene.speed);
    friction.include(trial.scene.friction_coefficient);
  }
  speed.widen(0.02, 0.02);
  friction.widen(0.03, 0.03);

  std::ostringstream script;
  write_axes(script, files, axis_of("speed", "speed"), speed, axis_of("friction_coefficient", "friction coefficient"),
             friction);
  const std::array<std::size_t, outcomes> numbers = numbers_of(trials);
  std::vector<std::string> plots;
  std::vector<LegendEntry> legend;
  for (std::size_t outcome = 0; outcome < outcomes; ++outcome) {
    if (numbers[outcome] == 0) continue;
    const Mark& mark = marks[outcome];
    const std::string look =
        "points pt " + std::to_string(mark.type) + " lc rgb '" + std::string(mark.colour) + "' lw 1.5";
    const std::string words = std::to_string(numbers[outcome]) + " " + words_of(outcome);
    plots.push_back("data index " + std::to_string(outcome) + " using 1:2 with " + look + " ps " +
                    short_number(size_among(static_cast<Outcome>(outcome), trials.size()), 3) + " notitle");
    legend.push_back(LegendEntry::plain(look + " ps 0.9", words));
  }
  write_pictures(script, files, title_of(trials), plots, legend);
  return script.str();
}

ChartFiles draw_stability_map(const std::vector<Trial>& trials, const std::filesystem::path& name,
                              const std::string& gnuplot) {
  const ChartFiles files = chart_files(name);
  draw_pictures(files, stability_map_data(trials), stability_map_script(trials, files), gnuplot);
  return files;
}

}  // namespace rollres
