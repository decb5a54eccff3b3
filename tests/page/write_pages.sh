#!/bin/sh
# Writes the pages that the scripts open: DIR/KIND/report.html and DIR/pareto-KIND/pareto.html.
# write_pages.sh REPORT_FIXTURE PARETO_FIXTURE DIR
set -eu

for kind in made-up crowd smallest hostile; do
  rm -rf "${3:?}/$kind"
  mkdir -p "$3/$kind"
  "$1" $kind "$3/$kind" > /dev/null
done
for kind in cpu gpu; do
  rm -rf "${3:?}/pareto-$kind"
  mkdir -p "$3/pareto-$kind"
  "$2" $kind "$3/pareto-$kind"
done
