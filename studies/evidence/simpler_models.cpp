#include "studies/evidence/simpler_models.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/derivatives/objective.hpp"
#include "core/estimate/grid_choice.hpp"
#include "core/model/contact_surface.hpp"
#include "core/model/scene_rules.hpp"
#include "core/reference/reference_solutions.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/table_output.hpp"

namespace rollres {

namespace {

/// Below it inertia changes nothing that anybody sees.
constexpr double unseen_inertia = 1e-8;

class ModelsBeside {
 public:
  ModelsBeside(const RollingScene& scene, const RollingSolution& solution, const Evaluate& evaluate)
      : scene_(scene), solution_(solution), evaluate_(evaluate) {}

  std::vector<SimplerModel> run() {
    small_strains();
    without_friction();
    without_layers();
    inertia();
    if (!ContactModel(scene_).composite() && !scene_.period) closed_forms();
    return std::move(models_);
  }

 private:
  /// A model that the scene's method does not have is left out.
  void solve(const std::string& name, const std::function<void(RollingScene&)>& change) {
    RollingScene simpler = scene_;
    change(simpler);
    if (!check(simpler).empty()) return;
    const RollingSolution answer = evaluate_(simpler);
    const bool converged = answer.status == Status::converged;
    models_.push_back(
        {name, converged ? answer.rolling_resistance : RollingSolution::absent, answer.error_estimate, answer.seconds});
  }

  static void linear(RollingScene& scene) {
    if (scene.method == Method::finite_strain) scene.method = Method::automatic;
  }

  void small_strains() {
    if (scene_.method == Method::finite_strain) solve("small strains", linear);
  }

  static void smooth(RollingScene& scene) {
    scene.friction_coefficient = 0;
    scene.drive = Drive::top_force;
    scene.driving_torque.reset();
    scene.rotation_ratio.reset();
  }

  void without_friction() {
    if (scene_.friction_coefficient > 0) solve("without friction", smooth);
  }

  void without_layers() {
    const bool approach_needed = scene_.approach && dimension_of(scene_.indenter) == 2;
    if (!scene_.lower_layers.empty())
      solve_like("the first layer on a rigid base", [](RollingScene& s) { s.lower_layers.clear(); });
    if (std::isfinite(scene_.layer_thickness) && !approach_needed && !scene_.period)
      solve_like("a half-space of the first layer", [](RollingScene& s) {
        s.layer_thickness = INFINITY;
        s.lower_layers.clear();
      });
    if (!scene_.coating_layers.empty())
      solve_like("without coating", [](RollingScene& s) { s.coating_layers.clear(); });
  }

  /// A model whose contact would be of quite another size tells nothing, and may take long.
  void solve_like(const std::string& name, const std::function<void(RollingScene&)>& change) {
    constexpr double widest_ratio = 5;
    RollingScene simpler = scene_;
    change(simpler);
    const double ratio = estimate_contact(simpler).half_width / estimate_contact(scene_).half_width;
    if (ratio > 1 / widest_ratio && ratio < widest_ratio) solve(name, change);
  }

  void inertia() {
    const ContactModel model(scene_);
    const double number = rayleigh_number(model);
    const bool included = model.inertia;
    if (!included && (scene_.method == Method::spectral || number < unseen_inertia || number >= 1)) return;
    RollingScene other = scene_;
    other.inertia = included ? Inertia::off : Inertia::on;
    const bool as_ring = ContactModel(other).ring();
    if (model.ring() && !as_ring) return;  // a difference of both, of which the flat coating's is the larger
    solve(!included                 ? "with inertia"
          : as_ring != model.ring() ? "the ring without inertia"
                                    : "without inertia",
          [&](RollingScene& s) { s = other; });
  }

  /// Of bodies, whose contact they know.
  void closed_forms() {
    if (scene_.indenter == Indenter::pressure) return;
    const CreepSpectrum creep = ContactModel(scene_).top().creep;
    double weighted = 0;  // tau' = sum J_m tau_m / J0
    for (const CreepSpectrum::Term& term : creep.terms) weighted += term.compliance * term.time;
    const double length = body_length(scene_), load = solution_.load / length;  // of these forms: per metre
    const auto add = [&](const std::string& name, double value) { models_.push_back({name, value * length, 0, 0}); };
    add("the limit of slow rolling",
        slow_rolling_resistance(load, scene_.radius, scene_.speed, weighted / creep.at_rest()));
    if (scene_.material != MaterialModel::zener) return;
    if (scene_.stiffening > 0 && !std::isnan(solution_.approach)) fast_limit();
    if (dimension_of(scene_.indenter) == 2 && scene_.poisson_ratio == 0.5)
      add("Hunter's half-space",
          hunter_line(scene_.radius, load, static_modulus(scene_), scene_.stiffening, scene_.creep_time, scene_.speed)
              .rolling_resistance);
  }

