#pragma once

/// What scatters in a study, as text and as JSON. For sources only: it needs nlohmann_json.

#include <iosfwd>
#include <string>
#include <vector>

#include "studies/stored/scatter_results.hpp"
#include "studies/text/strict_json.hpp"

namespace rollres {

/// What is wanted of a study whose inputs scatter.
struct ScatterWish {
  std::vector<Formula> outputs;
  std::vector<Condition> conditions;                    ///< whose probability is wanted
  std::vector<double> probabilities = {0.1, 0.5, 0.9};  ///< of the quantiles
};

struct ScatterReport {
  const Study& study;
  ScatterWish wish;
  ScatterResults results;

  Body body() const { return body_of(study.base); }
};

/// The name of a quantile: "P10" of 0.1, "P2.5" of 0.025.
std::string quantile_name(double probability);

/// A number with its error, both to the second digit of the error: "401.12 ± 0.31"; the number alone without an error.
std::string with_error(const ScatterEstimate& estimate, double factor = 1);

/// The values of the axes at a place: "V = 1 m/s, load 20 kN/m"; empty without axes.
std::string place_in_words(const ScatterReport& report, const ScatterPlace& place);

/// What scatters, a table for each output, the probabilities.
void print_text(const ScatterReport& report, std::ostream& out);

Json json_of(const ScatterReport& report);

}  // namespace rollres
