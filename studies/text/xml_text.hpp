#pragma once

/// Text inside files of XML and HTML.

#include <string>
#include <string_view>

namespace rollres {

/// A text as it stands between tags and in quoted attributes. What is not UTF-8 becomes U+FFFD, control characters
/// other than line breaks and tabs become blanks.
std::string xml_text(std::string_view plain);

}  // namespace rollres
