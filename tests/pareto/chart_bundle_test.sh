#!/bin/sh
# tools/web/bundle/charts.js was made of the lock file and the entry beside it. chart_bundle_test.sh TOOLS/WEB
set -eu

web=$1
sources=$(cat "$web/package-lock.json" "$web/charts_entry.js" | sha256sum | cut -d' ' -f1)
made=$(sed -n '1s/.*tools\/web\/build of \([0-9a-f]*\)\..*/\1/p' "$web/bundle/charts.js")
if [ "$made" != "$sources" ]; then
  echo "bundle/charts.js was made of $made, its sources are $sources: run tools/web/build" >&2
  exit 1
fi
# A page closes its script at the first of these.
if grep -q '</script' "$web/bundle/charts.js"; then
  echo "bundle/charts.js would end the page's script" >&2
  exit 1
fi
echo "bundle/charts.js is up to date"
