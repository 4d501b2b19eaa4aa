#pragma once

/// A study in parts for several machines that know nothing of each other.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rollres {

/// Part `index` of `count`, from 1 to count.
struct Shard {
  int index = 1;
  int count = 1;
  std::string variable = {};  ///< of the queue, with its value, that tells the index; empty: it was given

  std::string name() const { return std::to_string(index) + "/" + std::to_string(count); }
};

constexpr int most_shards = 100000;

/// Reads "3/16", or "auto/16": then a queue tells its task's index by a variable of the environment. Outside of arrays
/// some queues set it to nothing, "undefined" or, LSF, to 0: these count as not set.
/// @throws std::invalid_argument naming the rule
Shard parse_shard(std::string_view text);

/// The shard, from 1 to `count`, of each point. Follows from the scenes alone; points with the same key share a shard.
/// Longest first, each to the shard that has least to do (Graham 1969: at most 4/3 of the best possible longest shard),
/// by predicted_seconds to two digits, so that a last bit of another machine's logarithm moves no point.
/// @param keys     evaluation_key of each point
/// @param seconds  predicted_seconds of each point
std::vector<int> shards_of_points(std::span<const std::string> keys, std::span<const double> seconds, int count);

/// Increasing numbers as Slurm's --array takes them: "3,7-9".
std::string array_list(std::span<const int> numbers);

}  // namespace rollres
