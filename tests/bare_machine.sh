#!/usr/bin/env bash
# The README's two commands on a machine that has nothing: makes a bare Debian 12 in a folder, with the Debian sources and
# apt's settings of this machine, clones HEAD into it and runs them there, then tests/sanitizers.sh. Fails if one of them
# fails, if the compiler warned, or if a test left something out for want of a program. Needs root; the last line is that
# of tests/run.sh.
set -u
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1

folder=$(mktemp -d) || exit 1
root=$folder/root clone="root/für Räder/rollres"
running=
# KILL, since unshare holds back all else; the processes in the root and their mounts go with it.
clean() {
  [ -z "$running" ] || kill -KILL "$running"
  wait
  rm -rf --one-file-system "$folder" 2>/dev/null || { sleep 2 && rm -rf --one-file-system "$folder"; }
}
trap clean EXIT
trap 'exit 1' HUP INT TERM

debian_sources() {
  apt-get indextargets --format 'deb $(REPO_URI) $(CODENAME) $(COMPONENT)' 'Created-By: Packages' 'Origin: Debian' |
    grep -E '^deb http.* bookworm(-updates|-security)? ' | sort -u
}

make_root() {
  [ "$(id -u)" -eq 0 ] && unshare --mount --pid --fork true || return
  # An update tells which sources are Debian's; it may fail for those of others.
  command -v mmdebstrap >/dev/null && [ -n "$(debian_sources)" ] || apt-get -qq update
  command -v mmdebstrap >/dev/null ||
    DEBIAN_FRONTEND=noninteractive apt-get -qq -y install --no-install-recommends mmdebstrap >/dev/null || return
  debian_sources >"$folder/sources" || echo "deb http://deb.debian.org/debian bookworm main" >"$folder/sources"
  apt-config dump | grep '^Acquire::' | grep -v Proxy-Auto-Detect >"$folder/settings"
  [ -z "${http_proxy-}" ] || echo "Acquire::http::Proxy \"$http_proxy\";" >>"$folder/settings"
  mmdebstrap --quiet --variant=apt --aptopt="$folder/settings" --dpkgopt=force-unsafe-io bookworm "$root" \
    "$folder/sources" && cp /etc/hosts "$root/etc/" && git clone --quiet --no-local . "$root/$clone"
}

commands='sh studies/quickstart.sh; first=$?; sh tests/run.sh; second=$?; sh tests/sanitizers.sh; third=$?
  worse=$((first > second ? first : second)); exit $((worse > third ? worse : third))'
# In namespaces of its own, so that nothing of it outlives unshare.
enter='
  mount -t proc proc "$1/proc"
  mount --rbind /sys "$1/sys"
  mount -t devpts -o newinstance,ptmxmode=0666 devpts "$1/dev/pts"
  mount -t tmpfs tmpfs "$1/dev/shm"
  exec chroot "$1" env -i --default-signal=INT,QUIT PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
    HOME=/root sh -c "cd \"/$2\" && $3"'

if make_root; then
  : >"$folder/output"
  setpriv --pdeathsig KILL unshare --mount --pid --fork --kill-child sh -euc "$enter" sh "$root" "$clone" "$commands" \
    >"$folder/output" 2>&1 </dev/null &
  running=$!
  tail --pid=$running -n +1 -f "$folder/output" &
  wait $running
  status=$?
  running=
  wait
else
  echo "NO BARE ROOT: THAT NEEDS ROOT, MOUNTS AND MMDEBSTRAP. ALL RUNS IN PLACE AND MAY USE WHAT IS ONLY HERE."
  sh -c "$commands" 2>&1 | tee "$folder/output"
  status=${PIPESTATUS[0]}
fi

last=$(grep -E '^[0-9]+ passed, [0-9]+ failed' "$folder/output" | tail -n 1)
[ -n "$last" ] || last=$(tail -n 1 "$folder/output")
complain() {
  echo "$1"
  [ "$status" -ne 0 ] || status=1
}
! grep '^SANITIZERS FOUND' "$folder/output" || complain "THE SANITIZERS REPORT: see above"
! grep -Eq ': warning: |^CMake .*Warning' "$folder/output" || complain "THE BUILD WARNED: see 'warning' above"
case $last in *skipped) complain "A TEST LEFT SOMETHING OUT: see 'not tried' above" ;; esac
echo "$last"
exit "$status"
