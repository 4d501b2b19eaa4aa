#!/bin/sh
# A folder to copy: installs the program of a build tree into TREE/rollres-VERSION-MACHINE, lays beside it every library but
# those of glibc, the database of units and the libraries' licences, and packs all as a .tar.gz, whose path it prints.
# sh studies/portable.sh TREE; made by `cmake --preset package && cmake --build --preset portable`.
set -eu
tree=$1
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$tree/CMakeCache.txt")
name=rollres-$version-$(uname -m)
folder=$tree/$name
rm -rf "$folder"
cmake --install "$tree" --component program --strip --prefix "$folder" >"$tree/portable.log"
fits=$(find "$folder" -name librollres_ceres.so)
libraries=${fits%/*}
licences=$folder/share/doc/rollres/licences
mkdir -p "$licences" "$folder/share/rollres/udunits"
cp /usr/share/xml/udunits/*.xml "$folder/share/rollres/udunits/"

# Those of glibc and its loader go with the system's kernel and names.
ldd "$folder/bin/rollres" "$fits" "$libraries/librollres_http.so" | awk '$2 == "=>" && $3 ~ /^\// {print $1, $3}' | sort -u |
  grep -Ev '^(libc|libm|libdl|librt|libpthread|libresolv)\.so\.' | while read -r library path; do
  cp -L "$path" "$libraries/$library"
  file=$(readlink -f "$path")
  package=$(dpkg-query -S "$file" "${file#/usr}" 2>/dev/null | sed -n '1s/:.*//p') || :
  [ -z "$package" ] || cp -L "/usr/share/doc/$package/copyright" "$licences/$package"
done
[ -e "$libraries/libfftw3.so.3" ] || { echo "portable.sh: $folder/bin/rollres names no FFTW; see ldd" >&2; exit 1; }
tar -C "$tree" --sort=name --owner=0 --group=0 --numeric-owner -I "gzip -${GZIP_LEVEL:-9}" -cf "$folder.tar.gz" "$name"
echo "$folder.tar.gz"
