#include "studies/report/html.hpp"

#include <algorithm>

#include "studies/report/report_look.hpp"

namespace rollres::html {

namespace {

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

std::string lead(std::string_view plain) { return "<p class=\"lead\">" + text(plain) + "</p>\n"; }

std::string folded(std::string_view summary, std::string_view body) {
  return "<details><summary>" + text(summary) + "</summary>\n" + std::string(body) + "</details>\n";
}

std::string listing(std::string_view plain) { return "<pre>" + text(plain) + "</pre>\n"; }

std::string table(const std::vector<TableColumn>& columns, const std::vector<TableRow>& rows) {
  constexpr std::size_t few = 3;  // rows that nobody sorts
  const bool sortable = rows.size() > few;
  const auto cell_of = [](const TableRow& row, std::size_t i) { return i < row.cells.size() ? row.cells[i] : ""; };
  std::vector<std::size_t> telling;
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (std::any_of(rows.begin(), rows.end(), [&](const TableRow& row) {
          const std::string text = cell_of(row, i);
          return !text.empty() && text != "-";
        }))
      telling.push_back(i);
  std::string markup = std::string("<div class=\"table\" tabindex=\"0\"><table") +
                       (sortable ? " class=\"sortable\"" : "") + ">\n<thead><tr>";
  for (const std::size_t i : telling) markup += cell("th", columns[i].number, columns[i].head);
  markup += "</tr></thead>\n<tbody>\n";
  for (const TableRow& row : rows) {
    markup += row.marked ? "<tr class=\"marked\">" : "<tr>";
    for (const std::size_t i : telling) markup += cell("td", columns[i].number, cell_of(row, i));
    markup += "</tr>\n";
  }
  return markup + "</tbody></table></div>\n";
}

std::string picture(std::string_view svg, std::string_view meaning, const ChartOverlay& overlay) {
  return "<figure><div class=\"picture\"><img alt=\"" + text(meaning) + "\" src=\"data:image/svg+xml;charset=utf-8," +
         percent_encoded(svg) + "\">" + overlay.layer + "</div>" + overlay.buttons + "<figcaption>" + text(meaning) +
         "</figcaption></figure>\n";
}

std::string page(std::string_view title, std::string_view body) {
  std::string markup =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>";
  markup += text(title);
  markup += "</title>\n<style>\n";
  markup += style();
  markup += "</style>\n</head>\n<body>\n<main>\n";
  markup += body;
  markup += "</main>\n<script>\n";
  markup += script();
  return markup + "</script>\n</body>\n</html>\n";
}

}  // namespace rollres::html
