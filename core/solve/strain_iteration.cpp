#include "core/solve/strain_iteration.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/interior/interior_summary.hpp"
#include "core/material/strain_softening.hpp"
#include "core/messages/message_text.hpp"

namespace rollres {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double wanted_agreement = 1e-8;  // of the factors
constexpr int most_solutions = 30;
constexpr double longest_step = 1.5;  // of logarithms
constexpr int most_halvings = 12;

std::vector<const MaterialInputs*> layers_of(const RollingScene& scene) {
  std::vector<const MaterialInputs*> layers{&scene};
  for (const BondedLayer& layer : scene.lower_layers) layers.push_back(&layer);
  for (const BondedLayer& layer : scene.coating_layers) layers.push_back(&layer);
  return layers;
}

/// A layer that softens.
struct SoftLayer {
  std::size_t place;      ///< among all: under the body from the contact, then on it
  MaterialInputs inputs;  ///< linear
  CreepSpectrum spectrum;
};

/// Where the amplitudes and the frequency of a linear solution are.
struct Answered {
  RollingSolution solution;
  VectorXd logarithms;  ///< of the amplitudes, and of the frequency
};

class StrainIteration {
 public:
  StrainIteration(const RollingScene& scene, const std::function<RollingSolution(const RollingScene&)>& solve_linear)
      : scene_(scene), solve_linear_(solve_linear) {
    const std::vector<const MaterialInputs*> layers = layers_of(scene);
    layers_ = layers.size();
    for (std::size_t i = 0; i < layers.size(); ++i)
      if (softens(*layers[i])) soft_.push_back({i, *layers[i], creep_spectrum(*layers[i])});
  }

  RollingSolution run() {
    Answered linear = answer_with({});
    if (linear.solution.status != Status::converged) return std::move(linear.solution);
    VectorXd x = linear.logarithms;
    MatrixXd slopes = -MatrixXd::Identity(x.size(), x.size());
    for (std::size_t i = 0; i < soft_.size(); ++i) start(soft_[i].inputs, static_cast<Index>(i), x, slopes);
    std::optional<std::vector<SofteningFactors>> factors = factors_at(x);
    if (!factors) {
      x = linear.logarithms;
      factors = std::vector<SofteningFactors>(soft_.size());
    }
    Answered answer = answer_with(*factors);
    for (;;) {
      if (answer.solution.status != Status::converged) return std::move(answer.solution);
      const VectorXd residual = answer.logarithms - x;
      const std::optional<std::vector<SofteningFactors>> own = factors_at(answer.logarithms);
      if (own && disagreement(*factors, *own) <= wanted_agreement) return finished(std::move(answer), *factors);
      if (solutions_ >= most_solutions)
        return refused(message_text("the strains and the moduli do not settle in ", solutions_, " solutions"));
      VectorXd step = -slopes.partialPivLu().solve(residual);
      if (!step.allFinite()) step = residual;
      step *= std::min(1.0, longest_step / step.cwiseAbs().maxCoeff());
      std::optional<std::vector<SofteningFactors>> next = factors_at(x + step);
      for (int halving = 0; !next && halving < most_halvings; ++halving) next = factors_at(x + (step *= 0.5));
      if (!next) return refused(unreachable(x));
      Answered tried = answer_with(*next);
      if (tried.solution.status != Status::converged) return std::move(tried.solution);
      const VectorXd change = tried.logarithms - answer.logarithms - step;  // of the residual
      slopes += (change - slopes * step) * step.transpose() / step.squaredNorm();
      x += step;
      factors = std::move(next);
      answer = std::move(tried);
    }
  }

 private:
  /// First guess of an amplitude, and how it depends on itself.
  static void start(const MaterialInputs& layer, Index i, VectorXd& x, MatrixXd& slopes) {
    constexpr double by_modulus = -0.5, difference = 1e-4;
    const auto own = [&](double logarithm) {
      return by_modulus * std::log(softening_at(layer, std::exp(logarithm)).storage);
    };
    const double linear = x(i);
    for (int step = 0; step < 60; ++step) x(i) = 0.5 * (x(i) + linear + own(x(i)));
    slopes(i, i) = -1 + std::clamp((own(x(i) + difference) - own(x(i) - difference)) / (2 * difference), -0.5, 0.7);
  }

