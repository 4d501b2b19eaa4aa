#include "studies/figures/figure_map.hpp"

#include <algorithm>
#include <cmath>

#include "studies/drawing/gnuplot.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

constexpr int most_outline_nodes = 240;
constexpr double lower_edge = 88, gap_above = 10;  // around the map [px]
constexpr double right_edge = 540, right_edge_at_bar = 424;

/// 1 where a zone is one of the wanted, blurred over the neighbours: its contour at 1/2 is the outline without the
/// steps of the cells, within half a cell.
PlaneField blurred_zones(const SurfaceFields& fields, const ShownNodes& nodes, const MapView& view, bool stick_only) {
  std::vector<double> inside(fields.zone.size());
  for (std::size_t i = 0; i < inside.size(); ++i)
    inside[i] = fields.zone[i] == Zone::stick || (!stick_only && fields.zone[i] == Zone::slip) ? 1 : 0;
  PlaneField field = plane_field(fields.grid, nodes, view, inside, 1);
  const int columns = static_cast<int>(field.x.size()), rows = static_cast<int>(field.y.size());
  const auto blur = [&](int step_column, int step_row) {
    const std::vector<double> sharp = field.values;
    const auto at = [&](int column, int row) {
      return column < 0 || row < 0 || column >= columns || row >= rows
                 ? 0.0
                 : sharp[static_cast<std::size_t>(row) * field.x.size() + static_cast<std::size_t>(column)];
    };
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
        field.values[static_cast<std::size_t>(row) * field.x.size() + static_cast<std::size_t>(column)] =
            0.25 * at(column - step_column, row - step_row) + 0.5 * at(column, row) +
            0.25 * at(column + step_column, row + step_row);
  };
  blur(1, 0);
  blur(0, 1);
  return field;
}

}  // namespace

std::vector<ContourLoop> zone_loops(const SurfaceFields& fields, const MapView& view, bool stick_only) {
  const ShownNodes nodes = view.nodes(fields.grid, most_outline_nodes);
  return contour_loops(blurred_zones(fields, nodes, view, stick_only), std::array{0.5}, 0.0);
}

ScaledUnit figure_unit(std::string_view unit, double size) { return scaled_unit(unit, 10 * size); }

std::string with_unit(std::string_view symbol, const ScaledUnit& unit) {
  return std::string(symbol) + (unit.name.empty() ? "" : " [" + unit.name + "]");
}

double largest(const std::vector<double>& values) {
  double size = 0;
  for (const double value : values)
    if (std::isfinite(value)) size = std::max(size, std::abs(value));
  return size;
}

MapView::MapView(const FigureSource& source) {
  const SurfaceGrid& grid = source.surface.grid;
  trailing_column_ = static_cast<int>(std::lround((source.solution.trailing_edge - grid.x(0)) / grid.spacing_x));
  length = scaled_unit("m", std::max(std::abs(grid.x(0)), std::abs(grid.x(grid.columns - 1))));
  x = {grid.x(0) / length.factor, grid.x(grid.columns - 1) / length.factor};
  y = {grid.y(0) / length.factor, grid.y(grid.rows - 1) / length.factor};
}

MapView::MapView(const FigureSource& source, double room) : MapView(source) {
  const RollingSolution& s = source.solution;
  const double around = room * 0.5 * (s.leading_edge - s.trailing_edge);
  x = {(s.trailing_edge - around) / length.factor, (s.leading_edge + around) / length.factor};
  y = {-(s.half_width + around) / length.factor, (s.half_width + around) / length.factor};
}

MapView::MapView(const SurfaceFields& fields) {
  const SurfaceGrid& grid = fields.grid;
  Span along, across;  // [m]
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      if (fields.zone[static_cast<std::size_t>(grid.index(column, row))] == Zone::free) continue;
      along.include(grid.x(column));
      across.include(grid.y(row));
      if (grid.x(column) == along.lowest) trailing_column_ = column;
    }
  length = scaled_unit("m", std::max({std::abs(along.lowest), std::abs(along.highest), std::abs(across.highest)}));
  const double half_x = 0.5 * grid.spacing_x, half_y = 0.5 * grid.spacing_y;
  x = {(along.lowest - half_x) / length.factor, (along.highest + half_x) / length.factor};
  y = {(across.lowest - half_y) / length.factor, (across.highest + half_y) / length.factor};
}

