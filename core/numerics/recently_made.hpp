#pragma once

/// What is costly to make, kept for the next who asks for the same: a small cache shared by all threads.

#include <algorithm>
#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <utility>

namespace rollres {

/// Values by keys that compare with ==; the most recently used are kept.
template <class Key, class Value, std::size_t capacity>
class RecentlyMade {
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

 private:
  std::shared_ptr<const Value> find(const Key& key) {
    const std::lock_guard lock(mutex_);
    return find_locked(key);
  }
  std::shared_ptr<const Value> find_locked(const Key& key) {
    const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const auto& entry) { return entry.first == key; });
    if (found == kept_.end()) return nullptr;
    kept_.splice(kept_.begin(), kept_, found);
    return found->second;
  }

  std::mutex mutex_;
  std::list<std::pair<Key, std::shared_ptr<const Value>>> kept_;  // most recently used first
};

}  // namespace rollres
