#!/bin/sh
# From a fresh Debian 12 to a chart: installs what is missing (as root or through sudo), builds, computes the rolling
# resistance of a cylinder against speed for three loads, stores it and draws it. Started again it computes only
# what the database lacks.
set -u
CDPATH= cd -- "$(dirname -- "$0")/.." || exit 1
. ./studies/setup.sh

name=speed_resistance
install_packages $packages
build_release rollres

rollres=build/release/rollres
mkdir -p out || fail "cannot make the folder $PWD/out"
"$rollres" sweep "studies/examples/$name.json" --db "out/$name.db"
[ $? -le 1 ] || fail "the study stopped, see above"  # 1: some points have no answer; the chart marks them
"$rollres" chart --db "out/$name.db" --out "out/$name" || fail "the chart could not be drawn, see above"

say ""
say "database  $PWD/out/$name.db"
say "pictures  $PWD/out/$name.svg"
say "          $PWD/out/$name.png"
say "next      $PWD/$rollres --help"
