#pragma once

/// What JSON schemas of several kinds of files are made of.

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "studies/scene_io/scene_entries.hpp"
#include "studies/study/study_keys.hpp"

namespace rollres::json_schema {

inline constexpr const char* draft = "http://json-schema.org/draft-07/schema#";

/// Names of definitions: texts such as "5 mm".
inline constexpr const char* with_unit = "number with a unit";

/// One of these texts.
Json names(std::span<const std::string_view> list);

/// A definition of the schema by its name.
Json reference(const std::string& name);

/// What all schemas define.
Json common_definitions();

/// The same, and every input by its key.
Json input_definitions();

/// An input's values.
Json input(const InputKind& kind);
Json input_reference(const InputKind& kind);

bool any_input(const InputKind& kind);
bool real_input(const InputKind& kind);
bool no_list(const InputKind& kind);

/// What the key of an input of any further layer looks like, "coating_layers[0].layer_thickness".
std::string layer_pattern(std::string_view own_key);

/// The key of an input, its own or a further layer's.
Json input_key(bool (*accepts)(const InputKind&));

/// An object whose properties are the inputs with these values.
template <class ValueOf>
Json inputs(ValueOf&& value_of, bool (*accepts)(const InputKind&)) {
  Json properties = Json::object();
  for (const InputKind& kind : written_kinds())
    if (accepts(kind)) properties[std::string(kind.quantity.key)] = value_of(kind);
  return {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
}

/// The same where keys of further layers' inputs are taken too: where inputs replace others, or vary.
template <class ValueOf>
Json inputs_and_layers(ValueOf&& value_of, bool (*accepts)(const InputKind&)) {
  Json object = inputs(value_of, accepts);
  for (const InputKind& own : layer_kinds())
    if (accepts(own)) object["patternProperties"][layer_pattern(own.quantity.key)] = value_of(own);
  return object;
}

/// An object of a file, by its keys. @param own  what stands under keys that have no form
/// @throws std::logic_error if one of these is missing, or not such a key
Json object_of(std::span<const FileKey> keys, const std::vector<std::pair<std::string_view, Json>>& own = {});

Json name();
Json whole(int lowest, int highest);
Json list_of(const Json& item);

/// A number, or one with a unit, of whichever input.
Json input_number();

/// Keys of every file that are ignored.
Json ignored_texts();

/// The same, and the name of a file with a master curve: the keys of a scene that are no inputs.
Json scene_texts();

/// A file's scene: its name, or an object with inputs, which may be few.
Json scene_or_file();

std::string printed(const Json& schema);

}  // namespace rollres::json_schema
