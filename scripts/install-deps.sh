#!/bin/sh
# Installs the Debian or Ubuntu packages that footfall is built from, where they are missing.
#
#   install-deps.sh           the library and the command line
#   install-deps.sh --demo    and what `make demo` makes its virtual environment with
#   install-deps.sh --python  and the Python package
#   install-deps.sh --test    and the tests and benchmarks
#   install-deps.sh --dev     and what .ci/run checks with
#
# Touches nothing, and needs neither network nor rights, where everything is there.
set -eu

packages="g++ cmake ninja-build pkg-config
    libeigen3-dev libboost-dev libceres-dev libfmt-dev libtomlplusplus-dev nlohmann-json3-dev libnetcdf-dev libcli11-dev"
# Debian 13's SUNDIALS includes MPI's header without depending on it.
test_packages="libgtest-dev librapidcheck-dev libsundials-dev mpi-default-dev"
demo_packages="python3-venv"
python_packages="python3-dev python3-pip python3-venv"
dev_packages="ccache clang-format-16 clang-tidy-16 git python3"

case "${1-}" in
    "") ;;
    --demo) packages="$packages $demo_packages" ;;
    --python) packages="$packages $python_packages" ;;
    --test) packages="$packages $test_packages" ;;
    --dev) packages="$packages $python_packages $test_packages $dev_packages" ;;
    *)
        echo "install-deps.sh: unknown argument '$1'; allowed: --demo, --python, --test, --dev, or none" >&2
        exit 2
        ;;
esac

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "install-deps.sh: not a Debian or Ubuntu machine; going on with what is installed." >&2
    exit 0
fi

missing=""
for package in $packages; do
    # Not `dpkg-query -W` alone: it also knows packages that were removed.
    status=$(dpkg-query -W -f='${db:Status-Status} ' "$package" 2>/dev/null) || status=""
    case " $status" in
        *" installed "*) ;;
        *) missing="$missing $package" ;;
    esac
done
[ -n "$missing" ] || exit 0

if [ "$(id -u)" -eq 0 ]; then
    sudo=""
elif command -v sudo >/dev/null; then
    sudo="sudo"
else
    echo "install-deps.sh: these packages are missing, and installing them needs root or sudo:" >&2
    echo "    apt-get install$missing" >&2
    exit 1
fi

# A machine that has just started installs updates of its own, and apt-get then fails at once where it needs the lock
# that they hold. It is run again until they are done.
wait_limit=${FOOTFALL_APT_WAIT:-600}  # seconds
pause=5
errors=$(mktemp)
trap 'rm -f "$errors"' EXIT
waited=0
apt() {
    while ! $sudo env LC_ALL=C DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=0 "$@" 2>"$errors"; do
        lock=$(sed -n 's/^E: Could not get lock \([^ ]*[^ .]\).*/\1/p' "$errors" | head -n 1)
        holder=$(sed -n 's/^E: Could not get lock .*held by process \(.*\)$/, held by process \1/p' "$errors" | head -n 1)
        if [ -z "$lock" ]; then
            cat "$errors" >&2
            return 1
        fi
        if [ "$waited" -ge "$wait_limit" ]; then
            echo "install-deps.sh: another program uses apt, and has not ended in $wait_limit s: $lock$holder" >&2
            return 1
        fi
        [ "$waited" -gt 0 ] || echo "Another program uses apt; waiting for it, $wait_limit s at most: $lock$holder"
        sleep "$pause"
        waited=$((waited + pause))
    done
    cat "$errors" >&2
}

echo "Installing:$missing"
# shellcheck disable=SC2086  # one word for each package
if ! { apt update -q && apt install -q -y --no-install-recommends $missing; }; then
    echo "install-deps.sh: apt-get failed. Missing:$missing" >&2
    exit 1
fi
