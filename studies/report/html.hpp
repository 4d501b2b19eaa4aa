#pragma once

/// Pieces of an HTML file that stands by itself: no network, pictures inside; for light and dark screens from the width
/// of a phone on and for paper. One small script sorts tables and picks curves; all of it can be read without.

#include <string>
#include <string_view>
#include <vector>

#include "studies/report/chart_overlay.hpp"
#include "studies/text/xml_text.hpp"

namespace rollres::html {

inline std::string text(std::string_view plain) { return xml_text(plain); }

/// <h2 id=...>
std::string heading(std::string_view plain);

/// A paragraph of plain text.
std::string paragraph(std::string_view plain);

/// The same, larger: what to read first.
std::string lead(std::string_view plain);

/// What is read by few: closed until its summary is clicked, and left out on paper. @param body  HTML
std::string folded(std::string_view summary, std::string_view body);

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

/// A table that scrolls inside the page where it is wider than that; a click on a head sorts it. Columns in which no
/// row says anything, each cell empty or "-", are left out.
std::string table(const std::vector<TableColumn>& columns, const std::vector<TableRow>& rows);

/// A picture inside the file. @param svg  text of an SVG file   @param meaning  caption, and alternative text
std::string picture(std::string_view svg, std::string_view meaning, const ChartOverlay& overlay = {});

/// The whole file. @param body  HTML
std::string page(std::string_view title, std::string_view body);

}  // namespace rollres::html
