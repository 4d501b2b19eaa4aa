#include "studies/study/study.hpp"

#include <algorithm>

#include "studies/study/base_scene.hpp"
#include "studies/study/study_axes.hpp"
#include "studies/study/study_keys.hpp"
#include "studies/study/study_outputs.hpp"
#include "studies/study/study_scene.hpp"

namespace rollres {

namespace {

void refuse_what_is_no_text(const Json& object, const std::string& key, const std::string& place) {
  if (const auto found = object.find(key); found != object.end() && !found->is_string())
    refuse(place, key, *found, "must be a text");
}

bool wants_fields(const Json& object, const std::string& place) {
  const auto found = object.find("fields");
  if (found == object.end()) return false;
  if (!found->is_boolean()) refuse(place, "fields", *found, "must be true or false");
  return found->get<bool>();
}

void refuse_set_axes(const std::vector<SceneEntry>& set, const std::vector<GivenAxis>& axes) {
  for (const SceneEntry& entry : set)
    for (const GivenAxis& axis : axes)
      if (axis.key == entry.key) refuse(entry.place, entry.key, entry.value, "is an axis of the study too");
}

/// The bodies of the study.
std::vector<Indenter> indenters_of(const Study& study) {
  std::vector<Indenter> indenters{study.base.indenter};
  for (const Axis& axis : study.axes)
    if (axis.key == "indenter")
      for (const std::string& name : axis.texts)
        indenters.push_back(static_cast<Indenter>(find_name(ChoiceNames<Indenter>::names, name)));
  return indenters;
}

}  // namespace

Study read_study(const std::filesystem::path& file) {
  const std::string place = file.string();
  const Json object = read_object(place);
  refuse_unknown_keys(object, study_keys, place);
  for (const std::string_view key : ignored_keys) refuse_what_is_no_text(object, std::string(key), place);

  Study study;
  study.name = needed_name(object, "study", place, "must be the name of the study");
  study.source = place;
  const std::vector<GivenAxis> given = given_axes(object, place);
  const std::vector<SceneEntry> set = set_entries(object, place);
  refuse_set_axes(set, given);
  study.base = base_scene(overridden(scene_entries_of(object, file, place), set), given, place);
  study.axes = axes_of(given, study.base.indenter);
  study.constraints = study_constraints(object, indenters_of(study), place);
  study.compute = study_outputs(object, place);
  study.fields = wants_fields(object, place);
  study.charts = study_charts(object, study.axes, place);
  return study;
}

}  // namespace rollres
