#pragma once

/// Bringing databases together: the shards of a study, or what somebody else has computed.
///
/// A row is the same in both files if its identity is: the key of an evaluation, the name of a study, otherwise the
/// columns of the table's UNIQUE constraint; numbers of rows are the file's own and are given anew. So merging again
/// changes nothing, and the order of sources matters only where they contradict each other:
///
///     evaluation   the row that is there stays, unless it has not converged and the source's has. Two that have both
///                  converged but differ by more than rounding are a conflict: the first stays
///     study        the one that was started last gives points, axes and definition; one of the same name that is
///                  defined otherwise, so that points would be lost, comes as "NAME 2"
///     other tables rows that belong to (refer to) a row of another table come with it as a whole, if the file has none
///                  that belong to that row; tables that this version does not know are treated in the same way

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "db/file/database.hpp"

namespace rollres {

struct MergeConflict {
  std::string key;     ///< of the evaluation
  std::string column;  ///< output that differs most
  double kept = 0, other = 0;
};

struct MergeReport {
  std::size_t evaluations = 0;  ///< in the source
  std::size_t added = 0;        ///< that were new
  std::size_t replaced = 0;     ///< that had not converged before
  std::size_t studies = 0;      ///< added, or taken over because they were started later
  std::vector<std::pair<std::string, std::string>> renamed =
      {};  ///< studies defined otherwise there: name, and new name
  std::vector<MergeConflict> conflicts;
};

/// Differences of converged outputs beyond this are conflicts: relative, and absolute for outputs of unit 1, which are
/// relative to something already.
constexpr double merge_tolerance = 1e-9;

/// Copies what `into` lacks, in one transaction. The source is only read, in one state of it, also while another
/// process writes to it; one of an older schema is brought up to date in a temporary copy.
/// @param study  only this study, with its evaluations and what belongs to them
/// @throws std::invalid_argument if the source is `into` itself, or has no such study
/// @throws std::runtime_error naming the file that failed; `into` is then as it was
MergeReport merge(const Database& into, const std::filesystem::path& source,
                  const std::optional<std::string>& study = {});

/// Writes one study of a database, as `merge` does, into a new file, whole or not at all: a single file without a log,
/// which can be read where nobody may write.
void extract_study(const std::filesystem::path& source, const std::string& study, const std::filesystem::path& file);

}  // namespace rollres
