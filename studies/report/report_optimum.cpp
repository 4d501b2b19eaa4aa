#include "studies/optimise/stored_optimum.hpp"
#include "studies/report/html.hpp"
#include "studies/report/report_sections.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

std::string optimum_section(const ReportSource& source) {
  const auto found = stored_optimum(source.store, source.study.name);
  if (!found) return "";
  const DesignProblem& problem = found->problem;
  const Indenter indenter = problem.indenter();
  std::string section =
      html::heading("Best design") +
      html::paragraph(std::string(problem.goal.maximise ? "Greatest " : "Least ") + problem.goal.formula.text() +
                      " among " + std::to_string(found->designs.size()) + " designs with an answer.");
  if (!found->best) return section + html::paragraph("No design meets the constraints.");
  const Design& best = *found->best;
  std::vector<html::TableRow> rows{
      {{problem.goal.formula.text(), readable(best.value, unit_of(problem.goal.formula, indenter)), ""}}};
  for (std::size_t i = 0; i < problem.variables.size(); ++i) {
    const Variable& variable = problem.variables[i];
    const std::string_view unit = variable.quantity.unit_for(indenter);
    rows.push_back({{in_words(std::string(variable.quantity.key)), readable(best.point[i], unit),
                     readable(variable.lowest, unit) + " to " + readable(variable.highest, unit)}});
  }
  for (std::size_t j = 0; j < best.constraints.size(); ++j)
    rows.push_back(
        {{constraint_name(problem, j),
          short_number(best.constraints[j].left, 5) + " against " + short_number(best.constraints[j].right, 5), ""}});
  return section + html::table({{"quantity"}, {"value"}, {"range"}}, rows);
}

}  // namespace rollres
