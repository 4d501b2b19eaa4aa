#include "core/solve/strain_iteration.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/algebra/dense_algebra.hpp"
#include "core/interior/interior_summary.hpp"
#include "core/material/strain_softening.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/stated_error.hpp"
#include "core/scene/layer_name.hpp"
#include "core/solve/doubts.hpp"

namespace rollres {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Factors = std::vector<SofteningFactors>;

constexpr double wanted_agreement = 1e-8;  // of the factors
constexpr int most_solutions = 30, most_halvings = 12, most_stuck = 8;
constexpr double longest_step = 1.5;   // of logarithms
constexpr double first_retreat = 0.2;  // of ln gamma

/// A layer that softens.
struct SoftLayer {
  std::size_t place;      ///< among all: under the body from the contact, then on it
  MaterialInputs inputs;  ///< linear
  CreepSpectrum spectrum;
};

/// Where the amplitudes and the frequency of a linear solution are.
struct Answered {
  RollingSolution solution;
  InteriorSummary inside;
  VectorXd logarithms;  ///< of the amplitudes, and of the frequency
};

class StrainIteration {
 public:
  StrainIteration(const ContactModel& model, const std::function<RollingSolution(const ContactModel&)>& solve_linear)
      : model_(model), solve_linear_(solve_linear) {
    const std::vector<const ModelLayer*> layers = model.layers();
    layers_ = layers.size();
    for (std::size_t i = 0; i < layers.size(); ++i)
      if (softens(*layers[i])) soft_.push_back({i, *layers[i], layers[i]->creep});
    offset_ = VectorXd::Zero(static_cast<Index>(soft_.size()) + 1);
  }

  RollingSolution run() {
    Factors factors(soft_.size());
    Answered answer = answer_with(factors);
    MatrixXd slopes = slopes_of_hertz(answer);
    if (answer.solution.status == Status::converged && is_dear(answer.solution) &&
        !agree(factors, answer, wanted_agreement))
      approach_roughly(factors, answer, slopes);
    if (const std::string why = settle(factors, answer, slopes, wanted_agreement, most_solutions); !why.empty())
      return without_answer(Method::newton, Status::not_converged, why);
    if (answer.solution.status != Status::converged) return std::move(answer.solution);
    return finished(std::move(answer), factors);
  }

 private:
  /// Goes on to factors that agree with their answer, which are left in place with it; where a solution has not
  /// converged that is the answer. @return why there are none, or nothing
  std::string settle(Factors& factors, Answered& answer, MatrixXd& slopes, double wanted, int most) {
    for (;;) {
      if (answer.solution.status != Status::converged) return {};
      if (agree(factors, answer, wanted)) return {};
      if ((rough_ ? rough_solutions_ : solutions_) >= most)
        return message_text("the strains and the moduli do not settle in ", solutions_, " solutions");
      const std::optional<Factors> next = agreeing_factors(answer.logarithms, factors, slopes);
      if (!next || stuck_ > most_stuck) return unreachable(answer.logarithms);
      Answered tried = answer_with(*next);
      if (tried.solution.status == Status::converged) {
        const VectorXd step = in_logarithms(*next) - in_logarithms(factors);
        const VectorXd missed = tried.logarithms - answer.logarithms - slopes * step;
        if (step.squaredNorm() > 0) slopes += missed * step.transpose() / step.squaredNorm();
        factors = *next;
      }
      answer = std::move(tried);
    }
  }

  /// Whether a solution costs many times what one on the usual grid does, without inertia: where a grid stands in for
  /// continuous edges or is as fine as a tolerance asks.
  bool is_dear(const RollingSolution& solution) const {
    return solution.method != Method::spectral && model_.method != Method::newton_dense &&
           (model_.tolerance || model_.method == Method::spectral);
  }

