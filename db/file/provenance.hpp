#pragma once

/// What computed a result: stored beside it, so that a number can be traced to the program that made it.

#include <string>

namespace rollres {

struct Provenance {
  std::string version;   ///< of the program: "1.0.0"
  std::string git_hash;  ///< commit it was built from, "-dirty" if files were changed; "unknown" outside a repository
  std::string solver;  ///< digest of the sources that decide on answers (db/provenance.cmake): as long as it stays, so
                       ///< do the numbers
  std::string compiler;  ///< "GNU 12.2.0"
  std::string machine;   ///< name of the host and kind of its processor

  bool operator==(const Provenance&) const = default;
};

/// The program that runs.
const Provenance& this_program();

}  // namespace rollres
