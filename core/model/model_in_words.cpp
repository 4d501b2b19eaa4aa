#include "core/model/model_in_words.hpp"

#include <cmath>

#include "core/material/strain_softening.hpp"
#include "core/messages/message_text.hpp"
#include "core/model/contact_surface.hpp"
#include "core/model/scene_rules.hpp"

namespace rollres {

namespace {

template <class... Parts>
std::string words(const Parts&... parts) {
  return message_text<4>(parts...);
}

/// "400 N/m", or of a body with a width "20 N".
/// @param line, body  units per metre and of a whole body
std::string told(const ContactModel& model, double per_metre, const char* line, const char* body) {
  return words(model.told(per_metre), " ", model.told_per_metre() ? line : body);
}

/// "load 400 N/m", or "approach 0.001 m"
std::string pressed(const ContactModel& model) {
  return model.load ? "load " + told(model, *model.load, "N/m", "N") : words("approach ", *model.approach, " m");
}

std::string given_pressure(const LoadedArea& area) {
  return words("given pressure, ", name_of(area.distribution), ", on ",
               area.shape == PressureShape::rectangle ? "a rectangle"
               : area.half_length == area.half_width  ? "a disc"
                                                      : "an ellipse",
               " ", 2 * area.half_length, " m long and ", 2 * area.half_width, " m wide",
               area.traction == 0 ? std::string() : words(", shear ", area.traction, " of it"));
}

std::string body_in_words(const ContactModel& model) {
  if (model.profiled()) return words("rigid roller, profile up to ", model.outline->reach(), " m from its middle");
  if (model.outline)
    return words("rigid roller, crown of ", model.outline->transverse_radius(), " m (", name_of(model.outline->crown()),
                 ")");
  if (model.dimension == 3) return "rigid sphere";
  return model.width ? words("rigid cylinder, ", *model.width, " m wide, solved per metre of it")
                     : "rigid cylinder, per metre of its length";
}

/// How the axle and the path of a body are turned; empty: straight.
std::string turned(const ContactModel& model) {
  std::string text;
  if (model.skew != 0) text += words(", skew ", std::atan(model.skew), " rad");
  if (model.camber != 0) text += words(", camber ", model.camber, " rad");
  if (model.pivot != 0) text += words(", pivot ", model.pivot, " 1/m");
  if (model.dimension == 3 && model.side_force) text += words(", lateral force ", *model.side_force, " N");
  return text;
}

std::string driven(const ContactModel& model) {
  if (model.loaded) return "no body";
  if (model.friction_coefficient == 0) return "no friction";
  std::string text = words("friction ", model.friction_coefficient);
  if (model.traction_limit) text += words(", at most ", *model.traction_limit, " Pa");
  text += words(", drive ", name_of(model.drive));
  if (model.driving_torque) text += " " + told(model, *model.driving_torque, "N m/m", "N m");
  if (model.rotation_ratio) text += words(" at RΩ/V = ", *model.rotation_ratio);
  return text;
}

std::string spectrum(const CreepSpectrum& creep) {
  if (creep.terms.empty()) return words("elastic, G = ", 1 / creep.at_rest(), " Pa");
  const std::string moduli = words("G from ", 1 / creep.at_rest(), " to ", 1 / creep.instantaneous, " Pa, ");
  if (creep.terms.size() == 1) return moduli + words("retardation time ", creep.terms.front().time, " s");
  return moduli + words(creep.terms.size(), " retardation times from ", creep.terms.front().time, " to ",
                        creep.terms.back().time, " s");
}

std::string layer(const ModelLayer& layer, bool inertia) {
  std::string text = std::isinf(layer.layer_thickness) ? "half-space" : words(layer.layer_thickness, " m thick");
  text += words(", ν = ", layer.poisson_ratio, ", ", spectrum(layer.creep));
  if (inertia) text += words(", ", layer.layer_density, " kg/m³");
  return text + (softens(layer) ? "; of small strains: the moduli at its strains come with the answer" : "");
}

std::string inertia(const ContactModel& model) {
  const std::string number = words("the largest ρV²/G over that of Rayleigh waves is ", rayleigh_number(model));
  if (!model.inertia_automatic) return words(model.inertia ? "included" : "left out", ": ", number);
  if (model.inertia) return words("included by itself: ", number, ", more than ", negligible_inertia(model));
  return words("left out by itself: ", number,
               model.asked_tolerance ? words(", negligible up to ", negligible_inertia(model), " and unanswered from 1")
                                     : ", and no tolerance asks for it");
}

std::string method(const ContactModel& model) {
  const std::string name(name_of(model.method));
  if (model.asked_method != Method::automatic) return name + ", as asked for";
  if (model.loaded) return name + ": the pressure is given";
  if (model.method == Method::spectral) return name + ": continuous edges of contact, and a grid where they give no answer";
  if (model.dimension == 3) return name + ": a body of three dimensions is solved on a grid";
  if (model.spacing) return name + ": the scene gives a spacing";
  return name + ": continuous edges do not apply, " + spectral_refusal(model);
}

std::string errors(const ContactModel& model) {
  if (!model.asked_tolerance) return "no tolerance: the method's own numbers, nothing left out";
  return words("tolerance ", *model.asked_tolerance, " of R_r: ", model.left_out, " taken by simplifications, ",
               *model.tolerance, " left for numbers");
}

}  // namespace

std::vector<ModelStatement> model_in_words(const ContactModel& model) {
  std::vector<ModelStatement> all;
  all.push_back({"body", model.loaded ? given_pressure(*model.loaded)
                                      : words(body_in_words(model), ", R = ", model.radius, " m, kinematics ",
                                              name_of(model.kinematics))});
  all.push_back(
      {"motion", words("V = ", model.speed, " m/s, ", pressed(model), ", ", driven(model), turned(model),
                       model.period ? words(", periodic train, L = ", *model.period, " m") : ", single passage")});
  all.push_back({"surface", surface_in_words(model)});
  for (std::size_t i = 0; i < model.foundation.size(); ++i)
    all.push_back({words("layer ", i + 1), layer(model.foundation[i], model.inertia)});
  for (std::size_t i = 0; i < model.coating.size(); ++i)
    all.push_back({words("coating ", i + 1), layer(model.coating[i], model.inertia)});
  if (const std::string coating = coating_in_words(model); !coating.empty()) all.push_back({"shape", coating});
  if (coating_flow_counts(model))
    all.push_back({"flow", words("the coating flows at ", model.flow, " V",
                                 model.drive == Drive::rotation ? "" : ", to begin with")});
  all.push_back({"inertia", inertia(model)});
  all.push_back({"method", method(model)});
  all.push_back({"errors", errors(model)});
  for (const std::string& decision : model.decisions) all.push_back({"left out", decision});
  return all;
}

}  // namespace rollres
