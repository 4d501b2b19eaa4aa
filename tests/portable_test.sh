#!/bin/sh
# The folder of studies/portable.sh and the image of studies/image.sh, in a root that holds glibc's files and nothing else: scenes,
# studies, queries, reports and fits run there, with the digits of the build, and what needs gnuplot says so.
# sh portable_test.sh TREE FOLDER; TREE must be built. Fails if a library or the database of units is taken from the system.
set -eu
tree=$1 folder=$2
here=$(cd "$(dirname "$0")/.." && pwd)
rm -rf "$folder" && mkdir -p "$folder/root/tmp" "$folder/root/dev"
trap 'rm -rf "$folder"' EXIT
# /proc tells the loader where the program is ($ORIGIN), as in every container.
[ "$(id -u)" -eq 0 ] && as_root= || as_root=--map-root-user
# Where / is no mount of its own, as in a chroot, its propagation cannot be set: there the caller has set it.
unshare $as_root --mount true 2>/dev/null && propagation= || propagation="--propagation unchanged"
unshare $as_root --mount $propagation true || { echo "not tried: no mounts of its own may be made here"; exit 77; }
enter='mount --rbind /proc "$0/proc" && mount --rbind /dev "$0/dev" && exec chroot "$0" "$@"'
portable=$(GZIP_LEVEL=1 sh "$here/studies/portable.sh" "$tree")
# glibc's files alone, as ldd finds them; no shell.
ldd "$tree/rollres" | grep -Eo '/[^ ]*/(ld-linux[^ ]*|lib(c|m|dl|rt|pthread)\.so\.[0-9]+)' >"$folder/glibc"
for file in $(cat "$folder/glibc") /lib/x86_64-linux-gnu/libpthread.so.0 /lib/x86_64-linux-gnu/libdl.so.2; do
  [ -e "$file" ] || continue
  mkdir -p "$folder/root${file%/*}" && cp -L "$file" "$folder/root$file"
done
tar -C "$folder/root" -cf "$folder/glibc.tar" .

# The image, unpacked: its one layer is the root with the folder in /opt/rollres.
image=$(sh "$here/studies/image.sh" "$portable" "$folder/image.tar" "$folder/glibc.tar")
mkdir "$folder/oci" "$folder/run" && tar -C "$folder/oci" -xf "$image"
blobs=$folder/oci/blobs/sha256
for blob in "$blobs"/*; do [ "$(sha256sum "$blob" | cut -d ' ' -f 1)" = "${blob##*/}" ]; done
python3 - "$folder/oci" >"$folder/layer" <<'PY'
import json, pathlib, sys
root = pathlib.Path(sys.argv[1])
def read(descriptor):
    path = root / "blobs" / descriptor["digest"].replace(":", "/")
    assert path.stat().st_size == descriptor["size"]
    return path
index = json.loads((root / "index.json").read_text())
manifest = json.loads(read(index["manifests"][0]).read_text())
config = json.loads(read(manifest["config"]).read_text())
assert json.loads((root / "oci-layout").read_text()) == {"imageLayoutVersion": "1.0.0"}
assert config["rootfs"]["diff_ids"] == [layer["digest"] for layer in manifest["layers"]]
print(read(manifest["layers"][0]))
PY
tar -C "$folder/run" -xf "$(cat "$folder/layer")"

mkdir "$folder/run/proc"
rollres() { env -i HOME=/tmp PATH="$PATH" unshare $as_root --mount $propagation sh -c "$enter" "$folder/run" /opt/rollres/bin/rollres "$@"; }
examples=/opt/rollres/share/rollres/examples
resistance() { grep '"rolling_resistance":'; }
for scene in paper_cylinder paper_sphere; do
  there=$(rollres solve "$examples/$scene.json" --json | resistance)
  here_=$("$tree/rollres" solve "$here/studies/examples/$scene.json" --json | resistance)
  [ "$there" = "$here_" ] || { echo "$scene: $there there, $here_ here"; exit 1; }
done
rollres sweep "$examples/speed_resistance.json" --db /tmp/a.db --shard 1/20 >/dev/null
rollres query --db /tmp/a.db --format csv | grep -q speed
rollres fit "$examples/fit_cylinder.json" --db /tmp/a.db >"$folder/fit"
rollres report --db /tmp/a.db --out /tmp/a.html >"$folder/said" 2>&1 || grep -q gnuplot "$folder/said"
if rollres chart --db /tmp/a.db --out /tmp >"$folder/said" 2>&1; then echo "a chart without gnuplot"; exit 1; fi
cat "$folder/said"
grep -q gnuplot "$folder/said"
[ -e "$folder/run/opt/rollres/share/doc/rollres/licences/libfftw3-double3" ]
echo "portable: $(wc -c <"$portable") bytes, from $(ls "$folder/run/opt/rollres/share/doc/rollres/licences" | wc -l) packages"
