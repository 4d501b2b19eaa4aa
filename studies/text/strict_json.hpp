#pragma once

/// JSON as this program accepts it. For sources only: public headers stay free of nlohmann_json.

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "studies/text/words.hpp"

namespace rollres {

using Json = nlohmann::ordered_json;

/// Parses JSON text; objects keep the order of their keys.
/// @param place where the text comes from, for messages
/// @throws std::invalid_argument for a syntax error (with its line), a key given twice, a number beyond double, or
/// anything but an object
Json parse_object(std::string_view text, const std::string& place);

/// Bytes of the largest file: no scene or study comes near.
inline constexpr std::size_t largest_json = 10'000'000;

/// The object in a file.
/// @throws std::runtime_error if the file cannot be read
Json read_object(const std::string& path);

/// A value as it stands in a message: JSON on one line, shortened where it is long.
std::string shown(const Json& value);

/// Throws std::invalid_argument with the one line "place: key = value: rule".
[[noreturn]] void refuse(const std::string& place, std::string_view key, const Json& value, const std::string& rule);

/// Refuses keys of `object` that are not among `known`.
void refuse_unknown_keys(const Json& object, std::span<const std::string_view> known, const std::string& place);

/// The value of a key that must be there; the rule says what it must be.
const Json& needed(const Json& object, const std::string& key, const std::string& place, const std::string& rule);

/// The same for a text that must not be empty.
std::string needed_text(const Json& object, const std::string& key, const std::string& place, const std::string& rule);
/// The same of a name that files, pictures and scripts bear: without control characters, not "." nor "..".
std::string needed_name(const Json& object, const std::string& key, const std::string& place, const std::string& rule);

/// The rule of names that a name breaks; empty if none: no control characters, no blanks at its ends, not . or ..
std::string broken_by_name(std::string_view name);

/// The names in a list under a key; none without it.
std::vector<std::string> names_or_none(const Json& object, const std::string& key, const std::string& place);

/// A whole number from `lowest` to `highest`, both included. @throws std::invalid_argument naming place, key and value
int whole_number(const Json& value, std::string_view key, int lowest, int highest, const std::string& place);

/// The same under a key of `object`, or `usual` without it.
int whole_number_or(const Json& object, const std::string& key, int usual, int lowest, int highest,
                    const std::string& place);

}  // namespace rollres
