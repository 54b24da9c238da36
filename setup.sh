#!/usr/bin/env bash
# Installs what Polynya needs from Debian's packages, and nothing else. Asks nothing.
# Usage: ./setup.sh [group...]   groups: build (default), module (Python's), test, python, bench, view, export, site,
#                                slurm, package, browser (also configures build/browser: cmake --build --preset browser)
#                                and windows (also configures build/windows: cmake --build --preset windows)
set -euo pipefail
cd "$(dirname "$0")"

declare -A packages=(
  [build]="g++ cmake ninja-build libcgal-dev libeigen3-dev libboost-dev libgmp-dev libmpfr-dev
           nlohmann-json3-dev libcli11-dev libfmt-dev libexpected-dev libtbb-dev librsvg2-bin python3"
  [test]="libgtest-dev librapidcheck-dev libchipmunk-dev libgeos-dev python3 strace gdal-bin"
  [view]="chromium nodejs npm"
  [python]="python3 python3-numpy python3-scipy python3-matplotlib python3-pytest
           python3-dev python3-venv pybind11-dev ffmpeg"
  [module]="python3 python3-numpy python3-matplotlib python3-dev pybind11-dev"
  [package]="lintian mmdebstrap"
  [site]="python3-sphinx furo python3-myst-parser python3-sphinx-copybutton python3-numpy
           doxygen libjs-katex node-normalize.css"
  [browser]="clang-16 lld-16 llvm-16 libc++-16-dev-wasm32 libc++abi-16-dev-wasm32 wasi-libc
           libclang-rt-16-dev-wasm32 cmake ninja-build libcgal-dev libeigen3-dev libboost-dev nlohmann-json3-dev
           libfmt-dev libexpected-dev python3"
  [windows]="g++-mingw-w64-x86-64-posix wine64 wine cmake ninja-build libcgal-dev libeigen3-dev libboost-dev
           nlohmann-json3-dev libfmt-dev libexpected-dev python3"
  [slurm]="slurmctld slurmd slurm-client munge"
  [export]="python3-vtk9 python3-pandas python3-shapely"
  [bench]="libbenchmark-dev libbox2d-dev libchipmunk-dev libgeos-dev libpolyclipping-dev"
)

# Packages that not every system has. Without them some tests are skipped, which say so.
declare -A optional=([browser]="firefox-esr")

# Programs that may have come from elsewhere than their package of Debian's.
declare -A program=([firefox-esr]=firefox-esr [chromium]=chromium [nodejs]=node [npm]=npm)

is_installed() {
  [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ] ||
    { [ -n "${program[$1]:-}" ] && command -v "${program[$1]}" >/dev/null; }
}

missing=() wanted=()
for group in "${@:-build}"; do
  [ -n "${packages[$group]:-}" ] || { echo "setup.sh: no such group: $group (there are: ${!packages[*]})" >&2; exit 2; }
  for package in ${packages[$group]}; do
    is_installed "$package" || missing+=("$package")
  done
  for package in ${optional[$group]:-}; do
    is_installed "$package" || wanted+=("$package")
  done
done
# The groups browser and windows need one more command, which configures their builds.
configure() {
  local preset
  for preset in browser windows; do
    case " ${*:-build} " in *" $preset "*) ;; *) continue ;; esac
    mkdir -p build
    cmake --preset "$preset" >"build/configure-$preset.log" 2>&1 || { cat "build/configure-$preset.log" >&2; return 1; }
  done
}
[ ${#missing[@]} -gt 0 ] || [ ${#wanted[@]} -gt 0 ] || { configure "$@"; exit; }

command -v apt-get >/dev/null || {
  [ ${#missing[@]} -gt 0 ] || { configure "$@"; exit; }
  echo "setup.sh: this machine has no apt-get; please install by hand: ${missing[*]}" >&2; exit 1; }
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    [ ${#missing[@]} -gt 0 ] || { configure "$@"; exit; }
    echo "setup.sh: please run this as root, there is no sudo: apt-get install ${missing[*]}" >&2; exit 1; }
  as_root=(sudo)
fi

echo "Installing Debian packages: ${missing[*]} ${wanted[*]}"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
run() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive "$@" >>"$log" 2>&1; }
run apt-get update || true # an unreachable extra source is no error; the install below reports faults
[ ${#missing[@]} -eq 0 ] || run apt-get install -y --no-install-recommends "${missing[@]}" || {
  tail -n 25 "$log" >&2; echo "setup.sh: the installation failed; its last lines are above" >&2; exit 1; }
for package in "${wanted[@]}"; do
  run apt-get install -y --no-install-recommends "$package" ||
    echo "setup.sh: $package cannot be had here; the tests that need it will be skipped"
done
configure "$@"
