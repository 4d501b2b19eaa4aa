#include <algorithm>
#include <cmath>

#include "core/interior/interior_summary.hpp"
#include "studies/drawing/colour_map.hpp"
#include "studies/drawing/contour_levels.hpp"
#include "studies/drawing/gnuplot.hpp"
#include "studies/figures/figure_map.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

/// A field on the section x-z, z rising, in SI; at a bond z stands twice, a hair apart.
struct SectionField {
  std::vector<double> x, z, values, bonds;
  double y = 0;
};

SectionField section_field(const FigureSource& source, std::string_view name) {
  const ContactModel solved = ContactModel(source.scene).with_answer(source.solution);
  SectionField section;
  for (const InteriorSection& part : interior_sections(solved, source.solution.fields)) {
    if (part.is_face()) continue;
    section.x = part.x;
    section.y = part.y.front();
    const Eigen::ArrayXXd field = name == "loss_density" ? part.fields.loss_density : largest_shear_strain(part.fields);
    std::vector<double> z = part.z, values(field.data(), field.data() + field.size());
    for (std::size_t row = 1; row < part.layer.size(); ++row)
      if (part.layer[row] != part.layer[row - 1]) section.bonds.push_back(part.z[row]);
    section.bonds.push_back(part.z.back());
    if (!part.on_body) {
      std::reverse(z.begin(), z.end());
      for (Eigen::Index row = 0; row < field.cols(); ++row)
        std::copy_n(&field(0, field.cols() - 1 - row), field.rows(),
                    values.begin() + static_cast<std::ptrdiff_t>(row * field.rows()));
    }
    section.z.insert(section.z.end(), z.begin(), z.end());
    section.values.insert(section.values.end(), values.begin(), values.end());
  }
  const double hair = 1e-6 * (section.z.back() - section.z.front());
  for (std::size_t row = 1; row < section.z.size(); ++row)
    section.z[row] = std::max(section.z[row], section.z[row - 1] + hair);
  return section;
}

}  // namespace

PictureText section_map(const Figure& figure, const FigureSource& source, const ChartFiles& files) {
  const bool loss = figure.name == "loss_density";
  const SectionField section = section_field(source, figure.name);
  const ScaledUnit length = scaled_unit("m", std::max(std::abs(section.x.front()), std::abs(section.x.back())));
  const ScaledUnit unit = figure_unit(loss ? "W/m3" : "1", largest(section.values));
  PlaneField field;
  for (const double x : section.x) field.x.push_back(x / length.factor);
  for (const double z : section.z) field.y.push_back(z / length.factor);
  for (const double value : section.values) field.values.push_back(value / unit.factor);
  const ColourBands bands(0, *max_element(field.values));
  const std::vector<ContourLoop> loops = contour_loops(field, bands.levels, -std::numeric_limits<double>::infinity());

  const Span x{field.x.front(), field.x.back()}, z{field.y.front(), field.y.back()};
  PictureBuilder picture(figure.title, files, {.name = "along the motion", .symbol = "x", .unit = length.name}, x,
                         {.name = "height", .symbol = "z", .unit = length.name}, z);
  picture.script() << "set border 15\nunset grid\nset tics out\n";
  const std::string symbol = loss ? "D" : "γ";
  write_colours(picture.script(), bands,
                gnuplot::symbol(symbol) + (unit.name.empty() ? "" : "  [" + typeset_unit(unit.name) + "]"));
  picture.script() << "set object rectangle from graph 0, graph 0 to graph 1, graph 1 fillcolor palette cb "
                   << short_number(bands.inside(bands.levels.front(), true)) << " fillstyle solid noborder behind\n";
  const std::string columns = with_unit("x", length) + ", " + with_unit("z", length);
  for (const ContourLoop& loop : loops) {
    const std::string inside = short_number(bands.inside(loop.level, loop.higher_inside));
    const std::string block =
        picture.add("loop", columns + "; level " + short_number(loop.level) + ", inside about " + inside, closed(loop));
    picture.plot(block + " using 1:2 with filledcurves closed fillcolor palette cb " + inside + " notitle");
    picture.plot(block + " using 1:2 with lines lc rgb '#80000000' lw 0.7 notitle");
  }
  write_contour_levels(picture.script(), loops, x, z);
  std::vector<DataRow> bonds;
  for (const double bond : section.bonds) {
    if (bond <= section.z.front() || bond >= section.z.back()) continue;
    bonds.push_back({x.lowest, bond / length.factor});
    bonds.push_back({x.highest, bond / length.factor});
    bonds.emplace_back();
  }
  if (!bonds.empty()) {
    constexpr const char* look = "lines lc rgb '#B0B0B0' lw 2 dt (5,3)";
    picture.plot(picture.add("bonds", columns, bonds) + " using 1:2 with " + look + " notitle");
    picture.explain(LegendEntry::plain(look, "bonds of layers"));
  }
  constexpr const char* look = "lines lc rgb '#D55E00' lw 5";
  const std::vector<DataRow> contact{{source.solution.trailing_edge / length.factor, 0.0},
                                     {source.solution.leading_edge / length.factor, 0.0}};
  picture.plot(picture.add("contact", columns, contact) + " using 1:2 with " + look + " notitle");
  picture.explain(LegendEntry::plain(look, "contact"));
  // To scale, unless that were too low for the numbers beside it.
  constexpr double right = 424, lower = 88, above = 10, lowest = 190;
  const double left = left_edge_for(z);
  const double to_scale = (right - left) * (z.highest - z.lowest) / (x.highest - x.lowest);
  const double height = std::max(to_scale, lowest);
  std::string subtitle = dimension_of(source.scene.indenter) == 3 ? "at y = " + readable(section.y, "m") : "";
  if (height > to_scale)
    subtitle += (subtitle.empty() ? "" : ", ") + ("heights stretched " + short_number(height / to_scale, 2) + " times");
  return picture.finished(std::string(figure.title), {.height = std::round(above + height + lower),
                                                      .left = left,
                                                      .right = right,
                                                      .bottom = lower,
                                                      .subtitle = subtitle});
}

}  // namespace rollres