  void fast_limit() {
    RollingScene glassy = scene_;
    smooth(glassy);
    glassy.static_shear_modulus = static_modulus(scene_) * (1 + scene_.stiffening);
    glassy.static_young_modulus.reset();
    glassy.temperature.reset();
    glassy.stiffening = 0;
    glassy.material = MaterialModel::elastic;
    linear(glassy);
    if (!check(glassy).empty()) return;
    const RollingSolution elastic = evaluate_(glassy);
    if (elastic.status != Status::converged) return;
    const SurfaceGrid& grid = elastic.fields.grid;
    double pressure = 0, square = 0;
    for (int node = 0; node < grid.size(); ++node) {
      const double x = grid.x(node % grid.columns), p = elastic.fields.pressure[static_cast<std::size_t>(node)];
      pressure += p;
      square += p * x * x;
    }
    models_.push_back({"the limit of fast rolling",
                       fast_rolling_resistance(elastic.load, elastic.approach, square / pressure, scene_.radius,
                                               scene_.speed, fast_loss_time(scene_.stiffening, scene_.creep_time)),
                       RollingSolution::absent, elastic.seconds});  // its own R_r is 0, and no measure
  }

  const RollingScene& scene_;
  const RollingSolution& solution_;
  const Evaluate& evaluate_;
  std::vector<SimplerModel> models_;
};

}  // namespace

std::vector<SimplerModel> simpler_models(const RollingScene& scene, const RollingSolution& solution,
                                         const Evaluate& evaluate) {
  return ModelsBeside(scene, solution, evaluate).run();
}

namespace {

/// Beyond it a model tells nothing about the scene.
constexpr double beside_the_point = 1;

/// Whether it has more in it than the model of the scene, not less.
bool is_richer(const SimplerModel& model) { return model.name == "with inertia"; }

/// "nearest: without friction, 3.9 % off; none is within the tolerance of 0.001"
std::string verdict(const std::vector<SimplerModel>& models, const std::optional<double>& tolerance, double full) {
  const SimplerModel* nearest = nullptr;
  const auto off = [&](const SimplerModel& model) { return std::abs(model.rolling_resistance / full - 1); };
  std::string within;
  for (const SimplerModel& model : models) {
    if (is_richer(model) || !std::isfinite(off(model))) continue;
    if (!nearest || off(model) < off(*nearest)) nearest = &model;
    if (tolerance && off(model) <= *tolerance) within += (within.empty() ? "" : ", ") + model.name;
  }
  if (!within.empty()) return "enough for the tolerance of " + short_number(*tolerance, 2) + ": " + within;
  std::string text = !nearest || off(*nearest) > beside_the_point
                         ? std::string("no simpler model comes near: all of this scene's model is needed")
                         : "nearest: " + nearest->name + ", " + percent(off(*nearest), 2) + " off";
  if (tolerance && nearest) text += "; none is within the tolerance of " + short_number(*tolerance, 2);
  return text;
}

}  // namespace

std::string simpler_models_text(const RollingScene& scene, const RollingSolution& solution,
                                const std::vector<SimplerModel>& models) {
  const std::string unit(real_output("rolling_resistance").unit_for(body_of(scene)));
  const double full = solution.rolling_resistance;
  const std::string none;
  Table table{{"model", "R_r", "off by", "own error", "seconds", ""}, {}};
  table.rows.push_back({std::string("this one"), readable(full, unit), none, percent(solution.error_estimate, 2),
                        short_number(solution.seconds, 2), none});
  std::string unlike, richer;
  for (const SimplerModel& model : models) {
    const double off = model.rolling_resistance / full - 1;
    if (is_richer(model)) {
      richer =
          model.name + " R_r would be " + readable(model.rolling_resistance, unit) + ", " + percent(off, 2) + " off";
      continue;
    }
    if (!(std::abs(off) <= beside_the_point)) {
      unlike += (unlike.empty() ? "" : ", ") + model.name +
                (std::isfinite(off) ? " (" + short_number(1 + off, 2) + " times R_r)" : " (no answer)");
      continue;
    }
    const bool solved = model.seconds > 0, near = scene.tolerance && std::abs(off) <= *scene.tolerance;
    table.rows.push_back({model.name, readable(model.rolling_resistance, unit), percent(off, 2),
                          solved ? percent(model.error_estimate, 2) : none,
                          solved ? short_number(model.seconds, 2) : std::string("closed form"),
                          near ? std::string("within the tolerance") : none});
  }
  std::ostringstream text("simpler models: " + verdict(models, scene.tolerance, full) + '\n', std::ios::ate);
  write_aligned(text, table, "", "  ");
  if (!unlike.empty()) text << "  does not apply here: " << unlike << '\n';
  if (!richer.empty()) text << "  " << richer << '\n';
  return text.str();
}

}  // namespace rollres
