#include "core/estimate/composite_estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>

#include "core/material/master_curve.hpp"
#include "core/material/material_scale.hpp"
#include "core/model/contact_surface.hpp"
#include "core/numerics/bracketed_root.hpp"
#include "core/numerics/quadrature.hpp"

namespace rollres {

namespace {

constexpr std::array<double, 13> borders{1e-4, 1e-3, 1e-2, 0.05, 0.2, 0.6, 1.5, 3, 5, 8, 12, 20, 40};

/// phi(z) and its derivative.
struct PressureTransform {
  double phi, change;

  PressureTransform(bool sphere, double z) {
    if (sphere) {
      const double sine = std::sin(z), cosine = std::cos(z);
      phi = z < 0.05 ? 1 - z * z / 10 : 3 * (sine - z * cosine) / (z * z * z);
      change = z < 0.05 ? -z / 5 : -3 * ((3 - z * z) * sine - 3 * z * cosine) / (z * z * z * z);
    } else {
      phi = 2 * ::j1(z) / z;
      change = -2 * ::jn(2, z) / z;
    }
  }
};

class HertzPressure {
 public:
  explicit HertzPressure(const ContactModel& model)
      : sphere_(model.dimension == 3), radius_(model.radius), surface_(steady_surface(model)) {}

  ContactEstimate at(double half_width) const { return contact(half_width, response(half_width, false)); }

  /// @param found  the response at this half-width
  ContactEstimate contact(double half_width, const HertzResponse& found) const {
    const double a = half_width;
    const double load = -(sphere_ ? 0.8 : 0.5) * a / (radius_ * found.slope);
    return {a, load * found.compliance + a * a / ((sphere_ ? 5 : 8) * radius_), load};
  }

  /// The change of one layer's moduli.
  using Stiffen = std::function<void(SteadySurface::Moduli&, double factor)>;

  /// What a modulus of 1 Pa at each time, added to one layer's, changes slope and loss by.
  struct Changes {
    Eigen::VectorXd slope, loss;
  };
  Changes changes(double half_width, const CreepSpectrum& material, const Stiffen& stiffen,
                  const Eigen::ArrayXd& times) const {
    Changes sum{Eigen::VectorXd::Zero(times.size()), Eigen::VectorXd::Zero(times.size())};
    // Of the normal compliance, for a modulus that is not passed through the layer's memory.
    const auto derivative = [&](const SteadySurface::Moduli& moduli, double along, double across) {
      constexpr double step = 1e-5;
      SteadySurface::Moduli stiffer = moduli;
      stiffen(stiffer, 1 + step);
      return (surface_(stiffer, along, across).normal - surface_(moduli, along, across).normal) *
             material(-along * surface_.speed()) / step;
    };
    const auto turns = [&](double along) -> Eigen::ArrayXcd {
      const Eigen::ArrayXd turn = -along * surface_.speed() * times;
      Eigen::ArrayXcd answer(times.size());
      answer.real() = 1 - 1 / (1 + turn.square());
      answer.imag() = times.isInf().select(0, turn / (1 + turn.square()));
      return answer;
    };
    for_waves(half_width, [&](double z, double k, double weight) {
      const PressureTransform transform(sphere_, z);
      const SteadySurface::Moduli moduli = surface_.moduli(k);
      const std::complex<double> c = surface_(moduli, k, 0).normal, rate = derivative(moduli, k, 0);
      const Eigen::ArrayXcd change = rate * turns(k);
      sum.slope.array() +=
          weight * 2 * transform.phi * transform.change * k * (std::conj(c) * change).real() / std::abs(c);
      const double squared = weight * transform.phi * transform.phi;
      if (!sphere_) {
        sum.loss.array() += squared * k * change.imag();
        return;
      }
      for_directions(k, [&](double along, double across, double part) {
        sum.loss.array() +=
            squared * part * along * (derivative(surface_.moduli(along), along, across) * turns(along)).imag();
      });
    });
    return sum;
  }

  /// What the waves take of the power, by k_x, rising.
  struct WaveLoss {
    double along, loss;
  };
  std::vector<WaveLoss> losses(double half_width) const {
    std::vector<WaveLoss> all;
    for_waves(half_width, [&](double z, double k, double weight) {
      const double squared = weight * std::pow(PressureTransform(sphere_, z).phi, 2);
      if (!sphere_) return all.push_back({k, squared * along_the_motion(k).loss});
      for_directions(k, [&](double along, double across, double part) {
        const std::complex<double> c = surface_(surface_.moduli(along), along, across).normal;
        all.push_back({along, squared * part * along * c.imag()});
      });
    });
    std::sort(all.begin(), all.end(), [](const WaveLoss& a, const WaveLoss& b) { return a.along < b.along; });
    return all;
  }

