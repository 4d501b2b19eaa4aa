#include <algorithm>
#include <chrono>
#include <cmath>
#include <ostream>
#include <stdexcept>

#include "db/rows/schema.hpp"
#include "fitting/errors/statistics.hpp"
#include "studies/fit/fit_curves.hpp"
#include "studies/fit/fit_file.hpp"
#include "studies/fit/fit_summary.hpp"
#include "studies/fit/material_file.hpp"
#include "studies/program/commands.hpp"
#include "studies/run/stop_signal.hpp"
#include "studies/run/stored_evaluations.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/text/files.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

struct FitArguments {
  std::string fit, database, out;
  int jobs = 0, coverage = 0;
  std::uint64_t seed = 1;
  bool json = false, no_profiles = false, design = false;
};

/// The unit of the measured values; empty where they are of several kinds.
std::string_view unit_of_all(const FitFile& file) {
  for (const MeasuredScene& row : file.scenes)
    if (row.output != file.scenes.front().output) return "";
  return measured_quantity(file.scenes.front().output).unit_for(file.indenter());
}

FitContext context_of(const FitFile& file) {
  FitContext context{.name = file.name,
                     .kind = "resistance",
                     .definition = file.definition,
                     .data_digest = file.data_digest,
                     .indenter = file.indenter(),
                     .output_unit = unit_of_all(file),
                     .data_warnings = file.warnings,
                     .notes = file.notes};
  for (const FixedInput& fixed : file.fixed)
    context.fixed.push_back(
        {fixed.key, std::string(find_input(fixed.key)->quantity.unit_for(file.indenter())), fixed.value});
  return context;
}

/// Draws around the fit, solves them without the store (nobody asks for these scenes again) and counts.
Coverage coverage_of(const FitFile& file, const FitReport& report, const FitArguments& arguments, Session& session) {
  FitFile alone = file;
  for (std::size_t j = 0; j < alone.inputs.size(); ++j) alone.inputs[j].start = report.parameters[j].value;
  const FitProblem problem = problem_of(alone, session.evaluate, 1);
  return coverage(problem, report.point(), std::sqrt(report.errors.scale),
                  {.draws = arguments.coverage,
                   .seed = arguments.seed,
                   .jobs = arguments.jobs,
                   .profiles = !arguments.no_profiles,
                   .stop = file.options.stop});
}

/// The curves of the moduli at the reference temperature; data are shifted there.
FitCurves modulus_curves(const MaterialFile& file, const MaterialFit& found) {
  FitCurves curves{{.name = "reduced angular frequency", .symbol = "ω", .unit = "rad/s", .logarithmic = true},
                   {.name = "shear modulus", .unit = "Pa", .logarithmic = true},
                   {{.label = "storage"}, {.label = "loss"}}};
  std::vector<double> reduced;
  for (const MeasuredModulus& row : file.data)
    reduced.push_back(row.angular_frequency * shift_factor(found.shift, row.temperature));
  const auto [lowest, highest] = std::minmax_element(reduced.begin(), reduced.end());
  constexpr int pieces = 120;
  const double quantile = two_sided_quantile(confidence, found.report.deviations_known ? 0 : found.report.degrees);
  const auto add = [&](FitCurve& curve, double omega, double modulus, double error) {
    curve.x.push_back(omega);
    curve.value.push_back(modulus);
    curve.band.push_back(std::isfinite(error) ? quantile * error : 0);
  };
  auto &storage = curves.curves[0], &loss = curves.curves[1];
  for (std::size_t i = 0; i < reduced.size(); ++i) {
    storage.data.push_back(2 * i);
    loss.data.push_back(2 * i + 1);
  }
  storage.data_x = loss.data_x = reduced;
  for (int i = 0; i <= pieces; ++i) {
    const double omega = *lowest * std::pow(*highest / *lowest, static_cast<double>(i) / pieces);
    const std::complex<double> modulus = found.modulus(omega, found.shift.reference),
                               error = found.modulus_error(omega, found.shift.reference);
    add(storage, omega, modulus.real(), error.real());
    add(loss, omega, modulus.imag(), error.imag());
  }
  return curves;
}

/// Stores the fit, and tells by the exit status what it is worth.
void save(const FitReport& report, FitContext& context, std::chrono::steady_clock::time_point begin,
          const FitArguments& arguments, Session& session) {
  context.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  save_fit(open_database(arguments.database, Access::write), fit_record(report, context));
  if (report.status < FitStatus::usable_with_warnings) session.status = ExitStatus::no_answer;
}

void draw(const FitReport& report, const FitCurves& curves, const std::string& name, Indenter indenter,
          const FitArguments& arguments, Session& session) {
  for (const auto& picture : draw_fit(report, curves, name, arguments.out, indenter))
    session.err << "drawn: " << picture.string() << '\n';
}