  /// To factors that agree by solutions on the usual grid, which are taken to miss what they miss of the last answer,
  /// until the answer there agrees, too. What is found is left in place, with its slopes; the rest is for `settle`.
  void approach_roughly(Factors& factors, Answered& answer, MatrixXd& slopes) {
    constexpr double near_enough_at_first = 1e-5;  // about what the grid misses otherwise at other factors
    constexpr int most_rounds = 4, most_rough = 12;
    rough_ = true;
    Answered there = answer_with(factors);
    for (int round = 0; round < most_rounds && there.solution.status == Status::converged; ++round) {
      offset_ = offset_ + answer.logarithms - there.logarithms;
      there.logarithms = answer.logarithms;
      Factors found = factors;
      const std::string why = settle(found, there, slopes, round == 0 ? near_enough_at_first : 0.2 * wanted_agreement,
                                     rough_solutions_ + most_rough);
      if (!why.empty() || there.solution.status != Status::converged || disagreement(factors, found) == 0) break;
      rough_ = false;
      Answered next = answer_with(found);
      if (next.solution.status != Status::converged) break;
      factors = std::move(found);
      answer = std::move(next);
      if (agree(factors, answer, wanted_agreement)) break;
      rough_ = true;
    }
    rough_ = false;
    stuck_ = 0;
  }

  static VectorXd in_logarithms(const Factors& factors) {
    VectorXd all(2 * static_cast<Index>(factors.size()));
    for (std::size_t i = 0; i < factors.size(); ++i) {
      all(2 * static_cast<Index>(i)) = std::log(factors[i].rest);
      all(2 * static_cast<Index>(i) + 1) = std::log(factors[i].relaxation);
    }
    return all;
  }

  /// Of ln gamma_i and ln omega by the logarithms of the factors: as G'^(-1/2) and G'^(1/2), as under a Hertz line.
  MatrixXd slopes_of_hertz(const Answered& linear) const {
    const auto count = static_cast<Index>(soft_.size());
    MatrixXd slopes = MatrixXd::Zero(count + 1, 2 * count);
    if (linear.solution.status != Status::converged) return slopes;
    const double omega = std::exp(linear.logarithms(count));
    for (Index i = 0; i < count; ++i) {
      const CreepSpectrum& spectrum = soft_[static_cast<std::size_t>(i)].spectrum;
      const double at_rest = 1 / spectrum.at_rest(), whole = (1.0 / spectrum(omega)).real();
      for (const auto& [column, share] : {std::pair{2 * i, at_rest / whole}, {2 * i + 1, 1 - at_rest / whole}}) {
        slopes(i, column) = -0.5 * share;
        slopes(count, column) = 0.5 * share / static_cast<double>(count);
      }
    }
    return slopes;
  }

  /// The factors of amplitudes x that a solution with these factors would have, if it were answer + slopes * change of
  /// the factors' logarithms: Newton's method with differences, which stops where it gets no nearer; nothing where no
  /// factors are found.
  std::optional<Factors> agreeing_factors(const VectorXd& answer, const Factors& factors, const MatrixXd& slopes) {
    constexpr int most_steps = 40;
    constexpr double difference = 1e-6, settled = 1e-13, rough = 0.05;
    const VectorXd before = in_logarithms(factors);
    const auto missing = [&](const VectorXd& x) -> std::optional<VectorXd> {
      const auto found = factors_at(x);
      if (!found) return std::nullopt;
      return VectorXd(answer + slopes * (in_logarithms(*found) - before) - x);
    };
    // From small strains, which any material bears, towards those of the answer.
    VectorXd x = answer;
    for (int halving = 0; !missing(x) && halving < most_halvings; ++halving)
      x.head(x.size() - 1).array() -= first_retreat * (1 << std::min(halving, 5));
    std::optional<VectorXd> residual = missing(x);
    if (!residual) return std::nullopt;
    for (int step = 0; step < most_steps && residual->cwiseAbs().maxCoeff() > settled; ++step) {
      MatrixXd jacobian(x.size(), x.size());
      for (Index i = 0; i < x.size(); ++i) {
        VectorXd moved = x;
        moved(i) -= difference;
        const std::optional<VectorXd> there = missing(moved);
        if (!there) return std::nullopt;
        jacobian.col(i) = (*residual - *there) / difference;
      }
      VectorXd change = -SquareSystem(jacobian).solve(*residual);
      if (!change.allFinite()) return std::nullopt;
      change *= std::min(1.0, longest_step / change.cwiseAbs().maxCoeff());
      std::optional<VectorXd> next = missing(x + change);
      for (int halving = 0; halving < most_halvings && !(next && next->norm() < residual->norm()); ++halving)
        next = missing(x + (change *= 0.5));
      if (!next || !(next->norm() < residual->norm())) break;
      x += change;
      residual = next;
    }
    if (residual->cwiseAbs().maxCoeff() > rough) ++stuck_;
    return factors_at(x);
  }

