#pragma once

/// What a fit says of scenes that were not measured, with intervals.
///
/// With the errors s and the correlations C of the parameters, and slopes g of a value by them, the variance of the
/// value is (g s)^T C (g s); that of one more measurement is larger by the noise. Intervals hold 95 %: normal where the
/// deviations of the data were given, else Student's t of the fit's degrees of freedom; of one more measurement of as
/// many as the error of its variance makes (Satterthwaite 1946, Biometrics Bulletin 2, 110). Everything is taken from
/// the record of the fit, so that a fit just made and a stored one say the same.

#include <array>
#include <string>
#include <vector>

#include "db/rows/fit_store.hpp"
#include "fitting/fit/resistance_fit.hpp"

namespace rollres {

/// What is predicted.
enum class PredictedAs {
  true_value,  ///< of the model, without the offset and the scale of the measurement
  reading,     ///< what the instrument would show on average: scale * true value + offset
  measurement  ///< what one more measurement would show: the reading with its noise
};
template <>
struct ChoiceNames<PredictedAs> {
  static constexpr std::array<std::string_view, 3> names{"true_value", "reading", "measurement"};
};

/// A scene to be predicted. `scene.set` is the data set whose offset, scale, noise and own parameters count;
/// `scene.measured` is what was measured there (NaN: nothing) and the deviation of one more measurement (NaN: that of
/// the fit).
struct AskedScene {
  MeasuredScene scene;
  double measured = RollingSolution::absent, deviation = RollingSolution::absent;  ///< [SI]
};

/// All NaN where the scene has no answer, or slopes that are but noise.
struct PredictedScene {
  double value, standard_error, lowest, highest;  ///< [SI]
};

/// A parameter's name as the key of an input and the data set that it belongs to: "offset (rig)".
struct ParameterName {
  std::string key, set;  ///< set: empty: all
};
ParameterName parameter_name(const std::string& name);

/// The fitted parameters of a record that act on a data set: no noise, nothing fixed.
std::vector<FitParameterRecord> parameters_of(const FitRecord& fit, const std::string& set);

/// Fitted offset [SI] and scale [1] of a data set's readings.
struct Instrument {
  double offset = 0, scale = 1;
};
Instrument instrument_of(const FitRecord& fit, const std::string& set);

/// The fitted values put into a scene.
void assign_fitted(RollingScene& scene, const FitRecord& fit, const std::string& set);

/// The variance of one more measurement about its reading [SI squared], and what that is uncertain by.
struct MeasurementNoise {
  double variance = RollingSolution::absent, error = 0;
};

/// Of a data set, where the reading is so much: by the fitted noise; else as the data have it, absolute or relative,
/// whichever varies less between them. A fitted term whose error is as large as itself counts by half the end of its
/// interval.
MeasurementNoise measurement_noise(const FitRecord& fit, const std::string& set, double reading);

/// @param fit     of scenes, with its data   @param output  its key
/// @param scenes  the fitted values are put into them
/// @throws std::invalid_argument naming the fit and what it lacks
std::vector<PredictedScene> predicted(const FitRecord& fit, const std::string& output,
                                      const std::vector<AskedScene>& scenes, PredictedAs as, const Evaluate& evaluate,
                                      int jobs = 0);

}  // namespace rollres
