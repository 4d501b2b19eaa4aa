#pragma once

/// What is costly to make, kept for the next who asks for the same: small caches shared by all threads.

#include <algorithm>
#include <cstddef>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

namespace rollres {

/// Empties every RecentlyMade of the program, so that the next solution is as cold as a program's first, but for the
/// plans of transforms and what does not depend on the scene.
void forget_kernels();

/// A cache that `forget_kernels` empties; none ends before the program.
class Forgettable {
 public:
  Forgettable();
  virtual void forget() = 0;

 protected:
  ~Forgettable() = default;
};

/// What depends on a whole number alone: made once in each thread, of that number, and kept.
template <class Made>
const Made& kept_for_thread(
    int number, Made (*make)(int) = [](int one) { return Made(one); }) {
  thread_local std::map<int, Made> kept;
  const auto found = kept.find(number);
  return found != kept.end() ? found->second : kept.emplace(number, make(number)).first->second;
}

/// Values by keys; the most recently used are kept. `Serves(kept key, wanted key)` tells whether a value will do.
template <class Key, class Value, std::size_t capacity, class Serves = std::equal_to<Key>>
class RecentlyMade final : Forgettable {
 public:
  /// The kept value, or what `make()` returns: outside the lock, so that two threads may make the same, one of which
  /// is kept.
  template <class Make>
  std::shared_ptr<const Value> operator()(const Key& key, const Make& make) {
    if (auto known = find(key)) return known;
    auto made = std::make_shared<const Value>(make());
    const std::lock_guard lock(mutex_);
    if (auto other = find_locked(key)) return other;
    kept_.emplace_front(key, made);
    if (kept_.size() > capacity) kept_.pop_back();
    return made;
  }

  void forget() override {
    const std::lock_guard lock(mutex_);
    kept_.clear();
  }

 private:
  std::shared_ptr<const Value> find(const Key& key) {
    const std::lock_guard lock(mutex_);
    return find_locked(key);
  }
  std::shared_ptr<const Value> find_locked(const Key& key) {
    const auto found =
        std::find_if(kept_.begin(), kept_.end(), [&](const auto& entry) { return Serves()(entry.first, key); });
    if (found == kept_.end()) return nullptr;
    kept_.splice(kept_.begin(), kept_, found);
    return found->second;
  }

  std::mutex mutex_;
  std::list<std::pair<Key, std::shared_ptr<const Value>>> kept_;  // most recently used first
};

}  // namespace rollres
