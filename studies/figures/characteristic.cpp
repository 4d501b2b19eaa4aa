#include "studies/figures/characteristic.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "studies/drawing/gnuplot.hpp"
#include "studies/figures/figure_map.hpp"

namespace rollres {

namespace {

// Of the picture [px].
constexpr double shown_right = 500, plot_height = 250, axis_height = 84, gap_over_plot = 10;
constexpr double widest_contact = 96, highest_contact = 110, bar_height = 16, words_height = 26;
constexpr std::size_t most_contacts = 6;

struct Curve {
  std::string symbol, name;
  std::vector<double> values;  // over the load
};

/// What the body takes, over its load; what is nearly nothing, or says the same as the resistance, is left out.
std::vector<Curve> curves_of(const std::vector<CharacteristicPoint>& points) {
  const RollingSolution& first = points.front().solution;
  const double half_length = 0.5 * (first.leading_edge - first.trailing_edge);
  const auto over_load = [&](std::string symbol, std::string name, double RollingSolution::*force, double arm = 1) {
    Curve curve{std::move(symbol), std::move(name), {}};
    for (const CharacteristicPoint& point : points) {
      const double value = point.solution.*force;  // absent where a body rolls straight, which needs none
      curve.values.push_back(std::isfinite(value) ? value / (point.solution.load * arm) : 0);
    }
    return curve;
  };
  std::vector<Curve> curves{over_load("R_r/P", "resistance", &RollingSolution::rolling_resistance),
                            over_load("F_x/P", "along", &RollingSolution::driving_force),
                            over_load("F_y/P", "across", &RollingSolution::lateral_force),
                            over_load("F_a/P", "along the axle", &RollingSolution::axial_force),
                            over_load("M_z/(P a)", "turning", &RollingSolution::spin_moment, half_length)};
  double all = 0;
  for (const Curve& curve : curves) all = std::max(all, largest(curve.values));
  std::vector<double> apart;  // F_x of a body that rolls free is its drag
  for (std::size_t i = 0; i < points.size(); ++i)
    apart.push_back(std::abs(curves[1].values[i]) - std::abs(curves[0].values[i]));
  constexpr double nothing = 0.01;
  if (largest(apart) < nothing * all) curves.erase(curves.begin() + 1);
  std::erase_if(curves,
                [&](const Curve& curve) { return &curve != &curves.front() && largest(curve.values) < nothing * all; });
  return curves;
}

/// Points whose contacts are shown.
struct ShownContacts {
  std::vector<const CharacteristicPoint*> points;
  double each = 0;  // room along the axis of one [px]
};

/// So many of the points, as even along the axis as they are.
ShownContacts evenly(const std::vector<CharacteristicPoint>& points, std::size_t count, const Span& span,
                     double plot_width) {
  std::set<std::size_t> chosen;
  const double from = span.fraction(points.front().place), to = span.fraction(points.back().place);
  for (std::size_t k = 0; k < count; ++k) {
    const double wanted = from + (to - from) * static_cast<double>(k) / static_cast<double>(count - 1);
    const auto nearer = [&](const CharacteristicPoint& a, const CharacteristicPoint& b) {
      return std::abs(span.fraction(a.place) - wanted) < std::abs(span.fraction(b.place) - wanted);
    };
    chosen.insert(static_cast<std::size_t>(min_element(points, nearer) - points.begin()));
  }
  constexpr double apart = 0.94;
  ShownContacts shown{{}, widest_contact};
  for (const std::size_t i : chosen) {
    if (!shown.points.empty())
      shown.each =
          std::min(shown.each,
                   apart * plot_width * (span.fraction(points[i].place) - span.fraction(shown.points.back()->place)));
    shown.points.push_back(&points[i]);
  }
  return shown;
}

/// Of up to six contacts those that fill the axis best.
ShownContacts shown_contacts(const std::vector<CharacteristicPoint>& points, const Span& span, double plot_width) {
  ShownContacts best = evenly(points, 2, span, plot_width);
  for (std::size_t count = 3; count <= std::min(points.size(), most_contacts); ++count)
    if (ShownContacts more = evenly(points, count, span, plot_width);
        more.each * static_cast<double>(more.points.size()) > best.each * static_cast<double>(best.points.size()))
      best = std::move(more);
  return best;
}

/// A contact as areas that are painted one over the other, about its middle [m].
struct ContactShape {
  struct Area {
    const char* colour;
    std::vector<std::array<double, 2>> outline;
  };
  std::vector<Area> areas;
  double length = 0, width = 0;  // along and across the motion [m]; 0: a cylinder's
};

ContactShape shape_of(const CharacteristicPoint& point) {
  const RollingSolution& s = point.solution;
  ContactShape shape;
  const double middle = 0.5 * (s.leading_edge + s.trailing_edge);
  if (dimension_of(point.scene.indenter) == 2) {
    shape.length = s.leading_edge - s.trailing_edge;
    for (const Zone zone : {Zone::slip, Zone::stick})
      for (const auto& [from, to] : zone_runs(zone, s.fields, s))
        shape.areas.push_back({zone == Zone::stick ? stick_colour : slip_colour,
                               {{from - middle, -0.5}, {to - middle, -0.5}, {to - middle, 0.5}, {from - middle, 0.5}}});
    return shape;
  }
  const MapView view(s.fields);
  const double unit = view.length.factor, middle_x = 0.5 * unit * (view.x.lowest + view.x.highest),
               middle_y = 0.5 * unit * (view.y.lowest + view.y.highest);
  shape.length = unit * (view.x.highest - view.x.lowest);
  shape.width = unit * (view.y.highest - view.y.lowest);
  for (const bool stick : {false, true})
    for (const ContourLoop& loop : zone_loops(s.fields, view, stick)) {
      const char* const outside = stick ? slip_colour : "white";
      ContactShape::Area& area = shape.areas.emplace_back(
          loop.higher_inside ? (stick ? stick_colour : slip_colour) : outside, std::vector<std::array<double, 2>>());
      for (const auto& [x, y] : loop.points) area.outline.push_back({x * unit - middle_x, y * unit - middle_y});
    }
  return shape;
}

/// Draws the contacts below the axis.
/// @returns the room that they take, with the words below them [px]
double draw_contacts(const CharacteristicRequest& request, const Span& span, double plot_width,
                     PictureBuilder& picture) {
  const auto [shown, each] = shown_contacts(request.points, span, plot_width);
  std::vector<ContactShape> shapes;
  double longest = 0, widest = 0;
  for (const CharacteristicPoint* const point : shown) {
    shapes.push_back(shape_of(*point));
    longest = std::max(longest, shapes.back().length);
    widest = std::max(widest, shapes.back().width);
  }
  const double scale = std::min(each / longest, widest > 0 ? highest_contact / widest : INFINITY);  // [px/m]
  const double band = widest > 0 ? scale * widest : bar_height;
  const auto graph = [](double x, double y) { return "graph " + short_number(x, 5) + ", graph " + short_number(y, 5); };
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const double x = span.fraction(shown[i]->place), y = -(axis_height + 0.5 * band) / plot_height;
    for (const ContactShape::Area& area : shapes[i].areas) {
      const double up = widest > 0 ? scale : bar_height;
      std::string corners;
      for (std::size_t k = 0; k <= area.outline.size(); ++k) {
        const auto& [along, across] = area.outline[k % area.outline.size()];
        corners += (k == 0 ? "from " : " to ") + graph(x + along * scale / plot_width, y + across * up / plot_height);
      }
      picture.script() << "set object polygon " << corners << " noclip front fc rgb '" << area.colour
                       << "' fs solid 1 noborder\n";
    }
    picture.script() << "set label "
                     << gnuplot::quoted(short_number(100 * slipping_share(shown[i]->solution), 2) + " %") << " at "
                     << graph(x, -(axis_height + band + 14) / plot_height) << " center font ',13'\n";
  }
  return band + words_height;
}

/// What the forces span, with the bounds by friction that they come near.
Span heights(const std::vector<Curve>& curves, const std::vector<CharacteristicPoint>& points) {
  constexpr double near = 0.5, room = 0.06;
  Span forces{.lowest = 0, .highest = 0};
  for (const Curve& curve : curves)
    for (const double value : curve.values)
      if (std::isfinite(value)) forces.include(value);
  Span all = forces;
  for (const CharacteristicPoint& point : points) {
    const double friction = point.scene.friction_coefficient;
    if (forces.highest > near * friction) all.include(friction);
    if (-forces.lowest > near * friction) all.include(-friction);
  }
  all.widen(all.lowest < 0 ? room : 0, room);
  return all;
}

}  // namespace