  std::optional<Factors> factors_at(const VectorXd& x) const {
    Factors all;
    for (std::size_t i = 0; i < soft_.size(); ++i) {
      const Softening wanted = softening_at(soft_[i].inputs, std::exp(x(static_cast<Index>(i))));
      const std::optional<SofteningFactors> found =
          softening_factors(soft_[i].spectrum, wanted, std::exp(x(x.size() - 1)));
      if (!found) return std::nullopt;
      all.push_back(*found);
    }
    return all;
  }

  bool agree(const Factors& factors, const Answered& answer, double wanted) const {
    const std::optional<Factors> own = factors_at(answer.logarithms);
    return own && disagreement(factors, *own) <= wanted;
  }

  static double disagreement(const Factors& one, const Factors& other) {
    double largest = 0;
    for (std::size_t i = 0; i < one.size(); ++i)
      largest = std::max(
          {largest, std::abs(other[i].rest / one[i].rest - 1), std::abs(other[i].relaxation / one[i].relaxation - 1)});
    return largest;
  }

  Answered answer_with(const Factors& factors) {
    std::vector<std::array<double, 2>> of_layers(layers_, {1, 1});
    for (std::size_t i = 0; i < factors.size(); ++i)
      of_layers[soft_[i].place] = {factors[i].rest, factors[i].relaxation};
    Answered answer;
    answer.solution.moduli_factors = of_layers;
    ContactModel tried = model_.with_answer(answer.solution);
    if (rough_) {
      tried.asked_method = tried.method = Method::newton;
      tried.tolerance.reset();
      tried.asked_tolerance.reset();
      tried.spacing.reset();
      if (tried.inertia_automatic) tried.inertia = false;
    }
    answer.solution = solve_linear_(tried);
    answer.solution.moduli_factors = std::move(of_layers);
    ++(rough_ ? rough_solutions_ : solutions_);
    if (answer.solution.status != Status::converged) return answer;
    answer.inside =
        interior_summary(model_.with_answer(answer.solution), answer.solution.fields, InteriorField::Detail::inside);
    answer.logarithms.resize(static_cast<Index>(soft_.size()) + 1);
    for (std::size_t i = 0; i < soft_.size(); ++i)
      answer.logarithms(static_cast<Index>(i)) =
          std::log(std::max(answer.inside.layers[soft_[i].place].strain_amplitude, 1e-300));
    answer.logarithms(answer.logarithms.size() - 1) = std::log(model_.speed / answer.inside.half_length);
    if (rough_) answer.logarithms += offset_;
    return answer;
  }

  /// What the error of the amplitudes does to the rolling resistance [1]. That goes as G" and at most as G'^(-3/2) (a
  /// Hertz line under a given load), and the amplitude follows as G'^(-1/2).
  double error_of_amplitudes(const Answered& answer) const {
    constexpr double of_storage = 1.5, difference = 1e-3, strongest = 0.8;
    double error = 0;
    const double unseen = unseen_loss(answer);
    for (std::size_t i = 0; i < soft_.size(); ++i) {
      const LayerLoss& layer = answer.inside.layers[soft_[i].place];
      if (!(layer.strain_amplitude > 0)) continue;
      const auto at = [&](double step) {
        return softening_at(soft_[i].inputs, layer.strain_amplitude * std::exp(step));
      };
      const Softening low = at(-difference), high = at(difference);
      const double by_storage = std::abs(std::log(high.storage / low.storage)) / (2 * difference);
      const double by_loss = std::abs(std::log(high.loss / low.loss)) / (2 * difference);
      error += (by_loss + of_storage * by_storage) / (1 - std::min(0.5 * by_storage, strongest)) *
               (layer.amplitude_error / layer.strain_amplitude + unseen);
    }
    return error;
  }

  /// What the lines miss of the loss, which is at depths below the shortest waves: its strains are missing in the mean.
  static double unseen_loss(const Answered& answer) {
    const double whole = std::abs(answer.solution.viscous_loss), seen = std::abs(answer.inside.loss);
    return on_grid(answer.solution.method) || seen == 0 ? 0 : std::abs(whole - seen) / std::max(whole, seen);
  }

  void add_error_of_amplitudes(const Answered& answer, RollingSolution& solution) const {
    const double error = error_of_amplitudes(answer);
    const bool missed = model_.tolerance && solution.error_estimate > *model_.tolerance;
    add_error(error, solution);
    if (model_.tolerance && !missed && solution.error_estimate > *model_.tolerance)
      solution.warnings.push_back(tolerance_missed(*model_.tolerance, solution, "",
                                                   message_text("the strain amplitudes are ", error, " of it")));
  }

