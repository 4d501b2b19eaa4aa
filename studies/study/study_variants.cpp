#include "studies/study/study_variants.hpp"

#include <algorithm>

#include "db/rows/schema.hpp"
#include "studies/scene_io/master_curve_file.hpp"
#include "studies/scene_io/scene_overrides.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

const std::string variant(variant_key), file_key(master_curve_key);

/// Each variant by its name, those of a list of files among them.
Json objects_of(const Json& varied, const std::string& place) {
  if (!varied.is_object()) return Json::object();
  const auto named = varied.find(variant), files = varied.find(file_key);
  if (named != varied.end() && files != varied.end())
    refuse(place, file_key, *files,
           "varies as a variant of its own: put each file into the variant that it belongs to");
  if (named != varied.end()) {
    const std::string rule = "must be an object of two or more variants, each an object { ... } of inputs";
    if (!named->is_object() || named->size() < 2) refuse(place, variant, *named, rule);
    for (const auto& [name, inputs] : named->items()) {
      if (!inputs.is_object() || inputs.empty() || trimmed(name).empty())
        refuse(place + ": " + variant, name, inputs, rule);
      if (const std::string broken = broken_by_name(name); !broken.empty()) refuse(place, variant, Json(name), broken);
    }
    return *named;
  }
  Json objects = Json::object();
  if (files == varied.end()) return objects;
  const std::string rule = "must be a list of two or more names of CSV files";
  if (!files->is_array() || files->size() < 2) refuse(place, file_key, *files, rule);
  for (const Json& name : *files) {
    if (!name.is_string() || name.get_ref<const std::string&>().empty()) refuse(place, file_key, name, rule);
    if (objects.contains(name.get<std::string>())) refuse(place, file_key, name, "value given twice");
    objects[name.get<std::string>()][file_key] = name;
  }
  return objects;
}

}  // namespace

bool is_of_variants(std::string_view key) { return key == variant_key || key == master_curve_key; }

std::vector<GivenVariant> given_variants(const Json& varied, const std::filesystem::path& folder,
                                         const std::string& place) {
  std::vector<GivenVariant> variants;
  const Json objects = objects_of(varied, place);
  for (const auto& [name, inputs] : objects.items()) {
    for (const auto& [other, same] : objects.items())
      if (other == name)
        break;
      else if (same == inputs)
        refuse(place + ": " + variant, name, inputs, "has the inputs of variant " + other);
    const std::string own_place = place + ": " + variant + ": " + name;
    variants.push_back({name, replacing_entries(with_master_curve(inputs, folder, own_place), own_place)});
  }
  return variants;
}

void refuse_given_twice(const std::vector<GivenVariant>& variants, std::string_view key, const std::string& elsewhere) {
  const std::string held = held_key(std::string(key));
  std::vector<std::string_view> same{held};
  const InputKind* const input = find_input(key);
  if (input && input->choices.empty())
    for (const std::string_view replaced : replaced_inputs(key, 0.0)) same.push_back(replaced);
  for (const GivenVariant& one : variants)
    for (const std::string_view given : same)
      if (const Json* const value = value_given(one.entries, given))
        refuse(one.entries.front().place, given, *value,
               given == held ? elsewhere : std::string(key) + ", which takes its place, " + elsewhere);
}

bool inline_variants(Json& varied, const std::filesystem::path& folder, const std::string& place) {
  Json objects = objects_of(varied, place);
  bool any = false;
  for (auto& [name, inputs] : objects.items())
    if (names_tables(inputs)) {
      inputs = with_master_curve(inputs, folder, place + ": " + variant + ": " + name);
      any = true;
    }
  if (!any) return false;
  Json complete = Json::object();
  for (const auto& [key, value] : varied.items()) complete[is_of_variants(key) ? variant : key] = value;
  complete[variant] = std::move(objects);
  varied = std::move(complete);
  return true;
}

}  // namespace rollres