ShownNodes MapView::nodes(const SurfaceGrid& grid, int most) const {
  const double spacing = std::max(grid.spacing_x, grid.spacing_y);
  const double longest = std::max(x.highest - x.lowest, y.highest - y.lowest) * length.factor;
  const int step = std::max(1, static_cast<int>(std::ceil(longest / spacing / most)));
  const auto along = [&](const Span& span, int start, int count, const auto& place) {
    std::vector<int> kept;
    for (int i = 0; i < count; ++i)
      if ((i - start) % step == 0 && place(i) >= span.lowest * length.factor - spacing &&
          place(i) <= span.highest * length.factor + spacing)
        kept.push_back(i);
    return kept;
  };
  return {along(x, trailing_column_, grid.columns, [&](int i) { return grid.x(i); }),
          along(y, -grid.first_row, grid.rows, [&](int i) { return grid.y(i); })};
}

PlaneField plane_field(const SurfaceGrid& grid, const ShownNodes& nodes, const MapView& view,
                       const std::vector<double>& values, double unit) {
  PlaneField field;
  for (const int column : nodes.columns) field.x.push_back(grid.x(column) / view.length.factor);
  for (const int row : nodes.rows) field.y.push_back(grid.y(row) / view.length.factor);
  for (const int row : nodes.rows)
    for (const int column : nodes.columns)
      field.values.push_back(values[static_cast<std::size_t>(grid.index(column, row))] / unit + 0.0);
  return field;
}

FigureMap::FigureMap(const Figure& figure, const FigureSource& source, const ChartFiles& files, const MapView& view,
                     bool bar)
    : PictureBuilder(figure.title, files, {.name = "along the motion", .symbol = "x", .unit = view.length.name}, view.x,
                     {.name = "across", .symbol = "y", .unit = view.length.name}, view.y),
      figure_(figure),
      source_(source),
      view_(view),
      bar_(bar),
      contact_(zone_loops(source.surface, view, false)),
      stick_(zone_loops(source.surface, view, true)) {
  script() << "set border 15\nunset grid\nset tics out\n";
}

void FigureMap::fill_contact() {
  for (const ContourLoop& loop : contact_)
    plot(add("contact", columns(), {loop}) + " using 1:2 with filledcurves closed lc rgb '" +
         (loop.higher_inside ? "#F0F0F0" : "white") + "' notitle");
}

void FigureMap::blank_outside() {
  // Once round the frame, clockwise; from its corner round each contact, counterclockwise, and back: what is filled is
  // between. White lines cover the seams.
  const Span &x = view_.x, &y = view_.y;
  const double left = x.lowest, right = x.highest, low = y.lowest, top = y.highest;
  std::vector<DataRow> rows{{left, low}, {left, top}, {right, top}, {right, low}, {left, low}};
  for (const ContourLoop& loop : contact_) {
    for (DataRow& row : closed(loop)) rows.push_back(std::move(row));
    rows.push_back({left, low});
  }
  const std::string block = add("outside", columns(), rows);
  plot(block + " using 1:2 with filledcurves closed lc rgb 'white' notitle");
  plot(block + " using 1:2 with lines lc rgb 'white' lw 1.5 notitle");
}

void FigureMap::draw_borders() {
  const auto& slips = source_.surface.zone;
  const bool slip = contains(slips, Zone::slip);
  constexpr const char *edge = "lines lc rgb 'black' lw 2", *border = "lines lc rgb 'black' lw 2 dt (5,3)";
  if (slip && !stick_.empty()) {
    plot(add("stick", columns(), stick_) + " using 1:2 with " + border + " notitle");
    explain({border, "stick-slip border", 17});
  }
  plot(add("contact_edge", columns(), contact_) + " using 1:2 with " + edge + " notitle");
  legend_.insert(legend_.begin(), {edge, "edge of contact", 15});
}

PictureText FigureMap::finished() {
  const double right = bar_ ? right_edge_at_bar : right_edge;
  const double left = left_edge_for(view_.y);
  const double height = (right - left) * (view_.y.highest - view_.y.lowest) / (view_.x.highest - view_.x.lowest);
  return PictureBuilder::finished(
      std::string(figure_.title),
      {.height = std::round(gap_above + height + lower_edge), .left = left, .right = right, .bottom = lower_edge});
}

}  // namespace rollres
