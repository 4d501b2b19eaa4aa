#include "core/material/master_curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/material/free_series.hpp"
#include "core/material/material_scale.hpp"
#include "core/material/passivity.hpp"
#include "core/material/relative_rows.hpp"
#include "core/material/row_noise.hpp"
#include "core/material/smooth_spectrum.hpp"
#include "core/messages/message_text.hpp"
#include "core/numerics/recently_made.hpp"
#include "core/numerics/sorted_places.hpp"

namespace rollres {

namespace {

/// A row is an outlier beyond so many times the usual misfit, and this one.
constexpr double outlier_ratio = 5, outlier_misfit = 0.05;
/// A modulus at rest within so much of the least that is assumed is not the table's.
constexpr double not_shown = 1.05;
/// Logarithm of the odds that few terms have over a smooth spectrum. By it solids of 1 to 10 terms, drawn at 9 to 81
/// rows with 2 to 10 % noise, and fractional solids are told apart: the difference of their evidence is at most 23
/// (median 5) for the former and at least 10 (median 30) for the latter.
constexpr double advantage_of_few = 10;
/// So much evidence, as a logarithm, comes and goes with the noise of the rows.
constexpr double evidence_by_chance = 3;

/// "0.1 Hz", or "1.6 s" of a table of relaxation.
std::string place_in_words(double frequency, bool relaxation) {
  return relaxation ? message_text(1 / (2 * std::numbers::pi * frequency), " s") : message_text(frequency, " Hz");
}

const char* curve_in_words(const MasterCurve& curve) {
  return curve.is_relaxation() ? "relaxation curve: " : "master curve: ";
}

std::string row_name(const MasterCurve& curve, std::size_t row) {
  return message_text("row ", row + 1, " (", place_in_words(curve.frequencies[row], curve.is_relaxation()), ")");
}

/// Adds a line for each of some rows, or one for all where they are many.
void add_lines(std::vector<std::string>& remarks, const std::vector<std::string>& lines) {
  constexpr std::size_t few = 3;
  if (lines.size() <= few)
    remarks.insert(remarks.end(), lines.begin(), lines.end());
  else
    remarks.push_back(lines.front() + message_text("; likewise at ", lines.size() - 1, " other rows"));
}

/// @param falls  whether falling storage moduli are told
std::vector<std::string> remarks_on_rows(const MasterCurve& curve, bool falls) {
  const std::vector<std::size_t> order = rows_in_order(curve);
  constexpr double noticed = 2e-3;  // of a relaxation modulus, which may come from creep
  const std::string table = curve_in_words(curve);
  std::vector<std::string> remarks, moved, repeated, falling;
  for (std::size_t row = 1; row < curve.frequencies.size(); ++row)
    if (curve.is_relaxation() ? curve.frequencies[row] > curve.frequencies[row - 1]
                              : curve.frequencies[row] < curve.frequencies[row - 1])
      moved.push_back(table + row_name(curve, row) + " is out of the order of " +
                      (curve.is_relaxation() ? "times" : "frequencies"));
  for (std::size_t i = 1; i < order.size(); ++i) {
    const std::size_t before = order[i - 1], row = order[i];
    if (curve.frequencies[row] == curve.frequencies[before])
      repeated.push_back(table + row_name(curve, row) + " has the " + (curve.is_relaxation() ? "time" : "frequency") +
                         " of row " + std::to_string(before + 1) + "; both count");
    else if (falls && curve.storage[row] < (curve.is_relaxation() ? 1 - noticed : 1) * curve.storage[before])
      falling.push_back(
          table +
          (curve.is_relaxation()
               ? row_name(curve, before) +
                     message_text(": the modulus rises from ", curve.storage[row], " to ", curve.storage[before], " Pa")
               : row_name(curve, row) + message_text(": the storage modulus falls from ", curve.storage[before], " to ",
                                                     curve.storage[row], " Pa")) +
          ", as no passive material's does");
  }
  for (const auto* const lines : {&moved, &repeated, &falling}) add_lines(remarks, *lines);
  return remarks;
}

std::vector<std::string> remarks_on_outliers(const MasterCurve& curve, const std::vector<double>& misfits) {
  std::vector<double> sorted = misfits;
  std::nth_element(sorted.begin(), sorted.begin() + std::ssize(sorted) / 2, sorted.end());
  const double usual = sorted[sorted.size() / 2];
  std::vector<std::string> lines, remarks;
  for (std::size_t row = 0; row < misfits.size(); ++row)
    if (misfits[row] > std::max(outlier_ratio * usual, outlier_misfit))
      lines.push_back(curve_in_words(curve) + row_name(curve, row) + " is an outlier: " +
                      message_text(100 * misfits[row], " % from the fit, others ", 100 * usual, " %"));
  add_lines(remarks, lines);
  return remarks;
}

/// Few terms or a smooth spectrum, whichever the rows are more likely on.
SpectrumFit likelier_spectrum(const RelativeRows& rows) {
  SpectrumFit smooth = smooth_spectrum(rows);
  smooth.evidence -= advantage_of_few;
  const SpectrumFit few = free_series(rows, smooth.evidence);
  const bool is_smooth = smooth.evidence > few.evidence;
  SpectrumFit best = is_smooth ? smooth : few;
  const SpectrumFit& other = is_smooth ? few : smooth;
  best.open.add(
      open_between(best.series, other.series, std::exp((other.evidence - best.evidence) / evidence_by_chance)));
  return best;
}

/// The likelier spectrum on rows as certain as they show themselves to be.
SpectrumFit spectrum_of(const RelativeRows& rows) {
  SpectrumFit found = likelier_spectrum(rows);
  constexpr int rounds = 2;
  for (int round = 0; round < rounds; ++round) {
    const RowNoise noise = noise_by_frequency(rows, found.series);
    if ((noise.deviations.array() == 1).all()) break;
    found = likelier_spectrum(rows.with_noise(noise.deviations));
    found.open.spread *= noise.widening;
  }
  return found;
}

}  // namespace

std::vector<std::size_t> rows_in_order(const MasterCurve& curve) {
  return sorted_places(curve.frequencies.size(), [&](std::size_t row) { return curve.frequencies[row]; });
}

std::vector<double> relative_misfits(const MasterCurve& curve, const PronySeries& series) {
  std::vector<double> misfits;
  for (std::size_t row = 0; row < curve.frequencies.size(); ++row) {
    const double omega = 2 * std::numbers::pi * curve.frequencies[row];
    const std::complex<double> measured(curve.storage[row], curve.is_relaxation() ? 0 : curve.loss[row]);
    const std::complex<double> fitted =
        curve.is_relaxation() ? relaxation_modulus(series, 1 / omega) : complex_modulus(series, omega);
    misfits.push_back(std::abs(fitted - measured) / std::abs(measured));
  }
  return misfits;
}

std::string MasterCurveFit::in_words() const {
  return message_text(is_relaxation ? "relaxation curve as " : "master curve as ", series.terms.size(),
                      " Prony terms, misfit ", 100 * rms_misfit, " % rms and ", 100 * largest_misfit, " % at most (at ",
                      place_in_words(worst_frequency, is_relaxation), ")");
}

MasterCurveFit fit_master_curve(const MasterCurve& curve) {
  const RelativeRows rows(curve);
  SpectrumFit found = spectrum_of(rows);
  MasterCurveFit fit{.series = std::move(found.series), .open = std::move(found.open), .remarks = {}};
  const std::vector<double> misfit = relative_misfits(curve, fit.series);
  const std::size_t worst = static_cast<std::size_t>(std::max_element(misfit.begin(), misfit.end()) - misfit.begin());
  fit.largest_misfit = misfit[worst];
  fit.worst_frequency = curve.frequencies[worst];
  fit.is_relaxation = curve.is_relaxation();
  fit.rms_misfit = Eigen::Map<const Eigen::VectorXd>(misfit.data(), std::ssize(misfit)).norm() /
                   std::sqrt(static_cast<double>(misfit.size()));
  constexpr double suspicious = 0.03;
  const std::string contradiction =
      fit.rms_misfit > suspicious && !curve.is_relaxation() ? passivity_test(curve).in_words() : "";
  fit.remarks = remarks_on_rows(curve, contradiction.empty());
  if (!contradiction.empty()) fit.remarks.push_back("master curve: " + contradiction);
  if (const std::string swapped = curve.is_relaxation() ? "" : swapped_moduli(curve.storage, curve.loss);
      !swapped.empty())
    fit.remarks.push_back("master curve: " + swapped);
  for (std::string& remark : remarks_on_outliers(curve, misfit)) fit.remarks.push_back(std::move(remark));
  if (rows.free_rest() && fit.series.static_modulus <= not_shown * rows.least_rest())
    fit.remarks.push_back(message_text(curve_in_words(curve), "does not show the modulus at rest, taken as ",
                                       fit.series.static_modulus, " Pa, about a tenth of the lowest ",
                                       curve.is_relaxation() ? "modulus" : "storage modulus",
                                       "; static_shear_modulus gives it where it is known"));
  return fit;
}

std::shared_ptr<const MasterCurveFit> shared_master_curve_fit(const MasterCurve& curve) {
  static RecentlyMade<MasterCurve, MasterCurveFit, 8> cache;
  return cache(curve, [&] { return fit_master_curve(curve); });
}

MasterCurve measured_curve(const MaterialInputs& layer) {
  const auto all_as_shear = [&](std::vector<double> listed) {
    for (double& modulus : listed) modulus = as_shear(layer, modulus);
    return listed;
  };
  const bool at_rest = layer.static_shear_modulus || layer.static_young_modulus;
  const double rest = at_rest ? given_static_modulus(layer) : 0;
  if (layer.material == MaterialModel::master_curve)
    return {layer.frequencies, all_as_shear(layer.storage_moduli), all_as_shear(layer.loss_moduli), rest};
  MasterCurve curve{{}, all_as_shear(layer.relaxation_moduli), {}, rest};
  for (const double time : layer.relaxation_times) curve.frequencies.push_back(1 / (2 * std::numbers::pi * time));
  return curve;
}

std::shared_ptr<const MasterCurveFit> shared_master_curve_fit(const MaterialInputs& layer) {
  return shared_master_curve_fit(measured_curve(layer));
}

}  // namespace rollres
