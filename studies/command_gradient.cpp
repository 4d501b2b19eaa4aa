#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <memory>
#include <ostream>
#include <stdexcept>

#include "core/gradient.hpp"
#include "studies/commands.hpp"
#include "studies/progress.hpp"
#include "studies/readable_number.hpp"
#include "studies/scene_file.hpp"
#include "studies/table_json.hpp"
#include "studies/table_output.hpp"

namespace rollres {

namespace {

struct GradientWords {
  std::string scene, output = "rolling_resistance";
  std::vector<std::string> overrides, inputs;
  GradientOptions options{.order = 4, .jobs = 0};
  bool json = false;
};

/// What the command tells of one input.
struct Finding {
  const Variable& variable;
  double value;  // [SI]
  const InputCalibration& calibration;
  const InputGradient& gradient;
  double output;  // [SI]

  int evaluations() const { return calibration.evaluations + gradient.evaluations; }
  double relative_noise() const { return calibration.noise / std::abs(output); }
  double elasticity_error() const {
    return std::isnan(gradient.elasticity) ? RollingSolution::absent : gradient.error() * std::abs(value / output);
  }
};

struct Findings {
  const Objective& objective;
  const Calibration& calibration;
  const Gradient& gradient;
  double seconds;

  Indenter indenter() const { return objective.base.indenter; }
  std::string_view output_unit() const { return objective.output.unit_for(indenter()); }
  std::size_t size() const { return gradient.inputs.size(); }
  Finding operator[](std::size_t i) const {
    return {objective.variables[i], gradient.point[i], calibration.inputs[i], gradient.inputs[i],
            gradient.centre.value};
  }
  int evaluations() const {
    int sum = 1;
    for (std::size_t i = 0; i < size(); ++i) sum += (*this)[i].evaluations();
    return sum;
  }
  std::string derivative_unit(const Variable& variable) const {
    const std::string unit(variable.quantity.unit_for(indenter()));
    if (unit == "1") return std::string(output_unit());
    return std::string(output_unit()) + " / " + (unit.find('/') == std::string::npos ? unit : '(' + unit + ')');
  }
};

Table table_of(const Findings& findings) {
  Table table{{"input", "value", "elasticity", "+-", "derivative", "+-", "unit", "noise", "scale", "step", "scheme",
               "evaluations"},
              {}};
  const auto number = [](double value) { return std::isfinite(value) ? Cell(value) : Cell(); };
  const auto rough = [](double value) { return std::isfinite(value) ? Cell(short_number(value, 2)) : Cell(); };
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const Finding finding = findings[i];
    const InputGradient& gradient = finding.gradient;
    const Quantity& quantity = finding.variable.quantity;
    table.rows.push_back({std::string(quantity.key), readable(finding.value, quantity.unit_for(findings.indenter())),
                          number(gradient.elasticity), rough(finding.elasticity_error()), number(gradient.derivative),
                          rough(gradient.error()), findings.derivative_unit(finding.variable),
                          rough(finding.relative_noise()), finding.variable.logarithmic ? "logarithmic" : "linear",
                          rough(gradient.step), std::string(name_of(gradient.scheme)),
                          static_cast<std::int64_t>(finding.evaluations())});
  }
  return table;
}

Json json_of(const Findings& findings) {
  const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); };
  const ObjectiveValue& centre = findings.gradient.centre;
  Json object{{"output", findings.objective.output.key},
              {"unit", findings.output_unit()},
              {"value", number(centre.value)},
              {"status", name_of(centre.status)},
              {"reason", centre.reason},
              {"evaluations", findings.evaluations()},
              {"seconds", findings.seconds},
              {"inputs", Json::array()}};
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const Finding finding = findings[i];
    const Variable& variable = finding.variable;
    const InputGradient& gradient = finding.gradient;
    Json failures = Json::array();
    for (const auto* const points : {&finding.calibration.failures, &gradient.failures})
      for (const FailedPoint& point : *points)
        failures.push_back({{"value", point.value}, {"status", name_of(point.status)}, {"reason", point.reason}});
    object["inputs"].push_back({{"key", variable.quantity.key},
                                {"unit", variable.quantity.unit_for(findings.indenter())},
                                {"value", finding.value},
                                {"lowest", number(variable.lowest)},
                                {"highest", number(variable.highest)},
                                {"scale", variable.logarithmic ? "logarithmic" : "linear"},
                                {"derivative", number(gradient.derivative)},
                                {"derivative_unit", findings.derivative_unit(variable)},
                                {"error", number(gradient.error())},
                                {"truncation_error", number(gradient.truncation_error)},
                                {"noise_error", number(gradient.noise_error)},
                                {"elasticity", number(gradient.elasticity)},
                                {"elasticity_error", number(finding.elasticity_error())},
                                {"noise", number(finding.calibration.noise)},
                                {"relative_noise", number(finding.relative_noise())},
                                {"step", number(gradient.step)},
                                {"scheme", name_of(gradient.scheme)},
                                {"evaluations", finding.evaluations()},
                                {"failures", failures}});
  }
  return object;
}

