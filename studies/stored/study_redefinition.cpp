#include "studies/stored/study_redefinition.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <unordered_set>

#include "studies/text/strict_json.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// Keys that decide no point.
constexpr std::array not_of_points{"$schema", "study", "comment", "chart", "charts", "compute", "fields"};

/// The object in a text without these keys; the text itself if it holds none.
nlohmann::json points_in(const std::string& text) {
  nlohmann::json object = nlohmann::json::parse(text, nullptr, false);
  if (!object.is_object()) return text;
  for (const char* const key : not_of_points) object.erase(key);
  if (const auto scene = object.find("scene"); scene != object.end() && scene->is_object())
    for (const char* const key : not_of_points) scene->erase(key);
  return object;
}

/// One step from the former file to the later one.
std::string in_words(const nlohmann::json& change, const nlohmann::json& before) {
  const std::string path = change.at("path"), what = change.at("op");
  const bool appended = path.ends_with("/-");
  const std::string key = replaced(path.substr(1, path.size() - (appended ? 3 : 1)), {{'/', "."}});
  if (what == "add") return key + ": " + shown(change.at("value")) + " added";
  const std::string former = shown(before.at(nlohmann::json::json_pointer(path)));
  return what == "remove" ? key + ": " + former + " left out" : key + " " + former + " -> " + shown(change.at("value"));
}

}  // namespace

std::string changes_between(const std::string& former, const std::string& later) {
  const nlohmann::json before = points_in(former), after = points_in(later);
  if (before == after) return {};
  if (!before.is_object() || !after.is_object()) return "its file";
  std::vector<std::string> changes;
  for (const nlohmann::json& change : nlohmann::json::diff(before, after)) changes.push_back(in_words(change, before));
  constexpr std::size_t told = 3;
  const std::size_t others = changes.size() - std::min(told, changes.size());
  changes.resize(changes.size() - others);
  return joined(changes) + (others > 0 ? " and " + std::to_string(others) + " more" : "");
}

std::optional<Redefinition> start_again(ResultStore& store, const StudyRecord& study, std::span<const std::string> keys,
                                        bool replace) {
  const std::optional<std::string> former = store.definition(study.name);
  if (!former || *former == study.definition) return std::nullopt;
  Redefinition found{changes_between(*former, study.definition)};
  if (found.changes.empty()) return std::nullopt;
  const std::unordered_set<std::string_view> stay(keys.begin(), keys.end());
  for (const std::string& key : store.points(study.name)) found.left += stay.contains(key) ? 0 : 1;
  if (found.left == 0) return std::nullopt;
  if (!replace)
    throw std::invalid_argument(store.database().name() + ": study = " + study.name +
                                ": is there already, defined otherwise: " + found.in_words() +
                                ": give this study another name, or --replace");
  return found;
}

std::string Redefinition::in_words() const {
  return changes + "; " + std::to_string(left) + (left == 1 ? " point of it leaves" : " points of it leave") +
         " the study, their rows stay";
}

}  // namespace rollres
