#!/bin/sh
# Opens a report in headless Chromium, drives it with a script, and fails on anything the console reports.
# check_page.sh REPORT.html [SCRIPT.js]: the script, with page_driver.js before it, writes its result into
# <body data-check="...">; "ok" is success.
set -eu

report=$1
here=$(dirname "$0")
script=${2:-$here/page_check.js}
chromium=${CHROMIUM:-$(command -v chromium || true)}
if [ -z "$chromium" ]; then
  echo "check_page: chromium is not installed; tools/test installs it" >&2
  exit 1
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
{ cat "$report"; echo '<script>'; cat "$here/page_driver.js" "$script"; echo '</script>'; } > "$work/page.html"

# Chromium's own window is never narrower than 500 pixels, so a telephone is a frame of that width.
cat > "$work/narrow.html" <<'END'
<!doctype html><html><body><script>onmessage = (event) => { document.body.dataset.check = event.data; };</script>
<iframe src="page.html" style="width: 390px; height: 1900px"></iframe></body></html>
END

for window in page narrow; do
  # A fresh profile each time; the flags after --disable-gpu keep Chromium off the network.
  timeout 120 "$chromium" --headless --no-sandbox --disable-gpu --disable-quic --no-first-run \
    --disable-background-networking --disable-component-update --disable-sync --disable-default-apps \
    --user-data-dir="$work/profile-$window" --window-size=1440,2000 --enable-logging=stderr --v=0 \
    --virtual-time-budget=20000 --dump-dom "file://$work/$window.html" > "$work/dom.html" 2> "$work/log" ||
    { echo "check_page: chromium failed" >&2; tail -20 "$work/log" >&2; exit 1; }

  if grep 'CONSOLE' "$work/log"; then
    echo "check_page: $report: the console is not empty" >&2
    exit 1
  fi
  result=$(grep -o '<body[^>]*data-check="[^"]*"' "$work/dom.html" | sed 's/.*data-check="//; s/"$//')
  echo "check_page: $window: ${result:-the page never finished}"
  case $result in
    ok*) ;;
    *) exit 1 ;;
  esac
done
