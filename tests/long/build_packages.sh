#!/bin/sh
# build_packages.sh FOLDER: builds the packages of the source package in FOLDER; runs as root in a fresh root file system
# (tests/long/packages.py).
set -eu
export DEBIAN_FRONTEND=noninteractive
quiet() { "$@" >/tmp/build.log 2>&1 || { tail -n 40 /tmp/build.log; exit 1; }; }
quiet apt-get update -q
quiet apt-get install -y -q --no-install-recommends build-essential dpkg-dev fakeroot
cd "$1"
quiet apt-get build-dep -y -q --no-install-recommends ./lambent_*.dsc
rm -rf source
quiet dpkg-source -x lambent_*.dsc source
cd source
quiet dpkg-buildpackage -us -uc -b
rm -f ../*-dbgsym_*
