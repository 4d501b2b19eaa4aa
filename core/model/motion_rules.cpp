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
  if (!roller && scene.transverse_radius)
    lines.push_back(refused("transverse_radius", *scene.transverse_radius, "only with indenter \"roller\""));
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
  if (scene.skew_angle) return message_text("skew_angle = ", *scene.skew_angle);
  if (scene.axial_force) return message_text("axial_force = ", *scene.axial_force);
  if (scene.lateral_force) return message_text("lateral_force = ", *scene.lateral_force);
  if (scene.camber_angle != 0) return message_text("camber_angle = ", scene.camber_angle);
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
  check_turning(scene, lines);
  return lines;
}

}  // namespace rollres
