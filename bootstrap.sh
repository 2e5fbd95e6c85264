#!/bin/bash
# Brings what the build needs; `make` calls it, and it does nothing where there is nothing to do.
#   bootstrap.sh debian    the packages of debian-packages.txt, by apt where the user may install
#   bootstrap.sh python    .venv with the exact versions of requirements.lock, and the `lacuna` command
#   bootstrap.sh sundials7 FOLDER    SUNDIALS 7 from Debian's sources, installed in FOLDER/installed
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

# Debian 12 has SUNDIALS 6; these are the sources of Debian 13's package, what the runtime needs of them.
sundials7() {
  local archive=sundials_7.1.1+dfsg1.orig.tar.xz
  local sha256=8ed409272af77e958d0ac02fd72199d8643063faf2aa61811e5c615d7db5cf8e
  [[ ! -d $1/installed ]] || return 0
  mkdir -p "$1/source"
  curl --silent --show-error --fail --location --output "$1/$archive" \
    "https://deb.debian.org/debian/pool/main/s/sundials/$archive"
  sha256sum --quiet --check <<<"$sha256  $1/$archive"
  tar --extract --xz --file "$1/$archive" --strip-components 1 --directory "$1/source"
  cmake -S "$1/source" -B "$1/build" -G Ninja --log-level=WARNING -DCMAKE_BUILD_TYPE=Release -DENABLE_KLU=ON \
    -DKLU_INCLUDE_DIR=/usr/include/suitesparse -DKLU_LIBRARY_DIR="/usr/lib/$(gcc -print-multiarch)" \
    -DBUILD_SHARED_LIBS=OFF -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DEXAMPLES_ENABLE_C=OFF -DEXAMPLES_INSTALL=OFF \
    -DBUILD_ARKODE=OFF -DBUILD_CVODE=OFF -DBUILD_CVODES=OFF -DBUILD_KINSOL=OFF -DBUILD_IDA=ON -DBUILD_IDAS=ON \
    -DCMAKE_INSTALL_PREFIX="$1/unfinished" >"$1/build.log"
  ninja -C "$1/build" --quiet install >>"$1/build.log"
  mv "$1/unfinished" "$1/installed"
}

case "${1:-}" in
  debian | python) "$1" ;;
  sundials7) "$1" "${2:?FOLDER is missing}" ;;
  *)
    echo "usage: bootstrap.sh debian|python|sundials7 FOLDER" >&2
    exit 2
    ;;
esac
