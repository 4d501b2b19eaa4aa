#pragma once

/// Peaks of a traction that lie so close to the contact's edge that a grid does not resolve them: where memory or a
/// zone of slip is shorter than a cell, the traction rises and falls again within one or two of them.

#include <string>
#include <string_view>
#include <vector>

namespace rollres {

/// Of 160 random cylinders with 120 nodes, those warned of had peak pressures off by 1 to 21 % and peak shears by 1 to
/// 73 %, from those of continuous edges; the others below 1 % and, mostly, 10 %.
/// @param output    the key of the peak, `peak` its value
/// @param sizes     of the traction from one end of the contact to the other, node by node
/// @param cells     from an end within which a peak is not resolved
/// @param what, cure  "grid" and "spacing": a smaller one helps
/// @return a warning, or nothing
std::string unresolved_peak(std::string_view output, double peak, const std::vector<double>& sizes, std::size_t cells,
                            std::string_view what, std::string_view cure);

}  // namespace rollres
