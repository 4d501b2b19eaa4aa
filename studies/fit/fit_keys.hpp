#pragma once

/// The keys of the files of fits with their meaning, as study_keys.hpp has those of a study.

#include <array>

#include "fitting/descent/fit_problem.hpp"
#include "fitting/material/material_fit.hpp"
#include "studies/study/study_keys.hpp"

namespace rollres {

inline constexpr std::array<std::string_view, 2> weight_names{"uniform", "relative"};
inline constexpr std::string_view free_shift = "free";  ///< a table of its own, found with the material
inline constexpr std::array<std::string_view, 5> shift_names{"none", "wlf", "arrhenius", "vft", free_shift};
inline constexpr std::array<std::string_view, 3> law_names{"wlf", "arrhenius", "vft"};
inline constexpr std::string_view shift_alone = "shift";  ///< in place of a material: a shift law from a table of a_T
inline constexpr std::string_view kraus_alone = "kraus";  ///< in place of a material: Kraus's model from a strain sweep
inline constexpr std::array<std::string_view, 5> material_names{"zener", "fractional_zener", "prony", shift_alone,
                                                                kraus_alone};
inline constexpr KeyForm fit_starts = whole_from(1, 1000), fit_seed = whole_from(0, 2'000'000'000);

/// Of a fit of a scene.
inline constexpr std::array fit_keys{
    FileKey{"$schema", "schema of this file, for editors", a_text},
    FileKey{"fit", "name of the fit in the database", a_name, is_needed},
    FileKey{"comment", "a text that the program ignores", a_text},
    FileKey{"scene",
            "name of a scene file, relative to this file, or a scene; what is fitted or measured may be missing",
            KeyForm{}, is_needed},
    FileKey{"set", "inputs that replace those of the scene"},
    FileKey{"data", "name of a CSV file, a data set, or a list of these", KeyForm{}, is_needed},
    FileKey{"parameters", "inputs to be fitted, each a start, an object, or a list of objects for several data sets",
            KeyForm{}, is_needed},
    FileKey{"prior", "a former fit: what it says of these parameters, with their correlations, is another datum"},
    FileKey{"output", "what is measured; default rolling_resistance"},
    FileKey{"weights", "without sigma: all residuals weigh the same, or the same relative to the measured values",
            one_of(weight_names)},
    FileKey{"loss", "none for least squares, or one that bears outliers", one_of(ChoiceNames<Loss>::names)},
    FileKey{"loss_scale", "the residual, in standard deviations, from which on the loss is robust", a_positive},
    FileKey{"starts", "number of descents, from the places that promise most; default 4; 1: from the given start only",
            fit_starts},
    FileKey{"seed", "of the other starts; default 1", fit_seed},
    FileKey{"solutions_limit", "after so many solutions the fit ends with the best so far",
            whole_from(1, 2'000'000'000)},
    FileKey{"time_limit", "after so long the fit ends with the best so far: in s, or with a unit"},
    FileKey{"step", "of the differences, scaled, in place of steps that suit the noise"},
    FileKey{"design", "what --design looks for: an object"},
};

inline constexpr std::array design_wish_keys{
    FileKey{"ranges",
            "inputs, each from and to: where further measurements can be made; default: about those of the data"},
    FileKey{"targets",
            "scenes whose prediction is to be known better, each an object of inputs (and data, a data set); "
            "default: the parameters are"},
    FileKey{"points", "how many measurements are named together; default 3", whole_from(1, 20)},
};
inline constexpr std::array design_range_keys{
    FileKey{"from", "its lower end", a_number, is_needed},
    FileKey{"to", "its upper end", a_number, is_needed},
};

inline constexpr std::array data_set_keys{
    FileKey{"file", "name of a CSV file, relative to this file", a_name, is_needed},
    FileKey{"name", "of the data set; default: the file's", a_name},
    FileKey{"set", "inputs that replace those of the scene for these data"},
    FileKey{
        "output",
        "what is measured here: an output, moduli, relaxation_modulus or creep_compliance; default: that of the fit"},
    FileKey{"sigma",
            "standard deviation of all these data: \"2 %\", or with a unit; of moduli one for storage_modulus and one "
            "for loss_modulus"},
    FileKey{"listed_moduli",
            "whether moduli, relaxation_modulus or creep_compliance are in shear or Young's, where the names of the "
            "columns do not say",
            one_of(ChoiceNames<ListedModuli>::names)},
    FileKey{"ignore_columns", "columns of the table that are left out"},
    FileKey{"comment", "a text that the program ignores", a_text},
};

inline constexpr std::array fit_parameter_keys{
    FileKey{"start", "where the fit starts; default: closed forms for a material, else the scene's value", a_number},
    FileKey{"lowest", "lower bound", a_number},
    FileKey{"highest", "upper bound", a_number},
    FileKey{"scale", "logarithmic (default for positive quantities) or linear", one_of(spacing_names)},
    FileKey{"fixed", "whether it keeps its start", yes_or_no},
    FileKey{"data", "the data set that it belongs to; left out: all", a_name},
    FileKey{"prior", "what was known of it: its mean, and sigma"},
    FileKey{"smooth", "of a list: standard deviation of the logarithms of neighbours' quotients", a_number},
};

inline constexpr std::array<std::string_view, 2> prior_names{"normal", "lognormal"};
inline constexpr std::array prior_keys{
    FileKey{"mean", "the mean; of a lognormal prior the median", a_number, is_needed},
    FileKey{"sigma", "standard deviation: \"10 %\", or for a normal prior with a unit", a_number, is_needed},
    FileKey{"kind", "normal (default), or lognormal: sigma is that of the logarithm", one_of(prior_names)},
};

/// Of a fit of a material to storage and loss moduli.
inline constexpr std::array material_fit_keys{
    FileKey{"$schema", "schema of this file, for editors", a_text},
    FileKey{"fit", "name of the fit in the database", a_name, is_needed},
    FileKey{"comment", "a text that the program ignores", a_text},
    FileKey{
        "material",
        "what is fitted to storage and loss moduli; shift: a law of shift to a table of shift factors; kraus: Kraus's "
        "model to a strain sweep",
        one_of(material_names), is_needed},
    FileKey{"data", "name of a CSV file, relative to this file", a_name, is_needed},
    FileKey{"terms", "of a Prony series; auto: as many as the data ask for"},
    FileKey{
        "times",
        "relaxation times in even steps of their logarithm, or free, fitted with their moduli (default up to 5 terms)",
        one_of(ChoiceNames<SeriesTimes>::names)},
    FileKey{"shift", "how temperature shifts the frequencies", one_of(shift_names)},
    FileKey{"vertical_shift",
            "b_T, a factor of the moduli at each temperature, beside free shifts; auto (default): where AICc asks",
            one_of(ChoiceNames<VerticalShift>::names)},
    FileKey{"shift_table_file",
            "name of a CSV file, relative to this file, with measured shifts: a_T in place of a law, b_T of moduli",
            a_name},
    FileKey{"reference_temperature", "where nothing is shifted: in K, or \"20 degC\" (the default)"},
    FileKey{"sigma",
            "relative standard deviation of all moduli: \"2 %\", or one of the storage and one of the loss moduli"},
    FileKey{"ignore_columns", "columns of the table that are left out"},
    FileKey{"scene",
            "name of a scene file, relative to this file, or a scene, in which the fitted material is written"},
    FileKey{"listed_moduli",
            "whether the table has moduli in shear or Young's, where the names of its columns do not say",
            one_of(ChoiceNames<ListedModuli>::names)},
    FileKey{"modulus", "former name of listed_moduli", one_of(ChoiceNames<ListedModuli>::names)},
    FileKey{"starts", "number of descents; default 1", fit_starts},
    FileKey{"seed", "of the other starts; default 1", fit_seed},
};

inline constexpr std::array modulus_sigma_keys{
    FileKey{"storage_modulus", "relative standard deviation of the storage moduli", KeyForm{}, is_needed},
    FileKey{"loss_modulus", "relative standard deviation of the loss moduli", KeyForm{}, is_needed},
};

/// Of a fit of a shift law to shift factors.
inline constexpr std::array shift_fit_keys{
    FileKey{"$schema", "schema of this file, for editors", a_text},
    FileKey{"fit", "name of the fit in the database", a_name, is_needed},
    FileKey{"comment", "a text that the program ignores", a_text},
    FileKey{"material", "shift", a_name, is_needed},
    FileKey{"data", "name of a CSV file, relative to this file", a_name, is_needed},
    FileKey{"shift", "the law", one_of(law_names)},
    FileKey{"reference_temperature", "where nothing is shifted; default: the temperature whose factor is nearest to 1"},
    FileKey{"sigma", "relative standard deviation of the factors: \"5 %\""},
    FileKey{"ignore_columns", "columns of the table that are left out"},
    FileKey{"scene", "name of a scene file, relative to this file, or a scene, in which the shift is written"},
    FileKey{"starts", "number of descents; default 1", fit_starts},
    FileKey{"seed", "of the other starts; default 1", fit_seed},
};

/// Of a fit of Kraus's model to a strain sweep.
inline constexpr std::array<std::string_view, 1> kraus_names{kraus_alone};
inline constexpr std::array strain_fit_keys{
    FileKey{"$schema", "schema of this file, for editors", a_text},
    FileKey{"fit", "name of the fit in the database", a_name, is_needed},
    FileKey{"comment", "a text that the program ignores", a_text},
    FileKey{"material", "kraus", one_of(kraus_names), is_needed},
    FileKey{"data", "name of a CSV file, relative to this file: strain, storage_modulus, loss_modulus", a_name,
            is_needed},
    FileKey{"sweep_deformation", "whether the strains are of shear (default) or tension",
            one_of(ChoiceNames<SweepDeformation>::names)},
    FileKey{"sweep_amplitude", "whether the strains are peak (default) or peak_to_peak",
            one_of(ChoiceNames<SweepAmplitude>::names)},
    FileKey{"sigma",
            "relative standard deviation of all moduli: \"2 %\", or one of the storage and one of the loss moduli"},
    FileKey{"ignore_columns", "columns of the table that are left out"},
    FileKey{"scene",
            "name of a scene file, relative to this file, or a scene, in which the parameters are written; its "
            "poisson_ratio turns strains of tension into shear"},
    FileKey{"starts", "number of descents; default 1", fit_starts},
    FileKey{"seed", "of the other starts; default 1", fit_seed},
};

}  // namespace rollres
