#include "studies/run/work_list.hpp"

#include <unordered_set>
#include <utility>

namespace rollres {

WorkList::WorkList(std::span<const std::string> keys, const std::vector<bool>& at_start,
                   std::function<bool(const std::string&)> known)
    : keys_(keys), known_(std::move(known)), is_open_(keys_.size(), 0) {
  std::unordered_set<std::string_view> seen;
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    if (!seen.insert(keys_[i]).second || at_start[i]) continue;
    is_open_[i] = 1;
    ++open_;
  }
}

std::size_t WorkList::open() const {
  const std::lock_guard lock(mutex_);
  return open_;
}

std::optional<std::size_t> WorkList::next() {
  const std::lock_guard lock(mutex_);
  while (open_ > 0) {
    while (!is_open_[cursor_]) cursor_ = (cursor_ + 1) % keys_.size();
    if (known_(keys_[cursor_])) {
      look_again();
      continue;
    }
    is_open_[cursor_] = 0;
    --open_;
    return cursor_;
  }
  return std::nullopt;
}

void WorkList::move_away() {
  const std::lock_guard lock(mutex_);
  look_again();
}

void WorkList::look_again() {
  std::size_t longest = 0, length = 0, last = 0;
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    if (is_open_[i] && known_(keys_[i])) {
      is_open_[i] = 0;
      --open_;
    }
    length = is_open_[i] ? length + 1 : 0;
    if (length > longest) {
      longest = length;
      last = i;
    }
  }
  if (longest > 0) cursor_ = last - longest / 2;
}

}  // namespace rollres