double slipping_share(const RollingSolution& solution) {
  const SurfaceFields& fields = solution.fields;
  double slips = 0, all = 0;
  if (fields.grid.rows == 1) {
    for (const Zone zone : {Zone::stick, Zone::slip})
      for (const auto& [from, to] : zone_runs(zone, fields, solution)) (zone == Zone::slip ? slips : all) += to - from;
    all += slips;
  } else {
    for (const Zone zone : fields.zone) {
      slips += zone == Zone::slip ? 1 : 0;
      all += zone != Zone::free ? 1 : 0;
    }
  }
  return all > 0 ? slips / all : 0;
}

ChartFiles draw_characteristic(const CharacteristicRequest& request, const std::filesystem::path& name) {
  const std::vector<CharacteristicPoint>& points = request.points;
  if (none_of(points, [](const auto& p) { return p.scene.friction_coefficient > 0; }))
    throw std::invalid_argument(request.title + ": has no friction, so that nothing sticks or slips");
  const std::vector<Curve> curves = curves_of(points);
  Span x{.logarithmic = request.x.logarithmic && points.front().place > 0};
  for (const CharacteristicPoint& point : points) x.include(point.place);
  x.widen(0, 0);
  const ChartFiles files = chart_files(name);
  constexpr const char* block = "characteristic";
  const Span y = heights(curves, points);
  const double left = left_edge_for(y);
  PictureBuilder picture(block, files, request.x, x, {.name = "force over load", .symbol = "", .unit = ""}, y);
  std::string columns = request.x.name + unit_in_brackets(request.x.unit);
  for (const Curve& curve : curves) columns += ", " + curve.symbol;
  std::vector<DataRow> rows;
  for (std::size_t i = 0; i < points.size(); ++i) {
    DataRow& row = rows.emplace_back(DataRow{points[i].place});
    for (const Curve& curve : curves) row.push_back(curve.values[i]);
    row.push_back(points[i].scene.friction_coefficient);
    row.push_back(slipping_share(points[i].solution));
  }
  const std::string data = picture.add(block, columns + ", friction coefficient, slipping share", rows);
  const std::string bound = "lines lw 1.5 dt (2,3) lc rgb '#444444'", column = std::to_string(curves.size() + 2);
  for (const char* const sign : {"", "-"})
    picture.plot(data + " using 1:(" + sign + "$" + column + ") with " + bound + " notitle");
  constexpr std::array<const char*, 5> dashes{"1", "(10,4)", "(3,3)", "(10,3,2,3)", "(6,2)"};
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const std::string look =
        "lines lw 2.5 dt " + std::string(dashes[i]) + " lc rgb '" + std::string(curve_colour(i)) + "'";
    picture.plot(data + " using 1:" + std::to_string(i + 2) + " with " + look + " notitle");
    picture.explain({look, gnuplot::symbol(curves[i].symbol) + ": " + gnuplot::plain(curves[i].name) + kept_blanks,
                     curves[i].symbol.size() + 1 + curves[i].name.size()});
  }
  picture.explain(LegendEntry::plain(bound, "bound of the shear"));
  const auto box = [](const char* colour) { return "boxes fs solid 1 noborder lc rgb '" + std::string(colour) + "'"; };
  picture.explain(LegendEntry::plain(box(stick_colour), "stick"));
  picture.explain(LegendEntry::plain(box(slip_colour), "slip, its share below"));
  picture.script() << "set arrow from graph 0, first 0 to graph 1, first 0 nohead lc rgb '#444444' back\n";
  const double below = axis_height + draw_contacts(request, x, shown_right - left, picture);
  const auto [script, text] = picture.finished(request.title, {.height = gap_over_plot + plot_height + below,
                                                               .left = left,
                                                               .right = shown_right,
                                                               .bottom = below,
                                                               .gap = gap_over_plot,
                                                               .subtitle = request.subtitle});
  std::string words = "what the body takes, over its load, against " + request.x.name + ":";
  for (const Curve& curve : curves) words += " " + curve.name + ",";
  draw_pictures(files, text, script, {request.title, words + " and what of the contact slips"});
  return files;
}

}  // namespace rollres
