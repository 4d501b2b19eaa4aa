#pragma once

/// Files of fits: which inputs of a scene are fitted to which tables of measured values.
///
///     {"fit": "rubber on drum", "scene": "paper_cylinder.json", "set": {"friction_coefficient": 0},
///      "data": [{"file": "drum.csv", "name": "drum", "set": {"radius": "0.1 m"}, "sigma": "2 %"}],
///      "parameters": {"static_shear_modulus": {"start": "2 MPa", "lowest": "0.1 MPa", "highest": "50 MPa"},
///                     "stiffening": {}, "creep_time": "0.1 s", "friction_coefficient": {"data": "drum"}},
///      "loss": "huber", "starts": 8}
///
/// `scene` and `set` are those of a study. `data` is the name of a CSV file (measured_table.hpp), an object, or a list
/// of these; its columns are inputs of the scene, the measured output (`output`, default rolling_resistance), `sigma`
/// (standard deviation, in the output's unit or in %) and `note`. `set` replaces inputs for one data set; `sigma` there
/// is one deviation for all its rows. Where no row has a sigma, all residuals weigh the same, or with "weights":
/// "relative" those relative to the measured value.
///
/// A fixed grid's answers jump where nodes enter and leave the contact. Where the scene allows smooth ones (continuous
/// edges, or a grid tied to a sphere's contact), its own spacing is left out; one in a `set` or a column is kept.
///
/// A parameter is a start, or an object with start, lowest, highest, scale ("logarithmic" or "linear"), fixed, and
/// data: the set that it belongs to. noise_level and relative_noise (an empty object, or one with data) are fitted too
/// where no sigma is given. Without a start, material parameters start from closed forms
/// (closed_form_start.hpp), the others from the scene. Other keys: loss ("none", "huber", "cauchy"), loss_scale, starts
/// (1), seed (1), step (scaled; in place of steps that suit the noise), design (design_wish.hpp), comment.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "db/rows/fit_store.hpp"
#include "fitting/fit/fit.hpp"
#include "fitting/fit/resistance_fit.hpp"

namespace rollres {

struct FixedInput {
  std::string key;
  double value;  ///< [SI]
};

/// A term of the noise that is fitted. @see fitting/fit/noise_fit.hpp
struct FittedNoise {
  std::string key, set;  ///< noise_level or relative_noise; set: empty: all
};

/// An input between two ends, in equal factors where both are positive.
struct DesignRange {
  std::string key;
  double lowest, highest;  ///< [SI]

  bool logarithmic() const { return lowest > 0; }
  double at(double part) const {
    part = std::clamp(part, 0.0, 1.0);
    const double there = logarithmic() ? std::exp(std::lerp(std::log(lowest), std::log(highest), part))
                                       : std::lerp(lowest, highest, part);
    return std::clamp(there, lowest, highest);
  }
  /// The part that a value lies at.
  double part_of(double value) const {
    return logarithmic() ? (std::log(value) - std::log(lowest)) / (std::log(highest) - std::log(lowest))
                         : (value - lowest) / (highest - lowest);
  }
};

/// What --design is to look for, as far as the file says so.
struct DesignWish {
  std::vector<DesignRange> ranges;     ///< in which further measurements can be made
  std::vector<MeasuredScene> targets;  ///< predictions to be known better; none: the parameters
  int points = 3;                      ///< measurements that are named together
};

struct FitFile {
  std::string name;
  std::string source;      ///< for messages
  std::string definition;  ///< text of the file
  std::string data_digest;
  std::vector<MeasuredScene> scenes;
  std::vector<std::string> varying;  ///< inputs that are columns of a table
  std::vector<FittedInput> inputs;
  std::vector<FixedInput> fixed;
  std::vector<FittedNoise> noise;
  std::string output = "rolling_resistance";
  bool deviations_known = false;
  bool relative_weights = false;
  Loss loss = Loss::none;
  double loss_scale = 1;
  std::optional<double> step = {};
  FitOptions options;
  DesignWish design = {};
  std::optional<FitRecord> former = {};    ///< a fit whose result is a prior
  std::vector<std::string> warnings = {};  ///< rows given twice, a negative output
  std::vector<std::string> notes = {};     ///< a spacing of the scene that was left out

  Body body() const { return body_of(scenes.front().scene); }
};

/// @throws std::invalid_argument one line naming file, line of the table or key, value and rule
/// @throws std::runtime_error if a file cannot be read
FitFile read_fit(const std::filesystem::path& file);

/// The problem that the file poses. @param jobs threads; 0: one for each core
/// @throws std::invalid_argument naming the file, key, value and rule
FitProblem problem_of(const FitFile& file, const Evaluate& evaluate, int jobs = 0);

/// The fit of the problem by the file's options, with its noise where that is fitted.
FitReport fit(const FitProblem& problem, const FitFile& file);

}  // namespace rollres
