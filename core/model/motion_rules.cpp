#include "core/model/motion_rules.hpp"

#include <algorithm>
#include <cmath>

#include "core/messages/message_text.hpp"

namespace rollres {

namespace {

using MotionLines = std::vector<std::string>;

std::string refused(const char* key, double value, const std::string& rule) {
  return message_text(key, " = ", value, ": ", rule);
}

/// What a roller's outline is not solved with.
void check_outline(const RollingScene& scene, MotionLines& lines) {
  const bool roller = scene.indenter == Indenter::roller, profile = scene.indenter == Indenter::profile;
  if (roller && !scene.transverse_radius) lines.push_back("transverse_radius is missing: indenter \"roller\" needs it");
  if (!roller && scene.indenter != Indenter::pressure && scene.transverse_radius)
    lines.push_back(
        refused("transverse_radius", *scene.transverse_radius, "only with indenter \"roller\" or \"pressure\""));
  if (!profile && !(scene.profile_places.empty() && scene.profile_heights.empty()))
    lines.push_back("profile_places: only with indenter \"profile\"");
  if (profile)
    if (std::string fault = profile_fault(scene); !fault.empty()) lines.push_back(std::move(fault));
  if (!roller && !profile) return;
  const auto only = [&](bool met, const char* rule) {
    if (!met) lines.push_back("indenter = " + std::string(name_of(scene.indenter)) + ": " + rule);
  };
  only(scene.kinematics == Kinematics::consistent, "only with kinematics \"consistent\"");
  only(scene.method != Method::active_set, "not with method \"active_set\"");
}

/// The first input that turns the axle or the path, as it was given; empty: there is none.
std::string turning_input(const RollingScene& scene) {
  if (scene.skew_angle) return "skew_angle = " + in_degrees(*scene.skew_angle);
  if (scene.axial_force) return message_text("axial_force = ", *scene.axial_force);
  if (scene.lateral_force) return message_text("lateral_force = ", *scene.lateral_force);
  if (scene.camber_angle != 0) return "camber_angle = " + in_degrees(scene.camber_angle);
  if (scene.pivot != 0) return message_text("pivot = ", scene.pivot);
  return {};
}

/// What a body whose axle is turned, or which turns along its path, is not solved with.
void check_turning(const RollingScene& scene, MotionLines& lines) {
  const bool round = dimension_of(scene.indenter) == 3;
  if (scene.skew_angle && scene.axial_force)
    lines.push_back(refused("axial_force", *scene.axial_force, "give skew_angle or axial_force, not both"));
  if (scene.skew_angle && scene.lateral_force)
    lines.push_back(refused("lateral_force", *scene.lateral_force, "give skew_angle or lateral_force, not both"));
  if (round && scene.axial_force) lines.push_back(refused("axial_force", *scene.axial_force, "only for a cylinder"));
  if (!round && scene.lateral_force)
    lines.push_back(refused("lateral_force", *scene.lateral_force, "only for a sphere or roller"));
  // Turning along the path does work on a body that is no sphere, which the straight passage does not have.
  if (!round && scene.camber_angle != 0)
    lines.push_back(refused("camber_angle", scene.camber_angle, "only for a sphere or roller"));
  if (scene.indenter != Indenter::sphere && scene.pivot != 0)
    lines.push_back(refused("pivot", scene.pivot, "only for a sphere"));
  const std::string key = turning_input(scene);
  if (key.empty()) return;
  const auto only = [&](bool met, const std::string& rule) {
    if (!met) lines.push_back(key + ": " + rule);
  };
  if (scene.axial_force || scene.lateral_force)
    only(scene.friction_coefficient > 0, "needs a friction_coefficient > 0");
  if (is_straight(scene)) return;
  if (round && scene.friction_coefficient > 0)
    only(scene.coating_layers.empty(),
         "not with a coating and friction, whose material passes along the wheel's plane");
  only(scene.kinematics == Kinematics::consistent, "only with kinematics \"consistent\"");
  only(scene.method == Method::automatic || scene.method == Method::newton || scene.method == Method::newton_dense ||
           scene.friction_coefficient == 0,
       "only with method \"automatic\", \"newton\" or \"newton_dense\"");
  only(!scene.period, "not with a period");
}

/// What belongs to a body alone, of a pressure in its place; and of bodies what belongs to a pressure.
void check_pressure(const RollingScene& scene, MotionLines& lines) {
  constexpr const char* of_body = "not with indenter \"pressure\", which is no body";
  if (scene.indenter != Indenter::pressure) {
    constexpr const char* rule = ": only with indenter \"pressure\"";
    if (scene.traction_coefficient != 0)
      lines.push_back(message_text("traction_coefficient = ", scene.traction_coefficient, rule));
    if (!scene.deflection_places_x.empty()) lines.push_back(std::string("deflection_places_x") + rule);
    if (!scene.deflection_places_y.empty()) lines.push_back(std::string("deflection_places_y") + rule);
    return;
  }
  const auto refuse = [&](bool given, const std::string& entry, const char* rule) {
    if (given) lines.push_back(entry + ": " + rule);
  };
  if (scene.approach) lines.push_back(refused("approach", *scene.approach, of_body));
  refuse(scene.friction_coefficient != 0, message_text("friction_coefficient = ", scene.friction_coefficient),
         "not with indenter \"pressure\", whose shear is traction_coefficient times it");
  refuse(scene.traction_limit.has_value(), "traction_limit", of_body);
  refuse(scene.drive != Drive::top_force && scene.drive != Drive::free, message_text("drive = ", name_of(scene.drive)),
         of_body);
  refuse(!scene.coating_layers.empty(), "coating_layers", of_body);
  refuse(scene.adhesion_threshold != 0, message_text("adhesion_threshold = ", scene.adhesion_threshold), of_body);
  refuse(scene.kinematics != Kinematics::consistent, message_text("kinematics = ", name_of(scene.kinematics)), of_body);
  refuse(scene.method != Method::automatic && scene.method != Method::convolution,
         message_text("method = ", name_of(scene.method)), "only \"convolution\" with indenter \"pressure\"");
  refuse(scene.heat == Heat::on, "heat = on", "not with indenter \"pressure\"");
  refuse(scene.period.has_value(), "period", "not with indenter \"pressure\"");
  if (scene.spacing && *scene.spacing > 0.25 * scene.radius)
    lines.push_back(refused("spacing", *scene.spacing, "must be at most an eighth of the length of a given pressure"));
  if (const std::string key = turning_input(scene); !key.empty()) lines.push_back(key + ": " + of_body);
  const std::size_t along = scene.deflection_places_x.size(), across = scene.deflection_places_y.size();
  if (along != across)
    lines.push_back(message_text("deflection_places_y: must have as many numbers as deflection_places_x, ", along,
                                 "; has ", across));
}

/// Of a profile whose numbers are in order: of its lowest point, and of what a camber hides.
std::string fault_of_heights(const RollingScene& scene) {
  const std::vector<double>&places = scene.profile_places, &heights = scene.profile_heights;
  const double lowest = *std::min_element(heights.begin(), heights.end()),
               highest = *std::max_element(heights.begin(), heights.end());
  if (!(highest - lowest < scene.radius))
    return message_text("profile_heights: must rise by less than the radius, ", scene.radius, " m; they rise by ",
                        highest - lowest, " m");
  const RollerOutline outline(scene.radius, places, heights);
  if (const std::optional<double> hidden = outline.hidden_place(std::sin(scene.camber_angle)))
    return refused("camber_angle", scene.camber_angle,
                   message_text("hides the profile behind its rim at y = ", *hidden,
                                " m from below: less camber, or a profile that ends before"));
  return {};
}

}  // namespace

std::string profile_fault(const RollingScene& scene) {
  const std::vector<double>&places = scene.profile_places, &heights = scene.profile_heights;
  if (places.empty() || heights.empty())
    return std::string(places.empty() ? "profile_places" : "profile_heights") +
           " is missing: indenter \"profile\" needs it, or profile_file";
  if (places.size() != heights.size())
    return message_text("profile_heights: must have as many numbers as profile_places, ", places.size(), "; has ",
                        heights.size());
  if (places.size() < 2) return "profile_places: must have two numbers at least";
  for (std::size_t i = 1; i < places.size(); ++i)
    if (!(places[i] > places[i - 1]))
      return message_text("profile_places[", i, "] = ", places[i], ": must rise from one to the next");
  return fault_of_heights(scene);
}

std::optional<RollerOutline> outline_of(const RollingScene& scene) {
  if (scene.indenter == Indenter::roller && scene.transverse_radius)
    return RollerOutline(scene.radius, *scene.transverse_radius, scene.crown);
  if (scene.indenter == Indenter::profile && profile_fault(scene).empty())
    return RollerOutline(scene.radius, scene.profile_places, scene.profile_heights);
  return std::nullopt;
}

std::vector<std::string> broken_motion_rules(const RollingScene& scene) {
  MotionLines lines;
  check_outline(scene, lines);
  check_pressure(scene, lines);
  if (scene.indenter != Indenter::pressure) check_turning(scene, lines);
  return lines;
}

}  // namespace rollres
