#pragma once

/// The stored fields of a study for ParaView: an image data file for each point, and collections that make a film of
/// them, with the value of an axis as the time.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "db/rows/result_store.hpp"

namespace rollres {

struct FieldCollections {
  std::string axis;                          ///< whose value is the time
  std::vector<std::filesystem::path> files;  ///< the collections
  std::size_t points = 0;                    ///< in them
  std::size_t without_fields = 0;            ///< answered points whose fields are not stored
};

/// Writes STUDY/0001.vti, ... (the surface around the contact, one file for each point with fields) and STUDY.pvd, a
/// VTK collection in the order of the axis; with several axes one collection for each combination of the others,
/// STUDY_load=20_kN_m.pvd. Where that leaves one point to each (a sample, axes that vary together) there is one for
/// all. The time of an axis of names is their place, counted from 0.
/// @param axis a key of the study's axes; empty: the first
/// @throws std::invalid_argument if the study has no such axis
/// @throws std::runtime_error naming the file or folder that failed
FieldCollections write_field_collections(ResultStore& store, const StudySummary& study, const std::string& axis,
                                         const std::filesystem::path& directory);

}  // namespace rollres
