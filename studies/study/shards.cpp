#include "studies/study/shards.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <queue>
#include <stdexcept>
#include <unordered_map>
#include <utility>

namespace rollres {

namespace {

/// Nanoseconds, rounded to two digits.
std::int64_t rounded_cost(double seconds) {
  const double nanoseconds = 1e9 * seconds;
  const double unit = std::pow(10.0, std::floor(std::log10(nanoseconds)) - 1);
  return std::llround(std::round(nanoseconds / unit) * unit);
}

bool read_number(std::string_view text, int& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

struct QueueVariable {
  const char* name;
  int first;  // index of the first task
};
constexpr QueueVariable queue_variables[]{{"SLURM_ARRAY_TASK_ID", 1},
                                          {"PBS_ARRAY_INDEX", 1},
                                          {"SGE_TASK_ID", 1},
                                          {"LSB_JOBINDEX", 1},
                                          {"OAR_ARRAY_INDEX", 1},
                                          {"JOB_COMPLETION_INDEX", 0},
                                          {"AWS_BATCH_JOB_ARRAY_INDEX", 0}};

[[noreturn]] void refuse_unset(std::string_view text) {
  std::string names;
  for (const QueueVariable& variable : queue_variables)
    names += (names.empty() ? "" : ", ") + std::string(variable.name);
  throw std::invalid_argument("shard = " + std::string(text) + ": no queue tells the index of a task (" + names +
                              "): submit an array of jobs, or give I/N");
}

/// The part that a queue's variable names.
/// @param text  "auto/16"
Shard shard_of_queue(std::string_view text, int count) {
  Shard shard{0, count};
  for (const auto& [name, first] : queue_variables) {
    const char* const set = std::getenv(name);
    const std::string value = set ? set : "";
    if (value.empty() || value == "undefined" || (value == "0" && name == std::string_view("LSB_JOBINDEX"))) continue;
    const std::string variable = std::string(name) + " = " + value;
    int index = 0;
    if (!read_number(value, index) || index < first || index - first >= count)
      throw std::invalid_argument("shard = " + std::string(text) + ": " + variable + ": must be from " +
                                  std::to_string(first) + " to " + std::to_string(count - 1 + first));
    if (shard.index > 0 && shard.index != index - first + 1)
      throw std::invalid_argument("shard = " + std::string(text) + ": " + shard.variable + " and " + variable +
                                  " are different tasks: give I/N");
    if (shard.index == 0) shard = {index - first + 1, count, variable};
  }
  if (shard.index == 0) refuse_unset(text);
  return shard;
}

}  // namespace

Shard parse_shard(std::string_view text) {
  Shard shard;
  const std::size_t slash = text.find('/');
  const bool automatic = text.starts_with("auto/");
  const bool read = slash != std::string_view::npos && (automatic || read_number(text.substr(0, slash), shard.index)) &&
                    read_number(text.substr(slash + 1), shard.count);
  if (!read || shard.index < 1 || shard.index > shard.count || shard.count > most_shards)
    throw std::invalid_argument("shard = " + std::string(text) +
                                ": must be I/N or auto/N with I from 1 to N, N up to " + std::to_string(most_shards));
  return automatic ? shard_of_queue(text, shard.count) : shard;
}

std::vector<int> shards_of_points(std::span<const std::string> keys, std::span<const double> seconds, int count) {
  std::vector<int> shards(keys.size(), 1);
  if (count == 1) return shards;
  std::unordered_map<std::string_view, std::size_t> first;
  std::vector<std::pair<std::int64_t, std::size_t>> work;  // of each key, at its first point
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (first.emplace(keys[i], i).second) work.emplace_back(rounded_cost(seconds[i]), i);
  std::stable_sort(work.begin(), work.end(), [](const auto& a, const auto& b) { return a.first > b.first; });

  using Load = std::pair<std::int64_t, int>;  // of a shard
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (int shard = 1; shard <= count; ++shard) loads.emplace(0, shard);
  for (const auto& [cost, point] : work) {
    const auto [load, shard] = loads.top();
    loads.pop();
    shards[point] = shard;
    loads.emplace(load + cost, shard);
  }
  for (std::size_t i = 0; i < keys.size(); ++i) shards[i] = shards[first.at(keys[i])];
  return shards;
}

std::string array_list(std::span<const int> numbers) {
  std::string list;
  for (std::size_t begin = 0, end = 0; begin < numbers.size(); begin = end) {
    for (end = begin + 1; end < numbers.size() && numbers[end] == numbers[end - 1] + 1;) ++end;
    list += (list.empty() ? "" : ",") + std::to_string(numbers[begin]);
    if (end > begin + 1) list += (end > begin + 2 ? "-" : ",") + std::to_string(numbers[end - 1]);
  }
  return list;
}

}  // namespace rollres
