#pragma once

/// What a model assumes of the world, each with the number it rests on and what it changes R_r by: the error of the
/// model, beside that of its numbers (`error_estimate`).

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/contact_model.hpp"
#include "core/scene/solution.hpp"

namespace rollres {

/// Names of assumptions of which others speak, too.
inline constexpr std::string_view small_strains = "small strains", flat_coating = "flat coating", no_heat = "no heat",
                                  one_temperature = "one temperature";

struct Assumption {
  std::string_view name;              ///< "small strains"
  std::string rests_on;               ///< "d/H = 0.053"
  std::optional<double> change = {};  ///< R_r without the assumption over the answer, minus 1; empty: not known [1]
  double scatter = 0;                 ///< standard deviation of that, or what it cannot exceed where it is small [1]
  std::string why_unknown = {};       ///< where `change` is
  bool of_inputs = false;             ///< holds or not by what the inputs say of the world: counts for no error
};

/// Half of the contact's length along the motion; on a grid with the cells of its ends [m].
double half_length(const RollingSolution& solution);

/// rho V^2 / |G*| at the frequency V / half-length, of the layer where it is largest [1].
double inertia_number(const ContactModel& model, const RollingSolution& solution);

/// Names of all assumptions that a model may rest on, in the order in which they are told.
std::vector<std::string_view> assumption_names();

/// Those of a model, in that order. @param solution  its converged answer
std::vector<Assumption> assumptions(const ContactModel& model, const RollingSolution& solution);

/// The assumption of that name; null where the model does not rest on it.
const Assumption* find_assumption(const std::vector<Assumption>& all, std::string_view name);

/// Relative error of R_r by the model: all changes, each with its scatter, summed in squares; empty where one of them
/// is not known.
std::optional<double> model_error(const std::vector<Assumption>& all);

/// "small strains (d/H = 0.053): without it R_r +1.2 % +- 0.9 %"
std::string in_words(const Assumption& assumption);

/// Of two digits, in per cent.
double in_percent(double part);

}  // namespace rollres
