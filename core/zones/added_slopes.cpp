#include "core/zones/added_slopes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rollres {

std::vector<double> ends_of_zones(const SpectralEdges& edges) {
  const Interval& contact = edges.contact;
  std::vector<double> ends{contact.from, contact.to};
  for (const Interval& stick : edges.sticks)
    for (const double end : {stick.from, stick.to})
      if (std::find(ends.begin(), ends.end(), end) == ends.end()) ends.push_back(end);
  return ends;
}

AddedSlopes::AddedSlopes(const SpectralProblem& part, const SpectralField& field, const SpectralEdges& edges,
                         double from, double to, std::size_t most)
    : part_(part), field_(field), most_(most) {
  if (!part.layered()) return;
  const Interval& contact = edges.contact;
  if (!part.model.ring()) {
    const auto itself = [](double x) { return x; };
    tabulate(from, to, from, to, itself, itself);
    return;
  }
  const double centre = contact.centre(), half = contact.half_length();
  const auto angle = [=](double x) { return std::acosh(std::max(1.0, std::abs((x - centre) / half))); };
  if (from < contact.from)
    tabulate(from, contact.from, angle(from), 0, angle, [=](double at) { return centre - half * std::cosh(at); });
  std::vector<double> ends = ends_of_zones(edges);
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const Interval zone{ends[i], ends[i + 1]};
    tabulate(
        zone.from, zone.to, -M_PI / 2, M_PI / 2,
        [=](double x) { return std::asin(std::clamp(place_in(zone, x), -1.0, 1.0)); },
        [=](double at) { return zone.centre() + zone.half_length() * std::sin(at); });
  }
  if (to > contact.to)
    tabulate(contact.to, to, 0, angle(to), angle, [=](double at) { return centre + half * std::cosh(at); });
}

SpectralField::Slopes AddedSlopes::operator()(double x) const {
  if (!part_.layered()) return {0, 0};
  for (const Stretch& stretch : stretches_)
    if (x >= stretch.from && x <= stretch.to) {
      const Eigen::Array2d sum = stretch.table(stretch.variable(x));
      return {sum(0), sum(1)};
    }
  return field_.added_slopes(part_, x);
}

void AddedSlopes::tabulate(double from, double to, double first, double last, Variable variable,
                           const Variable& place) {
  constexpr int degree = 17;
  const double panels = std::ceil((to - from) / part_.correction->depth());
  if (panels * (degree + 1) > static_cast<double>(most_)) return;
  if (last < first) std::swap(first, last);
  std::vector<double> borders;
  for (int i = 0; i <= static_cast<int>(panels); ++i) borders.push_back(first + (last - first) * i / panels);
  stretches_.push_back({from, to, std::move(variable), ChebyshevTable<2>(std::move(borders), degree, [&](double at) {
                          const SpectralField::Slopes value = field_.added_slopes(part_, place(at));
                          return Eigen::Array2d(value.w, value.u);
                        })});
}

}  // namespace rollres
