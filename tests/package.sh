#!/usr/bin/env bash
# Installs Debian packages with apt, checks them as their users have them, and removes them. Changes the system: for a
# root folder of its own, see tests/checks.sh. Usage: tests/package.sh FOLDER    with the packages
set -euo pipefail
here=$(dirname "${BASH_SOURCE[0]}")
export DEBIAN_FRONTEND=noninteractive
apt-get update -qq
apt-get install -y -qq "$1"/sbcollide_*.deb "$1"/libsbcollide-dev_*.deb xvfb xauth g++ cmake pkg-config lintian >/dev/null
lintian --allow-root --fail-on error "$1"/*.deb
for package in "$1"/*.deb; do
  closed=$(dpkg-deb -c "$package" | grep '^d' | grep -v '^drwxr-xr-x') || true
  [ -z "$closed" ] || { echo "package: not everybody may enter folders of $package: $closed" >&2; exit 1; }
done
bash "$here/install.sh" /usr
apt-get purge -y -qq sbcollide libsbcollide-dev >/dev/null
left=$(find / -xdev -iname "*sbcollide*" -not -path "$1/*")
[ -z "$left" ] || { echo "package: removing left this behind: $left" >&2; exit 1; }
