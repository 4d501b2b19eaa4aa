#include "studies/report/html.hpp"

namespace rollres::html {

namespace {

constexpr std::string_view style = R"(
:root { color-scheme: light; }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 62rem; padding: 1rem; font: 16px/1.45 system-ui, sans-serif; color: #1a1a1a;
  background: #fff; overflow-wrap: anywhere; }
h1 { font-size: 1.6rem; line-height: 1.2; margin: 0.5rem 0; }
h2 { font-size: 1.2rem; margin: 2rem 0 0.5rem; padding-bottom: 0.2rem; border-bottom: 2px solid #0072B2; }
p { margin: 0.5rem 0; }
.table { overflow-x: auto; margin: 0.7rem 0; }
table { border-collapse: collapse; font-size: 0.86rem; font-variant-numeric: tabular-nums; }
th, td { padding: 0.22rem 0.6rem; border-bottom: 1px solid #ddd; text-align: left; vertical-align: top;
  overflow-wrap: normal; }
th { border-bottom: 2px solid #888; vertical-align: bottom; }
.number { text-align: right; }
td.number { white-space: nowrap; }
tr.marked td { background: #fdecea; }
pre { margin: 0.7rem 0; padding: 0.7rem; background: #f4f4f4; font-size: 0.8rem; white-space: pre-wrap;
  overflow-wrap: anywhere; }
.pictures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 26rem), 1fr)); gap: 1rem; }
figure { margin: 0.5rem 0; }
img { display: block; width: 100%; height: auto; }
figcaption { font-size: 0.86rem; color: #444; }
@media (max-width: 480px) { body { padding: 0.6rem; font-size: 15px; } th, td { padding: 0.2rem 0.4rem; } }
@media print {
  @page { size: A4; margin: 15mm; }
  body { max-width: none; padding: 0; font-size: 10pt; }
  h2 { break-after: avoid; }
  .table { overflow: visible; }
  table { font-size: 7.5pt; width: 100%; }
  th, td { padding: 0.12rem 0.3rem; overflow-wrap: break-word; }
  td.number { white-space: normal; }
  thead { display: table-header-group; }
  tr, figure { break-inside: avoid; }
  .pictures { display: block; }
  figure { max-width: 150mm; }
  pre { font-size: 7.5pt; }
  tr.marked td { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
)";

/// As part of a URL: what is not a plain letter or sign as %XX (RFC 3986).
std::string percent_encoded(std::string_view text) {
  constexpr std::string_view kept = "-_.~!*,:;@$/";
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string encoded;
  for (const char letter : text) {
    const bool plain = (letter >= '0' && letter <= '9') || (letter >= 'A' && letter <= 'Z') ||
                       (letter >= 'a' && letter <= 'z') || kept.find(letter) != std::string_view::npos;
    const auto byte = static_cast<unsigned char>(letter);
    if (plain)
      encoded += letter;
    else
      (encoded += '%') += {digits[byte >> 4], digits[byte & 15]};
  }
  return encoded;
}

std::string cell(const char* tag, bool number, std::string_view plain) {
  return std::string("<") + tag + (number ? " class=\"number\">" : ">") + text(plain) + "</" + tag + ">";
}

}  // namespace

std::string heading(std::string_view plain) { return "<h2>" + text(plain) + "</h2>\n"; }

std::string paragraph(std::string_view plain) { return "<p>" + text(plain) + "</p>\n"; }

std::string listing(std::string_view plain) { return "<pre>" + text(plain) + "</pre>\n"; }

std::string table(const std::vector<TableColumn>& columns, const std::vector<TableRow>& rows) {
  std::string markup = "<div class=\"table\"><table>\n<thead><tr>";
  for (const TableColumn& column : columns) markup += cell("th", column.number, column.head);
  markup += "</tr></thead>\n<tbody>\n";
  for (const TableRow& row : rows) {
    markup += row.marked ? "<tr class=\"marked\">" : "<tr>";
    for (std::size_t i = 0; i < columns.size(); ++i)
      markup += cell("td", columns[i].number, i < row.cells.size() ? row.cells[i] : "");
    markup += "</tr>\n";
  }
  return markup + "</tbody></table></div>\n";
}

std::string picture(std::string_view svg, std::string_view meaning) {
  return "<figure><img alt=\"" + text(meaning) + "\" src=\"data:image/svg+xml;charset=utf-8," + percent_encoded(svg) +
         "\"><figcaption>" + text(meaning) + "</figcaption></figure>\n";
}

std::string page(std::string_view title, std::string_view body) {
  std::string markup =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>";
  markup += text(title);
  markup += "</title>\n<style>";
  markup += style;
  markup += "</style>\n</head>\n<body>\n";
  markup += body;
  return markup + "</body>\n</html>\n";
}

}  // namespace rollres::html
