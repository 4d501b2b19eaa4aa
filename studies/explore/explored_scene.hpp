#pragma once

/// A scene that is moved by hand: its inputs described for a page, its answer with what a sketch needs, curves through
/// it, its materials. For sources only: it needs nlohmann_json.

#include "core/solve/rolling_contact.hpp"
#include "studies/drawing/chart.hpp"
#include "studies/run/stored_evaluations.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// All inputs and outputs as their lists have them: "inputs" with the group that each stands in, "layer" the keys of a
/// further layer, "outputs" the numbers of an answer; "tables" the keys that name files, "figures" what can be drawn.
Json quantities_for_pages();

/// The scene with the names of its files relative to `folder`, or with their contents where they lie elsewhere.
/// @throws as read_scene
Json scene_for_pages(const std::string& file, const std::filesystem::path& folder);

/// The answer as `rollres solve --json` has it under "answer", with the coordinates of a sketch under "surface": the
/// places x of the nodes in the middle of the contact and beside it, displacement w of the layers, pressure, shear and
/// zone; "coating_yields" tells which of both bodies is dented; "decisions" is the text of the model.
Json answer_for_pages(const RollingScene& scene, const RollingSolution& solution);

/// A scene that is answered in a fraction of the time, for a first look: null where the scene itself is quick.
std::optional<RollingScene> coarse_scene(const RollingScene& scene);

/// One output against one input. Its answers are those of `solve` to the scene with that input.
struct ExploredCurve {
  std::string x, y;         ///< keys
  double from = 0, to = 0;  ///< [SI]
  std::size_t points = 60;
  bool logarithmic = false;
};

/// @throws std::invalid_argument naming the key, value and rule that is broken
ExploredCurve explored_curve(const Json& wish, const std::string& place);

/// The values of x and y and what is known of their error; null where there is no answer. @param stop asked all the
/// time
/// @throws Interrupted once stop says yes
Json curve_for_pages(const RollingScene& scene, const ExploredCurve& curve, StoredEvaluations& evaluations,
                     const std::function<bool()>& stop);

/// A chart as data, in the units of its axes.
Json chart_for_pages(const ChartRequest& chart);

/// G' and G" of each layer as "charts", and the "frequency" of the contact [Hz], null where none is to be had.
Json materials_for_pages(const RollingScene& scene);

}  // namespace rollres
