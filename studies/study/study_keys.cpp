#include "studies/study/study_keys.hpp"

#include <cmath>
#include <vector>

#include "studies/scene_io/scene_entries.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/words.hpp"

namespace rollres {

void refuse_unknown_keys(const Json& object, std::span<const FileKey> known, const std::string& place) {
  std::vector<std::string_view> names;
  for (const FileKey& key : known) names.push_back(key.key);
  refuse_unknown_keys(object, names, place);
}

std::string needed_name(const Json& object, const std::string& key, std::span<const std::string_view> names,
                        const std::string& place, const std::string& rule) {
  const Json& value = needed(object, key, place, rule);
  if (!value.is_string()) refuse(place, key, value, rule);
  const auto name = value.get<std::string>();
  if (find_name(names, name) < 0) refuse(place, key, value, unknown(rule, names, name));
  return name;
}

std::string name_or_first(const Json& object, const std::string& key, std::span<const std::string_view> names,
                          const std::string& place) {
  if (!object.contains(key)) return std::string(names.front());
  return needed_name(object, key, names, place, "must be one of " + joined(names));
}

bool is_true(const Json& object, const std::string& key, const std::string& place) {
  const auto found = object.find(key);
  if (found == object.end()) return false;
  if (!found->is_boolean()) refuse(place, key, *found, "must be true or false");
  return found->get<bool>();
}

double positive_or(const Json& object, const std::string& key, double usual, const std::string& place, double highest) {
  const auto found = object.find(key);
  if (found == object.end()) return usual;
  if (!found->is_number() || !(*found > 0 && *found <= highest))
    refuse(place, key, *found, "must be a number > 0" + (std::isinf(highest) ? "" : " and up to " + shortest(highest)));
  return found->get<double>();
}

void refuse_ignored_other_than_texts(const Json& object, const std::string& place) {
  for (const std::string_view key : ignored_keys)
    if (const auto found = object.find(key); found != object.end() && !found->is_string())
      refuse(place, key, *found, "must be a text");
}

}  // namespace rollres
