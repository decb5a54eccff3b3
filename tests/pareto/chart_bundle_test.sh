#!/bin/sh
# Each bundle of tools/web was made of the lock file and its entry beside it. chart_bundle_test.sh TOOLS/WEB
set -eu

web=$1
for name in charts three; do
  sources=$(cat "$web/package-lock.json" "$web/${name}_entry.js" | sha256sum | cut -d' ' -f1)
  made=$(sed -n '1s/.*tools\/web\/build of \([0-9a-f]*\)\..*/\1/p' "$web/bundle/$name.js")
  if [ "$made" != "$sources" ]; then
    echo "bundle/$name.js was made of $made, its sources are $sources: run tools/web/build" >&2
    exit 1
  fi
  # A page closes its script at the first of these.
  if grep -q '</script' "$web/bundle/$name.js"; then
    echo "bundle/$name.js would end the page's script" >&2
    exit 1
  fi
  echo "bundle/$name.js is up to date"
done
