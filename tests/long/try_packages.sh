#!/bin/sh
# try_packages.sh FOLDER: runs as root in a fresh root file system (tests/long/packages.py): installs the packages of FOLDER, runs the tests
# of debian/tests as a user, draws the models of FOLDER, and removes the packages. It prints the cells of tests/long/table.py.
set -eu
tree=$(cd "$(dirname "$0")/../.." && pwd)
folder=$1
install() { DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "$@" >/tmp/apt.log 2>&1 || { cat /tmp/apt.log; exit 1; }; }
list() { dpkg-query -W -f '${Package}\n' | sort; }
apt-get update -q >/dev/null
list >/tmp/before
install "$folder"/lambent_*.deb
list >/tmp/after
echo "installed with lambent: $(comm -13 /tmp/before /tmp/after | tr '\n' ' ')"
if comm -13 /tmp/before /tmp/after | grep -E '^(libegl|libgl|python|node|perl)'; then
    echo 'lambent pulls in more than it needs' >&2
    exit 1
fi
sh "$tree/packaging/debian/tests/program"
install libexpat1 python3-minimal libglib2.0-bin man-db bash-completion "$folder"/*.deb gcc libc6-dev pkg-config
echo 'cell: installs | yes'
cd "$folder"
while IFS='|' read -r column model; do
    lambent "$model" -q -s 96 -o /tmp/own.png && cmp /tmp/own.png "$model.expected" && echo "cell: $column | yes"
done <<END
glTF|spot.glb
OBJ with texture|tiles.obj
PLY|cube.ply
STL|cube.stl
3MF|deflated.3mf
Draco|draco.gltf
END
cd /tmp
# The desktop's entry opens the model in a browser, which stands here for one: it fetches the page that it is told.
cat >/tmp/browser <<'END'
#!/usr/bin/python3
import sys, urllib.request
page = urllib.request.urlopen(sys.argv[1]).read()
open("/tmp/seen", "wb").write(page[-3000:])
END
chmod +x /tmp/browser
DISPLAY=:9 BROWSER=/tmp/browser gio launch /usr/share/applications/io.github.lambent.lambent.desktop "$folder/cube.stl" </dev/null >/tmp/launch.log 2>&1 &
for _ in $(seq 150); do [ -s /tmp/seen ] && break; sleep 0.2; done
grep -q '"/cube.stl"' /tmp/seen || { cat /tmp/launch.log; exit 1; }
lambent "$folder/cube.stl" -q -s 64 -o page.html && grep -q 'data-path="/cube.stl"' page.html && grep -q '==== zlib' page.html && echo 'cell: page | yes'
man lambent | grep -q turntable && man lambent-diff | grep -q LAMBENT_REPORT
bash -c '. /usr/share/bash-completion/bash_completion; _completion_loader lambent; complete -p lambent' && echo 'cell: man, completion | yes'
test -e /usr/share/doc-base/lambent-doc.lambent -o -e /usr/share/doc-base/lambent
sh "$tree/packaging/debian/tests/classroom"
sh "$tree/packaging/debian/tests/library"
sh "$tree/packaging/debian/tests/python"
echo "size installed: $(dpkg-query -W -f '${Package} ${Installed-Size} kB\n' '*lambent*' | tr '\n' ';')"
# All installed files are removed afterwards.
packages=$(dpkg-query -W -f '${Package} ' '*lambent*')
dpkg-query -L $packages | sort -u >/tmp/files
apt-get purge -y -q $packages >/tmp/apt.log 2>&1 || { cat /tmp/apt.log; exit 1; }
left=$(while read -r path; do if [ -f "$path" ] || [ -L "$path" ]; then echo "$path"; fi; done </tmp/files | grep -v '^/lib' || true)
if [ -n "$left" ] || find / -xdev -name '*lambent*' -not -path '/lambent*' -not -path '/debs*' -not -path '/shared*' -not -path '/proc/*' -not -path '/tmp/*' -not -path '/var/cache/man/*' | grep .; then
    echo "left behind: $left" >&2
    exit 1
fi
echo 'cell: removed | yes'
echo 'the packages work'
