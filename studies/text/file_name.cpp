#include "studies/text/file_name.hpp"

#include <algorithm>
#include <string_view>

namespace rollres {

std::string file_name(std::string name) {
  std::replace_if(
      name.begin(), name.end(),
      [](unsigned char letter) {
        return letter <= 0x20 || letter == 0x7f ||
               std::string_view("/\\:*?\"<>|").find(static_cast<char>(letter)) != std::string_view::npos;
      },
      '_');
  if (name == "." || name == "..") name = "_";
  constexpr std::size_t longest = 120;  // file systems take 255 bytes, suffix included
  if (name.size() > longest) name.resize(longest);
  return name;
}

}  // namespace rollres
