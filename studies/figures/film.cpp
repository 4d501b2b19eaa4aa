#include "studies/figures/film.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "studies/drawing/chart_frame.hpp"
#include "studies/drawing/gnuplot.hpp"
#include "studies/figures/figure_map.hpp"
#include "studies/text/files.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

constexpr int blocks_before = 1, blocks_of_frame = 3;  // the chart; what moves, stick, slip
constexpr double hundredths = 100;                     // in which the format counts its time
constexpr int film_width = 640;                        // [px]

/// What all pictures of a film share, and its data.
class Film {
 public:
  explicit Film(const FilmRequest& request) : request_(request), frames_(request.frames) {
    double reach = 0;
    for (const FilmFrame& frame : frames_)
      for (const double edge : {frame.solution.leading_edge, frame.solution.trailing_edge})
        reach = std::max(reach, std::abs(edge));
    length_ = scaled_unit("m", reach);
    sphere_ = dimension_of(frames_.front().scene.indenter) == 3;
    for (const FilmFrame& frame : frames_) {
      const SurfaceFields& fields = frame.solution.fields;
      x_.include(frame.solution.trailing_edge / length_.factor);
      x_.include(frame.solution.leading_edge / length_.factor);
      if (sphere_) across_ = std::max(across_, frame.solution.half_width / length_.factor);
      largest_ = std::max({largest_, sphere_ ? 0.0 : largest(fields.pressure), largest(fields.shear_x)});
    }
    traction_ = figure_unit("Pa", largest_ > 0 ? largest_ : 1);
    x_.widen(0.12, 0.12);
    block("chart", "where, what");
    for (const FilmFrame& frame : frames_) row({frame.point.x, frame.point.y});
    for (const FilmFrame& frame : frames_) sphere_ ? add_map(frame) : add_lines(frame);
  }

  std::string data() const { return data_.str(); }

  std::string script(const FilmFiles& files) const {
    std::ostringstream script;
    script << "# Draws the film anew when run in this folder with gnuplot.\nreset\nset encoding utf8\n"
           << "data = " << gnuplot::quoted(files.data.filename().string()) << "\n"
           << "frames = " << frames_.size() << "\narray words[frames]\n";
    for (std::size_t i = 0; i < frames_.size(); ++i)
      script << "words[" << i + 1 << "] = " << gnuplot::quoted(gnuplot::plain(words_of(frames_[i]))) << "\n";
    const int height = sphere_ ? 900 : 720;
    script << "set terminal gif animate delay " << std::lround(hundredths * request_.seconds) << " loop 0 size "
           << film_width << "," << height << " enhanced background rgb 'white' font 'DejaVu Sans,11'\n"
           << "set output " << gnuplot::quoted(files.film.filename().string()) << "\n"
           << "set border 3 lw 1.2 lc rgb '#444444'\nset tics nomirror\nset grid xtics ytics lc rgb '#CCCCCC'\n"
           << "do for [i=1:frames] {\nfirst = " << blocks_before << " + " << blocks_of_frame << " * (i - 1)\n"
           << "set multiplot\n";
    int line = 0;
    const auto above = [&](const std::string& text) {
      ++line;
      script << "set label " << line << " " << text << " at screen 0.5, screen "
             << short_number(1 - line * 20.0 / height, 4) << " center\n";
    };
    for (const std::string& words : lines_of(request_.title)) above(gnuplot::quoted(gnuplot::plain(words)));
    if (!request_.subtitle.empty()) above(gnuplot::quoted(gnuplot::plain(request_.subtitle)));
    above("words[i]");
    const double top = 1 - 142.0 / height, bottom = sphere_ ? 0.40 : 0.46;
    double side = 0.41;  // half-width of the picture
    if (sphere_)
      side = std::min(side, 0.5 * (top - bottom) * height / film_width * (x_.highest - x_.lowest) / (2.5 * across_));
    script << "set lmargin at screen " << short_number(0.55 - side, 4) << "\nset rmargin at screen "
           << short_number(0.55 + side, 4) << "\nset tmargin at screen " << short_number(top, 4)
           << "\nset bmargin at screen " << bottom << "\nset key at screen 0.55, screen "
           << short_number(1 - (20.0 * line + 14) / height, 4) << " center top horizontal samplen 2\n";
    sphere_ ? write_map(script) : write_lines(script);
    script << "unset key\nunset label\nunset arrow\nset size noratio\nset lmargin at screen 0.14\n"
           << "set rmargin at screen 0.96\nset tmargin at screen " << (sphere_ ? "0.32" : "0.36")
           << "\nset bmargin at screen 0.09\n";
    write_chart(script);
    return script.str() + "unset multiplot\n}\nunset output\n";
  }

 private:
  /// A title as lines that the picture holds.
  static std::vector<std::string> lines_of(const std::string& title) {
    constexpr std::size_t longest = 70;
    std::vector<std::string> lines(1);
    std::istringstream words(title);
    for (std::string word; words >> word;) {
      if (!lines.back().empty() && width(lines.back()) + 1 + width(word) > longest) lines.emplace_back();
      lines.back() += (lines.back().empty() ? "" : " ") + word;
    }
    return lines;
  }

