#pragma once

/// Pieces of an HTML file that stands by itself: no script, no network, pictures inside; for screens from the width of
/// a phone on and for paper.

#include <string>
#include <string_view>
#include <vector>

#include "studies/text/xml_text.hpp"

namespace rollres::html {

inline std::string text(std::string_view plain) { return xml_text(plain); }

/// <h2 id=...>
std::string heading(std::string_view plain);

/// A paragraph of plain text.
std::string paragraph(std::string_view plain);

/// Preformatted text, whose long lines are broken.
std::string listing(std::string_view plain);

struct TableColumn {
  std::string head;
  bool number = false;  ///< set flush right
};

/// A row of plain texts; `marked` rows stand out.
struct TableRow {
  std::vector<std::string> cells;
  bool marked = false;
};

/// A table that scrolls inside the page where it is wider than that.
std::string table(const std::vector<TableColumn>& columns, const std::vector<TableRow>& rows);

/// A picture inside the file. @param svg  text of an SVG file   @param meaning  caption, and alternative text
std::string picture(std::string_view svg, std::string_view meaning);

/// The whole file. @param body  HTML
std::string page(std::string_view title, std::string_view body);

}  // namespace rollres::html
