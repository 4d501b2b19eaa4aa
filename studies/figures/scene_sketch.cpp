#include "studies/figures/scene_sketch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/derivatives/objective.hpp"
#include "core/material/material.hpp"
#include "core/model/contact_surface.hpp"
#include "core/scene/layer_name.hpp"
#include "studies/drawing/gnuplot.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

constexpr std::array<const char*, 3> layer_colours{"#F3DCAE", "#E2B878", "#C9955A"};
constexpr std::array<const char*, 3> coating_colours{"#BFD9EE", "#8FB8DC", "#6497C4"};
constexpr const char *body_colour = "#D0D3D8", *base_colour = "#9A9DA2", *ink = "#1A1A1A";
constexpr const char* contact_colour = "#009E73";
constexpr double plot_width = 530, plot_left = 15;  // [px]

using Point = std::array<double, 2>;

/// Four digits are enough on a sketch.
std::string shown(double value, std::string_view unit) {
  if (!std::isfinite(value)) return readable(value, unit);
  const ScaledUnit scaled = scaled_unit(unit, value);
  return short_number(value / scaled.factor, 4) + " " + typeset_unit(scaled.name);
}

std::string pair(const Point& at) { return short_number(at[0], 8) + "," + short_number(at[1], 8); }

/// "Zener, G0 = 3 MPa, f = 1, τ = 250 ms"
std::string material_in_words(const MaterialInputs& layer) {
  const auto modulus = [&] { return "G0 = " + readable(static_modulus(layer), "Pa"); };
  switch (layer.material) {
    case MaterialModel::elastic:
      return "elastic, " + modulus();
    case MaterialModel::zener:
      return modulus() + ", f = " + short_number(layer.stiffening, 3) + ", τ = " + readable(layer.creep_time, "s");
    case MaterialModel::fractional_zener:
      return "fractional, " + modulus() + ", f = " + short_number(layer.stiffening, 3) +
             ", τ = " + readable(layer.creep_time, "s");
    case MaterialModel::prony:
      return "Prony series of " + std::to_string(layer.relaxation_times.size()) + " terms, " + modulus();
    case MaterialModel::master_curve:
      return "master curve of " + std::to_string(layer.frequencies.size()) + " frequencies";
    case MaterialModel::relaxation_curve:
      return "relaxation curve of " + std::to_string(layer.relaxation_times.size()) + " times";
  }
  return {};
}

struct DrawnLayer {
  double thickness;  // [m]
  const MaterialInputs* material;
};

class SceneSketch {
 public:
  SceneSketch(const RollingScene& scene, const RollingSolution& solution, const std::string& title,
              const ChartFiles& files)
      : scene_(scene),
        solution_(solution),
        title_(title),
        answered_(solution.status == Status::converged && std::isfinite(solution.leading_edge) &&
                  std::isfinite(solution.trailing_edge)),
        layers_{{scene.layer_thickness, &scene}},
        unit_(scaled_unit("m", scene.radius)),
        coating_yields_(coating_yields(scene)),
        pressed_(scene.indenter == Indenter::pressure),
        picture_(title, files, {}, span_of_view().first, {}, span_of_view().second) {
    for (const BondedLayer& layer : scene.lower_layers) layers_.push_back({layer.layer_thickness, &layer});
  }

  PictureText text() {
    picture_.script() << "unset border\nunset tics\nunset grid\nunset xlabel\nunset ylabel\n";
    measure();
    if (coating_yields_) {
      draw_body();
      draw_layers();
    } else {
      draw_layers();
      draw_body();
    }
    draw_contact();
    draw_thickness();
    if (!pressed_) draw_radius();
    draw_motion();
    draw_length_scale();
    const double height = plot_width * (top_ - bottom_) / (2 * half_width_);
    return picture_.finished(
        title_, {.height = std::round(height + 20), .left = plot_left, .right = plot_left + plot_width, .bottom = 10});
  }

 private:
  // All places from here on are in units of `unit_`; z = 0 is the undeformed surface.
  double in_unit(double metres) const { return metres / unit_.factor; }
  double radius() const { return in_unit(scene_.radius); }
  bool whole_body() const { return half_width_ > 1.1 * radius() && !pressed_; }
  double pixel() const { return 2 * half_width_ / plot_width; }

