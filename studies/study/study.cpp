#include "studies/study/study.hpp"

#include "studies/study/study_axes.hpp"
#include "studies/study/study_keys.hpp"
#include "studies/study/study_outputs.hpp"
#include "studies/study/study_scene.hpp"
#include "studies/text/file_kind.hpp"
#include "studies/text/files.hpp"

namespace rollres {

namespace {

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
  const std::string text = whole_file(file, largest_json);
  const Json object = parse_object(text, place);
  require_kind(FileKind::study, object, place);
  refuse_unknown_keys(object, study_keys, place);
  refuse_ignored_other_than_texts(object, place);

  Study study;
  study.name = needed_name(object, "study", place, "must be the name of the study");
  study.source = place;
  const std::vector<GivenAxis> given = given_axes(object, place);
  const std::vector<SceneEntry> set = set_entries(object, place);
  refuse_set_axes(set, given);
  const CompleteScene scene = complete_scene(object, file, place);
  study.definition = standalone_text(object, text, scene);
  study.base = base_scene(overridden(scene_entries(scene.inputs, {}, scene.place), set), given, place);
  study.axes = axes_of(given, study.base.indenter);
  study.constraints = study_constraints(object, indenters_of(study), place);
  study.compute = study_outputs(object, place);
  study.fields = is_true(object, "fields", place);
  study.charts = study_charts(object, study.axes, place);
  return study;
}

}  // namespace rollres
