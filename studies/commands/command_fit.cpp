#include <chrono>
#include <cmath>
#include <ostream>
#include <stdexcept>
#include <type_traits>

#include "db/rows/schema.hpp"
#include "fitting/material/material_problem.hpp"
#include "studies/commands/fit_predictions.hpp"
#include "studies/fit/coverage_summary.hpp"
#include "studies/fit/fit_comparison.hpp"
#include "studies/fit/fit_curves.hpp"
#include "studies/fit/fit_design.hpp"
#include "studies/fit/fit_file.hpp"
#include "studies/fit/fit_keys.hpp"
#include "studies/fit/fit_record.hpp"
#include "studies/fit/fitted_scene.hpp"
#include "studies/fit/material_curves.hpp"
#include "studies/fit/material_file.hpp"
#include "studies/fit/shift_file.hpp"
#include "studies/fit/strain_file.hpp"
#include "studies/program/commands.hpp"
#include "studies/run/progress.hpp"
#include "studies/run/stop_signal.hpp"
#include "studies/run/stored_evaluations.hpp"
#include "studies/scene_io/scene_inputs.hpp"
#include "studies/stored_fits/fit_chart.hpp"
#include "studies/stored_fits/free_shift_files.hpp"
#include "studies/stored_fits/stored_fit.hpp"
#include "studies/text/files.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

struct FitArguments {
  std::vector<std::string> fits;
  std::string fit, database, out, scene;  ///< fit: the one that is at hand
  int jobs = 0, coverage = 0;
  std::uint64_t seed = 1;
  bool json = false, no_profiles = false, design = false, compare = false;
  PredictArguments predict;
  PredictArguments prediction() const { return {predict.scenes, predict.as, predict.data, out, jobs, json}; }
};

/// Draws around the fit, solves them without the store (nobody asks for these scenes again) and counts.
Coverage coverage_of(const FitFile& file, const FitReport& report, const FitArguments& arguments, Session& session) {
  FitFile alone = file;
  for (std::size_t j = 0; j < alone.inputs.size(); ++j) alone.inputs[j].start = report.parameters[j].value;
  FitProblem problem = problem_of(alone, session.evaluate, 1);
  for (std::size_t i = 0; i < report.values.size(); ++i)
    problem.data[i].deviation = report.values[i].measured.deviation;  // where the noise was fitted
  StatusLine line(session.err);
  const auto show = [&](int draws) {
    line.show(std::to_string(draws) + " of " + std::to_string(arguments.coverage) + " draws fitted");
  };
  const auto fit_drawn = [&](const FitProblem& drawn, const FitOptions& options) {
    FitFile own = alone;
    own.options = options;
    return fit(drawn, own);
  };
  return coverage(problem, report.point(), std::sqrt(report.errors.scale),
                  {.draws = arguments.coverage,
                   .seed = arguments.seed,
                   .jobs = arguments.jobs,
                   .profiles = !arguments.no_profiles,
                   .stop = file.options.stop,
                   .fit = fit_drawn,
                   .report = show});
}

void draw(const FitRecord& record, const FitArguments& arguments, Session& session) {
  for (const auto& picture : draw_fit(record, arguments.out)) session.err << "drawn: " << picture.string() << '\n';
}

/// A fit that was made and stored, with what is told of it.
struct MadeFit {
  FitCandidate candidate;
  FitRecord record;
};

/// Stores the fit, and tells by the exit status what it is worth.
MadeFit stored(FitCandidate candidate, FitRecord fit, std::chrono::steady_clock::time_point begin,
               const FitArguments& arguments, Session& session) {
  fit.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  save_fit(open_database(arguments.database, Access::write), fit);
  if (!arguments.scene.empty()) write_scene(arguments.scene, fit.scene);
  if (candidate.report.status < FitStatus::usable_with_warnings) session.status = ExitStatus::no_answer;
  return {std::move(candidate), std::move(fit)};
}

