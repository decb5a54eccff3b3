# Shared by tools/demo and tools/test, which source it: packages, progress lines, the build.
# shellcheck shell=bash

repo=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
jobs=$(nproc)
export NINJA_STATUS='[%f/%t] '

# say MESSAGE: one progress line with the time since the script began.
say() {
  printf '[%2d:%02d] %s\n' $((SECONDS / 60)) $((SECONDS % 60)) "$*"
}

# Lists the Debian packages of the given groups of tools/packages.txt that are not installed, one a line.
missing_packages() {
  local group package instead
  while read -r group package instead; do
    case " $* " in
      *" $group "*) ;;
      *) continue ;;
    esac
    if [ -n "$instead" ] && command -v "$instead" >/dev/null; then continue; fi
    if [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
      echo "$package"
    fi
  done < "$repo/tools/packages.txt"
}

# install_packages GROUP...: installs what is missing; where that needs root and we are not, says the command and ends.
install_packages() {
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    say "Not a Debian system: the build needs what tools/packages.txt names, installed by hand"
    return
  fi
  local packages
  mapfile -t packages < <(missing_packages "$@")
  if [ ${#packages[@]} -eq 0 ]; then
    say "All packages needed are installed"
    return
  fi
  if [ "$(id -u)" -ne 0 ]; then
    echo "Packages are missing. Install them with this command, then start again:" >&2
    echo "  sudo apt-get install --no-install-recommends ${packages[*]}" >&2
    exit 1
  fi
  say "Installing ${#packages[@]} packages: ${packages[*]}"
  local log
  log=$(mktemp)
  if ! { apt-get update -qq &&
         DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${packages[@]}"; } >"$log" 2>&1; then
    tail -n 30 "$log" >&2
    echo "apt-get could not install the packages; its messages are above, all of them in $log" >&2
    exit 1
  fi
  rm -f "$log"
}

# configure PRESET [OPTION...]: with a compiler cache where there is one.
configure() {
  local preset=$1 launcher=()
  shift
  if command -v ccache >/dev/null; then
    launcher=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  fi
  say "Configuring preset $preset"
  (cd "$repo" && cmake --preset "$preset" --log-level=WARNING -DRIGEL_UNITY=ON "${launcher[@]}" "$@")
}

# build PRESET [TARGET...]
build() {
  local preset=$1
  shift
  say "Building preset $preset with $jobs jobs"
  (cd "$repo" && cmake --build --preset "$preset" -j "$jobs" ${1:+--target "$@"})
}
