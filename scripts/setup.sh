#!/bin/sh
# setup.sh GROUP…: installs the Debian packages of the named groups (packages.txt) that are missing, and lists them. It is quick if nothing
# is missing. It uses sudo unless it runs as root.
set -eu
list="$(dirname "$0")/../packages.txt"
wanted=""
for group in "$@"; do
    wanted="$wanted $(sed -n "s/^$group  *//p" "$list")"
done
if ! command -v dpkg-query >/dev/null 2>&1; then
    echo "setup: this is not Debian; please see that these are installed:$(echo "$wanted" | tr '\n' ' ')" >&2
    exit 0
fi

# `missing` gets the packages that are not installed; for alternatives (A|B), it gets the first one that this Debian
# release provides.
find_missing() {
    missing=""
    installed=" $(dpkg-query -W -f '${db:Status-Status} ${Package}\n' $(echo "$wanted" | tr '|' ' ') 2>/dev/null |
        sed -n 's/^installed //p' | tr '\n' ' ')"
    for choice in $wanted; do
        package=${choice%%|*}
        while [ "$package" != "$choice" ] && ! has "$package" && ! apt-cache show "$package" >/dev/null 2>&1; do
            choice=${choice#*|}
            package=${choice%%|*}
        done
        has "$package" || missing="$missing $package"
    done
}
has() { case "$installed" in *" $1 "*) ;; *) return 1 ;; esac; }

find_missing
[ -n "$missing" ] || exit 0
as_root=""
if [ "$(id -u)" -ne 0 ]; then
    as_root=sudo
    command -v sudo >/dev/null 2>&1 || {
        echo "setup: these packages are missing and there is no sudo; as root: apt-get install$missing" >&2
        exit 1
    }
fi
echo "setup: installing$missing"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
install() {
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $missing >"$log" 2>&1
}
# The package lists may be old or missing: if the first try fails, update them and choose among alternatives again.
if ! install; then
    echo "setup: refreshing the package lists"
    $as_root apt-get update >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
    find_missing
    install || { cat "$log" >&2; exit 1; }
fi
