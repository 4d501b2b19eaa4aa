#pragma once

/// Formulas of the numbers of a scene and its solution, as people write them in study files:
///
///     "rolling_resistance * speed"            an objective
///     "approach / layer_thickness <= 0.1"     a condition
///     "peak_pressure <= 2 MPa"                the right side may have a unit where the left side is one quantity
///
///     "rolling_resistance + 2 [kN/m2] * approach"   a number with its unit, in brackets
///
/// Names are keys of inputs and outputs; numbers without a unit have none, and terms must fit. + - * / ^ ( ), min, max,
/// abs, sqrt, exp, ln, log10 and the rest of muParser's functions, `a < b ? c : d`. A key that is an input and an
/// output (load, approach, ...) stands for the output where there is one, else for the input. Inputs of further layers
/// are coating_layers[0].layer_thickness.

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/scene/solution.hpp"
#include "studies/text/unit_in_si.hpp"

namespace rollres {

/// Keys that a formula may name.
enum class FormulaNames { inputs, inputs_and_outputs };

/// Keys of all inputs, or of all inputs and outputs, that are numbers; without those of further layers.
std::vector<std::string_view> number_keys(FormulaNames names);

/// Names that stand for formulas, and these.
using FormulaDefinitions = std::vector<std::pair<std::string, std::string>>;

/// The text with the formula of each such name, in brackets, in its place.
std::string with_definitions(std::string_view text, const FormulaDefinitions& definitions);

/// Whether formulas know a function of this name, or the number pi.
bool is_function(const std::string& name);

/// A number with a unit in a formula: "2 [kN/m2]".
struct FormulaConstant {
  double value;             ///< [SI]
  UnitExponents exponents;  ///< of its unit
};

/// A formula that was understood. Copies share what was understood; it may be used by several threads.
class Formula {
 public:
  /// @param definitions  names that it may use, too
  /// @throws std::invalid_argument "text: what is wrong with it", naming the nearest key for an unknown one
  Formula(const std::string& text, FormulaNames names, const FormulaDefinitions& definitions = {});

  const std::string& text() const;
  const std::vector<std::string>& keys() const;  ///< that it uses, each once

  /// Its value [SI]; NaN if a number that it uses is absent.
  double operator()(const RollingScene& scene, const RollingSolution& solution) const;
  double operator()(const RollingScene& scene) const;  ///< of inputs alone; what is an output is absent
  /// Of whatever numbers its keys have [SI].
  double operator()(const std::function<double(const std::string& key)>& number_of_key) const;

  const std::vector<FormulaConstant>& constants() const;
  /// The same with each constant times a factor, one for each.
  double operator()(const std::function<double(const std::string& key)>& number_of_key,
                    std::span<const double> factors) const;

 private:
  struct Parts;
  std::shared_ptr<Parts> parts_;
};

/// @throws std::invalid_argument naming the formula and the units in it if its terms have different ones, or a limit in
/// it that looks as if it were in mm, MPa or degC
void refuse_different_units(const Formula& formula, Body body);

/// @throws std::invalid_argument naming the formula and the first of its outputs that no answer to the scene has
void refuse_absent(const Formula& formula, const RollingScene& scene);

/// The unit of a formula's value (dimension.hpp); empty if its terms have different ones.
std::string unit_of(const Formula& formula, Body body);

/// A condition between two formulas.
class Condition {
 public:
  /// @param text         "LEFT <= RIGHT" with <= < >= or >
  /// @param body     whose units hold
  /// @param definitions  names that it may use, too
  /// @throws std::invalid_argument as Formula, or if there is not one comparison, or if a side is a number without a
  /// unit that looks as if it were in mm, MPa or degC
  Condition(const std::string& text, FormulaNames names, Body body, const FormulaDefinitions& definitions = {});

  const std::string& text() const { return text_; }
  const Formula& left() const { return left_; }
  const Formula& right() const { return right_; }
  bool at_most() const { return at_most_; }  ///< <= or <, not >= or >

  /// How far left exceeds right (<=, <) or falls short of it (>=, >) [unit of the left side]: at most 0 where the
  /// condition holds (below 0 for < and >), NaN if a number is absent.
  double excess(const RollingScene& scene, const RollingSolution& solution) const;
  bool holds(const RollingScene& scene, const RollingSolution& solution) const;
  double excess(const RollingScene& scene) const;  ///< of inputs alone
  bool holds(const RollingScene& scene) const;
  /// Whether an excess is one with which the condition holds.
  bool holds_with(double excess) const { return strict_ ? excess < 0 : excess <= 0; }

 private:
  std::string text_;
  std::size_t sign_;  // its place in the text
  bool at_most_;      // left <= right, or left < right
  bool strict_;
  Formula left_, right_;
};

}  // namespace rollres
