#include "core/material/lumped_spectrum.hpp"

#include <algorithm>
#include <cmath>

namespace rollres {

namespace {

using Iterator = std::vector<CreepSpectrum::Term>::const_iterator;

CreepSpectrum::Term joined_short(Iterator begin, Iterator end) {
  if (end - begin == 1) return *begin;
  double compliance = 0, moment = 0;
  for (auto term = begin; term != end; ++term) {
    compliance += term->compliance;
    moment += term->compliance * term->time;
  }
  return {compliance, moment / compliance};
}

CreepSpectrum::Term joined_long(Iterator begin, Iterator end, double unending) {
  if (end - begin == 1 && begin->time <= unending) return *begin;
  double rate = 0, logarithms = 0;
  for (auto term = begin; term != end; ++term) {
    rate += term->compliance / term->time;
    logarithms += term->compliance / term->time * std::log(term->time);
  }
  const double time = std::min(std::exp(logarithms / rate), unending);
  return {rate * time, time};
}

}  // namespace

CreepSpectrum lumped(const CreepSpectrum& spectrum, const MemoryRange& range) {
  const auto& terms = spectrum.terms;
  const auto from =
      std::partition_point(terms.begin(), terms.end(), [&](const auto& t) { return t.time < range.shortest; });
  const auto to = std::partition_point(from, terms.end(), [&](const auto& t) { return t.time <= range.longest; });
  CreepSpectrum few{.instantaneous = spectrum.instantaneous, .terms = {}};
  if (from != terms.begin()) few.terms.push_back(joined_short(terms.begin(), from));
  few.terms.insert(few.terms.end(), from, to);
  if (to != terms.end()) few.terms.push_back(joined_long(to, terms.end(), range.unending));
  return few;
}

MemoryRange memory_range(double speed, double smallest, double largest) {
  return {1e-3 * smallest / speed, 1e4 * largest / speed, 1e10 * largest / speed};
}

}  // namespace rollres
