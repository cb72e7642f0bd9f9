#!/bin/sh
# install.sh: runs as root in a fresh Debian root file system, in Lambent's tree: make install, a program that uses the library, make
# uninstall. tests/long/install.py calls it.
set -eu
scripts/setup.sh build
rm -f /usr/bin/dpkg-architecture # Meson asks this program for the folder of libraries; many systems lack it
list() { find / -xdev \( -path /lambent -o -path /tmp -o -path /var -o -path /root -o -path /run \) -prune -o -print | sort; }
for prefix in /usr/local /usr; do
    list >/tmp/before
    make install prefix=$prefix >/tmp/install.txt 2>&1 || { tail -30 /tmp/install.txt; exit 1; }
    cc -std=c11 examples/render.c $(pkg-config --cflags --libs lambent) -o /tmp/render
    /tmp/render tests/models/cube.obj /tmp/render.png
    $prefix/bin/lambent teapot -s 64 -o /tmp/lambent.png --quiet
    head -c 4 /tmp/render.png /tmp/lambent.png | grep -c PNG | grep -qx 2
    make uninstall prefix=$prefix >/dev/null
    list >/tmp/after
    diff /tmp/before /tmp/after
    if pkg-config --exists lambent || /tmp/render tests/models/cube.obj /tmp/again.png 2>/dev/null; then
        echo "lambent is still there after make uninstall"
        exit 1
    fi
    echo "installed, used and uninstalled in $prefix"
done
