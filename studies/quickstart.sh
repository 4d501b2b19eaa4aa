#!/bin/sh
# From a fresh Debian 12 to a chart: installs what is missing (as root or through sudo), builds, computes the rolling
# resistance of a cylinder against speed for three loads, stores it and draws it. Started again it computes only
# what the database lacks.
set -u
script=studies/quickstart.sh
CDPATH= cd -- "$(dirname -- "$0")/.." || exit 1
. ./studies/setup.sh

name=speed_resistance
install_packages $packages
build release rollres

rollres=build/release/rollres
mkdir -p out && [ -w out ] || fail "no right to write into $PWD/out; remove it, then start again"
say "study: $name"
"$rollres" sweep "studies/examples/$name.json" --db "out/$name.db"
[ $? -le 1 ] ||  # 1: some points have no answer; the chart marks them
  fail "the study stopped as it says above; mend that, then start again: it goes on where it stopped"
"$rollres" chart --db "out/$name.db" --out "out/$name" >/dev/null ||
  fail "the chart could not be drawn as it says above; mend that, then start again"

say "chart: $PWD/out/$name.svg"
say "       $PWD/out/$name.png"
say "database: $PWD/out/$name.db"
say "next: $PWD/$rollres --help"