  std::string words_of(const FilmFrame& frame) const {
    return frame.words + ": " + request_.y.name + " " + short_number(frame.point.y, 4) +
           (request_.y.unit.empty() ? "" : " " + request_.y.unit);
  }

  void block(const std::string& name, const std::string& columns) {
    if (blocks_++ > 0) data_ << "\n\n";
    data_ << "# " << name << ": " << columns << '\n';
  }
  void row(const DataRow& numbers) {
    data_ << joined(numbers, " ", [](double value) { return std::isfinite(value) ? short_number(value, 6) : "NaN"; })
          << '\n';
  }

  void add_lines(const FilmFrame& frame) {
    const SurfaceFields& fields = frame.solution.fields;
    const RollingSolution& s = frame.solution;
    const double friction = frame.scene.friction_coefficient;
    std::vector<DataRow> rows;
    const auto add = [&](double x, double pressure, double shear) {
      const double p = pressure / traction_.factor, tau = shear / traction_.factor;
      rows.push_back({x / length_.factor, p, tau, friction * p, -friction * p});
    };
    for (int i = 0; i < fields.grid.columns; ++i) {
      const auto node = static_cast<std::size_t>(i);
      if (fields.zone[node] == Zone::free) continue;
      add(fields.grid.x(i), fields.pressure[node], fields.shear_x.empty() ? 0 : fields.shear_x[node]);
      lowest_ = std::min({lowest_, rows.back()[2], rows.back()[4]});
    }
    if (exact_edges(s)) {
      for (const double edge : {s.trailing_edge, s.leading_edge}) add(edge, 0, 0);
    } else if (!rows.empty()) {  // where the cells end
      const double cell = fields.grid.spacing_x, first = rows.front()[0] * length_.factor,
                   last = rows.back()[0] * length_.factor;
      for (const double edge : {first - 0.5 * cell, last + 0.5 * cell}) add(edge, 0, 0);
    }
    for (const double end : {x_.lowest, x_.highest}) add(end * length_.factor, 0, 0);
    std::sort(rows.begin(), rows.end());
    block(frame.words, "x [" + length_.name + "], p, tau_xz, mu p, -mu p [" + traction_.name + "]");
    for (const DataRow& one : rows) row(one);
    for (const Zone zone : {Zone::stick, Zone::slip}) {
      block(std::string(name_of(zone)), "from, to");
      const auto runs = zone_runs(zone, fields, s);
      for (const auto& [from, to] : runs) row({from / length_.factor, to / length_.factor});
      if (runs.empty()) row({std::nan(""), std::nan("")});
    }
  }

  void add_map(const FilmFrame& frame) {
    constexpr int most = 20;
    const SurfaceFields& fields = frame.solution.fields;
    const int step = std::max(1, std::max(fields.grid.columns, fields.grid.rows) / most);
    block(frame.words, "nothing");
    row({std::nan(""), std::nan("")});
    for (const Zone zone : {Zone::stick, Zone::slip}) {
      block(std::string(name_of(zone)), "x, y [" + length_.name + "], tau_xz, tau_yz [" + traction_.name + "]");
      bool any = false;
      for (int j = (fields.grid.rows / 2) % step; j < fields.grid.rows; j += step)
        for (int i = 0; i < fields.grid.columns; i += step) {
          const auto node = static_cast<std::size_t>(fields.grid.index(i, j));
          if (fields.zone[node] != zone) continue;
          row({fields.grid.x(i) / length_.factor, fields.grid.y(j) / length_.factor,
               fields.shear_x[node] / traction_.factor, fields.shear_y[node] / traction_.factor});
          any = true;
        }
      if (!any) row({std::nan(""), std::nan(""), std::nan(""), std::nan("")});
    }
  }

  void write_lines(std::ostream& script) const {
    const double top = largest_ / traction_.factor, range = top - lowest_;
    const double above = lowest_ - 0.05 * range, below = lowest_ - 0.11 * range;
    script << "unset logscale\nset format '%h'\nset xrange [" << short_number(x_.lowest, 6) << ":"
           << short_number(x_.highest, 6) << "]\n"
           << "set yrange [" << short_number(lowest_ - 0.16 * range, 6) << ":" << short_number(top + 0.05 * range, 6)
           << "]\nset xlabel 'along the motion  {/:Italic x}  [" << length_.name
           << "]'\nset ylabel 'traction on the layer  [" << traction_.name << "]'\n"
           << "set arrow 1 from graph 0, first 0 to graph 1, first 0 nohead lc rgb '#444444' back\n"
           << "above = " << short_number(above, 6) << "\nbelow = " << short_number(below, 6) << "\n"
           << "plot data index first using 1:2 with lines lw 2.5 dt (12,4) lc rgb '#D55E00' title 'pressure', \\\n"
           << "  data index first using 1:3 with lines lw 2.5 lc rgb '#0072B2' title 'shear', \\\n"
           << "  data index first using 1:4 with lines lw 1.5 dt (2,3) lc rgb '#444444' title 'bound by friction', \\\n"
           << "  data index first using 1:5 with lines lw 1.5 dt (2,3) lc rgb '#444444' notitle, \\\n"
           << boxes("first + 1", "'#0072B2' fs solid 0.45 border", "stick") << ", \\\n"
           << boxes("first + 2", "'#D55E00' fs pattern 4 border", "slip") << "\n";
  }

