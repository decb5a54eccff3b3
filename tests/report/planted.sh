# Sourced by tests of pages: planted WHAT REASON COMMAND..., where the page that COMMAND checks has the fault WHAT. A check
# that passes everything would pass that too. Needs $work, a folder.
planted() {
  what=$1
  reason=$2
  shift 2
  if "$@" > "$work/out" 2>&1; then
    echo "not noticed: $what" >&2
    exit 1
  fi
  if ! grep -q "$reason" "$work/out"; then
    echo "noticed for another reason: $what" >&2
    cat "$work/out" >&2
    exit 1
  fi
  echo "noticed: $what"
}