  double finite_thickness() const {
    double sum = 0;
    for (const DrawnLayer& layer : layers_)
      if (std::isfinite(layer.thickness)) sum += in_unit(layer.thickness);
    return sum;
  }
  double coating_thickness() const {
    double sum = 0;
    for (const BondedLayer& layer : scene_.coating_layers) sum += in_unit(layer.layer_thickness);
    return sum;
  }
  double contact_length() const { return answered_ ? in_unit(solution_.leading_edge - solution_.trailing_edge) : 0.0; }

  /// What the picture spans. The plot's ranges are set again in `text`, once the layers are known.
  static std::pair<Span, Span> span_of_view() { return {{-1, 1}, {-1, 1}}; }

  void measure() {
    constexpr double least_share = 1.0 / 12, widest = 1.62;
    double thinnest = coating_thickness() > 0 ? coating_thickness() : INFINITY;
    if (finite_thickness() > 0) thinnest = std::min(thinnest, finite_thickness());
    const double needed = std::max({12 * widest * thinnest, 4 * contact_length(), 0.02 * radius()});
    half_width_ = thinnest < least_share * radius() ? std::min(needed, widest * radius()) : widest * radius();
    if (pressed_) half_width_ = 2.5 * radius();
    top_ = whole_body() ? 2.62 * radius() : (pressed_ ? 0.8 : 1.15) * half_width_;
    deepest_ = 0;
    const double limit = 1.05 * half_width_;  // below it a thick layer is cut
    for (const DrawnLayer& layer : layers_) {
      const double thickness = std::isfinite(layer.thickness) ? in_unit(layer.thickness) : 0.45 * half_width_;
      depths_.push_back(deepest_);
      deepest_ = std::min(deepest_ + thickness, limit);
      cut_ = cut_ || !std::isfinite(layer.thickness) || deepest_ == limit;
    }
    bottom_ = -deepest_ - (cut_ ? 0.14 : 0.17) * half_width_;
    approach_ = answered_ ? sunk() : 0;
    picture_.script() << "set xrange [" << short_number(-half_width_, 8) << ":" << short_number(half_width_, 8)
                      << "]\nset yrange [" << short_number(bottom_, 8) << ":" << short_number(top_, 8) << "]\n";
  }

  /// The approach; where it is not defined, what the edges of the contact alone tell.
  double sunk() const {
    if (pressed_) return 0;
    if (std::isfinite(solution_.approach)) return in_unit(solution_.approach);
    return contact_length() * contact_length() / (8 * radius());
  }

  double bottom_of_body(double x) const {
    return radius() - approach_ - std::sqrt(std::max(radius() * radius() - x * x, 0.0));
  }

  /// Height of the layers' surface: the body's in the contact, beyond it a curve that falls to zero.
  double surface(double x) const {
    if (!answered_ || coating_yields_) return 0;
    if (pressed_) return surface_under_pressure(x);
    const double ahead = in_unit(solution_.leading_edge), behind = in_unit(solution_.trailing_edge);
    const double edge = std::clamp(x, behind, ahead), height = bottom_of_body(edge);
    if (edge == x) return height;
    const double length = std::max(0.5 * contact_length(), 4 * pixel());
    return height * std::exp(-std::abs(x - edge) / length);
  }

  /// The computed one as far as it reaches, and its end beyond.
  double surface_under_pressure(double x) const {
    const SurfaceGrid& grid = solution_.fields.grid;
    const double place = std::clamp((x * unit_.factor - grid.x(0)) / grid.spacing_x, 0.0, grid.columns - 1.001);
    const int column = static_cast<int>(place);
    const auto w = [&](int at) {
      return in_unit(solution_.fields.w[static_cast<std::size_t>(grid.index(at, -grid.first_row))]);
    };
    return w(column) + (place - column) * (w(column + 1) - w(column));
  }

