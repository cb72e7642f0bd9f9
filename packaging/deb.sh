#!/bin/sh
# deb.sh FOLDER: builds the Debian source package and the binary packages of the committed tree (without .git: of the tree) in FOLDER (make
# deb). scripts/project.py knows the version and the commit's date, so the same commit gives the same bytes. The source package contains the
# page of build-web, because a package is built without a network. DEBFULLNAME and DEBEMAIL name the maintainer.
set -eu
tree=$(cd "$(dirname "$0")/.." && pwd)
mkdir -p "$1"
out=$(cd "$1" && pwd)
version=$("$tree/scripts/project.py" version)
maintainer="${DEBFULLNAME:-The Lambent authors} <${DEBEMAIL:-lambent@users.noreply.github.com}>"
source="$out/lambent-$version"
python3 "$tree/web/build.py" "$tree/build-web"
rm -rf "$source" "$out"/*lambent*_*
"$tree/scripts/project.py" tree "$source"
mkdir "$source/build-web"
cp "$tree/build-web/lambent.html" "$tree/build-web/lambent-threads.wasm" "$tree/build-web/LICENCES" "$source/build-web"
cp -R "$source/packaging/debian" "$source/debian"
sed -i "s/@MAINTAINER@/$maintainer/" "$source/debian/control"
cat >"$source/debian/changelog" <<END
lambent ($version) unstable; urgency=medium

  * The changes are in CHANGELOG.md.

 -- $maintainer  $(date -u -R -d "@$("$tree/scripts/project.py" time)")
END
cd "$source"
dpkg-buildpackage -us -uc ${DEB_FLAGS:-} >"$out/build.log" 2>&1 || {
    tail -n 40 "$out/build.log" >&2
    exit 1
}
cd "$out"
rm -rf "$source"
sha256sum -- *.deb | tee "$out/SHA256SUMS"
