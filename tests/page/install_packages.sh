#!/bin/sh
# Installs what package-lock.json names into FOLDER, once for each state of the lock file. install_packages.sh FOLDER
set -eu

here=$(dirname "$0")
folder=$1
if ! command -v npm > /dev/null; then
  echo "install_packages: npm is not installed; tools/test installs it" >&2
  exit 1
fi
mkdir -p "$folder"
if [ -d "$folder/node_modules" ] && cmp -s "$here/package-lock.json" "$folder/installed.json"; then
  echo "the packages are installed"
  exit 0
fi
cp "$here/package.json" "$here/package-lock.json" "$folder"
# The browser is Debian's: nothing but the package itself is fetched.
(cd "$folder" && PLAYWRIGHT_SKIP_BROWSER_DOWNLOAD=1 npm ci --no-audit --no-fund --silent)
cp "$here/package-lock.json" "$folder/installed.json"
