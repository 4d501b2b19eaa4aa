#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "studies/chart.hpp"
#include "studies/chart_layout.hpp"
#include "studies/gnuplot.hpp"
#include "studies/readable_number.hpp"

namespace rollres {

namespace {

// Sizes in pixels of the SVG; the PNG has twice as many.
constexpr double picture_width = 560, plot_height = 345, title_height = 36, legend_row_height = 23, font_size = 17;

/// Look of the n-th curve. The colours are those of Okabe and Ito (2008) without their yellow; the periods 7, 6 and 5
/// of colours, marks and dashes have no common factor, so 210 curves differ.
struct Look {
  std::string_view colour;
  int filled, hollow;  // gnuplot's point types
  std::string_view dash;
};
Look look(std::size_t curve) {
  constexpr std::array<std::string_view, 7> colours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                    "#E69F00", "#56B4E9", "#000000"};
  constexpr std::array<int, 6> filled{7, 5, 9, 13, 11, 15}, hollow{6, 4, 8, 12, 10, 14};
  constexpr std::array<std::string_view, 5> dashes{"1", "(10,4)", "(3,3)", "(10,3,2,3)", "(6,2)"};
  return {colours[curve % colours.size()], filled[curve % filled.size()], hollow[curve % hollow.size()],
          dashes[curve % dashes.size()]};
}

/// A quoted text, set in smaller letters, down to two thirds, where it is longer than `room`, and cut where that is not
/// enough.
std::string fitted(std::string text, const std::string& markup, std::size_t room) {
  const std::size_t length = width(text), longest = room * 3 / 2;
  if (length <= room) return gnuplot::quoted(markup);
  const double scale = static_cast<double>(room) / static_cast<double>(std::min(length, longest));
  const std::string font = " font '," + short_number(font_size * scale, 3) + "'";
  if (length <= longest) return gnuplot::quoted(markup) + font;
  while (width(text) >= longest) {
    while ((text.back() & 0xc0) == 0x80) text.pop_back();
    text.pop_back();
  }
  return gnuplot::quoted(gnuplot::plain(text) + "…") + font;
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

void write_peak_values(std::ostream& script, const ChartRequest& request, const Layout& layout) {
  for (const PeakValue& value : peak_values(request, layout))
    script << "set label " << gnuplot::quoted(value.text) << " at first " << short_number(value.point.x, 15)
           << ", first " << short_number(value.point.y, 15) << " center offset 0," << (value.above ? "0.9" : "-0.9")
           << " tc rgb '" << look(value.curve).colour << "' front\n";
}

/// Crosses on the lower edge for points that have no value, each curve on its own level.
bool write_crosses(std::ostream& script, const ChartRequest& request) {
  bool any = false;
  for (std::size_t i = 0; i < request.curves.size(); ++i)
    for (const ChartPoint& point : request.curves[i].points) {
      if (point.converged || std::isfinite(point.y) || !std::isfinite(point.x)) continue;
      script << "set label '' at first " << short_number(point.x, 15) << ", graph "
             << short_number(0.025 + 0.03 * static_cast<double>(i % 6)) << " point pt 2 ps 0.7 lw 1.5 lc rgb '"
             << look(i).colour << "' front\n";
      any = true;
    }
  return any;
}

/// gnuplot keeps the blanks of an SVG's text only where two stand together.
constexpr const char* kept_blanks = "  ";

/// One line of the legend.
struct Entry {
  std::string sample;  // how it looks
  std::string markup;
  std::size_t letters;
};
std::vector<Entry> legend(const ChartRequest& request, bool crosses) {
  std::vector<Entry> entries;
  bool hollow = false;
  for (std::size_t i = 0; i < request.curves.size(); ++i) {
    const auto& [label, points] = request.curves[i];
    hollow |= std::any_of(points.begin(), points.end(), [](const auto& p) { return p.drawn() && !p.converged; });
    if (label.empty()) continue;
    const std::string& symbol = request.family.symbol;
    const std::string equals = symbol.empty() ? "" : gnuplot::symbol(symbol) + " = ";
    entries.push_back({"linespoints linetype " + std::to_string(i + 1), equals + gnuplot::plain(label) + kept_blanks,
                       width(label) + (symbol.empty() ? 0 : width(symbol) + 3)});
  }
  const std::string grey = " lw 1.5 lc rgb '#444444'";
  if (hollow) entries.push_back({"points pt 6 ps 0.7" + grey, "not converged", 13});
  if (crosses) entries.push_back({"points pt 2 ps 0.7" + grey, "no answer", 9});
  return entries;
}

/// Where the entries of a legend stand: row by row, as many side by side as the picture holds.
struct LegendGrid {
  static constexpr double sample = 54;  // room left of the text [px]
  double column = 1;                    // width of a column [px]
  std::size_t columns = 1, rows = 0;

  explicit LegendGrid(const std::vector<Entry>& entries) {
    if (entries.empty()) return;
    std::size_t longest = 1;
    for (const Entry& entry : entries) longest = std::max(longest, entry.letters);
    column = sample + 14 + 8.8 * static_cast<double>(longest);
    columns = std::clamp<std::size_t>(static_cast<std::size_t>((picture_width - 20) / column), 1, 4);
    columns = std::min(columns, entries.size());
    rows = (entries.size() + columns - 1) / columns;
  }
  double height() const { return legend_row_height * static_cast<double>(rows); }
  /// Start of an entry's text, from the left [px].
  double x(std::size_t entry) const {
    const double all = column * static_cast<double>(columns);
    return (picture_width - all) / 2 + sample + column * static_cast<double>(entry % columns);
  }
  /// Middle of its height, from the top [px].
  double y(std::size_t entry) const {
    const std::size_t row = entry / columns;
    return title_height + legend_row_height * (static_cast<double>(row) + 0.3);
  }
};

void write_plot(std::ostream& script, const ChartRequest& request, const std::vector<Entry>& entries,
                const LegendGrid& grid, double height) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < request.curves.size(); ++i) {
    const auto& points = request.curves[i].points;
    const std::string data = "data index " + std::to_string(i) + " using 1:($3 == ";
    const std::string type = "linetype " + std::to_string(i + 1) + " notitle";
    if (std::any_of(points.begin(), points.end(), [](const auto& point) { return point.joined(); })) {
      parts.push_back(data + "1 ? $2 : NaN) with lines " + type);
      parts.push_back(data + "1 && $4 == 1 ? $2 : NaN) with points " + type);
    }
    if (std::any_of(points.begin(), points.end(), [](const auto& p) { return p.drawn() && !p.converged; }))
      parts.push_back(data + "0 ? $2 : NaN) with points pt " + std::to_string(look(i).hollow) +
                      " ps 0.7 lw 1.5 lc rgb '" + std::string(look(i).colour) + "' notitle");
  }
  if (request.mark_peaks)
    for (std::size_t i = 0; i < request.curves.size(); ++i)
      if (const auto top = peak(request.curves[i])) {
        const std::string row = std::to_string(*top);
        parts.push_back("data index " + std::to_string(i) + " every ::" + row + "::" + row +
                        " using 1:2 with points pt 6 ps 1.3 lw 1.5 lc rgb '" + std::string(look(i).colour) +
                        "' notitle");
      }
  for (std::size_t i = 0; i < entries.size(); ++i)
    parts.push_back("keyentry with " + entries[i].sample + " title " + gnuplot::quoted(entries[i].markup) + " at " +
                    short_number(grid.x(i) / picture_width, 4) + "," + short_number(1 - grid.y(i) / height, 4));
  script << "plot ";
  for (std::size_t i = 0; i < parts.size(); ++i) script << (i == 0 ? "" : ", \\\n     ") << parts[i];
  script << "\n";
}

}  // namespace