void fit_resistance(const FitArguments& arguments, Session& session) {
  const auto begin = std::chrono::steady_clock::now();
  FitFile file = read_fit(arguments.fit);
  if (!arguments.out.empty()) make_directory(arguments.out);
  const StopSignal signal;
  file.options.stop = &signal.requested();
  file.options.profiles = !arguments.no_profiles;
  StoredEvaluations stored(session.evaluate, arguments.database);
  const Evaluate evaluate = [&](const RollingScene& scene) { return stored(scene); };
  const FitProblem problem = problem_of(file, evaluate, arguments.jobs);
  const FitReport report = refusing_at(file.source, [&] { return fit(problem, file.options); });
  FitContext context = context_of(file);
  context.solved = stored.count().solved;
  context.recalled = stored.count().recalled;
  save(report, context, begin, arguments, session);

  const bool known = report.slopes.found() && !report.interrupted;
  Json object = json_of(report, context);
  if (!arguments.json) session.out << fit_summary(report, context) << std::flush;
  if (arguments.design && known) {
    const FitDesign next = design_of(file, report, evaluate, arguments.jobs);
    object["design"] = json_of(next, report);
    if (!arguments.json) session.out << design_summary(next, file, report) << std::flush;
  }
  if (arguments.coverage > 0 && known) {
    const Coverage counted = coverage_of(file, report, arguments, session);
    object["coverage"] = json_of(counted);
    if (!arguments.json) session.out << coverage_summary(counted) << std::flush;
  }
  if (!arguments.out.empty() && known)
    draw(report, fit_curves(file, report, evaluate, arguments.jobs), file.name, file.indenter(), arguments, session);
  stored.flush();
  if (arguments.json) session.out << text_of(object, 2) << '\n';
}

void fit_moduli(const FitArguments& arguments, Session& session) {
  if (arguments.design || arguments.coverage > 0)
    throw std::invalid_argument(arguments.fit + ": --design and --coverage are for fits of scenes");
  const auto begin = std::chrono::steady_clock::now();
  MaterialFile file = read_material_fit(arguments.fit);
  if (!arguments.out.empty()) make_directory(arguments.out);
  const StopSignal signal;
  file.options.options.stop = &signal.requested();
  file.options.options.profiles = !arguments.no_profiles;
  const MaterialFit found = refusing_at(arguments.fit, [&] { return fit_material(file.data, file.options); });
  FitContext context{.name = file.name,
                     .kind = "material",
                     .definition = file.definition,
                     .data_digest = file.data_digest,
                     .output_unit = "Pa"};
  save(found.report, context, begin, arguments, session);
  if (arguments.json)
    session.out << text_of(json_of(found.report, context), 2) << '\n';
  else
    session.out << fit_summary(found.report, context) << std::flush;
  if (!arguments.out.empty() && found.report.slopes.found())
    draw(found.report, modulus_curves(file, found), file.name, Indenter::cylinder, arguments, session);
}

void run_fit(const FitArguments& arguments, Session& session) {
  is_material_fit(arguments.fit) ? fit_moduli(arguments, session) : fit_resistance(arguments, session);
}

}  // namespace

void add_fit(Command& program, Session& session) {
  const auto [command, arguments] = program.add<FitArguments>(
      "fit", "Fit a scene, or a material, to measured values, with intervals and a judgement", session, run_fit);
  command->add_option("fit FIT", arguments.fit, "Fit file (JSON): scene or material, data (CSV), parameters")
      ->required();
  command->add_option("--db FILE", arguments.database, "Database: every evaluation and the fit are stored here")
      ->required();
  command->add_option("--out DIR", arguments.out,
                      "Draw data, residuals, profiles and the worst pair's ellipse into DIR");
  command->add_flag("--design", arguments.design, "Which speed, and which load, to measure next");
  command
      ->add_option("--coverage N", arguments.coverage,
                   "Draw the data N times around the fit, fit them, and count the intervals that hold it")
      ->between(1, 1'000'000);
  command->add_option("--seed S", arguments.seed, "Of the draws; default 1");
  command->add_option("--jobs N", arguments.jobs, "Threads; default: one for each core")->between(1, 1024);
  command->add_flag("--no-profiles", arguments.no_profiles, "Leave out the intervals by profile likelihood");
  command->add_flag("--json", arguments.json, "Print one JSON object");
  command->footer(
      "Status: GOOD; USABLE WITH WARNINGS; NOT IDENTIFIED (the data do not bound a parameter); MISFIT (the model does "
      "not\n"
      "describe the data); DID NOT MOVE (ended where it started); NOT CONVERGED (no least misfit was found, or\n"
      "interrupted). Exit status 1 for the last four.\n"
      "Example: rollres fit studies/examples/fit_cylinder.json --db out/fit.db --out out/fit");
}

}  // namespace rollres
