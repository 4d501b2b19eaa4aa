#include "db/file/sql_text.hpp"

namespace rollres {

namespace {

std::string between(char quote, std::string_view text) {
  std::string result(1, quote);
  for (const char letter : text) result.append(letter == quote ? 2 : 1, letter);
  return result + quote;
}

}  // namespace

std::string quoted_name(std::string_view name) { return between('"', name); }

std::string quoted_text(std::string_view text) { return between('\'', text); }

}  // namespace rollres
