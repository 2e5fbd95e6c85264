#!/bin/bash
# Brings what the build needs; `make` calls it, and it does nothing where there is nothing to do.
#   bootstrap.sh debian    the packages of debian-packages.txt, by apt where the user may install
#   bootstrap.sh python    .venv with the exact versions of requirements.lock, and the `lacuna` command
set -euo pipefail
cd "$(dirname "$0")"

missing_packages() {
  local name
  for name in $(grep -v '^#' debian-packages.txt); do
    # The virtual environment module may come from a Python that is not Debian's.
    if [[ $name == python3-venv ]] && python3 -c 'import ensurepip, venv' 2>/dev/null; then continue; fi
    [[ $(dpkg-query -W -f='${db:Status-Status}' "$name" 2>/dev/null) == installed ]] || echo "$name"
  done
}

debian() {
  if ! command -v dpkg-query >/dev/null; then
    echo "note: not a Debian system; CMake will say what it cannot find (see debian-packages.txt)" >&2
    return
  fi
  local missing as_root=()
  missing=$(missing_packages | tr '\n' ' ')
  [[ -n $missing ]] || return 0
  if [[ $(id -u) != 0 ]]; then
    if ! sudo -n true 2>/dev/null; then
      echo "error: Debian packages are missing; install them with: sudo apt-get install $missing" >&2
      exit 1
    fi
    as_root=(sudo -n)
  fi
  echo "installing Debian packages: $missing"
  "${as_root[@]}" apt-get update -qq
  # shellcheck disable=SC2086  # one word a package
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null
}

python() {
  if ! python3 -c 'import sys; sys.exit(sys.version_info < (3, 11))'; then
    echo "error: Python 3.11 or later is needed; python3 is $(python3 --version 2>&1)" >&2
    exit 1
  fi
  if [[ ! -x .venv/bin/pip ]]; then
    rm -rf .venv
    python3 -m venv .venv
  fi
  echo "installing Python packages into .venv"
  .venv/bin/python -m pip install --quiet --disable-pip-version-check --requirement requirements.lock
  .venv/bin/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation \
    --config-settings=wheel.cmake=false --editable . # `make build` compiles the libraries
  touch .venv/.installed
}

case "${1:-}" in
  debian | python) "$1" ;;
  *)
    echo "usage: bootstrap.sh debian|python" >&2
    exit 2
    ;;
esac
