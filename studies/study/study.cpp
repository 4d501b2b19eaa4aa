#include "studies/study/study.hpp"

#include "core/model/absent_outputs.hpp"
#include "db/rows/schema.hpp"
#include "studies/scene_io/scene_overrides.hpp"
#include "studies/study/study_axes.hpp"
#include "studies/study/study_keys.hpp"
#include "studies/study/study_outputs.hpp"
#include "studies/study/study_scene.hpp"
#include "studies/study/study_variants.hpp"
#include "studies/study/uncertain_inputs.hpp"
#include "studies/text/file_kind.hpp"
#include "studies/text/files.hpp"

namespace rollres {

namespace {

/// Units of a distribution are those of one body.
void refuse_several_bodies(const std::vector<GivenAxis>& axes, const std::string& place) {
  for (const GivenAxis& axis : axes)
    if (axis.key == "indenter") refuse(place, "indenter", axis.shown, "cannot be an axis where inputs are uncertain");
}

/// An input that scatters about its value may be set; one that has a distribution of its own may not.
void refuse_set_uncertain(const std::vector<SceneEntry>& set, const std::vector<GivenVariant>& variants,
                          const UncertainInputs& uncertain) {
  for (const UncertainInput& input : uncertain.inputs) {
    refuse_given_twice(variants, input.key, "is uncertain too");
    for (const SceneEntry& entry : set)
      if (entry.key == input.key && !input.relative) refuse(entry.place, entry.key, entry.value, "is uncertain too");
  }
}

void refuse_given_twice(const std::vector<SceneEntry>& set, const std::vector<GivenAxis>& axes,
                        const std::vector<GivenVariant>& variants) {
  for (const SceneEntry& entry : set)
    for (const GivenAxis& axis : axes)
      if (axis.key == entry.key) refuse(entry.place, entry.key, entry.value, "is an axis of the study too");
  for (const SceneEntry& entry : set) refuse_given_twice(variants, entry.key, "is in \"set\" too");
  for (const GivenAxis& axis : axes) refuse_given_twice(variants, axis.key, "is an axis of the study too");
}

/// What varies, with its base or with that of each variant.
void add_scenes(Study& study, const std::vector<SceneEntry>& entries, const std::vector<GivenAxis>& axes,
                const std::vector<GivenVariant>& variants, const std::string& place) {
  if (variants.empty()) {
    study.base = base_scene(entries, axes, place);
    study.axes = axes_of(axes, body_of(study.base));
    return;
  }
  Axis names{.key = std::string(variant_key)};
  for (const GivenVariant& variant : variants) {
    study.variants.push_back(
        {variant.name, base_scene(overridden(entries, variant.entries), axes, variant.entries.front().place)});
    study.axes = axes_of(axes, body_of(study.variants.back().base));
    names.texts.push_back(variant.name);
  }
  study.axes.insert(study.axes.begin(), names);
  study.base = study.variants.front().base;
}

/// The bodies of the study.
std::vector<Body> bodies_of(const Study& study) {
  std::vector<Body> bodies{body_of(study.base)};
  for (const Variant& variant : study.variants) bodies.push_back(body_of(variant.base));
  for (const Axis& axis : study.axes)
    if (axis.key == "indenter")
      for (const std::string& name : axis.texts)
        bodies.push_back(static_cast<Indenter>(find_name(ChoiceNames<Indenter>::names, name)));
  return bodies;
}

/// What is asked for of the inside of the layers is computed nowhere where no scene has it.
void refuse_never_computed(const Study& study, const std::string& place) {
  const std::vector<std::string_view> numbers = number_outputs();
  const auto refuse_at = [&](const std::string& where, const std::string& name) {
    const auto formula = find_if(study.formulas, [&](const auto& one) { return one.first == name; });
    if (formula == study.formulas.end() && find_name(numbers, name) < 0) return;
    const Formula asked(formula == study.formulas.end() ? name : formula->second, FormulaNames::inputs_and_outputs);
    refusing_at(place + ": " + where, [&] { refuse_never_computed(asked, study); });
  };
  for (const std::string& name : study.compute) refuse_at("compute", name);
  for (const StudyChart& chart : study.charts)
    for (const std::string& name : {chart.x, chart.y, chart.map}) refuse_at("chart", name);
}

}  // namespace

void refuse_never_computed(const Formula& formula, const Study& study) {
  std::vector<RollingScene> scenes{study.base};
  for (const Variant& variant : study.variants) scenes.push_back(variant.base);
  for (const Axis& axis : study.axes)
    if (axis.key == "interior") return;
  for (const std::string& key : formula.keys()) {
    const auto by_interior = [&](RollingScene scene) {
      const bool absent = !why_absent(scene, key).empty();
      scene.interior = Interior::on;
      return absent && why_absent(scene, key).empty();
    };
    if (all_of(scenes, by_interior)) refuse_absent(formula, study.base);
  }
}

Study read_study(const std::filesystem::path& file) {
  const std::string place = file.string();
  const std::string text = whole_file(file, largest_json);
  Json object = parse_object(text, place);
  require_kind(FileKind::study, object, place);
  refuse_unknown_keys(object, study_keys, place);
  refuse_ignored_other_than_texts(object, place);

  Study study;
  study.name = needed_name(object, "study", place, "must be the name of the study");
  study.source = place;
  const std::vector<GivenVariant> variants =
      given_variants(object.contains("axes") ? object["axes"] : Json(), file.parent_path(), place + ": axes");
  std::vector<GivenAxis> given = given_axes(object, place, variants.size());
  const std::vector<SceneEntry> set = set_entries(object, place);
  refuse_given_twice(set, given, variants);
  const CompleteScene scene = complete_scene(object, file, place);
  const std::vector<SceneEntry> entries = overridden(scene_entries(scene.inputs, {}, scene.place), set);
  resolve_fit(object, file, place);
  study.definition = standalone_text(object, text, scene, file);
  study.uncertain = uncertain_inputs(object, entries, place);
  if (study.uncertain.any()) {
    refuse_several_bodies(given, place);
    refuse_set_uncertain(set, variants, study.uncertain);
    given = given_axes(object, place, variants.size(), uncertain_axes(study.uncertain, place));
  }
  add_scenes(study, entries, given, variants, place);
  const std::vector<Body> bodies = bodies_of(study);
  ComputeWish wish = compute_wish(object, bodies, place);
  study.compute = std::move(wish.columns);
  study.formulas = std::move(wish.formulas);
  study.constraints = study_constraints(object, bodies, study.formulas, place);
  study.fields = is_true(object, "fields", place);
  study.charts = study_charts(object, study.axes, study.formulas, place);
  refuse_never_computed(study, place);
  return study;
}

}  // namespace rollres
