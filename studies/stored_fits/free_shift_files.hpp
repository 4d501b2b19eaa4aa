#pragma once

/// The table of free shifts that a fit of a material has found, as a file and a picture.

#include <filesystem>
#include <vector>

#include "fitting/material/material_fit.hpp"

namespace rollres {

/// Writes `shifts.csv` (temperature [K], log10_a_T, b_T where it was found: a `shift_table_file`) and draws the table
/// with WLF, Arrhenius and VFT through it; and `van_gurp_palmen`, the rows' loss angles over |G*| at each temperature,
/// which lie on one curve where superposition holds. @return the files   @throws as write_file and draw_chart
std::vector<std::filesystem::path> write_free_shifts(const MaterialFit& found, const std::vector<MeasuredModulus>& data,
                                                     const std::string& name, const std::filesystem::path& folder);

}  // namespace rollres
