#!/bin/sh
# The report page in a browser: four reports must pass check_page.sh, and four with planted faults must not.
# report_page_test.sh REPORT_FIXTURE_PROGRAM
set -eu

fixture=$1
here=$(dirname "$0")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for kind in made-up crowd smallest hostile; do
  "$fixture" $kind "$work/$kind" > /dev/null
  echo "$kind:"
  "$here/check_page.sh" "$work/$kind/report.html"
done

. "$here/planted.sh"
page=$work/made-up/report.html
{ cat "$page"; echo '<script>console.error("planted")</script>'; } > "$work/planted.html"
planted 'an error on the console' 'the console is not empty' \
  "$here/check_page.sh" "$work/planted.html"
{ cat "$page"; echo '<img src="missing.png">'; } > "$work/planted.html"
planted 'a picture that is not embedded' 'the console is not empty' \
  "$here/check_page.sh" "$work/planted.html"
sed 's/"ArrowRight": kWipeStep\|ArrowRight: kWipeStep/ArrowRight: 0/' "$page" > "$work/planted.html"
planted 'a dead arrow key' 'failed: arrow right' \
  "$here/check_page.sh" "$work/planted.html"
sed 's/^const report = /const report = null; const unused = /' "$page" > "$work/planted.html"
planted 'a script that stops half-way' 'the console is not empty' \
  "$here/check_page.sh" "$work/planted.html"
