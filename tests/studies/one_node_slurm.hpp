#pragma once

/// A Slurm cluster of one node, this one, on loopback: started by a test, and gone without a trace after it.

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/studies/shell.hpp"
#include "tests/studies/temporary_directory.hpp"

class OneNodeSlurm {
 public:
  /// Starts the daemons; `trouble` tells why there is no cluster. Commands of this process find it by SLURM_CONF.
  OneNodeSlurm() {
    for (const char* const program : {"munged", "slurmctld", "slurmd", "sbatch"})
      if (path_of(program).empty()) {
        trouble = std::string(program) + " is not installed (Debian: slurm-wlm, munge)";
        return;
      }
    ::prctl(PR_SET_CHILD_SUBREAPER, 1);  // what Slurm leaves behind becomes ours
    write_files();
    const std::string folder = folder_.path.string();
    start({"munged", "--foreground", "--force", "--socket=" + folder + "/munge.socket",
           "--key-file=" + folder + "/munge.key", "--pid-file=" + folder + "/munged.pid",
           "--seed-file=" + folder + "/munge.seed", "--log-file=" + folder + "/munged.log", "--num-threads=2"});
    start({"slurmctld", "-D", "-i", "-f", folder + "/slurm.conf"});
    start({"slurmd", "-D", "-N", "localhost", "-f", folder + "/slurm.conf"});
    ::setenv("SLURM_CONF", (folder + "/slurm.conf").c_str(), 1);
    const bool up = within(10, [] { return run_shell("timeout 5 sinfo -h -o %t").out.find("idle") == 0; });
    if (!up) trouble = "Slurm cannot run here as this user: " + run_shell("tail -n 3 '" + folder + "'/slurm*.log").out;
  }
  OneNodeSlurm(const OneNodeSlurm&) = delete;
  OneNodeSlurm& operator=(const OneNodeSlurm&) = delete;
  ~OneNodeSlurm() {
    if (daemons_.empty()) return;
    if (trouble.empty()) {
      run_shell("timeout 5 scancel --user=\"$(id -un)\"");
      wait_until_empty(5);
    }
    for (auto daemon = daemons_.rbegin(); daemon != daemons_.rend(); ++daemon) ::kill(*daemon, SIGTERM);
    if (!within(5, [] { return children().empty(); }))
      within(5, [] {
        for (const pid_t child : children()) ::kill(child, SIGKILL);
        return children().empty();
      });
    ::prctl(PR_SET_CHILD_SUBREAPER, 0);
    ::unsetenv("SLURM_CONF");
  }

  std::string trouble;

  /// Whether all jobs have ended in time.
  bool wait_until_empty(double seconds) const {
    return within(seconds, [] { return run_shell("timeout 5 squeue -h").out.empty(); });
  }

  template <class Condition>
  static bool within(double seconds, Condition condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return true;
  }

  /// Processes that this one has to wait for; those that have ended are taken leave of.
  static std::vector<pid_t> children() {
    while (::waitpid(-1, nullptr, WNOHANG) > 0) {
    }
    std::vector<pid_t> all;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
      std::ifstream in(task.path() / "children");
      for (pid_t child; in >> child;) all.push_back(child);
    }
    return all;
  }

 private:
  static std::string path_of(const std::string& program) {
    std::string place = run_shell("PATH=$PATH:/usr/sbin:/sbin command -v " + program).out;
    while (!place.empty() && place.back() == '\n') place.pop_back();
    return place;
  }

  static int free_port() {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof address;
    ::bind(socket, reinterpret_cast<sockaddr*>(&address), length);
    ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &length);
    ::close(socket);
    return ntohs(address.sin_port);
  }

  void write_files() {
    std::random_device random;
    std::string key;
    for (int i = 0; i < 128; ++i) key += static_cast<char>(random());
    using std::filesystem::perms;
    std::filesystem::permissions(folder_.write("munge.key", key), perms::owner_read | perms::owner_write);
    std::filesystem::permissions(folder_.path, perms(0755));
    for (const char* const name : {"state", "spool"}) std::filesystem::create_directory(folder_ / name);
    char host[256] = {};
    ::gethostname(host, sizeof host - 1);
    const std::string folder = folder_.path.string(),
                      short_host = std::string(host).substr(0, std::string(host).find('.'));
    std::string user = run_shell("id -un").out;
    user.pop_back();
    folder_.write("slurm.conf",
                  "ClusterName=test\nSlurmctldHost=" + short_host +
                      "(127.0.0.1)\nSlurmctldPort=" + std::to_string(free_port()) +
                      "\nSlurmdPort=" + std::to_string(free_port()) + "\nSlurmUser=" + user + "\nSlurmdUser=" + user +
                      "\nAuthType=auth/munge\nCredType=cred/munge\nAuthInfo=socket=" + folder +
                      "/munge.socket\nStateSaveLocation=" + folder + "/state\nSlurmdSpoolDir=" + folder +
                      "/spool\nSlurmctldPidFile=" + folder + "/slurmctld.pid\nSlurmdPidFile=" + folder +
                      "/slurmd.pid\nSlurmctldLogFile=" + folder + "/slurmctld.log\nSlurmdLogFile=" + folder +
                      "/slurmd.log\nNodeName=localhost NodeHostname=" + short_host +
                      " NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN\n"
                      R"(ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_min_interval=100000,bf_interval=1
MpiDefault=none
ReturnToService=2
SlurmdParameters=config_overrides
MailProg=/bin/true
KillWait=2
PartitionName=test Nodes=localhost Default=YES MaxTime=INFINITE State=UP
)");
  }

  void start(const std::vector<std::string>& words) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const std::string program = path_of(words.front());
    const std::string log = (folder_ / (words.front() + ".out")).string();
    const pid_t child = ::fork();
    if (child == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
      ::dup2(out, STDOUT_FILENO);
      ::dup2(out, STDERR_FILENO);
      ::execv(program.c_str(), arguments.data());
      ::_exit(127);
    }
    daemons_.push_back(child);
  }

  TemporaryDirectory folder_;
  std::vector<pid_t> daemons_;
};
