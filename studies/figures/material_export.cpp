#include "studies/figures/material_export.hpp"

#include <algorithm>
#include <numbers>
#include <optional>
#include <sstream>

#include "core/material/prony_series.hpp"
#include "core/scene/scene_input.hpp"
#include "studies/scene_io/solution_json.hpp"

namespace rollres {

namespace {

/// log10 a = -c1 (T - reference)/(c2 + T - reference).
struct ExportedShift {
  double reference, c1, c2;
};

struct ExportedSeries {
  PronySeries series;  ///< in shear
  std::optional<ExportedShift> shift = {};
  std::string remark = {};
  double poisson_ratio = 0.5;

  /// G'(infinity) [Pa]
  double at_once() const {
    double sum = series.static_modulus;
    for (const PronySeries::Term& term : series.terms) sum += term.modulus;
    return sum;
  }
  double young() const { return 2 * (1 + poisson_ratio) * at_once(); }
};

std::optional<ExportedShift> written_shift(const MaterialInputs& layer) {
  if (!layer.reference_temperature || !layer.modulus_shifts.empty()) return std::nullopt;
  const double reference = *layer.reference_temperature;
  if (layer.wlf_c1) return ExportedShift{reference, *layer.wlf_c1, *layer.wlf_c2};
  if (!layer.vft_b) return std::nullopt;
  const double c2 = reference - *layer.vft_temperature;
  return ExportedShift{reference, *layer.vft_b / (c2 * std::numbers::ln10), c2};
}

/// The material's series in shear, at its temperature.
PronySeries series_of(const MaterialInputs& layer) {
  const CreepSpectrum creep = creep_spectrum(layer);
  PronySeries series{1 / creep.at_rest(), {}};
  for (const RelaxationSpectrum::Term& term : relaxation_spectrum(creep).terms)
    series.terms.push_back({term.modulus, term.time});
  return ordered(series);
}

ExportedSeries exported_series(MaterialInputs layer) {
  constexpr double nearly_incompressible = 0.4995;
  ExportedSeries exported;
  exported.shift = written_shift(layer);
  std::ostringstream remark;
  if (exported.shift)
    remark << "at the reference temperature, " << exported.shift->reference << " K";
  else if (layer.temperature)
    remark << "at " << *layer.temperature << " K: of laws of shift only WLF and VFT are written, without b_T";
  exported.remark = remark.str();
  if (exported.shift) layer.temperature.reset();
  exported.series = series_of(layer);
  exported.poisson_ratio = std::min(layer.poisson_ratio, nearly_incompressible);
  return exported;
}

std::string comment(std::string_view mark, const ExportedSeries& exported) {
  std::string text(mark);
  text += " Prony series in shear by rollres, SI units, K";
  return text + (exported.remark.empty() ? "" : "; " + exported.remark) + '\n';
}

void write_abaqus(std::ostream& out, const ExportedSeries& exported) {
  out << comment("**", exported) << "*MATERIAL, NAME=ROLLRES\n*ELASTIC, MODULI=INSTANTANEOUS\n"
      << exported.young() << ", " << exported.poisson_ratio << '\n';
  if (!exported.series.terms.empty()) out << "*VISCOELASTIC, TIME=PRONY\n";
  for (const PronySeries::Term& term : exported.series.terms)
    out << term.modulus / exported.at_once() << ", " << term.modulus / exported.at_once() << ", " << term.time << '\n';
  if (const auto& shift = exported.shift)
    out << "*TRS, DEFINITION=WLF\n" << shift->reference << ", " << shift->c1 << ", " << shift->c2 << '\n';
}

void write_ansys(std::ostream& out, const ExportedSeries& exported) {
  const std::size_t terms = exported.series.terms.size();
  out << comment("!", exported) << "MP,EX,1," << exported.young() << "\nMP,PRXY,1," << exported.poisson_ratio << '\n';
  for (const char* part : {"SHEAR", "BULK"}) {
    if (terms == 0) break;
    out << "TB,PRONY,1,," << terms << ',' << part << '\n';
    for (std::size_t i = 0; i < terms; ++i)
      out << "TBDATA," << 2 * i + 1 << ',' << exported.series.terms[i].modulus / exported.at_once() << ','
          << exported.series.terms[i].time << '\n';
  }
  if (const auto& shift = exported.shift)
    out << "TB,SHIFT,1,,3,WLF\nTBDATA,1," << shift->reference << ',' << shift->c1 << ',' << shift->c2 << '\n';
}

void write_constants(std::ostream& out, std::string_view mark, const ExportedSeries& exported) {
  out << comment(mark, exported) << mark << " shear modulus at rest [Pa]: " << exported.series.static_modulus << '\n';
  out << mark << " poisson_ratio: " << exported.poisson_ratio << '\n';
  if (const auto& shift = exported.shift)
    out << mark << " Williams-Landel-Ferry: T0 [K], C1, C2 [K]: " << shift->reference << ' ' << shift->c1 << ' '
        << shift->c2 << '\n';
}

void write_comsol(std::ostream& out, const ExportedSeries& exported) {
  write_constants(out, "%", exported);
  int branch = 0;
  for (const PronySeries::Term& term : exported.series.terms)
    out << ++branch << ' ' << term.modulus << ' ' << term.time << '\n';
}

void write_series(std::ostream& out, const ExportedSeries& exported) {
  write_constants(out, "#", exported);
  out << "relaxation_time [s],relaxation_modulus [Pa]\n";
  for (const PronySeries::Term& term : exported.series.terms) out << term.time << ',' << term.modulus << '\n';
}

/// The series at its reference temperature, or at its own where it has no law, in place of a layer's material.
void take_series(MaterialInputs& layer) {
  MaterialInputs at_reference = layer;
  at_reference.temperature.reset();
  const PronySeries series = series_of(at_reference);
  layer.material = MaterialModel::prony;
  layer.static_young_modulus.reset();
  layer.static_shear_modulus = series.static_modulus;
  layer.stiffening = layer.creep_time = 0;
  layer.fractional_order = MaterialInputs{}.fractional_order;
  for (std::vector<double>* list : {&layer.frequencies, &layer.storage_moduli, &layer.loss_moduli,
                                    &layer.relaxation_times, &layer.relaxation_moduli})
    list->clear();
  for (const PronySeries::Term& term : series.terms) {
    layer.relaxation_times.push_back(term.time);
    layer.relaxation_moduli.push_back(term.modulus);
  }
  layer.listed_moduli = ListedModuli::shear;
}

}  // namespace

std::string exported_material(RollingScene scene, std::string_view layer, std::string_view format) {
  MaterialInputs& material = layer_of(scene, layer);
  if (format == "scene") {
    take_series(material);
    return scene_json(scene) + '\n';
  }
  std::ostringstream out;
  out.precision(15);
  const ExportedSeries exported = exported_series(material);
  if (format == "abaqus") write_abaqus(out, exported);
  if (format == "ansys") write_ansys(out, exported);
  if (format == "comsol") write_comsol(out, exported);
  if (format == "prony_csv") write_series(out, exported);
  return out.str();
}

}  // namespace rollres
