#include "studies/scene_io/cells.hpp"

#include <cmath>

#include "core/messages/number_list.hpp"
#include "core/scene/scene_input.hpp"
#include "db/rows/layer_list.hpp"
#include "studies/text/words.hpp"

namespace rollres {

Cell cell_of(double value) { return std::isnan(value) ? Cell() : Cell(value); }
Cell cell_of(const std::optional<double>& value) { return value ? cell_of(*value) : Cell(); }
Cell cell_of(const std::vector<double>& list) { return list.empty() ? Cell() : Cell(text_of_list(list)); }
Cell cell_of(const BondedLayers& layers) { return layers.empty() ? Cell() : Cell(text_of_layers(layers)); }
Cell cell_of(const std::string& text) { return text.empty() ? Cell() : Cell(text); }
Cell cell_of(const std::vector<std::string>& lines) { return cell_of(joined(lines, "\n")); }

Cell input_of(const RollingScene& scene, std::string_view key) {
  Cell cell;
  visit_input(scene, key, [&](const Quantity&, const auto& value) { cell = cell_of(value); });
  return cell;
}

Cell output_of(const RollingSolution& solution, std::string_view key) {
  Cell cell;
  visit_outputs(solution, [&](const Quantity& quantity, const auto& value) {
    if (quantity.key == key) cell = cell_of(value);
  });
  return cell;
}

NamedCells input_cells(const RollingScene& scene) {
  NamedCells cells;
  visit_inputs(scene,
               [&](const Quantity& quantity, const auto& value) { cells.emplace_back(quantity.key, cell_of(value)); });
  return cells;
}

}  // namespace rollres
