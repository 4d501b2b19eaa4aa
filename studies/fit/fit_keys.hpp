#pragma once

/// The keys of the files of fits with their meaning, as study_keys.hpp has those of a study.

#include <array>

#include "studies/study/study_keys.hpp"

namespace rollres {

/// Of a fit of a scene.
inline constexpr std::array fit_keys{
    FileKey{"$schema", "schema of this file, for editors"},
    FileKey{"fit", "name of the fit in the database"},
    FileKey{"comment", "a text that the program ignores"},
    FileKey{"scene",
            "name of a scene file, relative to this file, or a scene; what is fitted or measured may be missing"},
    FileKey{"set", "inputs that replace those of the scene"},
    FileKey{"data", "name of a CSV file, a data set, or a list of these"},
    FileKey{"parameters", "inputs to be fitted, each a start, an object, or a list of objects for several data sets"},
    FileKey{"output", "what is measured; default rolling_resistance"},
    FileKey{"weights", "without sigma: all residuals weigh the same, or the same relative to the measured values"},
    FileKey{"loss", "none for least squares, or one that bears outliers"},
    FileKey{"loss_scale", "the residual, in standard deviations, from which on the loss is robust"},
    FileKey{"starts", "number of descents; default 1"},
    FileKey{"seed", "of the other starts; default 1"},
    FileKey{"step", "of the differences, scaled, in place of steps that suit the noise"},
};

inline constexpr std::array data_set_keys{
    FileKey{"file", "name of a CSV file, relative to this file"},
    FileKey{"name", "of the data set; default: the file's"},
    FileKey{"set", "inputs that replace those of the scene for these data"},
    FileKey{"sigma", "standard deviation of all these data: \"2 %\", or with a unit"},
    FileKey{"comment", "a text that the program ignores"},
};

inline constexpr std::array fit_parameter_keys{
    FileKey{"start", "where the fit starts; default: closed forms for a material, else the scene's value"},
    FileKey{"lowest", "lower bound"},
    FileKey{"highest", "upper bound"},
    FileKey{"scale", "logarithmic (default for positive quantities) or linear"},
    FileKey{"fixed", "whether it keeps its start"},
    FileKey{"data", "the data set that it belongs to; left out: all"},
};

/// Of a fit of a material to storage and loss moduli.
inline constexpr std::array material_fit_keys{
    FileKey{"$schema", "schema of this file, for editors"},
    FileKey{"fit", "name of the fit in the database"},
    FileKey{"comment", "a text that the program ignores"},
    FileKey{"material", "what is fitted to storage and loss moduli"},
    FileKey{"data", "name of a CSV file, relative to this file"},
    FileKey{"terms", "of a Prony series; auto: as many as the data ask for"},
    FileKey{"shift", "how temperature shifts the frequencies"},
    FileKey{"reference_temperature", "where nothing is shifted: in K, or \"20 degC\" (the default)"},
    FileKey{"sigma", "relative standard deviation of all moduli: \"2 %\""},
    FileKey{"modulus", "whether the table has moduli in shear (default) or Young's"},
    FileKey{"starts", "number of descents; default 1"},
    FileKey{"seed", "of the other starts; default 1"},
};

}  // namespace rollres
