#pragma once

/// What is costly to make, kept for the next who asks for the same: small caches shared by all threads.

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "core/numerics/solution_limits.hpp"

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
  /// The kept value, or what `make()` returns, which may throw. Of threads that ask for the same one makes it, and the
  /// others wait for it, as long as their limits let them (solution_limits.hpp).
  template <class Make>
  std::shared_ptr<const Value> operator()(const Key& key, const Make& make) {
    std::unique_lock lock(mutex_);
    while (true) {
      if (auto known = find(key)) return known;
      if (!being_made(key)) break;
      changed_.wait_for(lock, std::chrono::milliseconds(20));
      require_time();
    }
    const Making making(*this, key);
    lock.unlock();
    auto made = std::make_shared<const Value>(make());
    const std::lock_guard again(mutex_);
    kept_.emplace_front(key, made);
    if (kept_.size() > capacity) kept_.pop_back();
    return made;
  }

  void forget() override {
    const std::lock_guard lock(mutex_);
    kept_.clear();
  }

 private:
  /// What is being made, by which process: one that was forked meanwhile has not the thread that makes it.
  using Wanted = std::pair<Key, pid_t>;
  /// Tells the others, while it lives, that this thread makes what the key asks for.
  class Making {
   public:
    /// Under the lock.
    Making(RecentlyMade& cache, const Key& key) : in_(cache) {
      in_.making_.emplace_front(key, getpid());
      wanted_ = in_.making_.begin();
    }
    ~Making() {
      const std::lock_guard lock(in_.mutex_);
      in_.making_.erase(wanted_);
      in_.changed_.notify_all();
    }
    Making(const Making&) = delete;
    Making& operator=(const Making&) = delete;

   private:
    RecentlyMade& in_;
    typename std::list<Wanted>::iterator wanted_;
  };

  bool being_made(const Key& key) const {
    return std::any_of(making_.begin(), making_.end(),
                       [&](const Wanted& other) { return other.second == getpid() && Serves()(other.first, key); });
  }
  std::shared_ptr<const Value> find(const Key& key) {
    const auto found =
        std::find_if(kept_.begin(), kept_.end(), [&](const auto& entry) { return Serves()(entry.first, key); });
    if (found == kept_.end()) return nullptr;
    kept_.splice(kept_.begin(), kept_, found);
    return found->second;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::list<std::pair<Key, std::shared_ptr<const Value>>> kept_;  // most recently used first
  std::list<Wanted> making_;
};

}  // namespace rollres
