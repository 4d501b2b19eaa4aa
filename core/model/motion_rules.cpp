#include "core/model/motion_rules.hpp"

#include "core/messages/message_text.hpp"

namespace rollres {

namespace {

using MotionLines = std::vector<std::string>;

std::string refused(const char* key, double value, const std::string& rule) {
  return message_text(key, " = ", value, ": ", rule);
}

void check_crown(const RollingScene& scene, MotionLines& lines) {
  const bool roller = scene.indenter == Indenter::roller;
  if (roller && !scene.transverse_radius) lines.push_back("transverse_radius is missing: indenter \"roller\" needs it");
  if (!roller && scene.transverse_radius)
    lines.push_back(refused("transverse_radius", *scene.transverse_radius, "only with indenter \"roller\""));
  if (!roller) return;
  const auto only = [&](bool met, const char* rule) {
    if (!met) lines.push_back("indenter = roller: " + std::string(rule));
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

}  // namespace

std::vector<std::string> broken_motion_rules(const RollingScene& scene) {
  MotionLines lines;
  check_crown(scene, lines);
  check_turning(scene, lines);
  return lines;
}

}  // namespace rollres
