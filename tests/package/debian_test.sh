#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the Debian packages, installs them into a clean Debian 12 in a folder, and uses them there: the program runs, a
# consumer builds, Python imports the module; removed, they leave nothing behind. Needs root, debootstrap and the net.
# Usage: tests/package/debian_test.sh [FOLDER]     default: a new one in /tmp, which is removed
set -euo pipefail
cd "$(dirname "$0")/../.."
root=$(mktemp -d "${1:-/tmp}/tautline_debian.XXXXXX")
trap 'rm -rf "$root"' EXIT

.ci/build --preset debian
(cd build-debian && rm -f ./*.deb && cpack -G DEB)
ls -l build-debian/*.deb
# There is no mail address of the project; CPack calls ldconfig itself; pkg-config may well hand on -UNDEBUG.
suppressed=bogus-mail-host,bogus-mail-host-in-debian-changelog,lacks-ldconfig-trigger,pkg-config-bad-directive
if command -v lintian >/dev/null; then lintian --fail-on error --suppress-tags "$suppressed" build-debian/*.deb; fi

debootstrap --variant=minbase bookworm "$root"
mkdir "$root/packages" "$root/models"
cp build-debian/*.deb "$root/packages"
cp models/elbow.osim "$root/models"
cp -r tests/package/consumer "$root/consumer"
cp plugin/examples/host.cpp "$root"
# Nothing of this environment is in there.
inside() { chroot "$root" env -i PATH="$PATH" HOME=/root DEBIAN_FRONTEND=noninteractive sh -exc "$*"; }
inside apt-get update -qq
inside "dpkg-query -W -f '\${Package}\n' | sort > /before"
inside "apt-get install -y -qq --no-install-recommends /packages/*.deb"
inside "tautline --version && tautline solve /models/elbow.osim --pose elbow_flexion=100deg"
inside "for page in tautline tautline-run tautline-solve tautline-check; do zcat /usr/share/man/man1/\$page.1.gz | grep -q OPTIONS; done"
inside "cd / && python3 -c 'import tautline; print(tautline.read_osim(\"/models/elbow.osim\").muscles)'"
inside "apt-get install -y -qq --no-install-recommends g++ cmake make"
inside "cmake -S /consumer -B /build -DTAUTLINE_WANTED=0.1 '-DTAUTLINE_COMPONENT=simbody;models;plugin' && cmake --build /build && /build/consumer"
inside "g++ /host.cpp -o /host -I /usr/include/simbody -lSimTKsimbody -lSimTKmath -lSimTKcommon -ldl && /host"
inside "apt-get purge -y -qq libtautline0 && ! find /usr /etc /var/lib -iname '*tautline*' -not -path '/var/lib/dpkg/*' -not -path '/var/lib/apt/*' | grep ."
