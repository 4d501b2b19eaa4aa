#include "core/spectral/spectral_problem.hpp"

#include <algorithm>
#include <cmath>

#include "core/estimate/grid_choice.hpp"
#include "core/material/lumped_spectrum.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/contact_surface.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/spectral/closed_ring_slopes.hpp"
#include "core/spectral/passage_slopes.hpp"

namespace rollres {

namespace {

/// Memories below this part of the half-width count as elastic, whatever they lose.
constexpr double shortest_memory = 1e-9;
/// Compliance of a memory that counts, over the instantaneous one: a weaker one and its time of relaxation differ by
/// rounding alone, and (S5) divides by their difference.
constexpr double least_compliance = 1e-14;
/// What memories that count as elastic may lose, relative to all; where a tolerance allows it, a part of that.
constexpr double negligible_loss = 1e-7, part_of_tolerance = 0.1;
/// Losses by short memories in full solutions, over their estimate, at most: layers that differ press them into waves
/// shorter than the contact.
constexpr double caution_on_one_layer = 6, caution_on_several = 30;

struct TidySpectrum {
  CreepSpectrum creep;
  double left_out = 0;
  bool taken_up = false;    // terms too short to matter, by the shortest
  double made_elastic = 0;  // and compliance * time of those that no term took up
};

/// Takes the terms too short to matter into the shortest that does, with all their compliance and compliance * time:
/// that leaves losses as they are to second order of the times, and the pressure nearly up to the leading edge. Where
/// the joined memory would be much shorter, or change more than it saves, these terms are made elastic.
void take_up(TidySpectrum& tidy, const std::vector<CreepSpectrum::Term>& shorter, double half_time) {
  // Of the shortest term's time; boundary layers much thinner cost patterns of zones, and so whole answers.
  constexpr double least_time = 0.4;
  constexpr double least_gain = 10;  // in losses
  double compliance = 0, moment = 0, second = 0;
  const auto add = [&](const CreepSpectrum::Term& term) {
    compliance += term.compliance;
    moment += term.compliance * term.time;
    second += term.compliance * term.time * term.time;
  };
  std::for_each(shorter.begin(), shorter.end(), add);
  const double elastic = compliance, lost = moment;
  if (elastic > 0 && !tidy.creep.terms.empty()) {
    CreepSpectrum::Term& shortest = tidy.creep.terms.front();
    add(shortest);
    const double time = moment / compliance, changed = (second - moment * time) / half_time;
    if (time > least_time * shortest.time && least_gain * changed < lost) {
      shortest = {compliance, time};
      tidy.taken_up = true;
      return;
    }
  }
  tidy.creep.instantaneous += elastic;
  tidy.made_elastic = lost;
}

/// Ascending, with terms of nearly the same time joined and those too short to matter taken up or made elastic: beside
/// a glassy modulus many times the rubbery one they leave boundary layers that no number of coefficients resolves.
TidySpectrum tidied(CreepSpectrum creep, double half_time, double negligible, double caution) {
  std::sort(creep.terms.begin(), creep.terms.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  // To first order in a short time a term loses compliance * time; a long one loses as little.
  double all = 0, short_loss = 0;
  for (const CreepSpectrum::Term& term : creep.terms)
    all += term.compliance * term.time / (1 + std::pow(term.time / half_time, 2));
  TidySpectrum tidy{.creep = {.instantaneous = creep.instantaneous, .terms = {}}};
  std::vector<CreepSpectrum::Term>& terms = tidy.creep.terms;
  std::vector<CreepSpectrum::Term> shorter;
  for (const CreepSpectrum::Term& term : creep.terms) {
    short_loss += caution * term.compliance * term.time;
    if (term.time < shortest_memory * half_time || short_loss <= negligible * all) {
      shorter.push_back(term);
      tidy.left_out = std::min(short_loss / all, negligible);
    } else if (!terms.empty() && term.time < (1 + 1e-9) * terms.back().time) {
      terms.back().compliance += term.compliance;
    } else if (term.compliance > least_compliance * creep.instantaneous) {
      terms.push_back(term);
    }
  }
  take_up(tidy, shorter, half_time);
  return tidy;
}

/// A single incompressible layer remembers as its material does: its corrections are elastic.
class LayerSlopeCorrection final : public SlopeCorrection {
 public:
  LayerSlopeCorrection(double thickness, const std::vector<double>& memory_lengths) : thickness_(thickness) {
    for (const double length : memory_lengths) memories_.emplace_back(thickness, length);
  }
  LayerSlopes slope(double x) const override { return layer_slope_correction(x, thickness_); }
  LayerSlopes memory(std::size_t term, double x) const override { return memories_[term](x); }
  LayerSlopes displacement(double x) const override { return layer_displacement_correction(x, thickness_); }
  double depth() const override { return thickness_; }
  double reach() const override { return layer_reach * thickness_; }

 private:
  double thickness_;
  std::vector<LayerMemory> memories_;
};

/// Of waves in the layers over that at rest: e^{-k beta z} in the layer where inertia counts most.
double slowest_decay(const ContactModel& model) {
  if (!model.inertia) return 1;
  constexpr double rayleigh = 0.9;  // rho V^2/G of Rayleigh waves, about
  return std::sqrt(1 - rayleigh * std::min(rayleigh_number(model), 1.0));
}

bool single_incompressible(const ContactModel& model) { return !model.composite() && model.top().poisson_ratio == 0.5; }

}  // namespace

SpectralProblem::SpectralProblem(const ContactModel& given, const CreepSpectrum& material, double rough_half_width)
    : model(given), shape(given, share_of_coating(given)), half_width(rough_half_width) {
  const double largest = std::max(half_width, finite_thickness(model));
  const double negligible = std::max(negligible_loss, part_of_tolerance * model.tolerance.value_or(0));
  const MemoryRange told_apart = memory_range(model.speed, 1e-3 * half_width, 1e2 * largest);
  const TidySpectrum tidy =
      tidied(single_incompressible(model) ? lumped(material, told_apart) : near_spectrum(model, told_apart),
             half_width / model.speed, negligible, model.composite() ? caution_on_several : caution_on_one_layer);
  const CreepSpectrum& creep = tidy.creep;
  left_out = tidy.left_out;
  taken_up = tidy.taken_up;
  made_elastic = model.speed * tidy.made_elastic;
  const RelaxationSpectrum relaxation = relaxation_spectrum(creep);
  glassy = relaxation.instantaneous;
  glassy_compliance = rubbery_compliance = creep.instantaneous;
  for (const CreepSpectrum::Term& term : creep.terms) {
    creep_length.push_back(model.speed * term.time);
    creep_compliance.push_back(term.compliance);
    rubbery_compliance += term.compliance;
  }
  rubbery = 1 / rubbery_compliance;
  inertia = model.inertia;
  deep = std::make_shared<DeepResponse>(foundation_of(model).front(), model.speed, glassy_compliance, creep_length,
                                        creep_compliance, half_width);
  if (single_incompressible(model)) {
    if (std::isfinite(model.top().layer_thickness))
      correction = std::make_shared<LayerSlopeCorrection>(model.top().layer_thickness, creep_length);
  } else if (const double nearest = nearest_interface(model); std::isfinite(nearest)) {
    correction =
        std::make_shared<PassageSlopes>(steady_surface(model, told_apart), creep, nearest * slowest_decay(model),
                                        has_rigid_base(model), model.friction_coefficient > 0);
    if (feels_earlier_turns(model))
      correction = std::make_shared<ClosedRingSlopes>(correction, ring_alone(model), model.radius, creep, model.speed,
                                                      model.coating.empty(), model.friction_coefficient > 0);
  }
  for (const RelaxationSpectrum::Term& term : relaxation.terms) {
    relaxation_length.push_back(model.speed * term.time);
    relaxation_modulus.push_back(term.modulus);
  }
  if (!model.coating.empty()) {
    side_is_coating = model.friction_coefficient > 0 || !has_elastic_foundation(model);
    const ContactModel alone = side_is_coating ? coating_alone(model) : foundation_alone(model);
    side = std::make_shared<SpectralProblem>(alone, near_spectrum(alone), half_width);
  }
  const auto count = static_cast<double>(terms());
  require_memory(8 * count * count, message_text("the memories of ", terms(), " retardation times"));
  memory_factor.resize(terms(), terms());
  for (Eigen::Index j = 0; j < terms(); ++j)
    for (Eigen::Index m = 0; m < terms(); ++m) {
      const double creep_m = creep_length[static_cast<std::size_t>(m)];
      memory_factor(j, m) = creep_compliance[static_cast<std::size_t>(m)] * creep_m /
                            (creep_m - relaxation_length[static_cast<std::size_t>(j)]);
    }
}

}  // namespace rollres
