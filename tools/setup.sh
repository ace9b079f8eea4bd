# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced by ./demo and ./test: installs the Debian packages that are missing, then configures.
# FLEXWRIGHT_NO_INSTALL=1 leaves the system alone and only says what is missing.

build_packages="gcc libc6-dev cmake ninja-build pkg-config libxml2-dev libcairo2-dev libgsl-dev
liblapacke-dev liblapack-dev libjansson-dev zlib1g-dev
libmicrohttpd-dev libzip-dev libsqlite3-dev libnlopt-dev libcmocka-dev"
test_packages="g++ valgrind clang lld libclang-rt-14-dev libxml2-utils python3 klayout python3-gdspy python3-gmsh python3-shapely python3-tk libgeos-dev
python3-numpy python3-scipy python3-pip python3-setuptools python3-wheel dpkg-dev groff-base calculix-ccx chromium-headless-shell
slurmctld slurmd slurm-client munge parallel"
# The page is bundled with npm, any that is there; without one the program serves a plain page.
if [ -z "${FLEXWRIGHT_NO_INSTALL:-}" ] && ! command -v npm >/dev/null; then
    build_packages="$build_packages nodejs npm"
fi

say() { printf '%s\n' "$*" >&2; }

# packages of "$@" that dpkg does not know as installed
missing_packages() {
    for package in "$@"; do
        status=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null)
        [ "$status" = "install ok installed" ] || printf '%s ' "$package"
    done
}

install_packages() {
    command -v dpkg-query >/dev/null || {
        say "not a Debian system: install these yourself: $*"
        return 0
    }
    missing=$(missing_packages "$@")
    [ -n "$missing" ] || return 0
    if [ -n "${FLEXWRIGHT_NO_INSTALL:-}" ]; then
        say "missing packages: $missing"
        return 1
    fi
    as_root=
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || {
            say "missing packages: $missing- install them as root, then run this again"
            return 1
        }
        as_root=sudo
    fi
    say "installing: $missing"
    # shellcheck disable=SC2086
    $as_root apt-get update -qq >/dev/null &&
        $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq \
            --no-install-recommends $missing >/dev/null
}

# configure_and_build DIRECTORY [cmake options] [--target NAME]
configure_and_build() {
    directory=$1
    shift
    log=$directory.log
    # what was compiled before, here or in another directory, is not compiled again
    ! command -v ccache >/dev/null || export CMAKE_C_COMPILER_LAUNCHER="${CMAKE_C_COMPILER_LAUNCHER-ccache}"
    target=all
    options=
    # links in a third of the time that the usual one takes, of some 150 programs
    ! command -v ld.lld >/dev/null || options="'-DCMAKE_EXE_LINKER_FLAGS=-fuse-ld=lld' '-DCMAKE_SHARED_LINKER_FLAGS=-fuse-ld=lld'"
    while [ $# -gt 0 ]; do
        case $1 in
        --target) target=$2 && shift 2 ;;
        *) options="$options '$1'" && shift ;;
        esac
    done
    if ! { eval "cmake -S . -B \"\$directory\" -G Ninja $options" && cmake --build "$directory" --target "$target"; } >"$log" 2>&1; then
        tail -40 "$log" >&2
        say "the build failed; the whole log is $log"
        return 1
    fi
    rm -f "$log"
}
