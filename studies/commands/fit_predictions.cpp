#include "studies/commands/fit_predictions.hpp"

#include <ostream>
#include <stdexcept>

#include "db/rows/schema.hpp"
#include "fitting/fit/fit_report.hpp"
#include "studies/run/stop_signal.hpp"
#include "studies/run/stored_evaluations.hpp"
#include "studies/stored_fits/stored_fit.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/words.hpp"

namespace rollres {

Json tell_predictions(const FitRecord& fit, const PredictArguments& wanted, const Evaluate& evaluate,
                      Session& session) {
  const auto as = static_cast<PredictedAs>(find_name(ChoiceNames<PredictedAs>::names, wanted.as));
  const FitPredictions predictions = predictions_of(fit, wanted.scenes, as, wanted.data, evaluate, wanted.jobs);
  if (!wanted.json) session.out << prediction_summary(fit, predictions) << std::flush;
  if (const std::size_t without = predictions.without_answer(); without > 0) {
    session.err << without << " of " << predictions.values.size()
                << " scenes have no answer with the fitted values, or slopes that are noise\n";
    session.status = ExitStatus::no_answer;
  }
  if (!wanted.out.empty() && predictions.without_answer() < predictions.values.size())
    session.err << "drawn: "
                << draw_chart(prediction_chart(fit, predictions),
                              std::filesystem::path(wanted.out) / (fit.name + "_predictions.svg"))
                       .svg.string()
                << '\n';
  return json_of(predictions);
}

void predict_by_stored_fit(const std::string& name, const std::string& database, const PredictArguments& wanted,
                           Session& session) {
  const auto fit = find_fit(open_database(database, Access::read), name, FitParts::with_data);
  if (!fit)
    throw std::invalid_argument(name + ": there is no such file, and " + database + " holds no fit of this name");
  const StopSignal signal;
  StoredEvaluations stored(session.evaluate, database);
  if (!wanted.json)
    session.out << fit->name << ": " << fit->status << (fit->reason.empty() ? "" : ": " + fit->reason) << '\n';
  if (fit->status != name_of(FitStatus::good) && fit->status != name_of(FitStatus::usable_with_warnings))
    session.status = ExitStatus::no_answer;
  const Json list = tell_predictions(*fit, wanted, until_stopped(stored, signal.requested()), session);
  stored.flush();
  if (!wanted.json) return;
  Json object = json_of(*fit);
  object["predictions"] = list;
  session.out << text_of(object, 2) << '\n';
}

}  // namespace rollres
