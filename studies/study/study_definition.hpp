#pragma once

/// What a study file that is kept in a database says about its pictures and tables. The scene file that it names need
/// not be there any more, so this is read without it.

#include <set>
#include <string>
#include <vector>

#include "studies/study/study.hpp"

namespace rollres {

struct StudyDefinition {
  std::string comment = {};                     ///< what the study is about; may be empty
  std::vector<StudyChart> charts;               ///< at least one; it is empty where the file has none
  std::vector<std::string> compute;             ///< outputs and formulas; empty where the file says nothing
  FormulaDefinitions formulas;                  ///< of `compute`
  FormulaDefinitions goals = {};                ///< "goal" and "second_goal" of an optimisation
  std::set<std::string> logarithmic;            ///< inputs that are spaced so
  std::vector<std::set<std::string>> together;  ///< inputs that vary together
  std::set<std::string> sampled;                ///< inputs of a sample
  std::set<std::string> uncertain = {};         ///< inputs that scatter

  /// Whether two inputs vary together.
  bool are_together(const std::string& one, const std::string& other) const;

  /// The chart with this name, or with this number, from 1 on; the first for an empty name.
  /// @param place  for messages
  /// @throws std::invalid_argument naming the charts that there are
  const StudyChart& chart(const std::string& name, const std::string& place) const;

  /// Name of each chart, or its number where it has none.
  std::vector<std::string> chart_names() const;
};

/// The outputs and formulas that the charts of the file show, each once. @param axes  of the study: they are left out
std::vector<std::string> charted_numbers(const StudyDefinition& definition, const std::vector<std::string>& axes);

/// What a picture of the study is called: its comment, without what follows the first clause where it is long; without
/// a comment its name.
std::string title_of_study(const StudyDefinition& definition, const std::string& name);

/// @param text   of the study file; may be empty
/// @param place  for messages
/// @throws std::invalid_argument if the text is no JSON object
StudyDefinition definition_in(const std::string& text, const std::string& place);

}  // namespace rollres