  /// A given pressure as a figure of its height along the motion on the surface, with arrows.
  void draw_pressure() {
    const double r = radius(), high = 0.55 * r;
    const auto pressure = [&](double x) {
      return scene_.pressure_distribution == PressureDistribution::uniform
                 ? 1
                 : std::sqrt(std::max(1 - (x / r) * (x / r), 0.0));
    };
    constexpr int pieces = 200, arrows = 6;
    std::vector<Point> outline, foot;
    for (int i = 0; i <= pieces; ++i) {
      const double x = r * (2.0 * i / pieces - 1);
      outline.push_back({x, surface(x) + high * pressure(x)});
      foot.push_back({x, surface(x)});
    }
    outline.insert(outline.end(), foot.rbegin(), foot.rend());
    fill("pressure", outline, body_colour);
    for (int i = 0; i <= arrows; ++i) {
      const double x = 0.96 * r * (2.0 * i / arrows - 1);
      arrow({x, surface(x) + high * pressure(x)}, {x, surface(x)}, "head size screen 0.012,22 filled lw 1.1");
    }
    const std::string words = shown(2 * scene_.radius, "m");
    arrow({-r, high + 26 * pixel()}, {r, high + 26 * pixel()}, "heads size screen 0.016,22 filled lw 1.3");
    label(words, {-0.5 * r, high + 42 * pixel()}, "center", 16);
  }

  /// Points of a surface that follows the dent, less and less with the depth.
  std::vector<Point> interface(double depth) const {
    constexpr int pieces = 600;
    const double share = 1 - std::min(1.0, depth / deepest_);
    std::vector<Point> points;
    for (int i = 0; i <= pieces; ++i) {
      const double x = half_width_ * (2.0 * i / pieces - 1);
      points.push_back({x, -depth + share * surface(x)});
    }
    return points;
  }

  void fill(std::string_view name, const std::vector<Point>& outline, const std::string& colour, bool edge = true) {
    std::vector<DataRow> rows;
    for (const auto& [x, z] : outline) rows.push_back({x, z});
    rows.push_back(rows.front());
    const std::string block = picture_.add(name, "x, z [" + unit_.name + "]", rows);
    picture_.plot(block + " using 1:2 with filledcurves closed fc rgb '" + colour + "' notitle");
    if (edge) picture_.plot(block + " using 1:2 with lines lw 1 lc rgb '#555555' notitle");
  }

  void explain(const std::string& colour, const std::string& words) {
    constexpr double size = 14, usual = 17;
    const auto letters = static_cast<double>(width(words));
    picture_.explain({"boxes fc rgb '" + colour + "' fs solid border lc rgb '#555555'",
                      "{/=14 " + gnuplot::plain(words) + "}" + kept_blanks,
                      static_cast<std::size_t>(std::ceil(letters * size / usual))});
  }

