#pragma once

/// What the program must reproduce, asked live: numbers of Zehil and Gavin (2013), closed forms, tables of others, the
/// balance of power, and one method against another.
///
/// What is expected comes from core/reference, which uses no solver, or is a number that its source printed.

#include "core/solve/rolling_contact.hpp"

namespace rollres {

struct VerificationRow {
  std::string quantity;  ///< "paper's cylinder: mean pressure"
  std::string source;    ///< "Zehil and Gavin (2013), 5.1"
  std::string unit;      ///< of the two numbers, SI
  double expected = 0;
  double got = 0;           ///< NaN: no answer
  double tolerance = 0;     ///< of the difference
  std::string allowance;    ///< what the tolerance allows for
  std::string reason = {};  ///< why there is no answer

  /// |got/expected - 1|; where zero is expected, |got|.
  double difference() const;
  bool passed() const { return difference() <= tolerance; }  ///< NaN does not pass
};

/// All rows, some seconds of work. A scene without an answer is a row that does not pass.
/// @param evaluate solves a scene
std::vector<VerificationRow> verify(const Evaluate& evaluate);

}  // namespace rollres
