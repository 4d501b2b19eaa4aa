#pragma once

#include <string>

namespace rollres {

/// A name that file systems take: blanks, "/" and the like become "_".
std::string file_name(std::string name);

}  // namespace rollres
