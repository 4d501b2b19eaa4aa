#include "fitting/fit/measured_terms.hpp"

#include <cmath>
#include <deque>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>

#include "core/algebra/dense_algebra.hpp"

namespace rollres {

namespace {

/// The model's predictions, those of the last few points kept.
class RememberedModel {
 public:
  RememberedModel(FitProblem model, std::vector<MeasuredTerm> terms)
      : model_(std::move(model)), terms_(std::move(terms)) {}

  Prediction predict(const FitPoint& point, const DataRows& rows) {
    FitPoint own = point;
    for (const MeasuredTerm& term : terms_) own[term.parameter] = neutral(term.key);
    {
      const std::lock_guard lock(mutex_);
      for (const Known& known : known_)
        if (known.point == own && known.rows == rows) return known.prediction;
    }
    Prediction prediction = model_.predict(own, rows);
    const std::lock_guard lock(mutex_);
    if (prediction.found()) known_.push_back({own, rows, prediction});
    constexpr std::size_t most = 8;
    if (known_.size() > most) known_.pop_front();
    return prediction;
  }

  Prediction predicted(const FitPoint& point, const DataRows& rows) {
    Prediction prediction = predict(point, rows);
    for (Eigen::Index i = 0; prediction.found() && i < prediction.values.size(); ++i) {
      const std::size_t datum = rows.empty() ? static_cast<std::size_t>(i) : rows[static_cast<std::size_t>(i)];
      prediction.values[i] = factor(point, datum) * prediction.values[i] + shift(point, datum);
    }
    return prediction;
  }

  Slopes differentiate(const FitPoint& point, const Prediction& prediction) {
    Prediction raw = prediction;
    for (Eigen::Index i = 0; i < raw.values.size(); ++i) {
      const auto datum = static_cast<std::size_t>(i);
      raw.values[i] = (prediction.values[i] - shift(point, datum)) / factor(point, datum);
    }
    Slopes slopes = model_.differentiate(point, raw);
    for (Eigen::Index i = 0; slopes.found() && i < raw.values.size(); ++i) {
      const double by = factor(point, static_cast<std::size_t>(i));
      slopes.derivatives.row(i) *= by;
      slopes.errors.row(i) *= by;
      slopes.noise[i] *= by;
      for (const MeasuredTerm& term : terms_) {
        if (!term.acts[static_cast<std::size_t>(i)]) continue;
        const double slope = model_.parameters[term.parameter].variable.slope(point[term.parameter]);
        slopes.derivatives(i, static_cast<Eigen::Index>(term.parameter)) =
            term.key == offset_key ? slope : slope * by * raw.values[i] / point[term.parameter];
      }
    }
    return slopes;
  }

 private:
  struct Known {
    FitPoint point;
    DataRows rows;
    Prediction prediction;
  };

  static double neutral(std::string_view key) { return key == offset_key ? 0 : 1; }

  double factor(const FitPoint& point, std::size_t datum) const {
    double product = 1;
    for (const MeasuredTerm& term : terms_)
      if (term.key == scale_key && term.acts[datum]) product *= point[term.parameter];
    return product;
  }
  double shift(const FitPoint& point, std::size_t datum) const {
    double sum = 0;
    for (const MeasuredTerm& term : terms_)
      if (term.key == offset_key && term.acts[datum]) sum += point[term.parameter];
    return sum;
  }

