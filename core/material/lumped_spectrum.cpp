#include "core/material/lumped_spectrum.hpp"

#include <algorithm>

namespace rollres {

namespace {

/// The terms of a group as one, its time such that the sum of compliance * time^power is kept.
CreepSpectrum::Term joined(std::vector<CreepSpectrum::Term>::const_iterator begin,
                           std::vector<CreepSpectrum::Term>::const_iterator end, int power) {
  if (end - begin == 1) return *begin;
  double compliance = 0, moment = 0;
  for (auto term = begin; term != end; ++term) {
    compliance += term->compliance;
    moment += power > 0 ? term->compliance * term->time : term->compliance / term->time;
  }
  return {compliance, power > 0 ? moment / compliance : compliance / moment};
}

}  // namespace

CreepSpectrum lumped(const CreepSpectrum& spectrum, const MemoryRange& range) {
  const auto& terms = spectrum.terms;
  const auto from = std::partition_point(terms.begin(), terms.end(), [&](const auto& t) { return t.time < range.shortest; });
  const auto to = std::partition_point(from, terms.end(), [&](const auto& t) { return t.time <= range.longest; });
  CreepSpectrum few{.instantaneous = spectrum.instantaneous, .terms = {}};
  if (from != terms.begin()) few.terms.push_back(joined(terms.begin(), from, 1));
  few.terms.insert(few.terms.end(), from, to);
  if (to != terms.end()) few.terms.push_back(joined(to, terms.end(), -1));
  return few;
}

MemoryRange memory_range(double speed, double smallest, double largest) {
  return {1e-3 * smallest / speed, 1e4 * largest / speed};
}

}  // namespace rollres
