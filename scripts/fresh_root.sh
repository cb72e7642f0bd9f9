#!/bin/sh
# fresh_root.sh RELEASE FOLDER COMMAND: runs COMMAND on a fresh Debian release: in a root file system made by mmdebstrap in FOLDER, with the
# committed tree in /lambent as the current folder. Remove FOLDER to get a new root file system. It needs root. Exit code 77 means that the
# root file system cannot be made on this machine.
set -eu
tree=$(cd "$(dirname "$0")/.." && pwd)
release=$1 folder=$2 command=$3
mirror=${MIRROR:-http://deb.debian.org/debian}
as_root=""
[ "$(id -u)" -eq 0 ] || as_root=sudo
"$tree/scripts/setup.sh" fresh || exit 77
mkdir -p "$folder"
root=$(cd "$folder" && pwd)/root
if [ ! -e "$folder/made" ]; then
    echo "fresh_root: making a root of $release in $root"
    $as_root rm -rf "$root"
    $as_root mmdebstrap --quiet --variant=apt --include=make,ca-certificates "$release" "$root" "$mirror" || exit 77
    touch "$folder/made"
fi
$as_root rm -rf "$root/lambent"
$as_root mkdir "$root/lambent"
git -C "$tree" archive HEAD | $as_root tar -x -C "$root/lambent"
# The mounts are in a separate namespace and disappear with it.
$as_root unshare --mount --pid --fork sh -eu -c '
    root=$1
    mount -t proc proc "$root/proc"
    mount --rbind /dev "$root/dev"
    if [ -d "$2" ]; then # the folder of real models next to the tree
        mkdir -p "$root/shared"
        mount --bind -o ro "$2" "$root/shared"
    fi
    cp -L /etc/resolv.conf "$root/etc/resolv.conf"
    exec chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
        sh -eu -c "cat /etc/debian_version; cd /lambent; $3"
' sh "$root" "$tree/../shared" "$command"
