#include <algorithm>
#include <cmath>

#include "core/numerics/quadrature.hpp"
#include "core/solve/heat_balance.hpp"
#include "studies/figures/figure_map.hpp"

namespace rollres {

PictureText temperature_lines(const Figure& figure, const FigureSource& source, const ChartFiles& files) {
  const ContactModel solved = ContactModel(source.scene).with_answer(source.solution);
  RollingSolution per_metre = source.solution;
  per_metre.rolling_resistance /= body_length(source.scene);
  per_metre.frictional_loss /= body_length(source.scene);
  const WarmedDepth warmed = warmed_depth(source.scene, solved, per_metre);

  // The power lost is known at the nodes of a rule; at the ends it stands as at the nearest of them.
  struct Loss {
    double depth, density;  // [m], [W/m3]
  };
  std::vector<Loss> losses;
  const auto add = [&](double depth, double loss) {
    losses.push_back({depth, loss / (warmed.path.turn * (1 - depth / warmed.path.radius))});
  };
  const std::vector<LossPanel>& panels = warmed.lost.panels;
  add(0, panels.front().loss.front());
  for (const LossPanel& panel : panels) {
    const QuadratureRule& rule = gauss_rule(static_cast<int>(panel.loss.size()));
    for (std::size_t i = 0; i < panel.loss.size(); ++i)
      add(panel.from + (panel.to - panel.from) * rule.nodes[i], panel.loss[i]);
  }
  add(warmed.path.thickness, panels.back().loss.back());
  double largest_loss = 0;
  for (const Loss& loss : losses) largest_loss = std::max(largest_loss, loss.density);

  const ScaledUnit length = scaled_unit("m", warmed.path.thickness), scale = celsius();
  Span x, y{.lowest = warmed.path.thickness / length.factor, .highest = 0};  // downwards
  std::vector<DataRow> temperatures;
  constexpr int steps = 100;
  for (int i = 0; i <= steps; ++i) {
    const double depth = warmed.path.thickness * i / steps, temperature = scale.number(warmed.profile.at(depth));
    temperatures.push_back({depth / length.factor, temperature});
    x.include(temperature);
  }
  // What the materials are taken at: one temperature, or one in each sublayer.
  const std::vector<double>& sublayers = source.solution.sublayer_temperatures;
  std::vector<DataRow> taken;
  const auto take = [&](double temperature, double from, double to) {
    const double number = scale.number(temperature);
    x.include(number);
    for (const double depth : {from, to}) taken.push_back({number, depth / length.factor});
  };
  double depth = 0;
  for (std::size_t i = 0; i < sublayers.size(); ++i) {
    const double thickness = (solved.coating.empty() ? solved.foundation : solved.coating)[i].layer_thickness;
    take(sublayers[i], depth, depth + thickness);
    depth += thickness;
  }
  if (sublayers.empty()) take(source.solution.mean_temperature, 0, warmed.path.thickness);
  x.widen(0.06, 0.06);
  const ScaledUnit power = scaled_unit("W/m3", largest_loss);
  PictureBuilder picture(figure.title, files, {.name = "temperature", .symbol = "T", .unit = scale.name}, x,
                         {.name = "depth below the face", .symbol = "", .unit = length.name}, y);
  // The power lost takes a third of the picture's width.
  std::vector<DataRow> area{{y.highest, 0, x.lowest}};
  for (const Loss& loss : losses)
    area.push_back({loss.depth / length.factor, loss.density / power.factor,
                    x.lowest + (largest_loss > 0 ? loss.density / largest_loss / 3 : 0) * (x.highest - x.lowest)});
  area.push_back({y.lowest, 0, x.lowest});
  const std::string lost =
      picture.add("power lost", "depth [" + length.name + "], power lost [" + power.name + "], as it is drawn", area);
  picture.plot(lost + " using 3:1 with filledcurves closed lc rgb '#D55E00' fs transparent solid 0.3 noborder notitle");
  const std::string data =
      picture.add("temperature", "depth [" + length.name + "], T [" + scale.name + "]", temperatures);
  constexpr const char *line = "lines lw 2.5 lc rgb '#0072B2'", *dashed = "lines lw 2 dt (5,3) lc rgb '#444444'";
  picture.plot(data + " using 2:1 with " + std::string(line) + " notitle");
  picture.plot(picture.add("materials", "T, depth", taken) + " using 1:2 with " + std::string(dashed) + " notitle");
  picture.explain(LegendEntry::plain(line, "temperature"));
  picture.explain(LegendEntry::plain(
      dashed, sublayers.empty() ? "mean by the loss, of the materials" : "of the materials in each sublayer"));
  picture.explain(LegendEntry::plain(
      "boxes fc rgb '#D55E00' fs transparent solid 0.3 noborder",
      "power lost, up to " + short_number(largest_loss / power.factor, 3) + " " + typeset_unit(power.name)));
  return picture.finished(std::string(figure.title));
}

}  // namespace rollres
