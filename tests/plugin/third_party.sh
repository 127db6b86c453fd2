#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs Stroma into a temporary folder, builds a copy of the plugin template there with nothing but the
# package, and checks that its force acts: with the library's folder given, and installed beside the modules.
set -euo pipefail
cmake=$1 build=$2 template=$3 compiler=$4 config=$5

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset STROMA_PLUGIN_PATH LD_LIBRARY_PATH

fail() { echo "FAILED: $*" >&2; exit 1; }

"$cmake" --install "$build" --prefix "$work/stroma" > "$work/install.log"
cp -r "$template" "$work/plugin"
cd "$work/plugin"
"$cmake" -S . -B build -G Ninja -DCMAKE_PREFIX_PATH="$work/stroma" -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_BUILD_TYPE="$config" > "$work/configure.log" || { cat "$work/configure.log"; fail configure; }
"$cmake" --build build > "$work/build.log" || { cat "$work/build.log"; fail build; }

stroma=$work/stroma/bin/stroma
hash_of() { grep -o '"state_hash":"[0-9a-f]*"' <<< "$1"; }

if "$stroma" check radial_pull.xml 2> "$work/unknown.txt"; then fail "found the plugin without its folder"; fi
grep -q "unknown component 'RadialPull'" "$work/unknown.txt" || fail "no word of the unknown component"

pulled=$("$stroma" run radial_pull.xml --plugins build/lib/stroma --json)
grep -q '"radial_pull"' <<< "$pulled" || fail "the module was not loaded"
by_path=$(STROMA_PLUGIN_PATH=build/lib/stroma "$stroma" run radial_pull.xml --json)
idle=$("$stroma" run radial_pull.xml --plugins build/lib/stroma --json --set /pull.stiffness=0)
[[ $(hash_of "$pulled") == $(hash_of "$by_path") ]] || fail "STROMA_PLUGIN_PATH gives another result"
[[ $(hash_of "$pulled") != $(hash_of "$idle") ]] || fail "the force does not act"

"$cmake" --install build --prefix "$work/stroma" > "$work/install.log"
installed=$("$stroma" run radial_pull.xml --json)
[[ $(hash_of "$pulled") == $(hash_of "$installed") ]] || fail "installed, it gives another result"
"$stroma" components RadialPull | grep -q "N/m, >= 0, default 100" || fail "no reference"
echo "third party's plugin acts: $(hash_of "$pulled") with it, $(hash_of "$idle") without"
