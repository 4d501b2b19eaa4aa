#include "studies/evidence/stability.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/words.hpp"

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

std::string title_of(const std::vector<Trial>& trials) {
  assert(!trials.empty());
  const RollingScene& scene = trials.front().scene;
  return std::string(name_of(scene.method)) + ", " + std::string(name_of(scene.indenter)) + ": " +
         std::to_string(trials.size()) + (trials.size() == 1 ? " random scene" : " random scenes");
}

ChartAxis axis_of(const char* key) {
  const Quantity& quantity = find_input(key)->quantity;
  return {.name = in_words(key),
          .symbol = std::string(quantity.symbol),
          .unit = quantity.unit == "1" ? "" : std::string(quantity.unit),
          .logarithmic = true};
}

}  // namespace

PictureText stability_map(const std::vector<Trial>& trials, const ChartFiles& files) {
  Span speed{.logarithmic = true}, friction{.logarithmic = true};
  for (const Trial& trial : trials) {
    speed.include(trial.scene.speed);
    friction.include(trial.scene.friction_coefficient);
  }
  speed.widen(0.02, 0.02);
  friction.widen(0.03, 0.03);

  PictureBuilder picture(title_of(trials), files, axis_of("speed"), speed, axis_of("friction_coefficient"), friction);
  for (std::size_t outcome = 0; outcome < outcomes; ++outcome) {
    std::vector<DataRow> rows;
    for (const Trial& trial : trials)
      if (static_cast<std::size_t>(trial.outcome) == outcome)
        rows.push_back({trial.scene.speed, trial.scene.friction_coefficient, static_cast<double>(trial.number)});
    if (rows.empty()) continue;
    const Mark& mark = marks[outcome];
    const std::string words = in_words(ChoiceNames<Outcome>::names[outcome]);
    const std::string look =
        "points pt " + std::to_string(mark.type) + " lc rgb '" + std::string(mark.colour) + "' lw 1.5";
    picture.plot(picture.add(words, "speed V [m/s], friction coefficient, number of the scene", rows) +
                 " using 1:2 with " + look + " ps " +
                 short_number(size_among(static_cast<Outcome>(outcome), trials.size()), 3) + " notitle");
    picture.explain(LegendEntry::plain(look + " ps 0.9", std::to_string(rows.size()) + " " + words));
  }
  return picture.finished(title_of(trials));
}

ChartFiles draw_stability_map(const std::vector<Trial>& trials, const std::filesystem::path& name) {
  const ChartFiles files = chart_files(name);
  const PictureText text = stability_map(trials, files);
  draw_pictures(files, text.data, text.script, {title_of(trials), "outcomes over speed and friction"});
  return files;
}

}  // namespace rollres
