#pragma once

/// SQLite as the sources of this chapter see it; no other header includes it.

#include <SQLiteCpp/SQLiteCpp.h>
#include <SQLiteCpp/Savepoint.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace rollres {

/// Does `work`, and puts the file's name before SQLite's own words where it fails.
template <class Work>
auto naming(const std::string& file, Work&& work) -> decltype(work()) {
  try {
    return std::forward<Work>(work)();
  } catch (const SQLite::Exception& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
}

}  // namespace rollres
