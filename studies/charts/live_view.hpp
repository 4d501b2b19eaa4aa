#pragma once

/// How far a stored study is, for people who watch it grow while other processes compute: how much is done, when the
/// rest will be, what failed, and its curves up to now.

#include <string>

#include "db/rows/result_store.hpp"

namespace rollres {

struct LiveProgress {
  StudySummary study;
  double rate = 0;        ///< answers a second, by the newest 60; 0: not known
  double since_last = 0;  ///< seconds since the newest answer; NaN without one
  bool done() const { return study.answered >= study.points; }
};

/// @param now  seconds since 1970, UTC
/// @throws std::invalid_argument if there is no such study
LiveProgress live_progress(ResultStore& store, const std::string& study, double now);

/// "rubber: 57 of 180 answered, 2 failed, 12.3/s, 0:10 left".
std::string in_words(const LiveProgress& progress);

/// The line, a bar, why points failed, and the study's chart as letters; `width` letters at most.
std::string live_view(ResultStore& store, const LiveProgress& progress, std::size_t width, std::size_t height);

}  // namespace rollres
