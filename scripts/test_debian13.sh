#!/bin/sh
# test_debian13.sh [FOLDER]: the README's two commands on a fresh Debian 13 machine: a root made by mmdebstrap in FOLDER (default
# build-debian13), the committed tree copied into it, `make demo` and `make test` there. Remove FOLDER for a new machine; needs root.
set -eu
tree=$(cd "$(dirname "$0")/.." && pwd)
folder=${1:-$tree/build-debian13}
mirror=${MIRROR:-http://deb.debian.org/debian}
as_root=""
[ "$(id -u)" -eq 0 ] || as_root=sudo
"$tree/scripts/setup.sh" debian13
mkdir -p "$folder"
root=$folder/root
if [ ! -e "$folder/made" ]; then
    echo "test-debian13: making a Debian 13 root in $root"
    $as_root rm -rf "$root"
    $as_root mmdebstrap --quiet --variant=apt --include=make,ca-certificates trixie "$root" "$mirror"
    touch "$folder/made"
fi
$as_root rm -rf "$root/lambent"
$as_root mkdir "$root/lambent"
git -C "$tree" archive HEAD | $as_root tar -x -C "$root/lambent"
# The mounts live in a namespace of their own and are gone with it.
$as_root unshare --mount --pid --fork sh -eu -c '
    root=$1
    mount -t proc proc "$root/proc"
    mount --rbind /dev "$root/dev"
    if [ -d "$2" ]; then # real models, where they lie beside the tree
        mkdir -p "$root/shared"
        mount --bind -o ro "$2" "$root/shared"
    fi
    cp -L /etc/resolv.conf "$root/etc/resolv.conf"
    exec chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
        sh -eu -c "cat /etc/debian_version; cd /lambent; make demo; sha256sum out/demo.png; make test"
' sh "$root" "$tree/../shared"
