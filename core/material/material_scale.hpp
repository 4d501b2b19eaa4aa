#pragma once

/// What turns the numbers of a layer's material into moduli of shear and times at its temperature.
///
/// Time-temperature superposition: b(T) G*(omega, T) = G*(a(T) omega, T0) with the reference temperature T0, for an
/// entropic rubber b = T0/T (Ferry 1980, Viscoelastic Properties of Polymers, chapter 11).

#include <optional>

#include "core/material/shift_table.hpp"
#include "core/scene/material_inputs.hpp"

namespace rollres {

/// G'(0) [Pa] from static_shear_modulus or static_young_modulus, one of which must be there.
double given_static_modulus(const MaterialInputs& layer);

/// A modulus of one of the layer's lists [Pa] as a modulus of shear.
double as_shear(const MaterialInputs& layer, double listed);

/// a(T): the times of the layer at its temperature over those at the reference; 1 without a temperature.
double time_shift(const MaterialInputs& layer);

/// b(T): the moduli of the layer at the reference temperature over those at its own, at shifted times; 1 without a
/// table of b_T.
double modulus_shift(const MaterialInputs& layer);

enum class ShiftLaw { none, wlf, arrhenius, vft, table };

/// A table of shifts, as measured (shift_table.hpp).
struct ShiftTable {
  std::vector<double> temperatures;  ///< [K]
  std::vector<double> factors;       ///< a(T) [1], as many or none
  std::vector<double> moduli;        ///< b(T) [1], as many or none
};

/// log10 a = -c1 (T - T0) / (c2 + T - T0) (Williams, Landel and Ferry 1955, J. Am. Chem. Soc. 77, 3701), or
/// ln a = E/R (1/T - 1/T0), or ln a = B/(T - T1) - B/(T0 - T1) (Vogel 1921, Fulcher 1925, Tammann and Hesse 1926),
/// which is WLF with c2 = T0 - T1, c1 = B/(c2 ln 10).
struct TemperatureShift {
  ShiftLaw law = ShiftLaw::none;
  double reference = 293.15;     ///< T0 [K]
  double c1 = 0, c2 = 0;         ///< [1], [K], of WLF
  double activation_energy = 0;  ///< E [J/mol], of Arrhenius
  double vft_b = 0;              ///< B [K], of VFT
  double vft_temperature = 0;    ///< T1 [K]
  ShiftTable table = {};         ///< its a(T) in place of a law; its b(T) beside any
};

/// a(T), of a table the one at T over the one at T0. @param temperature [K]; for WLF above T0 - c2, for VFT it and T0
/// above T1, for a table both within it
/// @throws std::invalid_argument if it is not
double shift_factor(const TemperatureShift& shift, double temperature);

/// b(T), that at T over that at T0; 1 without a table of b(T). @throws as above
double modulus_factor(const TemperatureShift& shift, double temperature);

/// Both at many temperatures: what a table asks of its rows is worked out once.
class ShiftFactors {
 public:
  /// @param shift  lives longer than this   @throws as above, if T0 is beyond a table
  explicit ShiftFactors(const TemperatureShift& shift);
  double time(double temperature) const;     ///< a(T), @throws as above
  double modulus(double temperature) const;  ///< b(T), @throws as above

 private:
  const TemperatureShift& shift_;
  std::optional<TableFactors> times_, moduli_;
  double time_at_reference_ = 1, modulus_at_reference_ = 1;
};

}  // namespace rollres
