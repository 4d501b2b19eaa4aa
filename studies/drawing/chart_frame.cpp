#include "studies/drawing/chart_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "studies/drawing/gnuplot.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

// Sizes in pixels of the SVG; the PNG has twice as many.
constexpr double picture_width = 560, legend_row_height = 23, font_size = 17;

/// A file in the script's own folder: never read as a pipe or a home folder.
std::string here(const std::filesystem::path& file) { return gnuplot::quoted("./" + file.filename().string()); }

/// A quoted text, set in smaller letters, down to two thirds, where it is longer than `room`, and cut where that is not
/// enough.
std::string fitted(std::string text, const std::string& markup, std::size_t room, double size = font_size) {
  const std::size_t length = width(text), longest = room * 3 / 2;
  if (length <= room)
    return gnuplot::quoted(markup) + (size == font_size ? "" : " font '," + short_number(size, 3) + "'");
  const double scale = static_cast<double>(room) / static_cast<double>(std::min(length, longest));
  const std::string font = " font '," + short_number(size * scale, 3) + "'";
  if (length <= longest) return gnuplot::quoted(markup) + font;
  while (width(text) >= longest) {
    while ((text.back() & 0xc0) == 0x80) text.pop_back();
    text.pop_back();
  }
  return gnuplot::quoted(gnuplot::plain(text) + "…") + font;
}

/// A text broken between words into lines of at most `room` letters, where words allow it.
std::vector<std::string> broken(std::string_view text, std::size_t room) {
  std::vector<std::string> lines(1);
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find(' ', start), text.size());
    const std::string word(text.substr(start, end - start));
    if (!lines.back().empty() && width(lines.back()) + 1 + width(word) > room) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
    start = end + 1;
  }
  return lines;
}

/// Title and subtitle: their lines, and the places of these from the top [px].
class Heading {
 public:
  Heading(const std::string& title, const std::string& subtitle) {
    constexpr std::size_t room = 48, most_lines = 2;
    std::vector<std::string> lines = broken(title, room);
    if (lines.size() > most_lines) {  // the first half, and the rest in smaller letters
      lines = broken(title, width(title) / most_lines + room / 4);
      for (; lines.size() > most_lines; lines.pop_back()) lines[lines.size() - 2] += " " + lines.back();
    }
    if (lines.size() == 2 && 4 * width(lines.back()) < width(lines.front()))  // one word alone
      lines = broken(title, 2 * width(title) / 3);
    std::size_t longest = room;
    for (const std::string& line : lines) longest = std::max(longest, std::min(width(line), 3 * room / 2));
    const double size = font_size * static_cast<double>(room) / static_cast<double>(longest);
    for (const std::string& line : lines) add(line, longest, size, 24);
    constexpr std::size_t wide = 60, widest = 90;  // letters of a subtitle: in full size, in one line
    for (const std::string& line : broken(subtitle, width(subtitle) > widest ? wide : widest))
      if (!line.empty()) add(line, wide, 14, 20);
    height_ += 6;
  }

  double height() const { return height_; }
  template <class FromTop>
  void write(std::ostream& script, const FromTop& from_top) const {
    for (const auto& [text, place] : lines_)
      script << "set label " << text << " at screen 0.5, screen " << from_top(place) << " center\n";
  }

 private:
  void add(const std::string& text, std::size_t room, double size, double step) {
    lines_.emplace_back(fitted(text, gnuplot::plain(text) + kept_blanks, room, size), height_ + step / 2);
    height_ += step;
  }

  double height_ = 6;
  std::vector<std::pair<std::string, double>> lines_;
};

std::string axis_label(const ChartAxis& axis, std::size_t room) {
  std::string text = axis.name, markup = gnuplot::plain(axis.name);
  if (!axis.symbol.empty()) {
    text += "  " + axis.symbol;
    markup += kept_blanks + gnuplot::symbol(axis.symbol);
  }
  if (!axis.unit.empty()) {
    text += "  [" + axis.unit + "]";
    markup += "  [" + gnuplot::plain(axis.unit) + "]";
  }
  return fitted(text, markup, room);
}

