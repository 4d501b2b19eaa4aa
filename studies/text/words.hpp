#pragma once

/// Words taken out of texts and put together to such, for files, shells and refusals; keys as people read them.

#include <initializer_list>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/messages/message_text.hpp"
#include "core/scene/quantity.hpp"

namespace rollres {

/// The text without blanks, tabulators and carriage returns at its ends.
std::string_view trimmed(std::string_view text);

/// The words of "speed, load", without the blanks around them; nothing for an empty text.
std::vector<std::string> split_at_commas(std::string_view text);

/// The text with some letters replaced by others. @param by  each of these letters with what stands for it
std::string replaced(std::string_view text, std::initializer_list<std::pair<char, std::string_view>> by);

/// A text as it stands in a message: its first 80 bytes and "..." where it is longer.
std::string shortened(std::string text);

/// What is unknown, then the nearest known name or, where none is near, what else to do.
std::string unknown(const std::string& what, std::span<const std::string_view> known, std::string_view name,
                    const std::string& otherwise = "");
std::string unknown(const std::string& what, const std::vector<std::string>& known, std::string_view name,
                    const std::string& otherwise = "");

/// A text as one word of the shell.
std::string shell_word(std::string_view text);

/// A name that file systems take: blanks, "/" and the like become "_".
std::string file_name(std::string name);

/// Does `function`, and puts the place (a file, an option) in front of its refusal.
template <class Function>
auto refusing_at(const std::string& place, Function function) {
  try {
    return function();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(place + ": " + error.what());
  }
}

/// "rolling resistance", "layer thickness of coating [0]"
std::string in_words(std::string_view key);

/// A formula or condition as people read it: "rolling resistance / load", "peak pressure ≤ 4 MPa".
std::string formula_in_words(std::string_view formula);

/// The symbol of a quantity where its name in words stands beside it: "H", not "H of coating [0]".
std::string_view symbol_beside_name(const Quantity& quantity);

}  // namespace rollres
