#!/bin/sh
# try_packages.sh FOLDER: runs as root in a fresh root file system (tests/long/packages.py): installs the packages of FOLDER, runs the tests
# of debian/tests as a user, and removes the packages.
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
install libexpat1 "$folder"/lambent-draco_*.deb
cp "$tree/tests/fuzz/corpus/3mf/deflated.3mf" "$tree/tests/fuzz/corpus/gltf/draco.gltf" /tmp
cd /tmp
lambent deflated.3mf draco.gltf -q -s 64 -o '{stem}.png'
install "$folder"/liblambent0_*.deb "$folder"/liblambent-check0_*.deb "$folder"/liblambent-dev_*.deb "$folder"/lambent-doc_*.deb gcc libc6-dev pkg-config
sh "$tree/packaging/debian/tests/library"
install "$folder"/python3-lambent_*.deb
sh "$tree/packaging/debian/tests/python"
echo "size installed: $(dpkg-query -W -f '${Package} ${Installed-Size} kB\n' lambent lambent-draco lambent-doc python3-lambent 'liblambent*' | tr '\n' ';')"
# All installed files are removed afterwards.
dpkg-query -L lambent lambent-draco lambent-doc python3-lambent liblambent0 liblambent-check0 liblambent-dev | sort -u >/tmp/files
apt-get purge -y -q lambent lambent-draco lambent-doc python3-lambent liblambent0 liblambent-check0 liblambent-dev >/tmp/apt.log 2>&1 || { cat /tmp/apt.log; exit 1; }
left=$(while read -r path; do if [ -f "$path" ] || [ -L "$path" ]; then echo "$path"; fi; done </tmp/files | grep -v '^/lib' || true)
if [ -n "$left" ] || find / -xdev -name '*lambent*' -not -path '/lambent*' -not -path '/debs*' -not -path '/shared*' -not -path '/proc/*' -not -path '/tmp/*' | grep .; then
    echo "left behind: $left" >&2
    exit 1
fi
echo 'the packages work'
