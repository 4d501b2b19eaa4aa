#include "studies/drawing/bar_chart.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "studies/drawing/chart_frame.hpp"
#include "studies/drawing/gnuplot.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

constexpr std::array<const char*, 3> colours{"#0072B2", "#E69F00", "#009E73"};

std::size_t series_of(const BarChart& chart) { return std::max<std::size_t>(1, chart.series.size()); }

std::string number(double value) { return std::isfinite(value) ? short_number(value, 12) : "NaN"; }

/// One block for each series: height, value, error.
std::string data_of(const BarChart& chart) {
  std::ostringstream data;
  data << "# " << chart.title << "\n# column 1: place from the top\n# column 2: " << chart.axis.name
       << "\n# column 3: its error\n";
  for (std::size_t s = 0; s < series_of(chart); ++s) {
    if (s > 0) data << "\n\n";
    if (!chart.series.empty()) data << "# " << chart.series[s] << "\n";
    const double shift = (static_cast<double>(s) + 0.5) / static_cast<double>(series_of(chart)) - 0.5;
    for (std::size_t i = 0; i < chart.bars.size(); ++i) {
      const BarValue& bar = chart.bars[i].values.at(s);
      data << number(static_cast<double>(i + 1) + 0.7 * shift) << " " << number(bar.value) << " " << number(bar.error)
           << " # " << chart.bars[i].name << "\n";
    }
  }
  return data.str();
}

Span span_of(const BarChart& chart) {
  Span span;
  span.include(0);
  for (const Bar& bar : chart.bars)
    for (const BarValue& value : bar.values) {
      if (!std::isfinite(value.value)) continue;
      const double error = std::isfinite(value.error) ? value.error : 0;
      span.include(value.value - error);
      span.include(value.value + error);
    }
  const bool positive_only = span.lowest >= 0;
  span.widen(positive_only ? 0 : 0.05, span.highest <= 0 ? 0 : 0.05);
  return span;
}

std::string script_of(const BarChart& chart, const ChartFiles& files) {
  std::ostringstream script;
  const Span heights{0.4, static_cast<double>(chart.bars.size()) + 0.6};
  const Span span = span_of(chart);
  write_axes(script, files, chart.axis, span, {}, heights);
  script << "set yrange [" << number(heights.highest) << ":" << number(heights.lowest) << "]\nset ytics (";
  std::size_t longest = 0;
  for (std::size_t i = 0; i < chart.bars.size(); ++i) {
    const Bar& bar = chart.bars[i];
    const std::string markup =
        gnuplot::plain(bar.name) + (bar.symbol.empty() ? "" : "  " + gnuplot::symbol(bar.symbol));
    script << (i == 0 ? "" : ", ") << gnuplot::quoted(markup) << " " << i + 1;
    longest = std::max(longest, width(bar.name) + 2 + width(bar.symbol));
  }
  constexpr double letter = 8.6 / 560;  // as a fraction of the picture's width
  constexpr double few_ticks = 2.9;     // bars leave their axis little room
  script << ")\nset lmargin at screen " << short_number(std::min(0.5, 0.05 + letter * static_cast<double>(longest)), 3)
         << "\nset xtics " << short_number(even_step(span.highest - span.lowest, few_ticks))
         << "\nunset ylabel\nset grid noytics\nset arrow from 0, graph 0 to 0, graph 1 nohead lw 1.2 lc rgb "
            "'#444444' front\nset style fill solid 0.85 noborder\n\n";
  const double half = 0.33 / static_cast<double>(series_of(chart));
  std::vector<std::string> plots;
  std::vector<LegendEntry> legend;
  for (std::size_t s = 0; s < series_of(chart); ++s) {
    const std::string index = "data index " + std::to_string(s) + " using ";
    const std::string colour = std::string(" lc rgb '") + colours[s % colours.size()] + "'";
    plots.push_back(index + "(0.5*$2):1:(0):2:($1-" + number(half) + "):($1+" + number(half) + ") with boxxyerror" +
                    colour + " notitle");
    plots.push_back(index + "2:1:3 with xerrorbars pt -1 lw 1.5 lc rgb '#222222' notitle");
    if (!chart.series.empty()) legend.push_back(LegendEntry::plain("boxes" + colour, chart.series[s]));
  }
  write_pictures(script, files, chart.title, plots, legend);
  return script.str();
}

}  // namespace

ChartFiles draw_bar_chart(const BarChart& chart, const std::filesystem::path& name, const std::string& gnuplot) {
  ChartFiles files = chart_files(name);
  bool any = false;
  for (const Bar& bar : chart.bars)
    for (const BarValue& value : bar.values) any |= std::isfinite(value.value);
  if (!any) throw std::invalid_argument(chart.title + ": nothing to draw, no bar has a value");
  draw_pictures(files, data_of(chart), script_of(chart, files), {chart.title, "bars of " + chart.axis.name}, gnuplot);
  return files;
}

}  // namespace rollres
