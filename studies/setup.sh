# Sourced by studies/quickstart.sh, tests/run.sh and tests/sanitizers.sh, from the top of the repository: what
# installing, building and testing need. `script` is the name of the one that runs.

# The one list of Debian packages, each with what includes, links or runs it. Essential ones (bash, gzip) are left out.
packages=$(sed 's/:.*//' <<'LIST'
g++: compiles
cmake: configures, installs, runs the tests
ninja-build: builds
pkg-config: finds FFTW, NLopt and muParser
git: names the commit that results state
catch2: catch2/catch.hpp
libcpp-httplib-dev: httplib.h
libboost-dev: boost/math/distributions, boost/random/sobol.hpp
libceres-dev: ceres/ceres.h
libcli11-dev: CLI/CLI.hpp
libeigen3-dev: Eigen/Core
libfftw3-dev: fftw3.h
libgoogle-glog-dev: glog/logging.h
libmuparser-dev: muParser.h
libnlopt-cxx-dev: nlopt.hpp
libnlopt-dev: libnlopt.so, nlopt.pc
libsqlite3-dev: sqlite3.h
libsqlitecpp-dev: SQLiteCpp/SQLiteCpp.h
libtbb-dev: oneapi/tbb
libudunits2-dev: udunits2.h
libxlsxwriter-dev: xlsxwriter.h
nlohmann-json3-dev: nlohmann/json.hpp
zlib1g-dev: zlib.h
gnuplot-nox: draws charts
fonts-dejavu-core: letters of PNG charts
LIST
)
# What tests run besides.
test_packages=$(sed 's/:.*//' <<'LIST'
slurm-wlm: a cluster of one node
munge: signs the cluster's messages
parallel: shards side by side
mount: the root in which the folder to copy is tried
sqlite3: the README's shell
python3-pandas: the README's Python
pybind11-dev: pybind11/pybind11.h, the Python package
python3-dev: Python.h
python3-scipy: an example of the Python package
python3-matplotlib: an example of the Python package
python3-lmfit: an example of the Python package
python3-joblib: an example of the Python package
python3-distributed: an example of the Python package
r-cran-dbi: the README's R
r-cran-rsqlite: the README's R
r-base-core: the README's R
python3-jsonschema: holds files against their schemas
chromium-headless-shell: reports in a browser
fish: completion
zsh: completion
man-db: manual page
dpkg-dev: the Debian package
file: the Debian package
LIST
)

say() { printf '%s\n' "$*"; }

# Tests write thousands of small files and databases, and wait for the disk: they go into memory where it has room.
temporary_files_in_memory() {
  [ -z "${TMPDIR-}" ] && [ -w /dev/shm ] && [ "$(df --output=avail /dev/shm | tail -n 1)" -gt 4000000 ] || return 0
  export TMPDIR=/dev/shm
}

# The last line of a run that failed tells what to do.
fail() {
  printf '%s: %s\n' "$script" "$*" >&2
  exit 1
}

# Runs a command, keeps all that it prints in a file and shows how far it is: packages of apt-get, steps of ninja, tests
# of ctest, on a terminal in one line that changes, elsewhere in a line for each fifth. What ninja and ctest print
# besides, a compiler's messages and failed tests, is shown whole.
# follow packages|build|tests FILE COMMAND...
follow() {
  what=$1 file=$2
  shift 2
  { "$@" 2>&1; say "$script: ended with $?"; } | tee "$file" | {
    [ -t 1 ] && [ "${TERM:-dumb}" != dumb ] && erase=$(printf '\r\033[K') || erase=
    all=0 fetched=0 unpacked=0 set_up=0 fifth=0
    while IFS= read -r line; do
      now=
      case $what:$line in
        *":$script: ended with "*) break ;;
        packages:*" newly installed"*) line=${line%% newly*} all=${line##* } ;;
        packages:"Get:"*) fetched=$((fetched + 1)) now="$fetched/$all fetched" ;;
        packages:"Unpacking "*) unpacked=$((unpacked + 1)) now="$unpacked/$all unpacked" ;;
        packages:"Setting up "*) set_up=$((set_up + 1)) now="$set_up/$all set up" ;;
        packages:*) ;;
        build:"["*/*"] "*) now=${line%%"] "*} now=${now#"["} ;;
        tests:*/*" Test "*" Passed "*) now=${line%% Test *} now=${now##* } ;;
        tests:*" Start "*) ;;
        *) printf '%s%s\n' "$erase" "$line" ;;
      esac
      [ -n "$now" ] || continue
      done=${now%%/*} rest=${now#*/}
      total=${rest%% *}
      if [ -n "$erase" ]; then
        printf '%s%s: %s of %s' "$erase" "$what" "$done" "$rest"
      elif [ $((done * 5 / total)) -ne "$fifth" ]; then
        fifth=$((done * 5 / total))
        [ "$fifth" -eq 0 ] || say "$what: $done of $rest"
      fi
    done
    status=${line##* }
    [ "$status" -ne 0 ] && printf '%s' "$erase" || say "$erase$what: done"
    exit "$status"
  }
}

# Installs those of the packages named that are missing; needs neither rights nor a network if none is.
install_packages() {
  if ! command -v dpkg-query >/dev/null; then
    say "packages: this is no Debian; the counterparts of these have to be there: $*"
    return
  fi
  # One that another provides is there: gnuplot-qt has what gnuplot-nox has, and both at once is not possible.
  there=$(dpkg-query -W -f '${db:Status-Status} ${Package}, ${Provides},\n' | sed -n 's/^installed//p')
  missing=
  for package in "$@"; do
    case $there in
      *" $package,"* | *" $package ("*) ;;
      *) missing="$missing $package" ;;
    esac
  done
  if [ -z "$missing" ]; then
    say "packages: all $# are there"
    return
  fi
  command="apt-get install --no-install-recommends$missing"
  as_root=
  if [ "$(id -u)" -ne 0 ]; then
    as_root=sudo
    command -v sudo >/dev/null && sudo true || fail "packages are missing; have root run this, then start again: $command"
  fi
  say "packages: of $# these are missing and installed, with what they need:$missing"
  $as_root apt-get -qq update || say "packages: apt-get update failed; trying with the lists that are there"
  # LC_ALL: follow reads apt's English. Lock: a machine that has just started may be installing its updates.
  follow packages build/packages.log $as_root env LC_ALL=C DEBIAN_FRONTEND=noninteractive \
    apt-get -q -y -o DPkg::Lock::Timeout=600 install --no-install-recommends $missing || {
    grep -E '^(E:|dpkg: )' build/packages.log >&2
    fail "apt-get failed as it says above; mend that, then start again, or have root run: $command"
  }
}

# Builds a target of a preset.
# build PRESET TARGET
build() {
  cmake --preset "$1" >build/configure.log || fail "install what CMake misses above, or remove build/$1; then start again"
  NINJA_STATUS="[%f/%t] " follow build "build/$1.log" cmake --build --preset "$1" --target "$2" ||
    fail "install or mend what the first 'error:' above names (all is in build/$1.log), then start again"
}

[ -w . ] && mkdir -p build || fail "no right to write into $PWD; clone rollres into a folder of yours and start there"
