#pragma once

/// Reads "uncertain" of a study file or of an optimisation: inputs that scatter.
///
///     "uncertain": {"static_shear_modulus": {"normal": ["3 MPa", "10 %"]},       mean, standard deviation
///                   "creep_time": {"lognormal": ["0.25 s", "20 %"]},             median, that of the logarithm
///                   "friction_coefficient": {"uniform": [0.1, 0.3]},             or loguniform: lowest, highest
///                   "layer_thickness": {"triangular": ["4 mm", "5 mm", "7 mm"]}, lowest, most probable, highest
///                   "load": {"normal": "5 %"},                                   about the value that it has otherwise
///                   "correlation": [["static_shear_modulus", "creep_time", -0.4]],
///                   "points": 512, "method": "sobol", "scramblings": 8, "seed": 1,
///                   "probability": ["peak_pressure > 2 MPa"]}
///
/// Shares alone, "5 %" or ["-5 %", "10 %"], scatter an input about its value in the scene. "fit": {"name": "rubber",
/// "db": "results.db"} gives the parameters of a stored fit with their errors and correlations; an offset, a scale and
/// the noise of its data are of no scene and do not scatter. A distribution with weight outside an input's range is
/// refused, or with "truncated": true cut off there.
///
/// For sources only: it needs nlohmann_json.

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "studies/scene_io/scene_entries.hpp"
#include "studies/study/study_axes.hpp"
#include "studies/study/study_keys.hpp"
#include "studies/study/uncertain.hpp"

namespace rollres {

inline constexpr std::array uncertain_keys{
    FileKey{"fit", "a stored fit whose parameters scatter by its covariance"},
    FileKey{"correlation", "pairs of inputs that scatter together, each with a correlation from -1 to 1"},
    FileKey{"points", "number of points, a multiple of the scramblings; default 512, in an optimisation 64",
            whole_from(2, most_points)},
    FileKey{"method", "how the points are spread", one_of(ChoiceNames<SampleMethod>::names)},
    FileKey{
        "scramblings",
        "parts of the points that are scrambled, or drawn, anew and tell the errors; default 8, in an optimisation 1",
        whole_from(1, 1000)},
    FileKey{"seed", "the same seed gives the same points; default 1"},
    FileKey{"probability", "conditions of inputs and outputs whose probability is wanted"},
};

inline constexpr std::array distribution_keys{
    FileKey{"normal", "mean and standard deviation, which may be a share of the mean; or that share alone"},
    FileKey{"lognormal", "median and standard deviation of the logarithm, a number or a share; or that share alone"},
    FileKey{"uniform", "lowest and highest value"},
    FileKey{"loguniform", "lowest and highest value, uniform in the logarithm"},
    FileKey{"triangular", "lowest, most probable and highest value"},
    FileKey{"truncated", "whether weight outside the input's range is cut off", yes_or_no},
};

/// What stands under "uncertain" with the parameters of its fit in the place of "fit"; nothing to do without one.
/// @throws std::invalid_argument naming place, fit and rule
/// @throws std::runtime_error if the database cannot be read
void resolve_fit(Json& file, const std::filesystem::path& path, const std::string& place);

/// Reads the object under "uncertain" of a file; empty without one.
/// @param scene   entries of the scene, for units and for what scatters about its value
/// @param usual   how many points there are where the file says nothing
/// @param varied  inputs that may scatter about values that are not known yet, the variables of an optimisation:
/// whether
///                they stay inside their ranges is left to the caller
/// @throws std::invalid_argument naming place, key, value and rule
UncertainInputs uncertain_inputs(const Json& file, const std::vector<SceneEntry>& scene, const std::string& place,
                                 const UncertainInputs& usual = {}, const std::vector<std::string>& varied = {});

/// Axes of a study with these points; they vary together.
std::vector<GivenAxis> uncertain_axes(const UncertainInputs& uncertain, const std::string& place);

}  // namespace rollres
