#include <cmath>
#include <iterator>

#include "studies/report/html.hpp"
#include "studies/report/report_sections.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// "speed from 1 mm/s to 10 m/s (60 values)", "load 10 kN/m, 20 kN/m, 40 kN/m"
std::string axis_in_words(const ReportSource& source, const QuantityColumn& axis) {
  constexpr std::size_t few = 4;
  const std::vector<Cell> values = source.rows.values(axis);
  const auto shown = [&](const Cell& cell) { return value_in_words(axis.quantity, cell, unit_in(source.rows, axis)); };
  const std::string name = in_words(axis.quantity.key);
  if (values.size() <= few || axis.type == "TEXT") return name + " " + joined(values, ", ", shown);
  return name + " from " + shown(*values.begin()) + " to " + shown(*values.rbegin()) + " (" +
         std::to_string(values.size()) + " values)";
}

std::string what_was_asked(const ReportSource& source) {
  const std::vector<const QuantityColumn*> axes = source.varied();
  const std::string body = in_words(source.rows.text(0, "indenter"));
  std::string text =
      std::to_string(source.study.points) + (source.study.points == 1 ? " scene" : " scenes") + " of a rolling " + body;
  std::string ranges, scattered;
  for (const QuantityColumn* const axis : axes)
    if (source.definition.uncertain.contains(key_of(*axis)))
      scattered += (scattered.empty() ? "" : ", ") + in_words(axis->quantity.key);
    else
      ranges += (ranges.empty() ? ": " : "; ") + axis_in_words(source, *axis);
  return text + ranges + (scattered.empty() ? "." : ". What scatters: " + scattered + ".");
}

/// "between 0.75 N/m (at speed = 10 m/s) and 1570 N/m (at ...)"
std::string what_came_out(const ReportSource& source) {
  if (source.rows.values(*find_quantity_column("indenter")).size() > 1) return "It holds cylinders and spheres.";
  std::optional<std::size_t> least, greatest;
  const auto value = [&](std::size_t row) { return source.rows.number(row, "rolling_resistance"); };
  for (std::size_t row = 0; row < source.rows.size(); ++row) {
    if (!source.rows.converged(row) || std::isnan(value(row))) continue;
    if (!least || value(row) < value(*least)) least = row;
    if (!greatest || value(row) > value(*greatest)) greatest = row;
  }
  if (!least) return "No point has an answer.";
  const ScaledUnit unit = scaled_unit_logarithmic(unit_in(source.rows, *find_quantity_column("rolling_resistance")),
                                                  std::abs(value(*least)), std::abs(value(*greatest)));
  const auto told = [&](std::size_t row) {
    const std::string place = place_of(source, row);
    return short_number(value(row) / unit.factor, 4) + " " + typeset_unit(unit.name) +
           (place.empty() ? "" : " (" + place + ")");
  };
  if (value(*least) == value(*greatest)) return "The rolling resistance is " + told(*least) + ".";
  return "The rolling resistance lies between " + told(*least) + " and " + told(*greatest) + ".";
}

std::string how_sure(const ReportSource& source) {
  const StudySummary& study = source.study;
  const auto answered = study.answered - study.failed, missing = study.points - study.answered;
  std::string text =
      missing == 0 && study.failed == 0 ? "All points converged" : std::to_string(answered) + " points converged";
  if (study.failed > 0) text += ", " + std::to_string(study.failed) + " have no answer";
  if (missing > 0) text += ", " + std::to_string(missing) + " are not computed yet";
  const auto told = [](double error) {
    constexpr double smallest = 1e-4;  // below it percents have too many zeros
    return error < smallest ? short_number(error, 2) : percent(error, 2);
  };
  if (const std::vector<double> errors = sorted_values(source.rows, "error_estimate"); !errors.empty())
    text += "; the estimated relative error of the resistance is " + told(errors[errors.size() / 2]) +
            " in the median and " + told(errors.back()) + " at most";
  if (const std::vector<double> errors = sorted_values(source.rows, "model_error"); !errors.empty())
    text +=
        "; what the model assumes costs " + told(errors[errors.size() / 2]) + " in the median and " +
        told(errors.back()) + " at most" +
        (std::ssize(errors) < answered ? ", where that is known (" + std::to_string(errors.size()) + " points)" : "");
  return text + ".";
}

}  // namespace

std::string summary_section(const ReportSource& source, const std::vector<std::string>& sentences) {
  std::string section = html::heading("Summary");
  if (const std::string& comment = source.definition.comment;
      comment != title_of_study(source.definition, source.study.name))
    section += html::paragraph(source.definition.comment);
  if (!sentences.empty()) return section + html::lead(joined(sentences, " "));
  return section + html::lead(what_was_asked(source) + " " + what_came_out(source) + " " + how_sure(source));
}

}  // namespace rollres
