#include "db/file/provenance.hpp"

#include <sys/utsname.h>

#include "provenance.inc"

namespace rollres {

const Provenance& this_program() {
  static const Provenance program = [] {
    utsname host{};
    const std::string machine =
        uname(&host) == 0 ? std::string(host.nodename) + " (" + host.sysname + " " + host.machine + ")" : "unknown";
    return Provenance{ROLLRES_VERSION, ROLLRES_GIT_HASH, ROLLRES_SOLVER_DIGEST, ROLLRES_COMPILER, machine};
  }();
  return program;
}

}  // namespace rollres
