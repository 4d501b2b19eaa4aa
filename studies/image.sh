#!/bin/sh
# An OCI image without a daemon: a bare Debian 12 with gnuplot, in it the folder of studies/portable.sh, as one layer and three
# JSON files in a tar. sh studies/image.sh PORTABLE.tar.gz IMAGE.tar [ROOT.tar]; with ROOT.tar, a root file system that is there,
# nothing is fetched. Needs mmdebstrap otherwise. The image's program is rollres.
set -eu
portable=$1 image=$2 root=${3-}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
blobs=$folder/oci/blobs/sha256
mkdir -p "$blobs" "$folder/add/opt"
layer=$folder/layer
if [ -n "$root" ]; then
  cp "$root" "$layer"
else
  mmdebstrap --quiet --variant=essential --include=gnuplot-nox,fonts-dejavu-core bookworm "$layer.tar"
  mv "$layer.tar" "$layer"
fi
tar -C "$folder/add/opt" -xzf "$portable"
mv "$folder/add/opt"/rollres-* "$folder/add/opt/rollres"
tar -C "$folder/add" --owner=0 --group=0 --numeric-owner -rf "$layer" opt

digest() { sha256sum "$1" | cut -d ' ' -f 1; }
# Lays a file among the blobs and prints what names it: a descriptor of OCI.
blob() {
  sum=$(digest "$2") size=$(stat -c %s "$2")
  mv "$2" "$blobs/$sum"
  printf '{"mediaType":"application/vnd.oci.image.%s","digest":"sha256:%s","size":%s' "$1" "$sum" "$size"
}
architecture=$(dpkg --print-architecture)
cat >"$folder/config" <<JSON
{"architecture":"$architecture","os":"linux","rootfs":{"type":"layers","diff_ids":["sha256:$(digest "$layer")"]},
 "config":{"Entrypoint":["rollres"],"WorkingDir":"/work","Env":["PATH=/opt/rollres/bin:/usr/bin:/bin","LC_ALL=C.UTF-8"]}}
JSON
config=$(blob config.v1+json "$folder/config")}
layer=$(blob layer.v1.tar "$layer")}
printf '{"schemaVersion":2,"mediaType":"application/vnd.oci.image.manifest.v1+json","config":%s,"layers":[%s]}\n' \
  "$config" "$layer" >"$folder/manifest"
manifest=$(blob manifest.v1+json "$folder/manifest")
printf '{"schemaVersion":2,"manifests":[%s,"annotations":{"org.opencontainers.image.ref.name":"rollres"}}]}\n' "$manifest" \
  >"$folder/oci/index.json"
printf '{"imageLayoutVersion":"1.0.0"}\n' >"$folder/oci/oci-layout"
tar -C "$folder/oci" --sort=name --owner=0 --group=0 -cf "$image" oci-layout index.json blobs
echo "$image"
