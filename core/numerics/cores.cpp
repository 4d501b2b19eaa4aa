#include "core/numerics/cores.hpp"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <thread>

namespace rollres {

namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Of a group and those above it. In a container the group may have the host's name: then only the mount is there.
double smallest_quota(const fs::path& mount, fs::path group, bool second_version) {
  double cores = std::numeric_limits<double>::infinity();
  for (;; group = group.parent_path()) {
    const fs::path folder = mount / group.relative_path();
    const auto quota = cores_of_quota(second_version ? content_of(folder / "cpu.max")
                                                     : content_of(folder / "cpu.cfs_quota_us") + " " +
                                                           content_of(folder / "cpu.cfs_period_us"));
    cores = std::min(cores, quota.value_or(cores));
    if (group.relative_path().empty()) return cores;
  }
}

int cores_of_affinity() {
  cpu_set_t set;  // of 1024 cores; where there are more, the call fails
  if (sched_getaffinity(0, sizeof set, &set) == 0) return CPU_COUNT(&set);
  return static_cast<int>(std::thread::hardware_concurrency());
}

}  // namespace

std::optional<double> cores_of_quota(std::string_view text) {
  std::istringstream stream{std::string(text)};
  stream.imbue(std::locale::classic());
  double quota = 0, period = 0;
  if (!(stream >> quota >> period) || !(quota > 0) || !(period > 0)) return std::nullopt;
  return quota / period;
}

std::optional<double> cores_of_control_groups(const fs::path& root) {
  double cores = std::numeric_limits<double>::infinity();
  std::ifstream groups(root / "proc/self/cgroup");
  const fs::path mount = root / "sys/fs/cgroup";
  for (std::string line; std::getline(groups, line);) {  // NUMBER:CONTROLLERS:GROUP, of version 2 without controllers
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = std::string(",").append(line, first + 1, second - first - 1).append(",");
    const fs::path group = line.substr(second + 1);
    if (controllers == ",,")
      cores = std::min(cores, smallest_quota(mount, group, true));
    else if (controllers.find(",cpu,") != std::string::npos)
      cores = std::min(cores, smallest_quota(mount / "cpu", group, false));
  }
  return std::isfinite(cores) ? std::optional(cores) : std::nullopt;
}

int usable_cores() {
  static const double quota = cores_of_control_groups("/").value_or(std::numeric_limits<double>::infinity());
  return std::max(1, static_cast<int>(std::min<double>(cores_of_affinity(), std::ceil(quota))));
}

}  // namespace rollres
