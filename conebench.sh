#!/usr/bin/env bash
# The two commands of the README, on a fresh Debian 12 as root or with sudo:
#
#   ./conebench.sh demo    installs what is missing, builds, compares solvers on real problems
#   ./conebench.sh test    the same, then runs every test
#
# Anything else goes to the program: ./conebench.sh solve FILE, ./conebench.sh --help.
set -euo pipefail

here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
build="$here/build"
packages=(g++ make cmake ninja-build ccache pkg-config libeigen3-dev libhdf5-dev libfmt-dev libcli11-dev
  libtomlplusplus-dev nlohmann-json3-dev libssl-dev libsqlitecpp-dev zlib1g-dev
  libsuitesparse-dev coinor-libipopt-dev libmumps-seq-dev libbullet-dev
  libnlopt-dev libsiconos-numerics-dev libbenchmark-dev libgtest-dev libgmock-dev libfclib-dev
  python3 python3-h5py)
# For the report's page, unless they came another way.
command -v node >/dev/null && command -v npm >/dev/null || packages+=(nodejs npm)
# The browser that tests that page, and what reads the manual.
[ "${1:-}" = test ] && packages+=(chromium groff-base)

say() { echo "conebench.sh: $*" >&2; }

# Installs those of the Debian packages that are missing, and says which.
ensure_packages() {
  local missing=() package
  for package in "${packages[@]}"; do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] ||
      missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return
  say "installing ${missing[*]}"
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      say "these Debian packages are missing; install them as root: ${missing[*]}"
      exit 3
    fi
    as_root=(sudo)
  fi
  "${as_root[@]}" apt-get update -q >&2
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends "${missing[@]}" >&2
}

# Configures once for this machine's processor, then builds what changed.
build_targets() {
  if [ ! -f "$build/build.ninja" ]; then
    say "configuring in build/ (once)"
    cmake -S "$here" -B "$build" -G Ninja -DCONEBENCH_NATIVE=ON >&2
  fi
  ninja -C "$build" -n "$@" | grep -q "no work to do" && return
  say "building $* (the first build takes a few minutes)"
  ninja -C "$build" "$@" >&2
}

ensure_packages
case "${1:-}" in
  test)
    build_targets all
    cd "$build"
    exec ctest --output-on-failure "${@:2}"
    ;;
  demo)
    build_targets conebench
    exec "$build/conebench" demo --data "$here/../shared/data" -o "$here/demo-results" "${@:2}"
    ;;
  *)
    build_targets conebench
    exec "$build/conebench" "$@"
    ;;
esac
