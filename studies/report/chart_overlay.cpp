#include "studies/report/chart_overlay.hpp"

#include <algorithm>
#include <regex>

#include "studies/drawing/chart_frame.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/words.hpp"
#include "studies/text/xml_text.hpp"

namespace rollres {

namespace {

/// The frame of the plot, and the size of the picture [px].
struct Frame {
  double left = 0, right = 0, top = 0, bottom = 0;
  std::string view;  ///< "0 0 560 428"
};

/// gnuplot draws the axes as one path from the upper left corner to the lower right one.
std::optional<Frame> frame_of(std::string_view svg) {
  static const std::regex box("viewBox=\"([0-9. ]+)\"");
  static const std::regex axes("d='M([0-9.]+),([0-9.]+) L\\1,([0-9.]+) L([0-9.]+),\\3 M\\4,\\2 M\\1,\\2 ");
  std::cmatch view, path;
  const char *const begin = svg.data(), *const end = begin + svg.size();
  if (!std::regex_search(begin, end, view, box) || !std::regex_search(begin, end, path, axes)) return std::nullopt;
  return Frame{std::stod(path[1]), std::stod(path[4]), std::stod(path[2]), std::stod(path[3]), view[1]};
}

class Overlay {
 public:
  Overlay(const ChartRequest& request, const Frame& frame)
      : request_(request), frame_(frame), spans_(chart_spans(request)) {}

  std::string layer() const {
    const auto sides = {frame_.left, frame_.top, frame_.right, frame_.bottom};
    std::string markup = "<svg class=\"points\" viewBox=\"" + frame_.view + "\" aria-hidden=\"true\" data-frame=\"" +
                         joined(sides, " ", [](double side) { return short_number(side, 6); }) + "\"" +
                         axis("x", request_.x, spans_.x) + axis("y", request_.y, spans_.y) + ">";
    for (std::size_t i = 0; i < request_.curves.size(); ++i) markup += curve(i);
    return markup + "</svg>";
  }

  std::string buttons() const {
    const bool named = any_of(request_.curves, [](const ChartCurve& curve) { return !curve.label.empty(); });
    const auto has_button = [&](const ChartCurve& curve) { return !curve.like && !(named && curve.label.empty()); };
    if (count_if(request_.curves, has_button) < 2) return "";
    if (!request_.families.empty()) return buttons_of_families();
    std::string markup = "<div class=\"families\">";
    if (!request_.family.name.empty()) markup += "<span>" + xml_text(request_.family.name) + "</span>";
    for (std::size_t i = 0; i < request_.curves.size(); ++i)
      if (has_button(request_.curves[i]))
        markup += button(std::to_string(i), curve_colour(request_, i), name_of_curve(i));
    return markup + "</div>";
  }

 private:
  /// @param curves  their numbers: "0 4 8"   @param colour  of all of them, or empty
  static std::string button(const std::string& curves, const std::string& colour, const std::string& name) {
    return "<button type=\"button\" aria-pressed=\"false\" data-curve=\"" + curves + "\">" +
           (colour.empty() ? "" : "<i style=\"background:" + colour + "\"></i>") + xml_text(name) + "</button>";
  }

  /// A button for each value of either family, which shows all curves of that value.
  std::string buttons_of_families() const {
    std::string markup;
    for (std::size_t family = 0; family < request_.families.size(); ++family) {
      const auto& [axis, labels] = request_.families[family];
      markup += "<div class=\"families\">";
      if (!axis.name.empty()) markup += "<span>" + xml_text(axis.name) + "</span>";
      for (std::size_t value = 0; value < labels.size(); ++value) {
        std::string curves, colour;
        for (std::size_t i = 0; i < request_.curves.size(); ++i) {
          if (request_.curves[i].place[family] != value) continue;
          curves += (curves.empty() ? "" : " ") + std::to_string(i);
          if (family == 0) colour = curve_colour(request_, i);
        }
        markup += button(curves, colour, labels[value]);
      }
      markup += "</div>";
    }
    return markup;
  }

