#include "core/solve/model_notes.hpp"

#include <algorithm>
#include <cmath>

#include "core/estimate/assumptions.hpp"
#include "core/estimate/composite_estimate.hpp"
#include "core/estimate/linearity_error.hpp"
#include "core/influence/influence.hpp"
#include "core/material/material.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/absent_outputs.hpp"
#include "core/model/contact_surface.hpp"
#include "core/model/indenter_shape.hpp"
#include "core/newton/grid_solution.hpp"
#include "core/surface/edge_peak.hpp"

namespace rollres {

namespace {

constexpr double noticeable_strain = 0.1;
/// Change of the rolling resistance by the bending of a coating that is taken as flat.
constexpr double noticeable_bending = 0.002;

/// The sizes of a traction along the row of its peak, within the contact.
std::vector<double> along_peak(const SurfaceFields& fields, const std::vector<double>& traction) {
  const auto larger = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto peak = std::max_element(traction.begin(), traction.end(), larger) - traction.begin();
  const auto columns = static_cast<std::ptrdiff_t>(fields.grid.columns), first = peak / columns * columns;
  std::vector<double> sizes;
  for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(first + columns); ++i)
    if (fields.zone[i] != Zone::free) sizes.push_back(std::abs(traction[i]));
  return sizes;
}

/// What makes a grid finer: a tolerance chooses its spacing where none is given.
const char* finer_by(const ContactModel& model) { return model.tolerance && !model.spacing ? "tolerance" : "spacing"; }

void warn_of_peaks(const ContactModel& model, const RollingSolution& solution, std::vector<std::string>& warnings) {
  const auto warn = [&](std::string_view output, double peak, const std::vector<double>& traction) {
    if (traction.empty() || !(peak > 0)) return;
    std::string line = unresolved_peak(output, peak, along_peak(solution.fields, traction), 2, "grid", finer_by(model));
    if (!line.empty()) warnings.push_back(std::move(line));
  };
  warn("peak_pressure", solution.peak_pressure, solution.fields.pressure);
  warn("peak_shear_x", solution.peak_shear_x, solution.fields.shear_x);
}

/// What a tolerance leaves to choose, and why nothing more is left out.
std::string choices_in_words(const ContactModel& model, const RollingSolution& solution) {
  const bool sphere = model.dimension == 3;
  std::string text;
  if (solution.method == Method::spectral)
    text += message_text("; ", solution.contact_nodes, " coefficients of the pressure for an error below ",
                         *model.tolerance);
  else if (!on_grid(solution.method))
    text +=
        message_text("; ", solution.contact_nodes, " nodes of a mesh in contact for an error below ", *model.tolerance);
  else if (sphere)
    text += message_text("; ", solution.contact_nodes, " nodes in contact, ",
                         std::lround(2 * half_length(solution) / solution.spacing), " along it, for an error below ",
                         *model.tolerance);
  else
    text += message_text("; ", solution.contact_nodes, " nodes in contact for an error below ", *model.tolerance);
  if (std::isfinite(total_thickness(model)))
    text += message_text(
        "; the finite thickness H is computed, because a half-space would not be faster: half-length "
        "of the contact over H = ",
        half_length(solution) / total_thickness(model));
  else if (!sphere && model.friction_coefficient == 0 && model.top().material == MaterialModel::zener)
    text += "; closed form of the half-space (Hunter) not used: of a parabola, and without fields";
  if (model.friction_coefficient > 0)
    text += message_text("; friction and its coupling with the pressure are computed: friction takes ",
                         std::abs(solution.frictional_loss / (solution.rolling_resistance * model.speed)),
                         " of R_r, and it limits the drive");
  return text;
}

}  // namespace

std::string unanswered_inertia(const ContactModel& model) {
  if (!model.inertia_automatic || !model.inertia || !layers_carry_slower_waves(model)) return {};
  return message_text("inertia may count for a tolerance of ", *model.asked_tolerance,
                      ", and with it the speed must be below that of the waves which the layers carry together; "
                      "inertia = off leaves it out");
}