std::string chart_script(const ChartRequest& request, const ChartFiles& files) {
  const auto here = [](const std::filesystem::path& file) {
    return gnuplot::quoted("./" + file.filename().string());  // never read as a pipe or a home folder
  };
  const Layout layout = lay_out(request);
  std::ostringstream script;
  script << "# Draws the pictures anew when run in this folder with gnuplot.\n"
         << "reset\nset encoding utf8\n"
         << "data = " << here(files.data) << "\n\n"
         << "set xlabel " << axis_label(request.x, 44) << "\nset ylabel " << axis_label(request.y, 34) << "\n";
  write_axis(script, 'x', layout.x);
  write_axis(script, 'y', layout.y);
  script << "set border 3 lw 1.2 lc rgb '#444444'\nset tics nomirror\n"
         << "set grid xtics ytics lw 0.8 lc rgb '#CCCCCC' dt 1\n";
  for (std::size_t i = 0; i < request.curves.size(); ++i)
    script << "set linetype " << i + 1 << " lc rgb '" << look(i).colour << "' lw 2 dt " << look(i).dash << " pt "
           << look(i).filled << " ps 0.7\n";
  script << "\n";
  if (request.mark_peaks) write_peak_values(script, request, layout);
  const std::vector<Entry> entries = legend(request, write_crosses(script, request));
  const LegendGrid grid(entries);
  const double height = std::round(plot_height + title_height + grid.height());
  const auto from_top = [&](double pixels) { return short_number(1 - pixels / height, 4); };
  script << "set label " << fitted(request.title, gnuplot::plain(request.title) + kept_blanks, 46)
         << " at screen 0.5, screen " << from_top(title_height / 2) << " center\n"
         << "set tmargin at screen " << from_top(title_height + grid.height() + 10)
         << "\nset rmargin at screen 0.955\nset key Left reverse samplen 2.2\n";

  script << "\nset terminal svg size " << picture_width << "," << height
         << " dynamic enhanced background rgb 'white' font 'sans-serif," << font_size << "'\n"
         << "set output " << here(files.svg) << "\n";
  write_plot(script, request, entries, grid, height);
  script << "\nset terminal pngcairo size " << 2 * picture_width << "," << 2 * height
         << " enhanced background rgb 'white' font 'sans-serif," << font_size
         << "' fontscale 1.5 linewidth 2 pointscale 3.2\n"
         << "set output " << here(files.png) << "\nreplot\nunset output\n";
  return script.str();
}

}  // namespace rollres