  /// @param with_loss  takes a sphere's waves of all directions one by one, for its compliance, too; else they answer
  /// as those along the motion
  HertzResponse response(double half_width, bool with_loss) const {
    HertzResponse sum{0, 0, 0};
    for_waves(half_width, [&](double z, double k, double weight) {
      const PressureTransform transform(sphere_, z);
      const WaveAnswer answer = sphere_ && with_loss ? mean_of_directions(k) : along_the_motion(k);
      sum.compliance += weight * answer.compliance * transform.phi * transform.phi;
      sum.slope += weight * answer.compliance * 2 * transform.phi * transform.change * k;
      sum.loss += weight * answer.loss * transform.phi * transform.phi;
    });
    return sum;
  }

 private:
  /// visit(z, k = z/a, weight) for the nodes of the integral over k.
  template <class Visit>
  void for_waves(double half_width, const Visit& visit) const {
    for (std::size_t panel = 0; panel + 1 < borders.size(); ++panel) {
      const double from = borders[panel], to = borders[panel + 1];
      const QuadratureRule& rule = gauss_rule(to > 3 ? 10 : 6);
      for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
        const double z = from + (to - from) * rule.nodes[q], k = z / half_width;
        visit(z, k, rule.weights[q] * (to - from) / half_width * (sphere_ ? k / (2 * M_PI) : 1 / M_PI));
      }
    }
  }

  /// visit(k_x, k_y, weight) for directions of a sphere's waves, whose weights add up to 1.
  template <class Visit>
  static void for_directions(double k, const Visit& visit) {
    const QuadratureRule& rule = gauss_rule(6);
    for (std::size_t q = 0; q < rule.nodes.size(); ++q) {
      const double angle = M_PI / 2 * rule.nodes[q];
      visit(k * std::cos(angle), k * std::sin(angle), rule.weights[q]);
    }
  }

  /// Of a wave under pressure: |c| and k_x Im c.
  struct WaveAnswer {
    double compliance, loss;
  };
  WaveAnswer along_the_motion(double k) const {
    const std::complex<double> c = surface_(surface_.moduli(k), k, 0).normal;
    return {std::abs(c), k * c.imag()};
  }
  WaveAnswer mean_of_directions(double k) const {
    WaveAnswer mean{0, 0};
    for_directions(k, [&](double along, double across, double part) {
      const std::complex<double> c = surface_(surface_.moduli(along), along, across).normal;
      mean.compliance += part * std::abs(c);
      mean.loss += part * along * c.imag();
    });
    return mean;
  }

  bool sphere_;
  double radius_;
  SteadySurface surface_;
};

}  // namespace

ContactEstimate composite_estimate(const ContactModel& model) {
  const HertzPressure pressure(model);
  // Of the half-width over the radius, so that units do not tell where the search ends.
  const auto at = [&](double logarithm) { return pressure.at(model.radius * std::exp(logarithm)); };
  const auto excess = [&](double logarithm) {
    const ContactEstimate found = at(logarithm);
    return model.load ? std::log(found.load / *model.load) : std::log(found.approach / *model.approach);
  };
  double low = std::log(0.1), high = low;
  constexpr double farthest = 100;  // e^100 = 3e43 radii, or as small a part of one
  while (low > -farthest && excess(low) > 0) low -= 1;
  while (high < farthest && excess(high) < 0) high += 1;
  const std::optional<double> found = root_between(excess, low, high, 1e-4);
  if (!found)
    throw std::domain_error(model.load ? no_half_width("load", *model.load)
                                       : no_half_width("approach", *model.approach));
  ContactEstimate estimate = at(*found);
  if (std::isinf(total_thickness(model)) && model.dimension == 2) estimate.approach = NAN;
  return estimate;
}

ContactEstimate contact_of_width(const ContactModel& model, double half_width) {
  return HertzPressure(model).at(half_width);
}

HertzResponse hertz_response(const ContactModel& model, double half_width) {
  return HertzPressure(model).response(half_width, true);
}

std::optional<LossBand> loss_band(const ContactModel& model, double half_width) {
  constexpr double aside = 0.1;
  const auto losses = HertzPressure(model).losses(half_width);
  double total = 0;
  for (const auto& wave : losses) total += wave.loss;
  if (!(total > 0)) return std::nullopt;
  // Logarithms of k_x where that part of the power is reached, straight between the waves' middles.
  const auto reached = [&](double part) {
    double below = 0, before = 0, at = std::log(losses.front().along);
    for (const auto& wave : losses) {
      const double here = below + 0.5 * wave.loss / total, place = std::log(wave.along);
      if (here >= part) return here > before ? at + (place - at) * (part - before) / (here - before) : place;
      before = here;
      at = place;
      below += wave.loss / total;
    }
    return at;
  };
  const auto frequency = [&](double part) { return model.speed * std::exp(reached(part)) / (2 * M_PI); };
  return LossBand{frequency(aside), frequency(1 - aside)};
}