  static std::string boxes(const std::string& index, const std::string& look, const std::string& name) {
    return "  data index (" + index +
           ") using (($1+$2)/2):((above+below)/2):1:2:(below):(above) with boxxyerror lc rgb " + look + " title '" +
           name + "'";
  }

  void write_map(std::ostream& script) const {
    const double arrow = 0.09 * (x_.highest - x_.lowest) / (largest_ > 0 ? largest_ / traction_.factor : 1);
    script << "unset logscale\nset format '%h'\nset size ratio -1\nset xrange [" << short_number(x_.lowest, 6) << ":"
           << short_number(x_.highest, 6) << "]\nset yrange [" << short_number(-1.25 * across_, 6) << ":"
           << short_number(1.25 * across_, 6) << "]\nset xlabel 'along the motion  {/:Italic x}  [" << length_.name
           << "]'\nset ylabel 'across  {/:Italic y}  [" << length_.name << "]'\n"
           << "# Length of an arrow for 1 " << traction_.name << ".\nlength = " << short_number(arrow, 6) << "\n"
           << "plot " << points("first + 1", "pt 7 ps 0.5 lc rgb '#0072B2'", "stick") << ", \\\n"
           << points("first + 2", "pt 8 ps 0.8 lc rgb '#D55E00'", "slip") << ", \\\n"
           << arrows("first + 1", "'#0072B2'", "friction on the layer") << ", \\\n"
           << arrows("first + 2", "'#D55E00'", "") << "\n";
  }
  static std::string points(const std::string& index, const std::string& look, const std::string& name) {
    return "  data index (" + index + ") using 1:2 with points " + look + " title '" + name + "'";
  }
  static std::string arrows(const std::string& index, const std::string& colour, const std::string& name) {
    return "  data index (" + index +
           ") using 1:2:(length * $3):(length * $4) with vectors filled head lw 1.2 lc rgb " + colour +
           (name.empty() ? " notitle" : " title '" + name + "'");
  }

  void write_chart(std::ostream& script) const {
    ChartRequest chart{.title = "", .x = request_.x, .y = request_.y, .curves = {{"", {}}}, .mark_peaks = false};
    for (const FilmFrame& frame : frames_) chart.curves.front().points.push_back(frame.point);
    const ChartSpans spans = chart_spans(chart);
    const auto axis = [&](char name, const ChartAxis& shown, const Span& span) {
      script << "set " << name << "label " << gnuplot::quoted(gnuplot::plain(shown.name + unit_in_brackets(shown.unit)))
             << "\nset " << name << "range [" << short_number(span.lowest, 8) << ":" << short_number(span.highest, 8)
             << "]\n"
             << (span.logarithmic ? "set logscale " : "unset logscale ") << name << "\nset format " << name
             << (span.logarithmic ? " '%g'\n" : " '%h'\n");
    };
    axis('x', request_.x, spans.x);
    axis('y', request_.y, spans.y);
    script << "plot data index 0 using 1:2 with lines lw 2 lc rgb '#0072B2' notitle, \\\n"
           << "  data index 0 every ::(i-1)::(i-1) using 1:2 with points pt 7 ps 1.6 lc rgb '#D55E00' notitle\n";
  }

  const FilmRequest& request_;
  const std::vector<FilmFrame>& frames_;
  bool sphere_ = false;
  ScaledUnit length_, traction_;
  Span x_;
  double across_ = 0, largest_ = 0, lowest_ = 0;  // half-width of the map; tractions [Pa], [unit]
  int blocks_ = 0;
  std::ostringstream data_;
};

}  // namespace

FilmFiles draw_film(const FilmRequest& request, const std::filesystem::path& name) {
  refuse_other_kind(name, {".gif", ".gp", ".dat"});
  const std::string suffix = name.extension().string();
  const bool ours = suffix == ".gif" || suffix == ".gp" || suffix == ".dat";
  const ChartFiles files = chart_files(ours ? std::filesystem::path(name).replace_extension() : name);
  FilmFiles film{files.script, files.script, files.data};
  film.film.replace_extension(".gif");
  if (const auto folder = film.film.parent_path(); !folder.empty()) make_directory(folder);
  const Film made(request);
  write_file(film.data, made.data());
  write_file(film.script, made.script(film));
  run_script(film.script, {film.film});
  return film;
}

}  // namespace rollres
