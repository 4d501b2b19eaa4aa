#include "studies/figures/field_collection.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include "core/newton/surface_window.hpp"
#include "core/scene/scene_input.hpp"
#include "studies/figures/figure.hpp"
#include "studies/scene_io/cells.hpp"
#include "studies/scene_io/fields_file.hpp"
#include "studies/stored/study_rows.hpp"
#include "studies/text/files.hpp"
#include "studies/text/readable_number.hpp"
#include "studies/text/strict_json.hpp"
#include "studies/text/words.hpp"

namespace rollres {

namespace {

/// A point of a collection.
struct TimedFile {
  double time;
  std::string file;
};
/// By the values of the other axes: "_load=20 kN/m".
using TimedFiles = std::map<std::string, std::vector<TimedFile>>;

std::string chosen_axis(const StudySummary& study, const std::string& wish) {
  if (wish.empty()) return study.axes.empty() ? "" : study.axes.front();
  if (std::find(study.axes.begin(), study.axes.end(), wish) != study.axes.end()) return wish;
  const std::vector<std::string_view> names(study.axes.begin(), study.axes.end());
  throw std::invalid_argument("--axis = " + wish + ": " + unknown("is no axis of " + study.name, names, wish));
}

std::string unit_of_input(std::string_view key, const RollingScene& scene) {
  std::string unit;
  visit_input(scene, key, [&](const Quantity& quantity, const auto&) { unit = quantity.unit_for(scene.indenter); });
  return unit;
}

/// Times of the values of an axis; names are counted in the order in which they come.
class AxisTimes {
 public:
  double operator()(const Cell& cell) {
    if (const auto* const number = std::get_if<double>(&cell)) return *number;
    if (const auto* const count = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*count);
    const std::string name = value_in_words(cell, "");
    const auto found = std::find(names_.begin(), names_.end(), name);
    const auto place = found - names_.begin();
    if (found == names_.end()) names_.push_back(name);
    return static_cast<double>(place);
  }

 private:
  std::vector<std::string> names_;
};

std::string xml_text(std::string_view text) {
  return replaced(text, {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}});
}

std::string collection_text(const std::vector<TimedFile>& files) {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const TimedFile& file : files)
    text += "<DataSet timestep=\"" + shortest(file.time) + "\" part=\"0\" file=\"" + xml_text(file.file) + "\"/>\n";
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace

FieldCollections write_field_collections(ResultStore& store, const StudySummary& study, const std::string& axis,
                                         const std::filesystem::path& directory) {
  FieldCollections written;
  written.axis = chosen_axis(study, axis);
  const std::string base = file_name(study.name);
  TimedFiles collections;
  AxisTimes times;
  std::size_t position = 0;
  for (const std::string& key : store.points(study.name)) {
    ++position;
    std::optional<StoredEvaluation> answer = store.find(key);
    if (!answer || answer->solution.status != Status::converged) continue;
    std::optional<SurfaceFields> fields = store.find_fields(key);
    if (!fields) {
      ++written.without_fields;
      continue;
    }
    if (written.points == 0) make_directory(directory / base);
    answer->solution.fields = std::move(*fields);
    std::string number = std::to_string(position);
    number.insert(0, number.size() < 4 ? 4 - number.size() : 0, '0');
    const std::string file = base + "/" + number + ".vti";
    write_file(directory / file,
               fields_vti(answer->scene, surface_around(answer->scene, answer->solution, figure_margin)));
    std::string others;
    for (const std::string& other : study.axes)
      if (other != written.axis)
        others +=
            "_" + other + "=" + value_in_words(input_of(answer->scene, other), unit_of_input(other, answer->scene));
    const double time =
        written.axis.empty() ? static_cast<double>(position) : times(input_of(answer->scene, written.axis));
    collections[others].push_back({time, file});
    ++written.points;
  }
  if (collections.size() == written.points && written.points > 1) {
    TimedFiles all;
    for (const auto& [others, files] : collections) all[""].push_back(files.front());
    collections = std::move(all);
  }
  for (auto& [others, files] : collections) {
    std::stable_sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
    const std::string name = file_name(study.name + others);
    std::filesystem::path file = directory / (name + ".pvd");
    for (int again = 2; std::find(written.files.begin(), written.files.end(), file) != written.files.end(); ++again)
      file = directory / (name + "_" + std::to_string(again) + ".pvd");  // names that had to be cut
    written.files.push_back(file);
    write_file(written.files.back(), collection_text(files));
  }
  return written;
}

}  // namespace rollres