  void draw_layers() {
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      std::vector<Point> outline = interface(depths_[i]);
      std::vector<Point> below = interface(i + 1 < layers_.size() ? depths_[i + 1] : deepest_);
      outline.insert(outline.end(), below.rbegin(), below.rend());
      const std::string colour = layer_colours[i % layer_colours.size()];
      fill(layer_name(false, i), outline, colour);
      const double thickness = layers_[i].thickness;
      explain(colour, (std::isfinite(thickness) ? shown(thickness, "m") + " thick: " : "infinitely thick: ") +
                          material_in_words(*layers_[i].material));
    }
    if (cut_) return;
    fill("rigid base",
         {{-half_width_, -deepest_}, {half_width_, -deepest_}, {half_width_, bottom_}, {-half_width_, bottom_}},
         base_colour);
    label("rigid base", {0, 0.5 * (bottom_ - deepest_)}, "center", 14);
  }

  std::vector<Point> circle(double r) const {
    constexpr int pieces = 1440;
    std::vector<Point> points;
    for (int i = 0; i < pieces; ++i) {
      const double angle = 2 * std::numbers::pi * i / pieces;
      const double z = radius() - approach_ + r * std::sin(angle);
      points.push_back({r * std::cos(angle), coating_yields_ ? std::max(z, 0.0) : z});
    }
    return points;
  }

  void draw_body() {
    if (pressed_) return draw_pressure();
    double r = radius();
    for (std::size_t i = 0; i < scene_.coating_layers.size(); ++i) {
      const BondedLayer& layer = scene_.coating_layers[i];
      const std::string colour = coating_colours[i % coating_colours.size()];
      fill(layer_name(true, i), circle(r), colour);
      explain(colour, "coating, " + shown(layer.layer_thickness, "m") + ": " + material_in_words(layer));
      r -= in_unit(layer.layer_thickness);
    }
    if (r > 0) fill("rigid body", circle(r), body_colour);
  }

  /// The contact as a thick line, in the colours of stick and slip where they are known.
  void draw_contact() {
    if (!answered_) return;
    const SurfaceFields& fields = solution_.fields;
    const SurfaceGrid& grid = fields.grid;
    const int row = grid.rows > 1 ? -grid.first_row : 0;
    const bool zones = grid.size() > 0 && row >= 0 && row < grid.rows && scene_.friction_coefficient > 0;
    std::vector<DataRow> stick, slip, all;
    const double behind = in_unit(solution_.trailing_edge), ahead = in_unit(solution_.leading_edge);
    constexpr int pieces = 400;
    for (int i = 0; i <= pieces; ++i) {
      const double x = behind + (ahead - behind) * i / pieces;
      const double z = coating_yields_ ? 0 : surface(x);
      if (!zones) {
        all.push_back({x, z});
        continue;
      }
      const int column = std::clamp(static_cast<int>(std::lround((x * unit_.factor - grid.x(0)) / grid.spacing_x)), 0,
                                    grid.columns - 1);
      const Zone zone = fields.zone[static_cast<std::size_t>(grid.index(column, row))];
      (zone == Zone::slip ? slip : stick).push_back({x, z});
      (zone == Zone::slip ? stick : slip).push_back({});  // a line ends here
    }
    const auto line = [&](const char* name, const char* colour, const std::vector<DataRow>& rows) {
      if (all_of(rows, [](const DataRow& one) { return one.empty(); })) return;
      const std::string dashes = std::string_view(name) == "slip" ? " dt (1,0.6)" : "";  // seen without colour, too
      const std::string look = std::string("lines lw 4 lc rgb '") + colour + "'" + dashes;
      picture_.plot(picture_.add(name, "x, z [" + unit_.name + "]", without_doubled_blanks(rows)) + " using 1:2 with " +
                    look + " notitle");
      picture_.explain(
          LegendEntry::plain(look, std::string_view(name) == "contact" ? name : std::string("contact: ") + name));
    };
    line("contact", contact_colour, all);
    line("stick", stick_colour, stick);
    line("slip", slip_colour, slip);
  }

  /// Two blank lines would end a block of data.
  static std::vector<DataRow> without_doubled_blanks(const std::vector<DataRow>& rows) {
    std::vector<DataRow> kept;
    for (const DataRow& row : rows)
      if (!row.empty() || (!kept.empty() && !kept.back().empty())) kept.push_back(row);
    return kept;
  }

  void label(const std::string& text, const Point& at, const char* side, double size, const std::string& markup = {}) {
    picture_.script() << "set label " << gnuplot::quoted((markup.empty() ? gnuplot::plain(text) : markup) + kept_blanks)
                      << " at " << pair(at) << " " << side << " front font '," << size << "' tc rgb '" << ink << "'\n";
  }
  void arrow(const Point& from, const Point& to, const std::string& look) {
    picture_.script() << "set arrow from " << pair(from) << " to " << pair(to) << " front " << look << " lc rgb '"
                      << ink << "'\n";
  }
  static std::string named(std::string_view symbol, const std::string& value) {
    return gnuplot::symbol(symbol) + " = " + gnuplot::plain(value);
  }

  /// The thickness of all layers together as an arrow from top to bottom, or two from outside where it is small.
  void draw_thickness() {
    const double x = -0.86 * half_width_, room = 26 * pixel();
    const std::string words = std::isfinite(scene_.layer_thickness) ? shown(scene_.layer_thickness, "m") : "infinite";
    const double below = depths_.size() > 1 ? depths_[1] : deepest_;
    const char* const head = "size screen 0.016,22 filled lw 1.3";
    if (below > 1.6 * room)
      arrow({x, 0}, {x, -below}, std::string(std::isfinite(scene_.layer_thickness) ? "heads " : "head ") + head);
    else
      for (const double side : {1.0, -1.0})
        arrow({x, side > 0 ? room : -below - room}, {x, side > 0 ? 0 : -below}, std::string("head ") + head);
    const double z = below > 1.6 * room ? -0.5 * below : 1.2 * room;
    label(words, {x + 8 * pixel(), z}, "left", 16, named("H", words));
  }

  void draw_radius() {
    const std::string words = shown(scene_.radius, "m");
    const double centre = radius() - approach_;
    if (!whole_body()) {
      label(words, {-0.42 * half_width_, 0.62 * half_width_}, "center", 16, named("R", words));
      return;
    }
    const double angle = 0.80 * std::numbers::pi, r = radius();
    arrow({0, centre}, {r * std::cos(angle), centre + r * std::sin(angle)}, "head size screen 0.016,22 filled lw 1.3");
    label(words, {-0.56 * r, centre + 0.16 * r}, "center", 16, named("R", words));
    fill("axis", spot({0, centre}, 3 * pixel()), ink, false);
  }

  static std::vector<Point> spot(const Point& centre, double size) {
    std::vector<Point> points;
    for (int i = 0; i < 24; ++i) {
      const double angle = 2 * std::numbers::pi * i / 24;
      points.push_back({centre[0] + size * std::cos(angle), centre[1] + size * std::sin(angle)});
    }
    return points;
  }

  /// An arrow round the axis, clockwise as a body that rolls along +x turns.
  void draw_turning(double centre, double r, const std::string& words, const std::string& markup) {
    constexpr int pieces = 40;
    std::vector<DataRow> rows;
    for (int i = 0; i <= pieces; ++i) {
      const double angle = (-0.06 - 0.40 * i / pieces) * std::numbers::pi;
      rows.push_back({r * std::cos(angle), centre + r * std::sin(angle)});
    }
    const DataRow last = rows.back(), before = rows[rows.size() - 3];
    picture_.plot(picture_.add("turning", "x, z [" + unit_.name + "]", rows) + " using 1:2 with lines lw 1.6 lc rgb '" +
                  std::string(ink) + "' notitle");
    arrow({before[0], before[1]}, {last[0], last[1]}, "head size screen 0.022,22 filled lw 1.6");
    // Clear of the arrow at its height, with half a letter to spare.
    const double letter = 9.2 * pixel(), down = 0.42 * r;
    const double room = std::sqrt(r * r - down * down) - letter - 0.5 * letter * static_cast<double>(width(words));
    label("", {std::min(0.30 * r, room), centre - down}, "center", 16, markup);
  }

  void draw_motion() {
    const auto unit = [&](const char* output) { return real_output(output).unit_for(body_of(scene_)); };
    const double r = radius(), centre = r - approach_;
    const char* const force = "head size screen 0.026,20 filled lw 2.6";
    const char* const motion = "head size screen 0.026,20 empty lw 1.6";
    const bool whole = whole_body();
    const double peak = whole ? 2 * r - approach_ : 0.80 * half_width_;  // top of what is seen of the body
    const double axis = whole ? centre : 0.46 * half_width_, reach = whole ? r : half_width_;

    const double load = std::isfinite(solution_.load) ? solution_.load : scene_.load.value_or(RollingSolution::absent);
    arrow({0, top_ - 0.02 * reach}, {0, top_ - 0.50 * reach}, force);
    if (std::isfinite(load)) {
      const std::string words = shown(load, unit("load"));
      label(words, {-0.06 * reach, top_ - 0.14 * reach}, "right", 16, named("P", words));
    }
    const std::string speed = shown(scene_.speed, "m/s");
    const double v_from = whole ? 1.06 * r : 0.56 * half_width_, v_to = whole ? 1.50 * r : 0.94 * half_width_;
    const double v_at = whole ? centre + 0.45 * r : axis;
    arrow({v_from, v_at}, {v_to, v_at}, motion);
    label(speed, {0.5 * (v_from + v_to), v_at + 18 * pixel()}, "center", 16, named("V", speed));
    draw_skew({0.99 * half_width_, v_at + 18 * pixel()});
    if (pressed_) return;

    const double drive = answered_ ? solution_.driving_force : RollingSolution::absent;
    const std::string push =
        std::isfinite(drive) ? named("Q", shown(drive, unit("driving_force"))) : gnuplot::symbol("Q");
    const bool backwards = drive < 0, at_top = scene_.drive == Drive::top_force;
    const double from = at_top ? 0.06 * reach : 0, to = from + 0.52 * reach, z = at_top ? peak : axis;
    arrow({backwards ? to : from, z}, {backwards ? from : to, z}, force);
    if (at_top && whole)
      label("", {to + 0.05 * reach, z}, "left", 16, push);
    else
      label("", {0.5 * (from + to) + 0.08 * reach, z + 18 * pixel()}, "center", 16, push);
    if (!whole) return;
    std::string symbol = "Ω", value;
    if (scene_.drive == Drive::torque && scene_.driving_torque) {
      symbol = "T";
      value = shown(*scene_.driving_torque, unit("driving_torque"));
    } else if (answered_ && std::isfinite(solution_.rotation_ratio)) {
      symbol = "RΩ/V";
      value = short_number(solution_.rotation_ratio, 4);
    }
    if (scene_.drive != Drive::rotation || scene_.rotation_ratio.value_or(1) != 0) {
      draw_turning(centre, 0.72 * (r - coating_thickness()), symbol + (value.empty() ? "" : " = " + value),
                   value.empty() ? gnuplot::symbol(symbol) : named(symbol, value));
    } else {
      label("locked", {0.2 * r, centre - 0.4 * r}, "center", 16);
    }
  }

  /// The angles by which the axle is turned and raised, and the force along it, above the speed and left of a place.
  void draw_skew(const Point& above) {
    std::vector<std::pair<std::string, std::string>> angles;
    const auto add = [&](std::string_view symbol, double angle) {
      if (!std::isfinite(angle) || angle == 0) return;
      const std::string words = shown(angle, "rad");
      angles.emplace_back(std::string(symbol) + " = " + words, named(symbol, words));
    };
    const auto found_or = [&](double found, std::optional<double> given) {
      return answered_ && std::isfinite(found) ? found : given.value_or(RollingSolution::absent);
    };
    add("α", found_or(solution_.skew_angle, scene_.skew_angle));
    add("γ", scene_.camber_angle);
    int line = 0;
    const auto write = [&](const std::string& words, const std::string& markup) {
      label(words, {above[0], above[1] + 24 * ++line * pixel()}, "right", 16, markup);
    };
    if (!angles.empty())
      write(joined(angles, ", ", [](const auto& angle) { return angle.first; }),
            joined(angles, ", ", [](const auto& angle) { return angle.second; }));
    if (const double force = found_or(solution_.axial_force, scene_.axial_force); std::isfinite(force)) {
      const std::string words = shown(force, real_output("axial_force").unit_for(body_of(scene_)));
      write(words, named("F_a", words));
    }
  }

  /// A bar of a round length, in the lower right corner.
  void draw_length_scale() {
    const double length = even_step(2 * half_width_, 8), right = 0.95 * half_width_;
    const double z = bottom_ + (cut_ ? 0.075 : 0.085) * half_width_;
    arrow({right - length, z}, {right, z}, "heads size screen 0.008,90 lw 1.6");
    label("", {right - length - 8 * pixel(), z}, "right", 14, gnuplot::plain(short_number(length) + " " + unit_.name));
  }

  const RollingScene& scene_;
  const RollingSolution& solution_;
  std::string title_;
  bool answered_;  // and the contact is known
  std::vector<DrawnLayer> layers_;
  ScaledUnit unit_;
  bool coating_yields_, pressed_;
  PictureBuilder picture_;
  double half_width_ = 1, top_ = 1, bottom_ = -1, deepest_ = 0, approach_ = 0;
  std::vector<double> depths_;  // of the layers' upper sides
  bool cut_ = false;            // the layers go on below the picture
};

}  // namespace

bool coating_yields(const RollingScene& scene) {
  if (scene.coating_layers.empty()) return false;
  const auto stiffness = [&](const MaterialInputs& layer, double thickness) {
    return std::abs(complex_modulus(layer, 0.0)) / std::min(thickness, scene.radius);
  };
  const BondedLayer& coating = scene.coating_layers.front();
  return stiffness(coating, coating.layer_thickness) < stiffness(scene, scene.layer_thickness);
}

PictureText scene_sketch(const RollingScene& scene, const RollingSolution& solution, const std::string& title,
                         const ChartFiles& files) {
  return SceneSketch(scene, solution, title, files).text();
}

std::string sketch_in_words(const RollingScene& scene) {
  const std::size_t layers = 1 + scene.lower_layers.size();
  const bool pressed = scene.indenter == Indenter::pressure;
  return "a " + std::string(Body(scene.indenter).name()) + " of " + shown((pressed ? 2 : 1) * scene.radius, "m") +
         (pressed ? " length" : " radius") + (scene.coating_layers.empty() ? "" : " with a coating") + " on " +
         (layers == 1 ? "one layer" : std::to_string(layers) + " layers") + ", drawn to scale";
}

}  // namespace rollres
