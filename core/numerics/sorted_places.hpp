#pragma once

/// Places in the order of a key.

#include <algorithm>
#include <numeric>
#include <vector>

namespace rollres {

/// 0, 1, ... count - 1 in rising order of `key(place)`, which is a number; where it is the same, as they come.
template <class Place, class Key>
std::vector<Place> sorted_places(Place count, const Key& key) {
  std::vector<Place> places(static_cast<std::size_t>(count));
  std::iota(places.begin(), places.end(), Place{0});
  std::stable_sort(places.begin(), places.end(), [&](Place a, Place b) { return key(a) < key(b); });
  return places;
}

}  // namespace rollres
