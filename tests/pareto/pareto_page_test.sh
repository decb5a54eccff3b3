#!/bin/sh
# The chart's page in a browser: two studies must pass check_page.sh, and pages with planted faults must not.
# pareto_page_test.sh PARETO_FIXTURE_PROGRAM
set -eu

fixture=$1
here=$(dirname "$0")
check="$here/../report/check_page.sh"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for kind in cpu gpu; do
  mkdir "$work/$kind"
  "$fixture" $kind "$work/$kind"
  echo "$kind:"
  "$check" "$work/$kind/pareto.html" "$here/pareto_check.js"
done

. "$here/../report/planted.sh"
page=$work/gpu/pareto.html
sed 's/entry.y < last.y ||/entry.y > last.y ||/' "$page" > "$work/planted.html"
planted 'a front turned upside down' 'failed: front' \
  "$check" "$work/planted.html" "$here/pareto_check.js"
sed 's/^const study = /const study = null; const unused = /' "$page" > "$work/planted.html"
planted 'a script that stops half-way' 'the console is not empty' \
  "$check" "$work/planted.html" "$here/pareto_check.js"
