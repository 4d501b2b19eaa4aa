#include "core/numerics/cores.hpp"

#include <sched.h>

#include <thread>

#include "core/numerics/parallel.hpp"
#include "tests/catch.hpp"
#include "tests/studies/temporary_directory.hpp"

using namespace rollres;

TEST_CASE("quotas of control groups are read in both versions", "[core][parallel][cores]") {
  CHECK(cores_of_quota("200000 100000\n") == 2);
  CHECK(cores_of_quota("150000 100000") == 1.5);
  CHECK(cores_of_quota("50000\n 100000\n") == 0.5);
  for (const char* const none :
       {"max 100000\n", "-1\n 100000\n", "", " ", "100000", "0 100000", "100000 0", "some words"})
    CHECK_FALSE(cores_of_quota(none).has_value());
}

TEST_CASE("the smallest quota of a process's groups counts", "[core][parallel][cores]") {
  const TemporaryDirectory root;
  const auto write = [&](const std::string& file, const std::string& text) {
    std::filesystem::create_directories((root / file).parent_path());
    root.write(file, text);
  };
  CHECK_FALSE(cores_of_control_groups(root.path).has_value());
  write("proc/self/cgroup", "0::/system.slice/job.scope\n");
  CHECK_FALSE(cores_of_control_groups(root.path).has_value());
  write("sys/fs/cgroup/system.slice/job.scope/cpu.max", "max 100000\n");
  CHECK_FALSE(cores_of_control_groups(root.path).has_value());
  write("sys/fs/cgroup/system.slice/cpu.max", "350000 100000\n");
  CHECK(cores_of_control_groups(root.path) == 3.5);
  write("sys/fs/cgroup/system.slice/job.scope/cpu.max", "200000 100000\n");
  CHECK(cores_of_control_groups(root.path) == 2);

  // Version 1 in a container: the group has the host's name, and only the mount is there.
  write("proc/self/cgroup", "5:cpuset:/docker/1\n4:cpu,cpuacct:/docker/1\n0::/\n");
  CHECK_FALSE(cores_of_control_groups(root.path).has_value());
  write("sys/fs/cgroup/cpu/cpu.cfs_quota_us", "-1\n");
  write("sys/fs/cgroup/cpu/cpu.cfs_period_us", "100000\n");
  CHECK_FALSE(cores_of_control_groups(root.path).has_value());
  write("sys/fs/cgroup/cpu/cpu.cfs_quota_us", "50000\n");
  CHECK(cores_of_control_groups(root.path) == 0.5);
}

TEST_CASE("the default number of jobs respects the affinity", "[core][parallel][cores]") {
  CHECK(usable_cores() >= 1);
  CHECK(usable_cores() <= static_cast<int>(std::thread::hardware_concurrency()));
  CHECK(jobs_for(0, 100000) == static_cast<std::size_t>(usable_cores()));
  std::jthread([] {
    cpu_set_t allowed, one;
    CHECK(sched_getaffinity(0, sizeof allowed, &allowed) == 0);
    CPU_ZERO(&one);
    for (int core = 0; core < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++core)
      if (CPU_ISSET(core, &allowed)) CPU_SET(core, &one);
    CHECK(sched_setaffinity(0, sizeof one, &one) == 0);
    CHECK(usable_cores() == 1);
    CHECK(jobs_for(0, 10) == 1);
    CHECK(jobs_for(3, 10) == 3);
  }).join();
}
