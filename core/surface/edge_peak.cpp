#include "core/surface/edge_peak.hpp"

#include <algorithm>

#include "core/messages/message_text.hpp"

namespace rollres {

std::string unresolved_peak(std::string_view output, double peak, const std::vector<double>& sizes, std::size_t cells,
                            std::string_view what, std::string_view cure) {
  constexpr double noticeable = 0.5;  // of the peak
  if (sizes.size() <= cells) return {};
  const auto rise = [&](auto end) {
    const auto beyond = end + static_cast<std::ptrdiff_t>(cells);
    const double most = *std::max_element(end, beyond);
    return most > *beyond ? most : 0;
  };
  const double highest = std::max(rise(sizes.begin()), rise(sizes.rbegin()));
  if (highest < noticeable * peak) return {};
  return message_text(output, " may be off by 10 % or more: within ", cells,
                      " cells of the contact's edge the traction has a maximum of ", 100 * highest / peak,
                      " % of the peak, and this ", what, " is too coarse for it; take a smaller ", cure);
}

}  // namespace rollres
