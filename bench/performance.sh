#!/usr/bin/env bash
# Measures what docs/performance.md says, and puts the numbers and plots there.
# Usage: bench/performance.sh [--quick]      --quick: a tenth of every run, printed only; the page stays as it is
set -euo pipefail
cd "$(dirname "$0")/.."
./setup.sh build bench python
mkdir -p build
cmake --preset bench >build/bench.log 2>&1 || { cat build/bench.log >&2; exit 1; }
cmake --build --preset bench \
  --target polynya_bench_voyages polynya_bench_scaling polynya_bench_profile polynya_bench_micro \
  >>build/bench.log 2>&1 ||
  { tail -n 40 build/bench.log >&2; exit 1; }
bin=build/bench/bench
out=build/performance
mkdir -p "$out"
quick=()
[ "${1:-}" != --quick ] || quick=(--quick)
# Chipmunk says on stdout that Debian builds it with its checks on.
"$bin/polynya_bench_voyages" "${quick[@]}" --peer-seconds 5 --csv "$out/voyages.csv" 2>"$out/voyages.log" |
  grep --line-buffered "^|" | tee "$out/voyages.md"
# Voyages of the same ship some metres to the side, through the same ice.
{
  echo "| case | to port, m | Polynya, µs/step | touching pairs" \
    "| Box2D 3.2, µs/step | touching pairs | Box2D 3.2 over Polynya |"
  echo "|---|---|---|---|---|---|---|"
  for case in voyage field-10000; do
    for metres in -3 -2 -1 0 1 2 3; do
      "$bin/polynya_bench_voyages" "${quick[@]}" --only $case --lateral $metres --peer-seconds 5 \
        --csv "$out/lateral.csv" >"$out/lateral.log" 2>&1
      awk -F, -v case=$case -v metres=$metres '
        $2 == "Polynya" { ours = $6; pairs = $10 }
        $2 == "Box2D 3.2" {
          printf "| %s | %g | %.1f | %.1f | %.1f | %.1f | %s |\n", case, metres, ours, pairs, $6, $10, $16 + 0 }
      ' "$out/lateral.csv"
    done
  done
} | tee "$out/lateral.md"
"$bin/polynya_bench_profile" "${quick[@]}" | tee "$out/profile.md"
"$bin/polynya_bench_profile" "${quick[@]}" --only cylinder-shear --until 400 |
  awk -F'|' 'NR < 3 || $3 >= 1' | tee "$out/threads.md"
"$bin/polynya_bench_scaling" "${quick[@]}" --csv "$out/scaling.csv"
/usr/bin/python3 bench/scaling_figure.py "$out/scaling.csv" "$out/scaling.svg"
"$bin/polynya_bench_micro" --benchmark_format=csv >"$out/micro.csv" 2>"$out/micro.log"
cat "$out/scaling.csv" "$out/micro.csv"
if [ ${#quick[@]} -gt 0 ]; then exit 0; fi
cp "$out/scaling.svg" docs/images/performance-scaling.svg
cp "$out/voyages.csv" docs/images/performance-voyages.csv
python3 bench/put_tables.py docs/performance.md voyages="$out/voyages.md" lateral="$out/lateral.md" \
  profile="$out/profile.md" \
  threads="$out/threads.md" scaling="$out/scaling.csv" micro="$out/micro.csv" machine=
echo "docs/performance.md holds these numbers now"
