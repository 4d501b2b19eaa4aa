#include "core/numerics/recently_made.hpp"

#include <vector>

namespace rollres {

namespace {

struct Caches {
  std::mutex mutex;
  std::vector<Forgettable*> all;
};

Caches& caches() {
  static Caches caches;
  return caches;
}

}  // namespace

Forgettable::Forgettable() {
  const std::lock_guard lock(caches().mutex);
  caches().all.push_back(this);
}

void forget_kernels() {
  const std::lock_guard lock(caches().mutex);
  for (Forgettable* const cache : caches().all) cache->forget();
}

}  // namespace rollres
