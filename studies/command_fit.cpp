#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <ostream>

#include "studies/commands.hpp"
#include "studies/fit_file.hpp"
#include "studies/fit_summary.hpp"
#include "studies/scene_inputs.hpp"
#include "studies/shared_recall.hpp"
#include "studies/stop_signal.hpp"

namespace rollres {

namespace {

struct FitWords {
  std::string fit, database, out;
  int jobs = 0;
  bool json = false, no_profiles = false;
};

FitContext context_of(const FitFile& file) {
  FitContext context{.name = file.name,
                     .kind = "resistance",
                     .definition = file.definition,
                     .data_digest = file.data_digest,
                     .indenter = file.indenter(),
                     .output_unit = real_output(file.output).unit_for(file.indenter()),
                     .data_warnings = file.warnings};
  for (const FixedInput& fixed : file.fixed)
    context.fixed.push_back(
        {fixed.key, std::string(find_input(fixed.key)->quantity.unit_for(file.indenter())), fixed.value});
  return context;
}

void fit_resistance(const FitWords& words, Session& session) {
  const auto begin = std::chrono::steady_clock::now();
  FitFile file = read_fit(words.fit);
  const StopSignal signal;
  file.options.stop = &signal.requested();
  file.options.profiles = !words.no_profiles;
  SharedRecall recall(words.database, session.evaluate);
  const Evaluate evaluate = [&recall](const RollingScene& scene) { return recall(scene); };
  const FitProblem problem = problem_of(file, evaluate, words.jobs);
  const FitReport report = fit(problem, file.options);
  recall.finish();

  FitContext context = context_of(file);
  context.solved = recall.solved();
  context.recalled = recall.recalled();
  context.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  save_fit(Database(words.database, Access::write), fit_record(report, context));
  session.out << (words.json ? fit_json(report, context) + '\n' : fit_summary(report, context)) << std::flush;
  if (report.status < FitStatus::usable_with_warnings) session.status = ExitStatus::no_answer;
}

}  // namespace

void add_fit(CLI::App& program, Session& session) {
  CLI::App* const command =
      program.add_subcommand("fit", "Fit inputs of a scene to measured values, with intervals and a judgement");
  const auto words = std::make_shared<FitWords>();
  command->add_option("fit", words->fit, "Fit file (JSON): scene, data (CSV), parameters")
      ->required()
      ->option_text("FIT");
  command->add_option("--db", words->database, "Database: every evaluation and the fit are stored here")
      ->required()
      ->option_text("FILE");
  command->add_option("--jobs", words->jobs, "Threads; default: one for each core")->check(CLI::Range(1, 1024));
  command->add_flag("--no-profiles", words->no_profiles, "Leave out the intervals by profile likelihood");
  command->add_flag("--json", words->json, "Print one JSON object");
  command->footer(
      "Status: USABLE; USABLE WITH WARNINGS; NOT IDENTIFIED (the data do not bound a parameter); DID NOT MOVE (ended\n"
      "where it started); NOT CONVERGED (no least misfit was found). Exit status 1 for the last three.\n"
      "Example: rollres fit studies/examples/fit_cylinder.json --db out/fit.db");
  command->callback([words, &session] { fit_resistance(*words, session); });
}

}  // namespace rollres
