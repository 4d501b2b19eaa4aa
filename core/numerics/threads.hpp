#pragma once

/// How many threads one solution may take. Work on large grids is shared out by oneTBB; where scenes are solved side by
/// side, each solving thread takes one.

#include <functional>

namespace rollres {

/// From now on solutions begun by the calling thread take at most this many threads.
void limit_threads(int count);

/// Threads for work on so many points of a padded grid: one for small ones, where waking others costs more.
int threads_for(double points);

/// Calls work(index, slot) for each index from 0 to count - 1, side by side if threads > 1. Calls with the same slot,
/// which is less than `threads`, follow one another.
void share_out(int count, int threads, const std::function<void(int index, int slot)>& work);

}  // namespace rollres