ResistanceChange::ResistanceChange(const ContactModel& model, double half_width)
    : half_width_(half_width), load_given_(model.load.has_value()), own_(at(model, half_width)) {
  if (model.loaded) {  // whose size does not change
    power_ = 0;
    return;
  }
  constexpr double step = 0.02;
  const Logarithms wider = at(model, half_width * (1 + step));
  power_ = (wider.resistance - own_.resistance) / (wider.given - own_.given);
}

ResistanceChange::Change ResistanceChange::operator()(const ContactModel& other) const {
  constexpr double uncertain = 0.25;
  const Logarithms others = at(other, half_width_);
  const double at_once = others.resistance - own_.resistance, by_move = -power_ * (others.given - own_.given);
  const double value = std::expm1(at_once + by_move);
  return {value, uncertain * (std::abs(at_once) + std::abs(by_move)) * (1 + value)};
}

ResistanceChange::Logarithms ResistanceChange::at(const ContactModel& model, double half_width) const {
  const HertzPressure pressure(model);
  const HertzResponse response = pressure.response(half_width, true);
  const ContactEstimate contact = pressure.contact(half_width, response);
  if (model.loaded) return {0, std::log(response.loss)};
  return {std::log(load_given_ ? contact.load : contact.approach),
          2 * std::log(contact.load) + std::log(response.loss)};
}

double spectrum_error(const ContactModel& model, double half_width) {
  // Two deviations, and half of one for the fit's own distance from the mean of what is open.
  constexpr double deviations = 2.5;
  const auto is_curve = [](const MaterialInputs& layer) { return is_measured_curve(layer.material); };
  const auto any_curve = [&](const std::vector<ModelLayer>& layers) {
    return std::any_of(layers.begin(), layers.end(), is_curve);
  };
  if (!any_curve(model.foundation) && !any_curve(model.coating)) return 0;

  const HertzPressure pressure(model);
  constexpr double step = 0.02;
  const HertzResponse at = pressure.response(half_width, true),
                      wider = pressure.response(half_width * (1 + step), true);
  const double loss_power = std::log(wider.loss / at.loss) / std::log1p(step);
  const double slope_power = std::log(wider.slope / at.slope) / std::log1p(step);
  // Layers of the same table share what it leaves open.
  struct OpenTable {
    MasterCurve rows;
    std::shared_ptr<const MasterCurveFit> fit;
    Eigen::VectorXd slopes;
  };
  std::vector<OpenTable> tables;
  /// @param flow speed at which the layer flows through the contact over V
  const auto add = [&](const ModelLayer& layer, const CreepSpectrum& creep, double flow,
                       const HertzPressure::Stiffen& stiffen) {
    if (!is_curve(layer)) return;
    MasterCurve rows = measured_curve(layer);
    const auto fit = shared_master_curve_fit(rows);
    const Eigen::ArrayXd open =
        Eigen::Map<const Eigen::ArrayXd>(fit->open.times.data(), static_cast<Eigen::Index>(fit->open.times.size()));
    const Eigen::ArrayXd times = open.isInf().select(open, time_shift(layer) * flow * open);
    const HertzPressure::Changes change = pressure.changes(half_width, creep, stiffen, times);
    // Under a load P = -2 a/(n' R A') is kept, under an approach nearly a, and of a given pressure a itself.
    const Eigen::VectorXd slope = change.slope / at.slope, loss = change.loss / at.loss;
    const double through_slope = model.loaded ? 0 : model.load ? loss_power / (1 - slope_power) : -2;
    const auto known =
        std::find_if(tables.begin(), tables.end(), [&](const OpenTable& table) { return table.rows == rows; });
    if (known == tables.end())
      tables.push_back({std::move(rows), fit, loss + through_slope * slope});
    else
      known->slopes += loss + through_slope * slope;
  };
  const bool composite = model.composite();
  for (std::size_t i = 0; i < model.foundation.size(); ++i)
    add(model.foundation[i], model.foundation[i].creep, 1, [&](SteadySurface::Moduli& moduli, double factor) {
      if (composite)
        moduli.foundation[i] *= factor;
      else
        moduli.compliance /= factor;
    });
  for (std::size_t i = 0; i < model.coating.size(); ++i)
    add(model.coating[i], creep_in_flow(model, model.coating[i]), std::abs(model.flow),
        [i](SteadySurface::Moduli& moduli, double factor) { moduli.coating[i] *= factor; });
  double variance = 0;
  for (const OpenTable& table : tables) variance += std::pow(table.fit->open.deviation(table.slopes), 2);
  return deviations * std::sqrt(variance);
}

}  // namespace rollres