/// Numbers for a logarithmic axis so short that powers of ten alone would leave it with hardly a number; else empty.
std::vector<double> ticks(const Span& span) {
  constexpr double rounding = 1e-9;
  std::vector<double> numbers;
  if (!span.logarithmic) return numbers;
  const double powers_of_ten = std::floor(std::log10(span.highest)) - std::ceil(std::log10(span.lowest)) + 1;
  if (span.decades() >= 1.7 && powers_of_ten >= 2) return numbers;
  if (span.decades() < 0.5) {
    const double step = even_step(span.highest - span.lowest);
    const double last = std::floor(span.highest / step + rounding);
    for (double tick = std::ceil(span.lowest / step - rounding); tick <= last; ++tick) numbers.push_back(tick * step);
    return numbers;
  }
  for (double decade = std::floor(std::log10(span.lowest)); decade <= std::log10(span.highest); ++decade)
    for (const int step : {1, 2, 3, 5, 7})
      if (span.decades() < 1.2 || (step != 3 && step != 7)) numbers.push_back(step * std::pow(10.0, decade));
  return numbers;
}

void write_axis(std::ostream& script, char name, const Span& span) {
  script << "set " << name << "range [" << short_number(span.lowest, 15) << ":" << short_number(span.highest, 15)
         << "]\n";
  if (!span.logarithmic) {
    script << "set format " << name << " '%h'\n";  // gnuplot's own begins with a blank
    return;
  }
  script << "set logscale " << name << "\n";
  const bool plain_numbers = span.lowest >= 0.9e-4 && span.highest <= 1.1e5;
  const std::vector<double> numbers = ticks(span);
  script << "set format " << name << (plain_numbers || !numbers.empty() ? " '%g'\n" : " '10^{%L}'\n");
  if (numbers.empty()) return;
  script << "set " << name << "tics (" << joined(numbers, ", ", [](double tick) { return short_number(tick); })
         << ")\n";
}

/// The step that gnuplot chooses for a linear axis: it divides its length into four to ten parts.
double usual_step(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length))), parts = length / power;
  return power * (parts < 2 ? 0.2 : parts < 5 ? 0.5 : 1);
}

/// Width of the widest number of an axis whose linear numbers are so far apart [px].
double widest_number(const Span& span, double step) {
  std::vector<double> numbers = ticks(span);
  if (!span.logarithmic)
    for (double i = std::ceil(span.lowest / step); i <= std::floor(span.highest / step); ++i)
      numbers.push_back(i * step);
  else if (numbers.empty())
    for (const double end : {std::ceil(std::log10(span.lowest)), std::floor(std::log10(span.highest))})
      numbers.push_back(std::pow(10.0, end));
  constexpr double digit = 0.64 * font_size, sign = 0.36 * font_size, point = 0.32 * font_size;
  double widest = 0;
  for (const double number : numbers) {
    double wide = 0;
    for (const char letter : short_number(number)) wide += letter == '-' ? sign : letter == '.' ? point : digit;
    widest = std::max(widest, wide);
  }
  return widest;
}

/// From the middle of a y axis's label, left of its numbers, to the axis [px].
double label_to_plot(const Span& y) {
  constexpr double half_label_and_gaps = 40;
  return half_label_and_gaps + widest_number(y, usual_step(std::abs(y.highest - y.lowest)));
}

/// Numbers farther apart than gnuplot's own where these would run into each other.
void space_numbers(std::ostream& script, const Span& x, double plot_width) {
  if (x.logarithmic) return;
  constexpr double gap = 8;  // between two numbers [px]
  const double length = std::abs(x.highest - x.lowest), usual = usual_step(length);
  const auto fits = [&](double step) { return widest_number(x, step) + gap < step / length * plot_width; };
  if (fits(usual)) return;
  for (const double fewest : {4.0, 2.5, 1.5})
    if (const double step = even_step(length, fewest); fits(step)) {
      script << "set xtics " << short_number(step) << "\n";
      return;
    }
}

