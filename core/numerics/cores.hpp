#pragma once

/// How many cores this process may use: less than the machine has in a container, a job of a queue, under taskset.

#include <filesystem>
#include <optional>
#include <string_view>

namespace rollres {

/// Cores of a quota of control groups, "QUOTA PERIOD" as in cpu.max of version 2; of version 1 the contents of
/// cpu.cfs_quota_us and cpu.cfs_period_us, one after the other. Nothing for "max", -1, and what is no quota.
std::optional<double> cores_of_quota(std::string_view text);

/// The smallest quota of this process's control groups and those above them [cores]; nothing: there is none.
/// @param root  of the file system, with proc/self/cgroup and sys/fs/cgroup
std::optional<double> cores_of_control_groups(const std::filesystem::path& root);

/// Cores that the affinity of the calling thread and the quotas allow; a part of a core counts as one. At least 1.
int usable_cores();

}  // namespace rollres
