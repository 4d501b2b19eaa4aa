#include "studies/study/study_keys.hpp"

#include <vector>

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

}  // namespace rollres
