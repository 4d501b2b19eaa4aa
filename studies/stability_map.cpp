#include "studies/stability_map.hpp"

#include <array>
#include <cassert>
#include <sstream>
#include <string_view>

#include "studies/chart_axis.hpp"
#include "studies/gnuplot.hpp"
#include "studies/scaled_unit.hpp"

namespace rollres {

namespace {

constexpr std::size_t outcomes = ChoiceNames<Outcome>::names.size();

// Sizes in pixels of the SVG; the PNG has twice as many.
constexpr int width = 560, plot_height = 400, title_height = 36, legend_row_height = 23, legend_columns = 3;

/// Colours of Okabe and Ito (2008) and gnuplot's point types, in the order of Outcome. What is well is small and pale.
struct Mark {
  std::string_view colour;
  int type;
  double size;
};
constexpr std::array<Mark, outcomes> marks{{{"#56B4E9", 7, 0.3},     // disc
                                            {"#999999", 8, 0.5},     // triangle
                                            {"#E69F00", 11, 0.8},    // filled triangle on its point
                                            {"#D55E00", 2, 0.8},     // cross
                                            {"#CC79A7", 5, 0.8},     // filled square
                                            {"#000000", 13, 0.9}}};  // filled diamond

std::array<std::size_t, outcomes> numbers_of(const std::vector<Trial>& trials) {
  std::array<std::size_t, outcomes> numbers{};
  for (const Trial& trial : trials) ++numbers[static_cast<std::size_t>(trial.numbers.outcome)];
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
      if (static_cast<std::size_t>(trial.numbers.outcome) != outcome) continue;
      data << short_number(trial.scene.speed, 15) << " " << short_number(trial.scene.friction_coefficient, 15) << " "
           << trial.number << "\n";
      any = true;
    }
    if (!any) data << "NaN NaN NaN\n";  // keeps the count of the blocks
  }
  return data.str();
}

std::string stability_map_script(const std::vector<Trial>& trials, const ChartFiles& files) {
  const auto here = [](const std::filesystem::path& file) {
    return gnuplot::quoted("./" + file.filename().string());  // never read as a pipe or a home folder
  };
  Span speed{.logarithmic = true}, friction{.logarithmic = true};
  for (const Trial& trial : trials) {
    speed.include(trial.scene.speed);
    friction.include(trial.scene.friction_coefficient);
  }
  speed.widen(0.02, 0.02);
  friction.widen(0.03, 0.03);

  std::ostringstream script;
  script << "# Draws the pictures anew when run in this folder with gnuplot.\n"
         << "reset\nset encoding utf8\n"
         << "data = " << here(files.data) << "\n\n"
         << "set xlabel " << axis_label(axis_of("speed", "speed"), 44) << "\nset ylabel "
         << axis_label(axis_of("friction_coefficient", "friction coefficient"), 34) << "\n";
  write_axis(script, 'x', speed);
  write_axis(script, 'y', friction);
  script << "set border 3 lw 1.2 lc rgb '#444444'\nset tics nomirror\n"
         << "set grid xtics ytics lw 0.8 lc rgb '#CCCCCC' dt 1\n\n";

  const std::array<std::size_t, outcomes> numbers = numbers_of(trials);
  std::string points, legend;
  int entries = 0;
  for (std::size_t outcome = 0; outcome < outcomes; ++outcome) {
    if (numbers[outcome] == 0) continue;
    const Mark& mark = marks[outcome];
    const std::string look = "points pt " + std::to_string(mark.type) + " lc rgb '" + std::string(mark.colour) + "'";
    points += (points.empty() ? "" : ", \\\n     ") + ("data index " + std::to_string(outcome)) + " using 1:2 with " +
              look + " ps " + short_number(mark.size) + " notitle";
    legend += ", \\\n     keyentry with " + look + " ps 0.9 title " +
              gnuplot::quoted(gnuplot::plain(std::to_string(numbers[outcome]) + " " + words_of(outcome)) + "  ");
    ++entries;
  }
  const int columns = std::min(entries, legend_columns), rows = (entries + columns - 1) / columns;
  const int head = title_height + legend_row_height * rows, height = plot_height + head;
  const auto from_top = [&](int pixels) { return short_number(1.0 - static_cast<double>(pixels) / height, 4); };
  const std::string title = title_of(trials);
  script << "set label " << fitted(title, gnuplot::plain(title) + "  ", 46) << " at screen 0.5, screen "
         << from_top(title_height / 2) << " center\n"
         << "set tmargin at screen " << from_top(head + 12) << "\nset rmargin at screen 0.955\n"
         << "set key at screen 0.5, screen " << from_top(title_height - 4) << " center top horizontal maxcols "
         << columns << " Left reverse samplen 1.2 width -3\n"
         << "\nset terminal svg size " << width << "," << height
         << " dynamic enhanced background rgb 'white' font 'sans-serif,17'\n"
         << "set output " << here(files.svg) << "\nplot " << points << legend << "\n"
         << "\nset terminal pngcairo size " << 2 * width << "," << 2 * height
         << " enhanced background rgb 'white' font 'sans-serif,12.75' fontscale 2 linewidth 2 pointscale 3.2\n"
         << "set output " << here(files.png) << "\nreplot\nunset output\n";
  return script.str();
}

ChartFiles draw_stability_map(const std::vector<Trial>& trials, const std::filesystem::path& name,
                              const std::string& gnuplot) {
  const ChartFiles files = chart_files(name);
  draw_pictures(files, stability_map_data(trials), stability_map_script(trials, files), gnuplot);
  return files;
}

}  // namespace rollres
