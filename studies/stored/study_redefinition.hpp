#pragma once

/// A study that is started under a name that stands in the database already: the same study goes on, one that is
/// defined otherwise would push points of the former one out of it, which must be asked for.

#include <optional>
#include <span>
#include <string>

#include "db/rows/result_store.hpp"

namespace rollres {

/// What differs between two study files, for a message: `scene.creep_time "0.1 s" -> "0.2 s"`, the first few of them.
/// Comments, names and what is only drawn do not count; empty if nothing else differs.
/// @param former, later  texts; one that is no JSON object differs as a whole
std::string changes_between(const std::string& former, const std::string& later);

/// A former definition that a start replaces.
struct Redefinition {
  std::string changes;   ///< as above
  std::size_t left = 0;  ///< points that leave the study; their rows stay

  std::string in_words() const;
};

/// What starting the study replaces; nothing if there is none of its name, it is defined alike, or each of its points
/// stays.
/// @param keys  of the new points, where they are known; an optimisation has none before it runs
/// @throws std::invalid_argument saying what changed and what to do, if something is replaced and that is not asked for
std::optional<Redefinition> start_again(ResultStore& store, const StudyRecord& study, std::span<const std::string> keys,
                                        bool replace);

}  // namespace rollres
