# Sourced by studies/quickstart.sh and tests/run.sh, from the top of the repository: what installing and building need.
# The one list of Debian packages stands here.

packages="g++ cmake ninja-build pkg-config libeigen3-dev libfftw3-dev nlohmann-json3-dev libcli11-dev libsqlitecpp-dev
  libsqlite3-dev zlib1g-dev libudunits2-dev libtbb-dev libnlopt-dev libmuparser-dev libceres-dev libboost-dev catch2
  gnuplot-nox fonts-dejavu-core"
# What some tests need besides: a Slurm that they start themselves, and other programs that read what rollres writes.
test_packages="slurm-wlm munge sqlite3 python3-jsonschema"

say() { printf '%s\n' "$*"; }

fail() {
  printf '%s: %s\n' "$(basename -- "$0" .sh)" "$*" >&2
  exit 1
}

# Installs those of the packages named that are missing; needs no rights if none is.
install_packages() {
  if ! command -v dpkg-query >/dev/null 2>&1; then
    say "This is no Debian: have the counterparts of these packages installed:" "$@"
    return
  fi
  missing=
  for package in "$@"; do
    case $(dpkg-query -W -f '${Status}' "$package" 2>/dev/null) in
      "install ok installed") ;;
      *) missing="$missing $package" ;;
    esac
  done
  [ -n "$missing" ] || return 0

  if [ "$(id -u)" -eq 0 ]; then
    as_root=
  elif command -v sudo >/dev/null 2>&1; then
    as_root=sudo
  else
    fail "these packages are missing and installing them needs root:$missing"
  fi
  say "Installing$missing"
  $as_root apt-get -q update || fail "apt-get update failed, see above"
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y --no-install-recommends install $missing ||
    fail "apt-get could not install$missing, see above"
}

# Builds a target of the release preset.
build_release() {
  cmake --preset release || fail "the configuration failed, see above"
  cmake --build --preset release --target "$1" || fail "the build failed, see above"
}
