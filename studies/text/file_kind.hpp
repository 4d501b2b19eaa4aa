#pragma once

/// Which of the program's files a JSON object is, so that one given to the wrong command is told where it belongs.

#include <string>

#include "studies/text/strict_json.hpp"

namespace rollres {

enum class FileKind { scene, study, design, fit };

/// Does nothing where the object is of this kind or cannot be told: its keys decide then.
/// @throws std::invalid_argument naming what the file is and the commands that take it
void require_kind(FileKind wanted, const Json& object, const std::string& place);

}  // namespace rollres
