#include "core/heat/loss_with_depth.hpp"

#include <algorithm>
#include <cmath>

#include "core/interior/flow_loss.hpp"
#include "core/interior/interior_lines.hpp"
#include "core/interior/layers_inside.hpp"
#include "core/model/contact_surface.hpp"
#include "core/numerics/quadrature.hpp"

namespace rollres {

namespace {

double sum_of(const std::vector<LossPanel>& panels) {
  const QuadratureRule& rule = gauss_rule(static_cast<int>(panels.front().loss.size()));
  double sum = 0;
  for (const LossPanel& panel : panels)
    for (std::size_t i = 0; i < rule.nodes.size(); ++i)
      sum += (panel.to - panel.from) * rule.weights[i] * panel.loss[i];
  return sum;
}

/// Of layers on one side of the contact, as they stand there.
std::vector<LossPanel> panels_of(const LayeredMedium& medium, double flow, const ContactModel& model,
                                 const SurfaceFields& fields, double half, LossDetail detail) {
  const bool rough = detail == LossDetail::rough;
  const int nodes_of_panel = rough ? 3 : 6;
  const std::vector<WeightedLine> weighted = lines_across(medium, model.speed, half, nodes_of_panel);
  std::vector<InteriorLine> lines;
  for (const WeightedLine& line : weighted) lines.push_back(line.line);
  std::vector<LossPanel> panels;
  Eigen::ArrayXd loss = Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(lines.size()));
  if (std::any_of(medium.begin(), medium.end(), [](const MediumLayer& layer) { return creeps(layer.material); })) {
    const InteriorField field(medium, model.speed, flow, fields, half,
                              rough ? InteriorField::Detail::rough : InteriorField::Detail::inside);
    loss = field.at({}, lines, InteriorField::Wanted::strains).line_loss;
  }
  double depth = 0;
  for (std::size_t i = 0; i < weighted.size(); ++i) {
    if (i % static_cast<std::size_t>(nodes_of_panel) == 0) panels.push_back({depth, depth, {}});
    panels.back().to = depth += weighted[i].weight;
    panels.back().loss.push_back(loss(static_cast<Eigen::Index>(i)));
  }
  return panels;
}

}  // namespace

LossWithDepth loss_with_depth(const ContactModel& model, const RollingSolution& solution, LossDetail detail) {
  const double half = 0.5 * (solution.leading_edge - solution.trailing_edge);
  const double whole = solution.rolling_resistance * model.speed;
  LossWithDepth lost;
  lost.panels = panels_of(foundation_of(model), 1, model, solution.fields, half, detail);
  double inside = sum_of(lost.panels), under = 0;
  if (!model.coating.empty()) {
    under = inside;
    lost.panels = panels_of(coating_of(model), model.flow, model, mirrored_shear(solution.fields), half, detail);
    inside = sum_of(lost.panels);
  }
  const double viscous = std::isfinite(solution.frictional_loss) ? whole - solution.frictional_loss : whole;
  const double factor = inside + under > 0 && viscous > 0 ? viscous / (inside + under) : 0;
  for (LossPanel& panel : lost.panels)
    for (double& loss : panel.loss) loss *= factor;
  lost.elsewhere = factor * under;
  lost.at_face = whole - factor * (inside + under);
  return lost;
}

}  // namespace rollres
