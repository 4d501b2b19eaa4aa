#include "studies/report/report_slices.hpp"

#include <algorithm>
#include <iterator>

#include "studies/scene_io/cells.hpp"
#include "studies/text/readable_number.hpp"

namespace rollres {

namespace {

/// Rows as they are left where axes are fixed at their middle values, one after the other: those that go together with
/// one that is fixed have one value then, and those that scatter stay free.
FixedAxes fixed_at_middle(const ReportSource& source, const ReportOptions& options,
                          const std::vector<const QuantityColumn*>& axes) {
  FixedAxes fixed{options.filters, ""};
  for (const QuantityColumn* const axis : axes) {
    const ReportSource left = source.with(fixed.filters);
    const StudyRows& rows = left.rows;
    const std::vector<Cell> values = rows.values(*axis);
    if (values.size() < 2 || source.definition.uncertain.contains(key_of(*axis))) continue;
    const Cell& middle = *std::next(values.begin(), static_cast<std::ptrdiff_t>(values.size() / 2));
    const auto* const number = std::get_if<double>(&middle);
    fixed.filters.push_back({axis->name, Comparison::equal, number ? shortest(*number) : value_in_words(middle, "")});
    fixed.words += (fixed.words.empty() ? " at " : ", ") + in_words(std::string(axis->quantity.key)) + " = " +
                   value_in_words(axis->quantity, middle, unit_in(rows, *axis));
  }
  return fixed;
}

}  // namespace

std::vector<const QuantityColumn*> longest_first(const ReportSource& source, const std::string& wish) {
  std::vector<const QuantityColumn*> axes = source.varied();
  stable_sort(axes, [&](const auto* one, const auto* other) {
    const auto rank = [&](const auto* axis) {
      if (!wish.empty() && (key_of(*axis) == wish || axis->name == wish)) return source.rows.size() + 1;
      return axis->type == "TEXT" ? 0 : source.rows.values(*axis).size();
    };
    return rank(one) > rank(other);
  });
  return axes;
}

FixedAxes all_but_longest(const ReportSource& source, const ReportOptions& options, std::size_t free) {
  std::vector<const QuantityColumn*> axes = longest_first(source, options.x);
  axes.erase(axes.begin(), axes.begin() + static_cast<std::ptrdiff_t>(std::min(free, axes.size())));
  return fixed_at_middle(source, options, axes);
}

FixedAxes slice_along(const ReportSource& source, const ReportOptions& options, const QuantityColumn& along) {
  constexpr std::size_t most_colours = 7;
  std::vector<const QuantityColumn*> fixed;
  const QuantityColumn* family = nullptr;
  std::size_t most = 0;
  for (const QuantityColumn* const axis : longest_first(source, "")) {
    if (axis == &along || source.definition.are_together(key_of(along), key_of(*axis))) continue;
    fixed.push_back(axis);
    const std::size_t count = source.rows.values(*axis).size();
    const bool wished = key_of(*axis) == options.family || axis->name == options.family;
    if (wished || (options.family.empty() && count <= most_colours && count > most)) family = axis;
    if (family == axis) most = count;
  }
  std::erase(fixed, family);
  return fixed_at_middle(source, options, fixed);
}

}  // namespace rollres
