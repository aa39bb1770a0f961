#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Puts the headers that Debian's libopenfoam was built with into FOLDER: Debian ships them in the
# source package alone. The sources of apt are read from a copy with deb-src; the system's own are
# not touched. Usage: openfoam_headers.sh FOLDER
set -eu
folder=${1:?usage: openfoam_headers.sh FOLDER}
fail() { echo "openfoam_headers: $*" >&2; exit 1; }

version=$(dpkg-query --show --showformat='${source:Version}' libopenfoam 2>/dev/null) ||
  fail "the package libopenfoam is not installed"
if [ "$(cat "$folder/version" 2>/dev/null)" = "$version" ]; then
  echo "openfoam_headers: those of $version are in $folder"
  exit 0
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/sources" "$work/lists/partial" "$work/cache/archives/partial" "$work/source"
for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
  [ -f "$file" ] && sed 's/^deb /deb-src /' "$file" >"$work/sources/$(basename "$file" .list).list"
done
for file in /etc/apt/sources.list.d/*.sources; do
  [ -f "$file" ] && sed 's/^Types:.*/Types: deb-src/' "$file" >"$work/sources/$(basename "$file")"
done
apt() {
  apt-get -q -o Dir::Etc::sourcelist=/dev/null -o Dir::Etc::sourceparts="$work/sources" \
    -o Dir::State::Lists="$work/lists" -o Dir::Cache="$work/cache" "$@"
}
echo "openfoam_headers: reading openfoam $version from Debian's source package (45 MB)"
apt update -o APT::Update::Error-Mode=any >"$work/log" 2>&1 || fail "apt-get update failed: $(tail -n 1 "$work/log")"
(cd "$work/source" && apt source --download-only "openfoam=$version" >"$work/log" 2>&1) ||
  fail "apt-get source openfoam=$version failed: $(tail -n 1 "$work/log")"

# As wmake's lnInclude: one flat folder a library. The .C files are templates' bodies.
tar -xf "$work"/source/openfoam_*.orig.tar.* -C "$work" --strip-components=1 --wildcards \
  '*/src/OpenFOAM/*' '*/src/OSspecific/POSIX/*' '*/src/finiteVolume/*' '*/src/meshTools/*'
new="$folder.new"
rm -rf "$new"
for library in OpenFOAM OSspecific/POSIX finiteVolume meshTools; do
  target="$new/$(basename "$library")"
  mkdir -p "$target"
  find "$work/src/$library" \( -name lnInclude -o -name Make -o -name config -o -name noLink \) -prune \
    -o -type f \( -name '*.[CHh]' -o -name '*.hh' -o -name '*.hpp' -o -name '*.cxx' -o -name '*.type' \) \
    -exec cp -t "$target" {} +
done
echo "$version" >"$new/version"
rm -rf "$folder"
mv "$new" "$folder"
echo "openfoam_headers: $(find "$folder" -type f | wc -l) files, $(du -sh "$folder" | cut -f 1), in $folder"
