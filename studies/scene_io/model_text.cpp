#include "studies/scene_io/model_text.hpp"

#include <cmath>
#include <sstream>

#include "core/messages/message_text.hpp"
#include "core/model/contact_surface.hpp"
#include "core/model/model_in_words.hpp"
#include "core/model/scene_rules.hpp"
#include "core/numerics/solution_limits.hpp"
#include "core/solve/resolve.hpp"
#include "studies/text/table_json.hpp"
#include "studies/text/table_output.hpp"

namespace rollres {

namespace {

/// Within the limits of the scene.
ContactModel model_of_valid(const RollingScene& scene) {
  require_valid(scene);
  const SolutionLimits limits = limits_of(scene);
  return resolve(scene);
}

Json json_of(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json json_of(const std::vector<ModelLayer>& layers) {
  Json list = Json::array();
  for (const ModelLayer& layer : layers) {
    Json times = Json::array();
    for (const CreepSpectrum::Term& term : layer.creep.terms) times.push_back(term.time);
    const Json thickness = std::isinf(layer.layer_thickness) ? Json("infinite") : Json(layer.layer_thickness);
    list.push_back(json_object("layer_thickness", thickness, "poisson_ratio", layer.poisson_ratio, "layer_density",
                               layer.layer_density, "modulus_at_rest", layer.modulus_at_rest, "modulus_at_once",
                               1 / layer.creep.instantaneous, "retardation_times", times));
  }
  return list;
}

}  // namespace

std::string model_text(const RollingScene& scene) {
  Table table{{"", ""}, {}};
  try {
    for (const ModelStatement& line : model_in_words(model_of_valid(scene)))
      table.rows.push_back({line.about, line.text});
  } catch (const std::domain_error& error) {
    table.rows.push_back({std::string("none"), std::string(error.what())});
  } catch (const BeyondLimits& limit) {
    table.rows.push_back({std::string("none"), std::string(limit.what())});
  }
  std::ostringstream text;
  write_aligned(text << "model\n", table, "", "  ");
  return text.str() + '\n';
}

std::string model_json(const RollingScene& scene) {
  const ContactModel model = model_of_valid(scene);
  Json words = Json::array();
  for (const ModelStatement& line : model_in_words(model)) words.push_back({line.about, line.text});
  const Json object = json_object(
      "indenter", name_of(model.indenter), "dimension", model.dimension, "foundation", json_of(model.foundation),
      "coating", json_of(model.coating), "composite", model.composite(), "rigid_base", has_rigid_base(model), "flow",
      model.flow, "inertia", model.inertia, "inertia_automatic", model.inertia_automatic, "rayleigh_number",
      rayleigh_number(model), "method", name_of(model.method), "asked_method", name_of(model.asked_method),
      "asked_tolerance", json_of(model.asked_tolerance), "left_out", model.left_out, "tolerance",
      json_of(model.tolerance), "decisions", model.decisions, "words", words);
  return object.dump(2);
}

}  // namespace rollres
