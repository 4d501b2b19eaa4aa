#include "studies/drawing/chart.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "studies/drawing/gnuplot.hpp"
#include "studies/drawing/peak_values.hpp"
#include "studies/drawing/thinned_chart.hpp"
#include "studies/text/files.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/words.hpp"
#include "studies/text/xml_text.hpp"

namespace rollres {

namespace {

/// Which points of a curve bear a mark: all of a short one; of a long one every n-th, shifted from curve to curve, and
/// those that no line reaches.
std::vector<bool> marked(const ChartCurve& curve, std::size_t number) {
  const std::vector<ChartPoint>& points = curve.points;
  constexpr std::size_t enough = 16;
  const std::size_t step = (points.size() + enough - 1) / enough;
  std::vector<bool> marks(points.size(), false);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool alone = !(i > 0 && points[i - 1].joined()) && !(i + 1 < points.size() && points[i + 1].joined());
    marks[i] = alone || (curve.marks && (i + number) % step == 0);
  }
  return marks;
}

/// An SVG whose title and description, which gnuplot fills with its own name, say what it shows.
std::string with_words(std::string svg, const PictureWords& words) {
  const auto fill = [&](const std::string& tag, const std::string& text) {
    const std::size_t begin = svg.find("<" + tag + ">"), end = svg.find("</" + tag + ">");
    if (text.empty() || begin == std::string::npos || end == std::string::npos || end < begin) return;
    svg.replace(begin, end - begin, "<" + tag + ">" + xml_text(text));
  };
  fill("title", words.title);
  fill("desc", words.description);
  return svg;
}

/// "rolling resistance [N/m] against speed [m/s], one curve for each load: 10 kN/m, 20 kN/m"
std::string description_of(const ChartRequest& request) {
  const auto named = [](const ChartAxis& axis) { return axis.name + unit_in_brackets(axis.unit); };
  std::string text = named(request.y) + " against " + named(request.x);
  if (!request.subtitle.empty()) text += ", " + request.subtitle;
  if (request.curves.size() > 1) {
    text += request.family.name.empty() ? "; curves: " : ", one curve for each " + request.family.name + ": ";
    for (const ChartCurve& curve : request.curves)
      text += (&curve == &request.curves.front() ? "" : ", ") + curve.label;
  }
  const ChartSpans spans = chart_spans(request);
  for (const ChartCurve& curve : request.curves)
    if (const auto top = request.lines && request.mark_peaks ? curve_peak(curve, spans) : std::nullopt)
      text +=
          "; peak " + (curve.label.empty() ? "" : "at " + curve.label + " ") + top->y_text(4) + " at " + top->x_text();
  return text;
}

/// Whether a file ends as SVG, PNG or GIF do.
bool ends_as_a_picture(const std::filesystem::path& file) {
  constexpr std::streamoff tail = 64;
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  in.seekg(-std::min<std::streamoff>(tail, in.tellg()), std::ios::end);
  const std::string end((std::istreambuf_iterator<char>(in)), {});
  if (file.extension() == ".gif") return end.ends_with(std::string_view("\0;", 2));  // an empty block, the trailer
  return end.find(file.extension() == ".png" ? "IEND" : "</svg>") != std::string::npos;
}

}  // namespace

std::optional<std::size_t> peak(const ChartCurve& curve) {
  const auto& points = curve.points;
  std::optional<std::size_t> highest;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].joined() && (!highest || points[i].y > points[*highest].y)) highest = i;
  if (!highest || *highest == 0 || *highest + 1 == points.size()) return std::nullopt;
  if (!points[*highest - 1].joined() || !points[*highest + 1].joined()) return std::nullopt;
  return highest;
}

ChartFiles chart_files(const std::filesystem::path& name) {
  refuse_other_kind(name, {".svg", ".png", ".gp", ".dat"});
  const std::string suffix = name.extension().string();
  const bool ours = suffix == ".svg" || suffix == ".png" || suffix == ".gp" || suffix == ".dat";
  const std::string stem = (ours ? name.stem() : name.filename()).string();
  const std::string full = name.string();
  if (stem.empty() || stem == "." || stem == "..")
    throw std::invalid_argument("\"" + full + "\": must be the name of a file");
  if (any_of(full, [](unsigned char letter) { return letter < 0x20 || letter == 0x7f; }))
    throw std::invalid_argument("\"" + full + "\": the name of a chart must have no control characters");
  const auto beside = [&](const char* ending) { return name.parent_path() / (stem + ending); };
  return {beside(".gp"), beside(".dat"), beside(".svg"), beside(".png")};
}

