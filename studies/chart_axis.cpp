#include "studies/chart_axis.hpp"

#include <algorithm>
#include <ostream>

#include "studies/gnuplot.hpp"
#include "studies/scaled_unit.hpp"

namespace rollres {

std::size_t letters(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

std::string fitted(std::string text, const std::string& markup, std::size_t room) {
  const std::size_t length = letters(text);
  if (length <= room) return gnuplot::quoted(markup);
  const std::size_t longest = room * 3 / 2;
  const double scale = static_cast<double>(room) / static_cast<double>(std::min(length, longest));
  const std::string size = "{/*" + short_number(scale, 2) + " ";
  if (length <= longest) return gnuplot::quoted(size + markup + "}");
  while (letters(text) >= longest) {
    while ((text.back() & 0xc0) == 0x80) text.pop_back();
    text.pop_back();
  }
  return gnuplot::quoted(size + gnuplot::plain(text) + "…}");
}

std::string axis_label(const ChartAxis& axis, std::size_t room) {
  std::string text = axis.name, markup = gnuplot::plain(axis.name);
  if (!axis.symbol.empty()) {
    text += "  " + axis.symbol;
    markup += " " + gnuplot::symbol(axis.symbol);
  }
  if (!axis.unit.empty()) {
    text += "  [" + axis.unit + "]";
    markup += "  [" + gnuplot::plain(axis.unit) + "]";
  }
  return fitted(text, markup, room);
}

void write_axis(std::ostream& script, char name, const Span& span) {
  script << "set " << name << "range [" << short_number(span.lowest, 15) << ":" << short_number(span.highest, 15)
         << "]\n";
  if (!span.logarithmic) return;
  script << "set logscale " << name << "\n";
  const bool plain_numbers = span.lowest >= 0.9e-4 && span.highest <= 1.1e5;
  const std::vector<double> numbers = ticks(span);
  script << "set format " << name << (plain_numbers || !numbers.empty() ? " '%g'\n" : " '10^{%L}'\n");
  if (numbers.empty()) return;
  script << "set " << name << "tics (";
  for (std::size_t i = 0; i < numbers.size(); ++i) script << (i == 0 ? "" : ", ") << short_number(numbers[i]);
  script << ")\n";
}

}  // namespace rollres
