#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "db/queries/query.hpp"
#include "db/rows/schema.hpp"

/// The rows of a study without what differs from run to run.
inline std::vector<std::vector<rollres::Cell>> stored_rows(const std::filesystem::path& file,
                                                           const std::string& study) {
  using namespace rollres;
  const Database database = open_database(file, Access::read);
  const Query query{.filters = {{"study", Comparison::equal, study}}};
  Query lasting = query;
  for (const std::string& column : run_query(database, query).columns)
    if (column != "id" && column != "created" && column != "seconds" && column != "provenance")
      lasting.columns.push_back(column);
  return run_query(database, lasting).rows;
}
