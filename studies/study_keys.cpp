#include "studies/study_keys.hpp"

#include <stdexcept>
#include <vector>

namespace rollres {

void refuse_unknown_keys(const Json& object, std::span<const FileKey> known, const std::string& place) {
  std::vector<std::string_view> names;
  for (const FileKey& key : known) names.push_back(key.key);
  for (const auto& [key, value] : object.items())
    if (find_name(names, key) < 0) refuse(place, key, value, unknown("unknown key", names, key));
}

const Json& needed(const Json& object, const std::string& key, const std::string& place, const std::string& rule) {
  const auto found = object.find(key);
  if (found == object.end()) throw std::invalid_argument(place + ": " + key + " is missing: " + rule);
  return *found;
}

std::string needed_text(const Json& object, const std::string& key, const std::string& place, const std::string& rule) {
  const Json& value = needed(object, key, place, rule);
  if (!value.is_string() || value.get_ref<const std::string&>().empty()) refuse(place, key, value, rule);
  return value.get<std::string>();
}

std::string needed_name(const Json& object, const std::string& key, std::span<const std::string_view> names,
                        const std::string& place, const std::string& rule) {
  const Json& value = needed(object, key, place, rule);
  if (!value.is_string()) refuse(place, key, value, rule);
  const auto name = value.get<std::string>();
  if (find_name(names, name) < 0) refuse(place, key, value, unknown(rule, names, name));
  return name;
}

}  // namespace rollres
