#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# ./run installs exactly what is missing and says in one line what it cannot have. Debian's tools are played by stand-ins
# on a PATH of their own. Argument: the script.
set -u
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
bin=$folder/bin
script=$folder/run
cp "$1" "$script"  # where any user may read it
failures=0

# stand_in NAME BODY
stand_in() {
  printf '#!%s\n%s\n' "$(command -v bash)" "$2" >"$bin/$1"
  chmod +x "$bin/$1"
}

# A machine on which everything but $1 is installed.
machine_without() {
  rm -rf "$bin"
  mkdir -p "$bin"
  chmod 755 "$folder" "$bin"
  local tool
  for tool in bash dirname env cat; do ln -s "$(command -v "$tool")" "$bin/$tool"; done
  : >"$folder/log"
  chmod 666 "$folder/log"
  stand_in dpkg-query "[[ \"\${@: -1}\" == '$1' ]] || echo -n installed"
  stand_in apt-get "echo \"apt-get \$*\" >>'$folder/log'"
  stand_in apt-cache "exit 0"
}

# Runs the script as the current user, or as nobody when it asks for that and may.
run_packages() {
  local as_user=()
  [[ ${1:-} == nobody ]] && ((EUID == 0)) && as_user=(setpriv --reuid 65534 --clear-groups)
  output=$("${as_user[@]}" env PATH="$bin" bash "$script" packages 2>&1)
  status=$?
}

# expect WHAT STATUS TEXT: the last run ended so, and its last line holds the text.
expect() {
  if [[ $status != "$2" || ${output##*$'\n'} != *"$3"* ]]; then
    echo "FAILED: $1: status $status, expected $2; last line expected to hold \"$3\", got:"
    echo "$output"
    failures=$((failures + 1))
  fi
}

expect_log() {
  if [[ $(<"$folder/log") != "$2" ]]; then
    echo "FAILED: $1: expected \"$2\", got \"$(<"$folder/log")\""
    failures=$((failures + 1))
  fi
}

machine_without nothing
run_packages
expect "nothing is missing" 0 ""
expect_log "nothing is missing: apt-get is left alone" ""

machine_without libfmt-dev
stand_in sudo 'exec "$@"'
run_packages
expect "one package is missing" 0 "run: installing libfmt-dev"
expect_log "one package is missing" "apt-get -qq update
apt-get -qq install -y --no-install-recommends libfmt-dev"

machine_without libfmt-dev
stand_in sudo 'exec "$@"'
stand_in apt-cache 'exit 100'
run_packages
expect "a package is unknown" 1 "run: the apt sources of this machine have no package libfmt-dev"

machine_without libfmt-dev
stand_in sudo 'exec "$@"'
stand_in apt-get 'exit 100'
run_packages
expect "there is no network" 1 "run: apt-get update failed"

machine_without libfmt-dev
stand_in sudo 'exec "$@"'
stand_in apt-get '[[ "$*" == *update* ]]'
run_packages
expect "the installation fails" 1 "run: apt-get could not install: libfmt-dev"

machine_without libfmt-dev
run_packages nobody
expect "neither root nor sudo" 1 "run: needs root or sudo to install: libfmt-dev"
if ((EUID == 0)) && [[ $output == *$'\n'* ]]; then
  echo "FAILED: neither root nor sudo: expected one line, got:"
  echo "$output"
  failures=$((failures + 1))
fi

machine_without libfmt-dev
rm "$bin/dpkg-query"
run_packages
expect "no Debian" 1 "run: needs Debian 12"

exit $((failures > 0))