/// Where entries of a legend stand: row by row, as many side by side as the picture holds.
struct LegendGrid {
  static constexpr double sample = 54;  // room left of the text [px]
  double column = 1;                    // width of a column [px]
  std::size_t columns = 1, rows = 0;

  double top;  // above it [px]

  LegendGrid(std::span<const LegendEntry> entries, double above) : top(above) {
    constexpr double letter = 9.2, wide_letter = 0.45 * letter;  // what an m takes more
    double longest = letter;
    for (const LegendEntry& entry : entries)
      longest = std::max(longest, letter * static_cast<double>(entry.letters) +
                                      wide_letter * static_cast<double>(std::ranges::count(entry.markup, 'm')));
    column = sample + 11 + longest;
    columns = std::clamp<std::size_t>(static_cast<std::size_t>((picture_width - 4) / column), 1, 5);
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
    return top + legend_row_height * (static_cast<double>(row) + 0.3);
  }
};

/// A legend: its entries in grids one below the other, of which each starts with an entry that asks for a new row.
class Legend {
 public:
  Legend(const std::vector<LegendEntry>& entries, double above) {
    const std::span<const LegendEntry> all(entries);
    for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
      for (end = begin + 1; end < all.size() && !all[end].new_row;) ++end;
      const LegendGrid grid(all.subspan(begin, end - begin), above + height_);
      for (std::size_t i = 0; i < end - begin; ++i) places_.push_back({grid.x(i), grid.y(i)});
      height_ += grid.height();
    }
  }
  double height() const { return height_; }
  /// Start of an entry's text from the left, and the middle of its height from the top [px].
  const std::array<double, 2>& place(std::size_t entry) const { return places_[entry]; }

 private:
  double height_ = 0;
  std::vector<std::array<double, 2>> places_;
};

}  // namespace

double even_step(double length, double fewest) {
  const double power = std::pow(10.0, std::floor(std::log10(length / fewest)));
  for (const int step : {5, 2})
    if (length / (step * power) >= fewest) return step * power;
  return power;
}

std::string_view curve_colour(std::size_t curve) {
  constexpr std::array<std::string_view, 7> colours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                    "#B57E00", "#3C93C7", "#000000"};
  return colours[curve % colours.size()];
}

LegendEntry LegendEntry::plain(std::string sample, std::string_view text) {
  return {std::move(sample), gnuplot::plain(text) + kept_blanks, width(text)};
}

void write_axes(std::ostream& script, const ChartFiles& files, const ChartAxis& x, const Span& x_span,
                const ChartAxis& y, const Span& y_span) {
  script << "# Draws the pictures anew when run in this folder with gnuplot.\n"
         << "reset\nset encoding utf8\n"
         << "data = " << here(files.data) << "\n\n"
         << "set xlabel " << axis_label(x, 44) << "\nset ylabel " << axis_label(y, 34) << "\n";
  write_axis(script, 'x', x_span);
  write_axis(script, 'y', y_span);
  script << "set border 3 lw 1.2 lc rgb '#444444'\nset tics nomirror\n"
         << "set grid xtics ytics lw 0.8 lc rgb '#CCCCCC' dt 1\n";
}

