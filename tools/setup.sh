# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# What tools/run and tools/test share: packages, configuring and building. To be sourced.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# shellcheck disable=SC2034  # used by those who source this
run_packages=(g++ cmake ninja-build libeigen3-dev libtinyxml2-dev libboost-dev libboost-filesystem-dev
              libtbb-dev libcgal-dev libassimp-dev libcli11-dev libnanoflann-dev libbullet-dev
              nlohmann-json3-dev libjs-chart.js)

# Installs the Debian packages that are missing; as root, else by sudo. Where neither is possible it prints the
# command and stops.
install_missing() {
  local package missing=()
  if ! command -v dpkg-query > /dev/null; then
    echo "Not a Debian system: make sure that these, or their like, are installed: $*" >&2
    return
  fi
  for package in "$@"; do
    if [[ $(dpkg-query -W -f='${db:Status-Status}' "$package" 2> /dev/null) != installed ]]; then
      missing+=("$package")
    fi
  done
  (( ${#missing[@]} > 0 )) || return 0
  local sudo=()
  if (( EUID != 0 )); then
    if ! command -v sudo > /dev/null || { [[ ! -t 0 ]] && ! sudo -n true 2> /dev/null; }; then
      echo "Some packages are missing, and installing them needs root. Please run, then start again:" >&2
      echo "  apt-get install --no-install-recommends ${missing[*]}" >&2
      exit 1
    fi
    sudo=(sudo)
  fi
  echo "Installing ${missing[*]}"
  "${sudo[@]}" apt-get -qq update < /dev/null
  "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends \
    "${missing[@]}" < /dev/null > /dev/null
}

# npm builds the viewer's page. Debian's npm would clash with a Node that was installed otherwise, which has its own.
install_npm() {
  if ! command -v npm > /dev/null; then
    install_missing nodejs npm
  fi
}

# As many compilers at once as there are cores, and memory for (1.5 GB each).
build_jobs() {
  local cores memory
  cores=$(nproc)
  memory=$(awk '/^MemAvailable/ { print int($2 / 1572864) }' /proc/meminfo)
  (( memory < cores )) && cores=$memory
  (( cores > 0 )) || cores=1
  echo "$cores"
}

# configure PRESET [cmake options]; quiet unless it fails
configure() {
  local preset=$1 log
  shift
  log=$(mktemp)
  if ! (cd "$root" && cmake --preset "$preset" "$@") > "$log" 2>&1; then
    cat "$log" >&2
    rm -f "$log"
    exit 1
  fi
  rm -f "$log"
}

# build PRESET [cmake --build options]
build() {
  local preset=$1
  shift
  cmake --build "$root/build/$preset" --parallel "$(build_jobs)" "$@"
}
