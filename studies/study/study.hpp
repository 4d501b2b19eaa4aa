#pragma once

/// A study: one scene and what is varied of it. Every combination of the axes' values is one point.
///
///     {"study": "speed and load", "scene": "paper_cylinder.json", "set": {"method": "newton"},
///      "axes": {"speed": {"from": "1 mm/s", "to": "10 m/s", "points": 60, "spacing": "logarithmic"},
///               "load": ["10 kN/m", "20 kN/m"]},
///      "chart": {"x": "speed", "y": "rolling_resistance", "family": "load"}}
///
/// `scene` is the name of a scene file, relative to the study file, or the scene itself; `set` replaces inputs of it as
/// `--set` does. Every input can be an axis: `from`, `to` and `points` with linear (the default) or logarithmic
/// spacing, or a list; a choice such as `method` is a list of names. A zip lets several inputs vary together, its first
/// point being the first value of each:
///
///     "axes": {"layer": {"zip": {"layer_thickness": ["5 mm", "10 mm"], "static_shear_modulus": ["1 MPa", "2 MPa"]}}}
///
/// Numbers that go with them and are no inputs are columns of the study, as formulas are:
///
///     "axes": {"cycle": {"zip": {"load": ["5 kN", "8 kN"]}, "columns": {"share": [0.7, 0.3]}}}
///
/// Inputs that go together and need a name are the variants of an axis of their own, which varies slowest; its values
/// are their names (study_variants.hpp):
///
///     "axes": {"variant": {"soft": {"static_shear_modulus": "1 MPa", "creep_time": "1 ms"},
///                          "hard": {"material": "master_curve", "master_curve_file": "hard.csv"}}, "speed": [1, 2]}
///
/// Inputs of further layers are "coating_layers[0].layer_thickness", counted from 0; the scene must have the layer.
///
/// A sample spreads points over a box, in place of axes or beside them; every point of the sample is then combined with
/// every combination of the axes:
///
///     "sample": {"method": "sobol", "points": 64, "seed": 0,
///                "ranges": {"layer_thickness": {"from": "2 mm", "to": "20 mm", "spacing": "logarithmic"},
///                           "static_shear_modulus": {"from": "1 MPa", "to": "5 MPa"}}}
///
/// `uncertain` lets inputs scatter (uncertain_inputs.hpp); its points, too, are combined with every combination of the
/// axes.
///
/// `constraints` are conditions between inputs; points that break one are dropped:
///
///     "constraints": ["layer_thickness <= radius / 2", "speed >= 36 km/h"]
///
/// `compute` lists the outputs that the study is about, in the order of its tables, and formulas of inputs and outputs
/// with a name, which are columns as outputs are: ["rolling_resistance", {"deborah": "speed * creep_time / radius"}].
/// They are computed when they are read, from what is stored. `fields` keeps the fields of every
/// solution; `charts` is a list of charts, each as `chart` and with a `name`; {"map": OUTPUT, "x": AXIS, "y": AXIS} is
/// one too. study_keys.hpp lists all keys.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "studies/scene_io/formula.hpp"
#include "studies/study/uncertain.hpp"

namespace rollres {

/// The values that one input takes.
struct Axis {
  std::string key;
  std::vector<double> values = {};      ///< [SI unit of the key]; empty for a choice
  std::vector<std::string> texts = {};  ///< names, for a choice; empty for a number
  bool logarithmic = false;             ///< spaced so; a chart draws it so
  std::string group = {};               ///< neighbours of one group vary together and are of one size; empty: alone

  std::size_t size() const { return values.empty() ? texts.size() : values.size(); }
};

/// What a chart of the study shows; empty where the file says nothing.
struct StudyChart {
  std::string name;      ///< by which a chart is asked for
  std::string x;         ///< an axis or an output
  std::string y;         ///< an output
  std::string family;    ///< the axis with one curve for each of its values
  std::string map = {};  ///< an output: a contour map of it over x and y, two axes, in place of curves
};

/// A named set of inputs that go together, with all others.
struct Variant {
  std::string name;
  RollingScene base;  ///< as that of a study
};

struct Study {
  std::string name;
  RollingScene base;  ///< inputs that are axes hold one of their values; what only some drives of an axis use is kept
  std::vector<Axis> axes;                   ///< if there are variants, the first is "variant"
  std::vector<Variant> variants = {};       ///< empty where the file has none; the base is then that of the first
  std::vector<Condition> constraints = {};  ///< of inputs
  std::vector<std::string> compute = {};    ///< outputs and formulas by name; empty where the file says nothing
  FormulaDefinitions formulas = {};         ///< of `compute`
  bool fields = false;                      ///< keep the fields of every solution
  std::vector<StudyChart> charts = {};
  UncertainInputs uncertain = {};  ///< their points are the last axes
  std::string source = {};         ///< where the study was read from, for messages
  std::string definition = {};     ///< text of a study file that needs no other: the scene stands in it in full
};

/// Reads a study file. Its values are checked one by one; StudyPlan checks them together, at every point.
/// @throws std::invalid_argument one line naming file, key, value and the rule that is broken
/// @throws std::runtime_error if the study file or its scene file cannot be read
Study read_study(const std::filesystem::path& file);

/// @throws std::invalid_argument if the formula asks for a number of the inside and no scene of the study has
/// `interior`
void refuse_never_computed(const Formula& formula, const Study& study);

/// The points of a study: the combinations of its axes' values that meet all constraints. Their scenes are made when
/// they are asked for.
class StudyPlan {
 public:
  /// Every combination, the last axis varying fastest. An axis that gives one of load and approach, or of spacing and
  /// tolerance, replaces the other.
  /// @throws std::invalid_argument naming the point and the rule if a scene breaks one, or saying that no point is left
  explicit StudyPlan(const Study& study);

  std::size_t size() const { return combinations_.size(); }
  RollingScene scene(std::size_t point) const;
  /// The place of a point among all combinations of the axes, those that constraints drop included.
  std::size_t combination(std::size_t point) const { return combinations_.at(point); }
  /// Calls `visit(point, scene)` for all points in their order: faster than `scene` for each.
  void for_each(const std::function<void(std::size_t point, const RollingScene& scene)>& visit) const;
  /// evaluation_key of every point.
  std::vector<std::string> keys() const;
  /// Name of every point's variant; empty if the study has none.
  std::vector<std::string> variants() const;

  /// At each constraint, in their order: how many combinations break it that meet those before it.
  const std::vector<std::size_t>& dropped() const { return dropped_; }
  std::size_t all_dropped() const;

 private:
  std::vector<RollingScene> bases_;  // one, or of each variant
  std::vector<Axis> axes_;
  std::vector<std::uint32_t> combinations_ = {};  // of the points, counted from 0
  std::vector<std::size_t> dropped_;
};

}  // namespace rollres