  std::optional<std::vector<SofteningFactors>> factors_at(const VectorXd& x) const {
    std::vector<SofteningFactors> all;
    for (std::size_t i = 0; i < soft_.size(); ++i) {
      const Softening wanted = softening_at(soft_[i].inputs, std::exp(x(static_cast<Index>(i))));
      const std::optional<SofteningFactors> found =
          softening_factors(soft_[i].spectrum, wanted, std::exp(x(x.size() - 1)));
      if (!found) return std::nullopt;
      all.push_back(*found);
    }
    return all;
  }

  static double disagreement(const std::vector<SofteningFactors>& one, const std::vector<SofteningFactors>& other) {
    double largest = 0;
    for (std::size_t i = 0; i < one.size(); ++i)
      largest = std::max(
          {largest, std::abs(other[i].rest / one[i].rest - 1), std::abs(other[i].relaxation / one[i].relaxation - 1)});
    return largest;
  }

  Answered answer_with(const std::vector<SofteningFactors>& factors) {
    std::vector<std::array<double, 2>> of_layers(factors.empty() ? 0 : layers_, {1, 1});
    for (std::size_t i = 0; i < factors.size(); ++i)
      of_layers[soft_[i].place] = {factors[i].rest, factors[i].relaxation};
    Answered answer;
    answer.solution.moduli_factors = of_layers;
    const RollingScene tried = solved_scene(scene_, answer.solution);
    answer.solution = solve_linear_(tried);
    answer.solution.moduli_factors = std::move(of_layers);
    ++solutions_;
    if (answer.solution.status != Status::converged) return answer;
    summary_ =
        interior_summary(solved_scene(scene_, answer.solution), answer.solution.fields, InteriorField::Detail::inside);
    answer.logarithms.resize(static_cast<Index>(soft_.size()) + 1);
    for (std::size_t i = 0; i < soft_.size(); ++i)
      answer.logarithms(static_cast<Index>(i)) =
          std::log(std::max(summary_.layers[soft_[i].place].strain_amplitude, 1e-300));
    const double half_length = 0.5 * answer.solution.contact_area;
    answer.logarithms(answer.logarithms.size() - 1) = std::log(scene_.speed / half_length);
    return answer;
  }

  RollingSolution finished(Answered answer, const std::vector<SofteningFactors>& factors) const {
    RollingSolution& solution = answer.solution;
    const double omega = std::exp(answer.logarithms(answer.logarithms.size() - 1));
    solution.strain_amplitude = summary_.strain_amplitude;
    solution.peak_strain_amplitude = summary_.peak_strain_amplitude;
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
    return std::move(answer.solution);
  }

  std::string name_of_layer(std::size_t place) const {
    const std::size_t under = 1 + scene_.lower_layers.size();
    if (place == 0) return "the layer in contact";
    if (place < under) return message_text("lower layer ", place);
    return message_text("coating ", place - under + 1);
  }

  std::string unreachable(const VectorXd& x) const {
    for (std::size_t i = 0; i < soft_.size(); ++i) {
      const double amplitude = std::exp(x(static_cast<Index>(i)));
      const Softening s = softening_at(soft_[i].inputs, 1.2 * amplitude);
      if (softening_factors(soft_[i].spectrum, s, std::exp(x(x.size() - 1)))) continue;
      return message_text(name_of_layer(soft_[i].place), ", near a strain amplitude of ", amplitude,
                          ": no positive modulus at rest gives G' times ", s.storage, " with G\" times ", s.loss,
                          "; its relaxation is too large beside the modulus at rest");
    }
    return "no linear material has the moduli of these strains";
  }

  RollingSolution refused(const std::string& reason) const {
    RollingSolution solution;
    solution.reason = reason;
    return solution;
  }

  const RollingScene& scene_;
  const std::function<RollingSolution(const RollingScene&)>& solve_linear_;
  std::size_t layers_ = 0;
  std::vector<SoftLayer> soft_;
  InteriorSummary summary_;
  int solutions_ = 0;
};

}  // namespace

bool softens(const RollingScene& scene) {
  const std::vector<const MaterialInputs*> layers = layers_of(scene);
  return std::any_of(layers.begin(), layers.end(), [](const MaterialInputs* layer) { return softens(*layer); });
}

RollingSolution solve_softening(const RollingScene& scene,
                                const std::function<RollingSolution(const RollingScene&)>& solve_linear) {
  return StrainIteration(scene, solve_linear).run();
}

}  // namespace rollres