void write_pictures(std::ostream& script, const ChartFiles& files, const std::string& title,
                    std::vector<std::string> plots, const std::vector<LegendEntry>& entries,
                    const PictureShape& shape) {
  const Heading heading(title, shape.subtitle);
  const Legend legend(entries, heading.height());
  const double height = std::round(shape.height + heading.height() + legend.height());
  const auto from_top = [&](double pixels) { return short_number(1 - pixels / height, 4); };
  heading.write(script, from_top);
  script << "set tmargin at screen " << from_top(heading.height() + legend.height() + shape.gap)
         << "\nset rmargin at screen " << short_number(shape.right / picture_width, 3) << "\n";
  if (shape.left > 0) script << "set lmargin at screen " << short_number(shape.left / picture_width, 4) << "\n";
  if (shape.bottom > 0) script << "set bmargin at screen " << short_number(shape.bottom / height, 4) << "\n";
  script << "set key Left reverse samplen 2.2\n";
  for (std::size_t i = 0; i < entries.size(); ++i)
    plots.push_back("keyentry with " + entries[i].sample + " title " + gnuplot::quoted(entries[i].markup) + " at " +
                    short_number(legend.place(i)[0] / picture_width, 4) + "," + from_top(legend.place(i)[1]));
  const std::string plot = (shape.surface ? "splot " : "plot ") + joined(plots, ", \\\n     ");

  script << "\nset terminal svg size " << picture_width << "," << height
         << " dynamic enhanced background rgb 'white' font 'sans-serif," << font_size << "'\n"
         << "set output " << here(files.svg) << "\n"
         << plot << "\n"
         << "\nset terminal pngcairo size " << 2 * picture_width << "," << 2 * height
         << " enhanced background rgb 'white' font 'sans-serif," << font_size
         << "' fontscale 1.5 linewidth 2 pointscale 3.2\n"
         << "set output " << here(files.png) << "\nreplot\nunset output\n";
}

double left_edge_for(const Span& y) {
  constexpr double least = 84, before = 14;  // left of the middle of the label [px]
  return std::max(least, std::ceil(before + label_to_plot(y)));
}

std::vector<DataRow> closed(const ContourLoop& loop) {
  std::vector<DataRow> rows;
  for (const auto& [x, y] : loop.points) rows.push_back({x, y});
  rows.push_back(rows.front());
  return rows;
}

PictureBuilder::PictureBuilder(std::string_view title, const ChartFiles& files, const ChartAxis& x, const Span& x_span,
                               const ChartAxis& y, const Span& y_span)
    : files_(files),
      x_span_(x_span),
      y_span_(y_span),
      y_label_(y.name.empty() ? "" : axis_label(y, 34)),
      data_("# " + std::string(title) + '\n') {
  write_axes(script_, files, x, x_span, y, y_span);
}

std::string PictureBuilder::add(std::string_view name, std::string_view columns, const std::vector<DataRow>& rows,
                                int digits) {
  if (blocks_ > 0) data_ += "\n\n";
  data_ += "# " + std::string(name) + ": " + std::string(columns) + '\n';
  for (const DataRow& row : rows)
    data_ += joined(row, " ", [&](double value) { return short_number(value, digits); }) + '\n';
  return "data index " + std::to_string(blocks_++);
}

std::string PictureBuilder::add(std::string_view name, std::string_view columns,
                                const std::vector<ContourLoop>& loops) {
  std::vector<DataRow> rows;
  for (const ContourLoop& loop : loops) {
    if (!rows.empty()) rows.emplace_back();
    for (DataRow& row : closed(loop)) rows.push_back(std::move(row));
  }
  return add(name, columns, rows);
}

PictureText PictureBuilder::finished(const std::string& title, const PictureShape& shape) {
  if (shape.left > 0 && !shape.surface && !y_label_.empty()) {  // gnuplot's own label may cross the picture's edge
    script_ << "unset ylabel\nset label " << y_label_ << " at screen "
            << short_number((shape.left - label_to_plot(y_span_)) / picture_width, 4) << ", graph 0.5 center rotate\n";
    space_numbers(script_, x_span_, shape.right - shape.left);
  }
  write_pictures(script_, files_, title, plots_, legend_, shape);
  return {script_.str(), data_};
}

}  // namespace rollres
