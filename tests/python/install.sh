#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# install.sh BUILD: the package installed by pip (without network, from the source tree and from python/) and
# by cmake --install, moved elsewhere, each used away from the sources with nothing but itself.
set -eu
build=$(cd "$1" && pwd)
source=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$source/docs/gallery/reference-six-bar/device.xml" "$work/"
unset FLEXWRIGHT_DATA FLEXWRIGHT_LIBRARY PYTHONPATH || true

use() { # use NAME DIRECTORY_OF_THE_PACKAGE WHERE_THE_LIBRARY_MUST_BE
    (cd "$work" && PYTHONPATH="$2" /usr/bin/python3 - "$3" <<'END'
import pathlib, sys
import flexwright
own = sys.argv[1]
assert flexwright.__file__.startswith(own), flexwright.__file__
assert flexwright._library.lib._name.startswith(own), flexwright._library.lib._name
v = flexwright.Device("device.xml").check()
assert v.accepted and v.flows.count == 2
# its packs are read, not those of a source tree: what is wrong in them is found
base, = pathlib.Path(own).rglob("processes/base.xml")
base.write_text(base.read_text().replace("<material", "<metarial", 1))
try:
    flexwright.Device("device.xml")
except flexwright.InputError as error:
    assert "metarial" in str(error), error
else:
    raise AssertionError("other packs were read")
END
    )
    echo "$1: used"
}

# a copy of what pip looks at, since it leaves build directories beside its sources
mkdir "$work/tree"
(cd "$source" && cp -r CMakeLists.txt cmake include src processes masks python pyproject.toml "$work/tree/")
rm -rf "$work/tree/python/build"
ln -s "$build" "$work/tree/built" # named from the top of the tree, as docs/python.md does
for from in . python; do
    FLEXWRIGHT_BUILD=built /usr/bin/python3 -m pip install --quiet --no-index --no-deps \
        --no-build-isolation --root-user-action=ignore --target "$work/target-$from" "$work/tree/$from" \
        2>"$work/pip.txt" || { cat "$work/pip.txt"; exit 1; }
    mv "$work/target-$from" "$work/moved-$from"
    use "pip install $from" "$work/moved-$from" "$work/moved-$from"
done
rm -rf "$work/tree"

cmake --install "$build" --prefix "$work/first" >/dev/null
mv "$work/first" "$work/prefix"
use "cmake --install" "$work/prefix/lib/python3/dist-packages" "$work/prefix"