void print_text(const Findings& findings, Session& session) {
  const ObjectiveValue& centre = findings.gradient.centre;
  const std::string key(findings.objective.output.key);
  if (!centre.found()) {
    session.out << "status   " << name_of(centre.status) << "\nreason   " << centre.reason << '\n';
    return;
  }
  session.out << key << " = " << readable(centre.value, findings.output_unit()) << ", " << findings.evaluations()
              << " evaluations in " << duration_in_words(findings.seconds) << "\n\n";
  write_aligned(session.out, table_of(findings));
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const Finding finding = findings[i];
    const auto& first = finding.calibration.failures.empty() ? finding.gradient.failures : finding.calibration.failures;
    if (first.empty()) continue;
    session.err << finding.variable.quantity.key << ": "
                << finding.calibration.failures.size() + finding.gradient.failures.size()
                << " points without an answer, the first at " << short_number(first.front().value) << ": "
                << first.front().reason << '\n';
  }
}

/// Puts the place in front of a refusal.
template <class Function>
auto refusing_at(const std::string& place, Function function) {
  try {
    return function();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(place + ": " + error.what());
  }
}

void run_gradient(const GradientWords& words, Session& session) {
  const auto begin = std::chrono::steady_clock::now();
  const RollingScene scene = read_scene(words.scene, words.overrides);
  std::vector<InputChoice> inputs;
  for (const std::string& key : words.inputs) inputs.push_back({key});
  Objective objective{scene, {}, {}, session.evaluate};
  objective.output = refusing_at("--output", [&] { return real_output(words.output); });
  objective.variables = refusing_at(words.scene + " with --inputs", [&] { return variables_of(scene, inputs); });

  const std::vector<double> point = base_point(objective);
  const Calibration calibration = calibrate(objective, point, words.options.jobs);
  const Gradient slopes = calibration.centre.found() ? gradient(objective, point, calibration, words.options)
                                                     : Gradient{point, calibration.centre, {}};
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const Findings findings{objective, calibration, slopes, seconds};
  if (words.json)
    session.out << text_of(json_of(findings), 2) << '\n';
  else
    print_text(findings, session);
  if (!slopes.complete()) session.status = ExitStatus::no_answer;
}

}  // namespace

void add_gradient(CLI::App& program, Session& session) {
  CLI::App* const command =
      program.add_subcommand("gradient", "Differentiate one output of a scene by some of its inputs");
  const auto words = std::make_shared<GradientWords>();
  command->add_option("scene", words->scene, "Scene file (JSON)")->required()->option_text("SCENE");
  command->add_option("--inputs", words->inputs, "Inputs to differentiate by, separated by commas")
      ->required()
      ->delimiter(',')
      ->option_text("KEY,...");
  command->add_option("--output", words->output, "Output; default rolling_resistance")->option_text("KEY");
  command->add_option("--set", words->overrides, "Replace an input, in SI or with a unit; may be repeated")
      ->option_text("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--order", words->options.order, "2 or 4 (default): order of the differences")
      ->check(CLI::IsMember({2, 4}));
  command->add_option("--jobs", words->options.jobs, "Threads; default: one for each core")->check(CLI::Range(1, 1024));
  command->add_flag("--json", words->json, "Print one JSON object");
  command->footer(
      "Derivatives are by finite differences whose steps suit the noise of the output, which is measured first (8 or "
      "14\n"
      "evaluations for each input, then 2 or 4). \"+-\" is the estimated error: truncation and three standard "
      "deviations "
      "of\nthe noise. Steps are relative, noise is relative to the output; elasticity is d ln output / d ln input.\n"
      "Example: rollres gradient studies/examples/paper_cylinder.json --inputs load,speed,creep_time");
  command->callback([words, &session] { run_gradient(*words, session); });
}

}  // namespace rollres