MadeFit make_resistance_fit(const FitArguments& arguments, FitFile file, StoredEvaluations& evaluations,
                            const StopSignal& signal, Session& session) {
  const auto begin = std::chrono::steady_clock::now();
  file.options.stop = &signal.requested();
  file.options.profiles = !arguments.no_profiles;
  const FitProblem problem = problem_of(
      file, [&](const RollingScene& scene) { return evaluations(scene); }, arguments.jobs);
  const FitReport report = refusing_at(file.source, [&] { return fit(problem, file); });
  FitRecord record = with_report(begun_fit(file), report, file.body());
  record.solved = static_cast<std::int64_t>(evaluations.count().solved);
  record.recalled = static_cast<std::int64_t>(evaluations.count().recalled);
  record.scene = fitted_scene(report, file);
  const std::string names = joined(report.parameters, ", ", [](const auto& one) { return one.parameter.name; });
  MadeFit made =
      stored({.source = arguments.fit, .name = file.name, .model = names, .report = report, .resistance = file},
             std::move(record), begin, arguments, session);
  if (!report.slopes.found() || report.interrupted) return made;
  // The fit is stored whatever becomes of its curves.
  made.record = with_curves(std::move(made.record),
                            fit_curves(file, report, until_stopped(evaluations, signal.requested()), arguments.jobs,
                                       arguments.out.empty() ? for_the_store : CurveDetail{}));
  save_fit(open_database(arguments.database, Access::write), made.record);
  if (signal.requested()) session.err << "interrupted: the fit is stored, its curves are not complete\n";
  return made;
}

std::string model_in_words(const MaterialFitOptions& options, const MaterialFit& found) {
  std::string words(name_of(options.form));
  if (options.form == MaterialForm::prony) words += ", " + std::to_string(found.prony.terms.size()) + " terms";
  if (options.shift.law == ShiftLaw::none) return words;
  if (options.free_shifts) return words + ", free shifts" + (found.shift.table.moduli.empty() ? "" : " and b_T");
  if (options.shift.law == ShiftLaw::table) return words + ", table of shifts";
  return words + ", " + std::string(shift_names[static_cast<std::size_t>(options.shift.law)]);
}

MadeFit make_material_fit(const FitArguments& arguments, MaterialFile file, Session& session) {
  const auto begin = std::chrono::steady_clock::now();
  file.options.options.profiles = !arguments.no_profiles;
  MaterialFit found = refusing_at(arguments.fit, [&] { return fit_material(file.data, file.options); });
  file.notes.insert(file.notes.end(), found.notes.begin(), found.notes.end());
  FitRecord record = with_report(begun_fit(file), found.report, Indenter::cylinder);
  record.scene = fitted_scene(found, file);
  if (found.report.slopes.found()) record = with_curves(std::move(record), modulus_curves(file, found));
  const std::string model = model_in_words(file.options, found);
  if (file.options.free_shifts && !arguments.out.empty() && found.report.slopes.found())
    for (const auto& written : write_free_shifts(found, file.data, file.name, arguments.out))
      session.err << "written: " << written.string() << '\n';
  const FitReport report = found.report;
  return stored({.source = arguments.fit,
                 .name = file.name,
                 .model = model,
                 .report = report,
                 .file = std::move(file),
                 .material = std::move(found)},
                std::move(record), begin, arguments, session);
}

MadeFit make_shift_fit(const FitArguments& arguments, ShiftFile file, Session& session) {
  const auto begin = std::chrono::steady_clock::now();
  file.options.profiles = !arguments.no_profiles;
  const ShiftFit found = refusing_at(
      arguments.fit, [&] { return fit_shift(file.data, file.law, file.deviation, file.options, file.relative_to); });
  file.notes.push_back("the values are ln a_T, reference temperature " + readable(file.law.reference, "K"));
  FitRecord record = with_report(begun_fit(file), found.report, Indenter::cylinder);
  record.scene = fitted_scene(found, file);
  if (found.report.slopes.found())
    record = with_curves(std::move(record), shift_curves(file, shift_at(file.law, found.report.point())));
  return stored({.source = arguments.fit,
                 .name = file.name,
                 .model = std::string(shift_names[static_cast<std::size_t>(file.law.law)]),
                 .report = found.report,
                 .shift_law = file.law.law},
                std::move(record), begin, arguments, session);
}

MadeFit make_strain_fit(const FitArguments& arguments, StrainFile file, Session& session) {
  const auto begin = std::chrono::steady_clock::now();
  file.options.profiles = !arguments.no_profiles;
  const StrainFit found =
      refusing_at(arguments.fit, [&] { return fit_strain_sweep(file.data, file.deviations_known, file.options); });
  FitRecord record = with_report(begun_fit(file), found.report, Indenter::cylinder);
  record.scene = fitted_scene(found, file);
  if (found.report.slopes.found()) record = with_curves(std::move(record), strain_curves(file, found));
  return stored({.source = arguments.fit, .name = file.name, .model = std::string(kraus_alone), .report = found.report},
                std::move(record), begin, arguments, session);
}