  FitProblem model_;
  std::vector<MeasuredTerm> terms_;
  std::mutex mutex_;
  std::deque<Known> known_;
};

double value_of(const KnownBefore& known, const FitPoint& point) {
  double sum = 0;
  for (const KnownBefore::Part& part : known.parts)
    sum += part.weight * (part.logarithm ? std::log(point[part.parameter]) : point[part.parameter]);
  return sum;
}

/// Predictions of the measured values with those of what was known before behind them.
FitModel::Predict with_known(const FitModel::Predict& predict, const std::vector<KnownBefore>& known,
                             std::size_t measured) {
  return [=](const FitPoint& point, const DataRows& rows) {
    const auto row_at = [&](std::size_t place) { return rows.empty() ? place : rows[place]; };
    DataRows own;
    for (const std::size_t row : rows)
      if (row < measured) own.push_back(row);
    Prediction prediction;
    if (rows.empty() || !own.empty()) prediction = predict(point, own);
    if (!prediction.found()) return prediction;
    Eigen::VectorXd values(rows.empty() ? std::ssize(known) + prediction.values.size() : std::ssize(rows));
    for (Eigen::Index i = 0, next = 0; i < values.size(); ++i) {
      const std::size_t row = row_at(static_cast<std::size_t>(i));
      values[i] = row < measured ? prediction.values[next++] : value_of(known[row - measured], point);
    }
    prediction.values = values;
    return prediction;
  };
}

}  // namespace

Variable term_variable(std::string_view key, const Quantity& measured, double size) {
  if (key == scale_key)
    return {{scale_key, "", "1", "factor of measured values over true ones", positive},
            std::numeric_limits<double>::min(),
            std::numeric_limits<double>::infinity(),
            Scaling::logarithmic,
            1};
  Quantity offset = measured;
  offset.key = offset_key;
  offset.symbol = "";
  offset.meaning = "what measured values have too much";
  offset.range = any_number;
  return {offset, offset.range.lowest, offset.range.highest, Scaling::linear, size};
}

FitProblem with_terms(const FitProblem& model, std::vector<MeasuredTerm> terms) {
  if (terms.empty()) return model;
  const auto remembered = std::make_shared<RememberedModel>(model, std::move(terms));
  FitProblem problem = model;
  problem.model.predict = [remembered](const FitPoint& point, const DataRows& rows) {
    return remembered->predicted(point, rows);
  };
  problem.model.differentiate = [remembered](const FitPoint& point, const Prediction& prediction) {
    return remembered->differentiate(point, prediction);
  };
  return problem;
}

KnownBefore known_before(const Prior& prior, std::size_t parameter, const std::string& name) {
  return {.parts = {{parameter, prior.lognormal}},
          .mean = prior.lognormal ? std::log(prior.mean) : prior.mean,
          .deviation = prior.deviation,
          .of = name};
}

KnownBefore smooth_step(std::size_t before, std::size_t parameter, double deviation, const std::string& name) {
  return {.parts = {{parameter, true}, {before, true, -1}}, .deviation = deviation, .of = name};
}

std::vector<KnownBefore> known_before(const std::vector<FormerParameter>& former, const Eigen::MatrixXd& correlation) {
  // Of covariance L L^T the parameters' deviations by L^-1 are independent, each of deviation 1.
  const PositiveSystem system(correlation);
  if (!system.definite()) throw std::invalid_argument("the correlations of its parameters contradict one another");
  const Eigen::MatrixXd whitening = inverse_of_upper(system.lower().transpose()).transpose();
  std::vector<KnownBefore> known(former.size());
  for (std::size_t i = 0; i < former.size(); ++i)
    for (std::size_t k = 0; k <= i; ++k) {
      const FormerParameter& one = former[k];
      const double weight = whitening(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) / one.deviation;
      known[i].parts.push_back({one.parameter, one.logarithm, weight});
      known[i].mean += weight * (one.logarithm ? std::log(one.value) : one.value);
      known[i].of += (k > 0 ? ", " : "") + one.name;
    }
  return known;
}

FitProblem with_priors(const FitProblem& problem, const std::vector<KnownBefore>& known) {
  if (known.empty()) return problem;
  FitProblem with = problem;
  const std::size_t measured = problem.data.size();
  for (const KnownBefore& one : known)
    with.data.push_back(
        {.value = one.mean, .deviation = one.deviation, .place = "prior of " + one.of, .set = MeasuredValue::of_prior});
  with.model.predict = with_known(problem.model.predict, known, measured);
  if (problem.estimate) with.estimate = with_known(problem.estimate, known, measured);
  with.model.differentiate = [known, measured, problem](const FitPoint& point, const Prediction& prediction) {
    Slopes slopes = problem.differentiate(point, {prediction.values.head(static_cast<Eigen::Index>(measured)), ""});
    if (!slopes.found()) return slopes;
    const auto rows = static_cast<Eigen::Index>(measured), more = std::ssize(known);
    for (Eigen::MatrixXd* const matrix : {&slopes.derivatives, &slopes.errors}) {
      matrix->conservativeResize(rows + more, Eigen::NoChange);
      matrix->bottomRows(more).setZero();
    }
    slopes.noise.conservativeResize(rows + more);
    slopes.noise.tail(more).setZero();
    for (Eigen::Index i = 0; i < more; ++i) {
      for (const KnownBefore::Part& part : known[static_cast<std::size_t>(i)].parts) {
        const double value = point[part.parameter];
        const double slope = problem.parameters[part.parameter].variable.slope(value);
        slopes.derivatives(rows + i, static_cast<Eigen::Index>(part.parameter)) =
            part.weight * (part.logarithm ? slope / value : slope);
      }
    }
    return slopes;
  };
  return with;
}

}  // namespace rollres
