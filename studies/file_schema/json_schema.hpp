#pragma once

/// JSON schemas (draft-07) of the files that the program reads, for editors: made from the list of inputs and from the
/// keys of each file, so that they hold what the readers accept. What joins several keys with their values, such as a
/// unit that fits the quantity, is left to the readers.

#include <string>

namespace rollres {

/// The schema of a scene file: keys, ranges, names, which keys are needed and which exclude each other.
std::string scene_schema();

/// The schema of a study file.
std::string study_schema();

/// The schema of a fit's file, of a scene or of a material.
std::string fit_schema();

/// The schema of an optimisation's file.
std::string optimisation_schema();

}  // namespace rollres