template <class File>
FitOptions& options_of(File& file) {
  if constexpr (std::is_same_v<File, MaterialFile>)
    return file.options.options;
  else
    return file.options;
}

/// Does one of two things with a fit's file: `alone`, with what reads and makes a fit of no scenes, or `of_scenes`.
template <class Alone, class OfScenes>
auto by_kind(const std::string& fit, const Alone& alone, const OfScenes& of_scenes) {
  switch (kind_of_fit(fit)) {
    case FitKind::shift:
      return alone(read_shift_fit, make_shift_fit);
    case FitKind::strain:
      return alone(read_strain_fit, make_strain_fit);
    case FitKind::material:
      return alone(read_material_fit, make_material_fit);
    case FitKind::resistance:
      break;
  }
  return of_scenes();
}

/// A fit of no scenes: read, made, told and drawn.
template <class Read, class Make>
void fit_alone(const FitArguments& arguments, Session& session, const Read& read, const Make& make) {
  if (arguments.design || arguments.coverage > 0 || !arguments.predict.scenes.empty())
    throw std::invalid_argument(arguments.fit + ": --predict, --design and --coverage are for fits of scenes");
  auto file = read(arguments.fit);
  if (!arguments.out.empty()) make_directory(arguments.out);
  const StopSignal signal;
  options_of(file).stop = &signal.requested();
  const MadeFit made = make(arguments, std::move(file), session);
  const FitReport& report = made.candidate.report;
  if (arguments.json)
    session.out << text_of(json_of(made.record), 2) << '\n';
  else
    session.out << fit_summary(made.record) << std::flush;
  if (!arguments.out.empty() && report.slopes.found()) draw(made.record, arguments, session);
}

void fit_resistance(const FitArguments& arguments, Session& session) {
  FitFile file = read_fit(arguments.fit);
  if (!arguments.out.empty()) make_directory(arguments.out);
  const StopSignal signal;
  StoredEvaluations stored(session.evaluate, arguments.database);
  const MadeFit made = make_resistance_fit(arguments, std::move(file), stored, signal, session);
  const FitReport& report = made.candidate.report;
  const FitFile& given = *made.candidate.resistance;

  const bool known = report.slopes.found() && !report.interrupted;
  Json object = json_of(made.record);
  if (!arguments.json) session.out << fit_summary(made.record) << std::flush;
  if (arguments.design && known) {
    const FitDesign next = design_of(given, report, until_stopped(stored, signal.requested()), arguments.jobs);
    if (signal.requested()) {
      session.err << "interrupted: the fit is stored, what to measure next is not known\n";
    } else {
      object["design"] = json_of(next);
      if (!arguments.json) session.out << design_summary(next, given) << std::flush;
    }
  }
  if (arguments.coverage > 0 && known && !signal.requested()) {
    const Coverage counted = coverage_of(given, report, arguments, session);
    object["coverage"] = json_of(counted);
    if (!arguments.json) session.out << coverage_summary(counted) << std::flush;
  }
  if (!arguments.predict.scenes.empty() && known && !signal.requested())
    object["predictions"] =
        tell_predictions(made.record, arguments.prediction(), until_stopped(stored, signal.requested()), session);
  if (!arguments.out.empty() && known) draw(made.record, arguments, session);
  stored.flush();
  if (arguments.json) session.out << text_of(object, 2) << '\n';
}