  RollingSolution finished(Answered answer, const Factors& factors) const {
    RollingSolution& solution = answer.solution;
    add_error_of_amplitudes(answer, solution);
    const double omega = std::exp(answer.logarithms(answer.logarithms.size() - 1));
    solution.strain_amplitude = answer.inside.strain_amplitude;
    solution.peak_strain_amplitude = answer.inside.peak_strain_amplitude;
    solution.softening = INFINITY;
    for (std::size_t i = 0; i < soft_.size(); ++i) {
      const double amplitude = std::exp(answer.logarithms(static_cast<Index>(i)));
      const Softening s = softening_at(soft_[i].inputs, amplitude);
      solution.softening = std::min(solution.softening, s.storage);
      solution.model +=
          message_text("; ", name_of_layer(soft_[i].place), ": moduli at a shear strain amplitude of ", amplitude,
                       " and ", omega, " rad/s: G' times ", s.storage, ", G\" times ", s.loss,
                       " (modulus at rest times ", factors[i].rest, ", relaxation times ", factors[i].relaxation, ")");
      if (const auto largest = largest_measured_strain(soft_[i].inputs); largest && amplitude > *largest)
        solution.warnings.push_back(message_text("sweep_strains: the strain amplitude ", amplitude, " of ",
                                                 name_of_layer(soft_[i].place), " is beyond the largest measured, ",
                                                 *largest, ", whose moduli are taken"));
    }
    solution.model += message_text("; found in ", solutions_, " linear solutions");
    if (rough_solutions_ > 0) solution.model += message_text(" and ", rough_solutions_, " on the usual grid");
    return std::move(answer.solution);
  }

  std::string name_of_layer(std::size_t place) const {
    const std::size_t under = model_.foundation.size();
    const bool on_body = place >= under;
    const std::vector<std::size_t> places = layers_of_scene(on_body ? model_.coating : model_.foundation);
    const std::size_t layer = on_body ? place - under : place;
    const auto first = std::find(places.begin(), places.end(), places[layer]) - places.begin();
    const bool alone = std::count(places.begin(), places.end(), places[layer]) == 1;
    return layer_name(on_body, places[layer]) +
           (alone ? "" : message_text(", sublayer ", layer - static_cast<std::size_t>(first) + 1));
  }

  std::string unreachable(const VectorXd& x) const {
    for (std::size_t i = 0; i < soft_.size(); ++i) {
      const double omega = std::exp(x(x.size() - 1));
      double amplitude = std::exp(x(static_cast<Index>(i)));
      const double farthest = 10 * amplitude;
      const auto borne = [&] {
        return softening_factors(soft_[i].spectrum, softening_at(soft_[i].inputs, amplitude), omega).has_value();
      };
      while (borne() && amplitude < farthest) amplitude *= 1.1;
      if (borne()) continue;
      const Softening s = softening_at(soft_[i].inputs, amplitude);
      return message_text(name_of_layer(soft_[i].place), ", near a strain amplitude of ", amplitude,
                          ": no positive modulus at rest gives G' times ", s.storage, " with G\" times ", s.loss,
                          "; its relaxation is too large beside the modulus at rest");
    }
    return "no linear material has the moduli of these strains";
  }

  const ContactModel& model_;
  const std::function<RollingSolution(const ContactModel&)>& solve_linear_;
  std::size_t layers_ = 0;
  std::vector<SoftLayer> soft_;
  int solutions_ = 0, rough_solutions_ = 0;
  bool rough_ = false;  // on the usual grid, whatever the scene asks for
  VectorXd offset_;     // of logarithms found so, to what the scene asks for
  int stuck_ = 0;       // how often no factors that agree were near
};

}  // namespace

bool softens(const ContactModel& model) {
  const std::vector<const ModelLayer*> layers = model.layers();
  return std::any_of(layers.begin(), layers.end(), [](const ModelLayer* layer) { return softens(*layer); });
}

RollingSolution solve_softening(const ContactModel& full,
                                const std::function<RollingSolution(const ContactModel&)>& solve_linear) {
  return StrainIteration(full, solve_linear).run();
}

}  // namespace rollres