  /// What an axis spans and says, for the script that draws it anew: data-x="0.01 10 log" data-x-name="speed V [m/s]".
  static std::string axis(const std::string& letter, const ChartAxis& axis, const Span& span) {
    std::string name = axis.name + (axis.symbol.empty() ? "" : " " + axis.symbol);
    if (!axis.unit.empty()) name += " [" + axis.unit + "]";
    return " data-" + letter + "=\"" + short_number(span.lowest, 12) + " " + short_number(span.highest, 12) +
           (span.logarithmic ? " log" : "") + "\" data-" + letter + "-name=\"" + xml_text(name) + "\"";
  }

  std::string place(double at_x, double at_y) const {
    const double x = frame_.left + spans_.x.fraction(at_x) * (frame_.right - frame_.left);
    const double y = frame_.bottom - spans_.y.fraction(at_y) * (frame_.bottom - frame_.top);
    return short_number(x, 6) + "," + short_number(y, 6);
  }
  std::string place(const ChartPoint& point) const { return place(point.x, point.y); }

  std::string name_of_curve(std::size_t i) const {
    const std::string& label = request_.curves[i].label;
    return label.empty() ? "curve " + std::to_string(i + 1) : label;
  }

  static std::string told(const ChartAxis& axis, double value) {
    return axis.name + " " + short_number(value, 5) + (axis.unit.empty() ? "" : " " + axis.unit);
  }

  std::string words(std::size_t i, const ChartPoint& point) const {
    std::string text = told(request_.y, point.y) + "\n" + told(request_.x, point.x);
    if (!request_.curves[i].label.empty())
      text += "\n" + (request_.family.name.empty() ? "" : request_.family.name + " ") + request_.curves[i].label;
    if (!request_.areas.empty() && point.area())
      text += "\n" + request_.areas + " ± " + short_number(0.5 * (point.high - point.low), 2);
    if (!point.converged) text += "\n" + request_.hollow;
    return text;
  }

  std::string curve(std::size_t i) const {
    const std::string colour = curve_colour(request_, i);
    std::string markup =
        "<g data-curve=\"" + std::to_string(request_.curves[i].like.value_or(i)) + "\" style=\"color:" + colour + "\">";
    std::string line, above, below;  // a run of joined points, and the two sides of its area, there and back
    const auto end_line = [&] {
      if (!above.empty()) markup += "<polygon points=\"" + above + below + "\"/>";
      if (request_.lines && request_.curves[i].line && !line.empty()) markup += "<polyline points=\"" + line + "\"/>";
      line = above = below = "";
    };
    for (const ChartPoint& point : request_.curves[i].points) {
      if (!point.joined() || !request_.lines || !request_.curves[i].line) end_line();
      if (!point.joined()) continue;
      line += (line.empty() ? "" : " ") + place(point);
      if (!point.area()) continue;
      above += place(point.x, std::max(point.high, spans_.y.lowest)) + " ";
      below.insert(0, place(point.x, std::max(point.low, spans_.y.lowest)) + " ");
    }
    end_line();
    for (const ChartPoint& point : request_.curves[i].points) {
      if (!point.drawn()) continue;
      const std::string at = place(point);
      const std::size_t comma = at.find(',');
      markup += "<circle cx=\"" + at.substr(0, comma) + "\" cy=\"" + at.substr(comma + 1) + "\" r=\"6\"><title>" +
                xml_text(words(i, point)) + "</title></circle>";
    }
    return markup + "</g>";
  }

  const ChartRequest& request_;
  const Frame& frame_;
  ChartSpans spans_;
};

}  // namespace

ChartOverlay chart_overlay(const ChartRequest& request, std::string_view svg) {
  constexpr std::size_t most_points = 3000;
  std::size_t points = 0;
  for (const ChartCurve& curve : request.curves) points += curve.points.size();
  const std::optional<Frame> frame = frame_of(svg);
  if (!frame || points > most_points) return {};
  const Overlay overlay(request, *frame);
  return {overlay.layer(), overlay.buttons()};
}

}  // namespace rollres