/// Fits all of the files, and says which model the data are most likely on.
void compare_fits(const FitArguments& given, Session& session) {
  if (given.design || given.coverage > 0 || !given.out.empty() || !given.scene.empty() || !given.predict.scenes.empty())
    throw std::invalid_argument("--compare: stands with --db, --jobs, --no-profiles and --json alone");
  if (given.fits.size() < 2) throw std::invalid_argument("--compare: needs two fit files at least");
  const StopSignal signal;
  StoredEvaluations stored(session.evaluate, given.database);
  std::vector<FitCandidate> fits;
  for (const std::string& fit : given.fits) {
    if (signal.requested()) break;
    FitArguments arguments = given;
    arguments.fit = fit;
    const auto alone = [&](const auto& read, const auto& make) {
      auto file = read(fit);
      options_of(file).stop = &signal.requested();
      return make(arguments, std::move(file), session);
    };
    const auto of_scenes = [&] { return make_resistance_fit(arguments, read_fit(fit), stored, signal, session); };
    fits.push_back(by_kind(fit, alone, of_scenes).candidate);
    session.err << fit << ": " << name_of(fits.back().report.status) << '\n';
  }
  if (fits.size() < given.fits.size()) throw std::runtime_error("interrupted: the fits that were made are stored");
  const FitComparison comparison = compare(fits, until_stopped(stored, signal.requested()), given.jobs);
  stored.flush();
  session.status = comparison.fits.front().usable ? ExitStatus::answered : ExitStatus::no_answer;
  if (given.json)
    session.out << text_of(json_of(comparison), 2) << '\n';
  else
    session.out << comparison_summary(comparison);
}

void run_fit(const FitArguments& given, Session& session) {
  if (given.compare) return compare_fits(given, session);
  if (given.fits.size() != 1) throw std::invalid_argument("several fits: need --compare");
  FitArguments arguments = given;
  arguments.fit = given.fits.front();
  if (!arguments.predict.scenes.empty() && !std::filesystem::exists(arguments.fit))
    return predict_by_stored_fit(arguments.fit, arguments.database, arguments.prediction(), session);
  by_kind(
      arguments.fit, [&](const auto& read, const auto& make) { fit_alone(arguments, session, read, make); },
      [&] { fit_resistance(arguments, session); });
}

}  // namespace

void add_fit(Command& program, Session& session) {
  const auto [command, arguments] = program.add<FitArguments>(
      "fit", "Fit a scene, or a material, to measured values, with intervals and a judgement", session, run_fit);
  command
      ->add_option("fits FIT", arguments.fits,
                   "fit file (JSON): scene or material, data (CSV), parameters; several with --compare; with --predict "
                   "also the name of a stored fit")
      ->required();
  command->add_option("--db FILE", arguments.database, "database: every evaluation and the fit are stored here")
      ->or_usual_database();
  command->add_option("--out DIR", arguments.out,
                      "draw data, residuals, profiles and the worst pair's ellipse into DIR");
  command->add_option("--scene FILE", arguments.scene, "write what was fitted as a scene file, with all digits: that of the first measurement; of a material without a scene its keys alone");
  command->add_flag("--design", arguments.design,
                    "tell what to measure next, within the ranges under design in the file");
  command
      ->add_option(
          "--coverage N", arguments.coverage,
          "draw data from the fit N times, fit them, and count the 95 % intervals that contain the fit's values")
      ->between(1, 1'000'000);
  command->add_option("--seed S", arguments.seed, "seed of --coverage; default: 1");
  command->add_option("--jobs N", arguments.jobs, "threads; default: one for each core")->between(1, 1024);
  command->add_option(
      "--predict SCENES", arguments.predict.scenes,
      "predict the fit's output with 95 % intervals, for a scene, for a study's points, or for the rows of a CSV file "
      "with the columns of the fit's data; --out draws them with the data");
  command
      ->add_option("--predict-as WHAT", arguments.predict.as,
                   "the model's true value (default), the reading with offset and scale, or one more measurement with "
                   "its noise")
      ->one_of(ChoiceNames<PredictedAs>::names);
  command->add_option("--predict-data SET", arguments.predict.data,
                      "data set whose offset, scale and noise count; default: the first");
  command->add_flag("--compare", arguments.compare,
                    "fit several files to the same data and compare them: AICc, BIC, weights, likelihood ratios");
  command->add_flag("--no-profiles", arguments.no_profiles, "leave out the intervals by profile likelihood");
  command->add_flag("--json", arguments.json, "print one JSON object");
  command->footer(
      "Status: GOOD; USABLE WITH WARNINGS; NOT IDENTIFIED (the data do not bound a parameter); MISFIT (the model does\n"
      "not describe the data); DID NOT MOVE (ended where it started); NOT CONVERGED (no least misfit was found, or\n"
      "interrupted). Exit status 1 for the last four.\n"
      "Examples: rollres fit studies/examples/fit_cylinder.json --db out/fit.db --out out/fit\n"
      "          rollres fit zener.json prony.json --compare --db out/fit.db\n"
      "          rollres fit fit_cylinder --predict studies/examples/speed_resistance.json --db out/fit.db");
}

}  // namespace rollres
