#pragma once

/// How a report looks (CSS) and answers (a small script), as texts inside the file.

#include <string_view>

namespace rollres::html {

/// For light and dark screens from the width of a phone on, and for paper.
std::string_view style();

/// Sorts tables by a click on a head, shows one curve of a chart alone. Nothing is hidden without it.
std::string script();

}  // namespace rollres::html
