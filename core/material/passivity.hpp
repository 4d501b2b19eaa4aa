#pragma once

/// Whether storage and loss moduli belong together, as they do in any passive linear material by the relations of
/// Kramers and Kronig.
///
///  - Locally G" = (π/2) dG'/d ln ω, so that the loss implies a rise of the storage modulus by (2/π) ∫ G" d ln ω: exact
///    for a whole spectrum, and over a table up to what the ends miss.
///  - What the series of non-negative moduli at dense times leaves of the rows, no passive material can meet. It is
///    scatter where neighbours differ at random; where neighbours share it, the moduli contradict each other.
/// @see Booij and Thoone (1982), Rheologica Acta 21, 15

#include <string>
#include <vector>

#include "core/material/master_curve.hpp"

namespace rollres {

struct PassivityTest {
  double implied_rise = 0;     ///< of the storage modulus over the table, by the loss [Pa]
  double measured_rise = 0;    ///< [Pa]
  double misfit = 0;           ///< of the nearest passive material: rms of |G*_fit - G*| / |G*| [1]
  double shared = 0;           ///< rms of what neighbouring rows share of the relative residuals [1]
  bool contradiction = false;  ///< the shared part is above 2 %, and above what chance explains
  std::vector<double> worst;   ///< frequencies where the misfit is largest, half a decade apart at least [Hz]

  /// One line; empty without a contradiction.
  std::string in_words() const;
};

/// @param curve with at least two different frequencies
PassivityTest passivity_test(const MasterCurve& curve);

/// Warns of columns that were exchanged: the loss is above the storage in most rows. Empty otherwise. In its glass
/// transition a polymer has rows of that kind, between rubber and glass, so it is no proof.
/// @param storage, loss  of each row [Pa]
std::string swapped_moduli(const std::vector<double>& storage, const std::vector<double>& loss);

}  // namespace rollres