std::filesystem::path one_of_several(const std::filesystem::path& name, const std::string& ending) {
  const std::filesystem::path script = chart_files(name).script;  // its suffix is known
  return script.parent_path() / (script.stem().string() + "_" + file_name(ending) + ".svg");
}

std::string chart_data(const ChartRequest& request) {
  std::ostringstream data;
  const auto comment = [&](std::string_view text) {
    data << "# ";
    for (const char letter : text) data << (letter == '\n' ? std::string_view("\n# ") : std::string_view(&letter, 1));
    data << "\n";
  };
  const auto named = [](const ChartAxis& axis) { return axis.name + (axis.symbol.empty() ? "" : " " + axis.symbol); };
  const auto described = [&](const ChartAxis& axis) {
    return named(axis) + (axis.unit.empty() ? "" : " [" + axis.unit + "]");
  };
  comment(request.title);
  if (!request.subtitle.empty()) comment(request.subtitle);
  if (!request.comment.empty()) comment(request.comment);
  comment("column 1: " + described(request.x));
  comment("column 2: " + described(request.y));
  comment(request.hollow == not_converged ? "column 3: 1 if converged, else 0"
                                          : "column 3: 0 if it " + request.hollow + ", else 1");
  comment("column 4: 1 if the curve bears a mark here");
  const bool areas = any_of(request.curves, [](const ChartCurve& curve) {
    return any_of(curve.points, [](const auto& point) { return point.area(); });
  });
  if (areas) comment("column 5, 6: ends of " + (request.areas.empty() ? "the curve's part" : request.areas));
  for (std::size_t i = 0; i < request.curves.size(); ++i) {
    const ChartCurve& curve = request.curves[i];
    if (i > 0) data << "\n\n";
    comment(named(request.family) + (request.family.name.empty() ? "" : " = ") + curve.label);
    const std::vector<bool> marks = request.lines && curve.line && request.marks
                                        ? marked(curve, i)
                                        : std::vector<bool>(curve.points.size(), !request.lines || !curve.line);
    for (std::size_t j = 0; j < curve.points.size(); ++j) {
      const ChartPoint& point = curve.points[j];
      data << short_number(point.x, 15) << " " << (point.drawn() ? short_number(point.y, 15) : "NaN") << " "
           << (point.converged ? 1 : 0) << " " << (marks[j] ? 1 : 0);
      if (areas && point.joined() && point.area())
        data << " " << short_number(point.low, 15) << " " << short_number(point.high, 15);
      else if (areas)
        data << " NaN NaN";
      data << "\n";
    }
    if (curve.points.empty()) data << "NaN NaN 0 0\n";  // keeps the count of the blocks
  }
  return data.str();
}

void run_script(const std::filesystem::path& script, const std::vector<std::filesystem::path>& pictures,
                const std::string& gnuplot) {
  std::error_code error;
  for (const auto& picture : pictures) std::filesystem::remove(picture, error);
  gnuplot::run(script, gnuplot);
  for (const auto& picture : pictures) {
    if (const auto size = std::filesystem::file_size(picture, error); error || size == 0)
      throw std::runtime_error(picture.string() + ": " + gnuplot + " ended well but drew nothing");
    if (ends_as_a_picture(picture)) continue;
    std::filesystem::remove(picture, error);
    throw std::runtime_error(picture.string() + ": " + gnuplot + " ended well but the picture is cut off: disk full?");
  }
}

void draw_pictures(const ChartFiles& files, const std::string& data, const std::string& script,
                   const PictureWords& words, const std::string& gnuplot) {
  if (const auto folder = files.script.parent_path(); !folder.empty()) make_directory(folder);
  write_file(files.data, data);
  write_file(files.script, script);
  run_script(files.script, {files.svg, files.png}, gnuplot);
  write_file(files.svg, with_words(content_of(files.svg), words));
}

ChartFiles draw_chart(const ChartRequest& asked, const std::filesystem::path& name, const std::string& gnuplot) {
  const ChartRequest request = thinned(asked);
  ChartFiles files = chart_files(name);
  const bool something = any_of(request.curves, [](const ChartCurve& curve) {
    return any_of(curve.points, [](const auto& point) { return point.drawn(); });
  });
  if (!something)
    throw std::invalid_argument(request.title + ": nothing to draw, no point has a value of " + request.y.name);
  draw_pictures(files, chart_data(request), chart_script(request, files), {request.title, description_of(request)},
                gnuplot);
  return files;
}

}  // namespace rollres
