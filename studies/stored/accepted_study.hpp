#pragma once

/// Study and fit files that an earlier program accepted and stored, as this one accepts them: numbers that it asks a
/// unit for have that of the SI, and listed moduli, which were of shear unless something else was said, say so.

#include <string>

namespace rollres {

/// The text itself where nothing is to be said, or if it is no JSON object.
std::string accepted_study(const std::string& definition);

}  // namespace rollres
