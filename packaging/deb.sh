#!/bin/sh
# deb.sh FOLDER: builds the Debian source package and the binary packages of the committed tree in FOLDER (make deb). The version comes from
# meson.build and the date from the commit, so the same commit gives the same bytes. DEBFULLNAME and DEBEMAIL name the maintainer.
set -eu
tree=$(cd "$(dirname "$0")/.." && pwd)
mkdir -p "$1"
out=$(cd "$1" && pwd)
version=$(sed -n "s/^  version: '\(.*\)',/\1/p" "$tree/meson.build")
maintainer="${DEBFULLNAME:-The Lambent authors} <${DEBEMAIL:-lambent@users.noreply.github.com}>"
source="$out/lambent-$version"
rm -rf "$source" "$out"/lambent*_* "$out"/liblambent*_*
mkdir "$source"
git -C "$tree" archive HEAD | tar -x -C "$source"
cp -R "$source/packaging/debian" "$source/debian"
sed -i "s/@MAINTAINER@/$maintainer/" "$source/debian/control"
cat >"$source/debian/changelog" <<END
lambent ($version) unstable; urgency=medium

  * The changes are in CHANGELOG.md.

 -- $maintainer  $(git -C "$tree" log -1 --format=%cD)
END
cd "$source"
dpkg-buildpackage -us -uc ${DEB_FLAGS:-} >"$out/build.log" 2>&1 || {
    tail -n 40 "$out/build.log" >&2
    exit 1
}
cd "$out"
rm -rf "$source"
sha256sum -- *.deb | tee "$out/SHA256SUMS"
