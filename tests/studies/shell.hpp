#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <string>

/// What a command of the shell printed, and its exit status.
struct ShellRun {
  int status = -1;
  std::string out;
};

inline ShellRun run_shell(const std::string& command) {
  ShellRun run;
  FILE* const pipe = ::popen((command + " 2>&1").c_str(), "r");
  char buffer[4096];
  for (std::size_t got; pipe && (got = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) run.out.append(buffer, got);
  const int status = pipe ? ::pclose(pipe) : -1;
  run.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return run;
}

/// Whether the shell finds a program of this name.
inline bool installed(const std::string& program) { return run_shell("command -v " + program).status == 0; }
