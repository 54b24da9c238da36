#!/usr/bin/env bash
# Measures what docs/performance.md says, and puts the numbers and plots there.
# Usage: bench/performance.sh [--quick] [--only PART[,PART...]]
#   --quick: a tenth of every run, printed only; the page stays as it is
#   --only:  of voyages, lateral, profile, threads, scaling, micro, million; the page's other tables stay as they are
set -euo pipefail
cd "$(dirname "$0")/.."
quick=()
only=voyages,lateral,profile,threads,scaling,micro,million
while [ $# -gt 0 ]; do
  case $1 in
    --quick) quick=(--quick) ;;
    --only) only=${2:?--only needs parts}; shift ;;
    *) sed -n 3,5p "bench/performance.sh" >&2; exit 2 ;;
  esac
  shift
done
./setup.sh build bench python
mkdir -p build
cmake --preset bench >build/bench.log 2>&1 || { cat build/bench.log >&2; exit 1; }
cmake --build --preset bench \
  --target polynya polynya_bench_voyages polynya_bench_scaling polynya_bench_profile polynya_bench_micro \
  >>build/bench.log 2>&1 ||
  { tail -n 40 build/bench.log >&2; exit 1; }
bin=build/bench/bench
out=build/performance
mkdir -p "$out"
tables=()
is_asked() { case ",$only," in *",$1,"*) return 0 ;; *) return 1 ;; esac; }
if is_asked voyages; then
  # Chipmunk prints to stdout that Debian builds it with its checks switched on.
  "$bin/polynya_bench_voyages" "${quick[@]}" --peer-seconds 5 --csv "$out/voyages.csv" 2>"$out/voyages.log" |
    grep --line-buffered "^|" | tee "$out/voyages.md"
  tables+=(voyages="$out/voyages.md")
fi
if is_asked lateral; then
  python3 bench/lateral.py "$bin/polynya_bench_voyages" "${quick[@]}" | tee "$out/lateral.md"
  tables+=(lateral="$out/lateral.md")
fi
if is_asked profile; then
  "$bin/polynya_bench_profile" "${quick[@]}" | tee "$out/profile.md"
  tables+=(profile="$out/profile.md")
fi
if is_asked threads; then
  "$bin/polynya_bench_profile" "${quick[@]}" --only cylinder-shear --until 400 |
    awk -F'|' 'NR < 3 || $3 >= 1' | tee "$out/threads.md"
  tables+=(threads="$out/threads.md")
fi
if is_asked scaling; then
  "$bin/polynya_bench_scaling" "${quick[@]}" --csv "$out/scaling.csv"
  /usr/bin/python3 bench/scaling_figure.py "$out/scaling.csv" "$out/scaling.svg"
  cat "$out/scaling.csv"
  tables+=(scaling="$out/scaling.csv")
fi
if is_asked micro; then
  "$bin/polynya_bench_micro" --benchmark_format=csv >"$out/micro.csv" 2>"$out/micro.log"
  cat "$out/micro.csv"
  tables+=(micro="$out/micro.csv")
fi
if is_asked million; then
  python3 bench/million_floes.py build/bench/app/polynya --until $([ ${#quick[@]} -gt 0 ] && echo 1 || echo 10) |
    tee "$out/million.md"
  tables+=(million="$out/million.md")
fi
if [ ${#quick[@]} -gt 0 ]; then exit 0; fi
if is_asked scaling; then cp "$out/scaling.svg" docs/images/performance-scaling.svg; fi
if is_asked voyages; then cp "$out/voyages.csv" docs/images/performance-voyages.csv; fi
python3 bench/put_tables.py docs/performance.md "${tables[@]}" machine=
echo "docs/performance.md holds these numbers now"