std::string unanswered_inertia(const ContactModel& model, const RollingSolution& solution) {
  if (!model.inertia_automatic || !model.tolerance || model.asked_method == Method::spectral) return {};
  const double number = rayleigh_number(model), mach = inertia_number(model, solution);
  if (number < 1 || mach <= negligible_inertia(model)) return {};
  return message_text("inertia counts for a tolerance of ", *model.asked_tolerance, " (ρV²/|G| = ", mach,
                      "), and with it the speed must be below that of Rayleigh waves on the layer at rest, ",
                      model.speed / std::sqrt(number), " m/s; inertia = off leaves it out");
}

void warn_of_materials(const ContactModel& model, std::vector<std::string>& warnings) {
  const auto warn_of = [&](const std::vector<ModelLayer>& layers, const auto& owner) {
    const std::vector<std::size_t> places = layers_of_scene(layers);
    for (std::size_t i = 0; i < layers.size(); ++i) {
      if (layers[i].continues) continue;
      for (const std::string& line : material_warnings(layers[i])) warnings.push_back(owner(places[i]) + line);
    }
  };
  warn_of(model.foundation, [](std::size_t place) {
    return place == 0 ? std::string() : message_text("lower_layers[", place - 1, "]: ");
  });
  warn_of(model.coating, [](std::size_t place) { return message_text("coating_layers[", place, "]: "); });
}

std::vector<std::string> warnings_for(const ContactModel& model, const RollingSolution& solution,
                                      const std::vector<Assumption>& assumed) {
  std::vector<std::string> warnings;
  const bool linear = solution.method != Method::finite_strain;
  const double strain = strain_number(model, solution);
  if (const Assumption* const small = find_assumption(assumed, small_strains); small && small->change) {
    if (strain > noticeable_strain || (model.tolerance && std::abs(*small->change) > *model.tolerance))
      warnings.push_back(message_text("the layer is taken as linear: at finite strain (", small->rests_on,
                                      ") the rolling resistance would differ by ", in_percent(*small->change), " +- ",
                                      in_percent(small->scatter), " %; method \"finite_strain\" computes it"));
  } else if (linear && strain > noticeable_strain) {
    warnings.push_back(message_text("strain d/H = ", strain,
                                    " is not small: the layer is taken as linear, and what that costs is not known"));
  }
  const double slope = std::max(std::abs(solution.leading_edge), std::abs(solution.trailing_edge)) / model.radius;
  if (linear && slope > 0.3 && !model.loaded)
    warnings.push_back(message_text("slope at the contact's edge, and contact over radius, ", slope,
                                    " is not small: displacements are taken as small"));
  if (const Assumption* const flat = find_assumption(assumed, flat_coating);
      linear && flat && std::abs(flat->change.value_or(0)) > noticeable_bending)
    warnings.push_back(
        message_text("the coating is taken as flat: bent around the core of a cylinder it would change the "
                     "rolling resistance by about ",
                     in_percent(*flat->change), " %"));
  const double mach = inertia_number(model, solution);
  constexpr double noticeable_inertia = 0.01;
  if (!model.inertia &&
      mach > (model.tolerance && model.inertia_automatic ? std::min(noticeable_inertia, negligible_inertia(model))
                                                         : noticeable_inertia))
    warnings.push_back(message_text("inertia ρV²/|G| = ", mach, " is not negligible, and is left out"));
  if (model.composite() && !model.period && on_grid(solution.method))
    if (const double error = expansion_error(model); error > 1e-4)
      warnings.push_back(message_text("the layers' compliance is expanded in retardation times and directions to ",
                                      error, " only",
                                      model.inertia ? ": the speed is close to that of Rayleigh waves" : ""));
  const double across = 2 * half_length(solution) / solution.spacing;
  if (across < 10)
    warnings.push_back(message_text("only ", across, " nodes along the contact: take a smaller ", finer_by(model)));
  if (on_grid(solution.method) && !model.loaded && solution.fields.grid.columns > 0)
    warn_of_peaks(model, solution, warnings);
  if (linear && model.kinematics == Kinematics::printed) {
    const double power = solution.rolling_resistance * model.speed;
    const double left = std::abs(power - solution.viscous_loss - solution.frictional_loss) / std::abs(power);
    if (constexpr double noticeable = 0.02; left > noticeable + solution.energy_residual)
      warnings.push_back(message_text("printed kinematics: ", left,
                                      " of the power goes neither into the layers nor into friction; kinematics "
                                      "\"consistent\" balances it"));
  }
  warn_of_materials(model, warnings);
  if (model.spacing && !on_grid(solution.method))
    warnings.push_back(message_text("spacing = ", *model.spacing, " m is not used by method ", name_of(solution.method),
                                    ", which has no grid"));
  double left = 0;  // of the slowest memory, when the next body of a train comes
  if (model.period)
    for (const CreepSpectrum::Term& term : model.top().creep.terms)
      left = std::max(left, std::exp(-*model.period / (model.speed * term.time)));
  if (left > 1e-4)
    warnings.push_back(
        message_text("the layer has not recovered after one period: e^(-L/(Vτ)) = ", left, " of its slowest memory"));
  return warnings;
}

std::string model_of(const ContactModel& model, const RollingSolution& solution) {
  const bool included = model.inertia;
  const double mach = inertia_number(model, solution);
  std::string text = surface_in_words(model) + "; " +
                     message_text(included ? "inertia included: ρV²/|G| = " : "inertia left out: ρV²/|G| = ", mach);
  if (!included && model.inertia_automatic && model.tolerance && mach > *model.tolerance)
    text += std::string(", which may change R_r by about as much (inertia = on takes it along") +
            (model.ring() ? ", on a flat coating)" : ")");
  const bool sphere = model.dimension == 3, spectral = solution.method == Method::spectral;
  const bool gridded = on_grid(solution.method);
  if (model.composite() && !model.period && gridded)
    if (const double error = expansion_error(model); error > 0)
      text += message_text("; memories expanded in fixed retardation times, to ", error);
  if (!sphere)
    text += message_text("; plane strain: the cylinder is long beside ",
                         1e3 * std::max(2 * half_length(solution), finite_thickness(model)), " mm");
  if (const std::string why = why_absent(model, "approach"); !why.empty() && !model.loaded)
    text += "; no approach: " + why;
  if (model.loaded)
    text += "; the pressure is given: no contact is looked for, and what a body on it loses is no part of R_r";
  else if (model.friction_coefficient == 0)
    text += std::string("; no friction (μ = 0): rotation and shear left out") +
            (model.coating.empty() ? "" : ", and what a coating resists is a torque at the axle, whatever the drive");
  const CreepSpectrum& creep = model.top().creep;
  const bool elastic =
      std::all_of(creep.terms.begin(), creep.terms.end(), [](const auto& term) { return term.compliance == 0; });
  if (!model.composite() && (elastic || (model.top().material == MaterialModel::zener && model.top().creep_time == 0)))
    text += "; elastic: no relaxation (f = 0 or τ = 0)";
  if (const std::string route = material_route(model.top()); !route.empty()) text += "; " + route;
  if (const double flow = model.flow; coating_flow_counts(model))
    text += flow == 0 ? "; the body is locked: its coating is at rest"
                      : message_text<6>("; the coating flows at ", flow, " V", flow < 0 ? ", backwards" : "");
  if (const std::string coating = coating_in_words(model); !coating.empty()) text += "; " + coating;
  if (spectral) text += "; continuous edges of contact, no grid";
  if (gridded && !model.spacing && sphere && !model.loaded && solution.method != Method::active_set)
    text += "; grid tied to the contact";
  text += model.period ? message_text("; periodic train, L = ", *model.period, " m") : "; single passage, no period";
  return model.tolerance ? text + choices_in_words(model, solution) : text;
}

}  // namespace rollres
