# The steps of .ci/setup.sh, in order. Each looks first, and works only when something is missing.
venv=.venv
build=build/main
python=${PYTHON:-python3}
log=build/setup.log
from_pypi=   # build tools and Eigen, where Debian packages cannot be had

# What is being done: one line. $1: the sentence.
say() { printf 'tissu: %s\n' "$1"; }

# Ends with the tail of the log and one sentence. $1: what went wrong and what to do.
fail() {
  [ -s "$log" ] && { printf -- '--- the last lines of %s\n' "$log"; tail -n 30 "$log"; printf -- '---\n'; } >&2
  printf 'tissu: %s\n' "$1" >&2
  exit 1
}

# The checksum of the text on standard input.
checksum() { sha256sum | cut -d' ' -f1; }

# $1: stamp, $2: checksum. True when the step was done with this very input.
is_done() { [ -f "$venv/.tissu-$1" ] && [ "$(cat "$venv/.tissu-$1")" = "$2" ]; }
mark_done() { printf '%s\n' "$2" >"$venv/.tissu-$1"; }

step_python() {
  command -v "$python" >/dev/null || fail "no $python; install Python 3.10 or newer (Debian: python3)."
  "$python" -c 'import sys; sys.exit(sys.version_info < (3, 10))' ||
    fail "$("$python" --version) is too old; 3.10 or newer is needed (PYTHON=/path/to/python3.x make ... names one)."
}

has_package() { dpkg-query -W -f '${db:Status-Status}\n' "$1" 2>/dev/null | grep -qx installed; }

# Prints what the machine lacks, one Debian package a line. $1: demo, test, lint or bench.
missing_packages() {
  local package wanted=yes
  case $1 in test | lint) wanted='\(yes\|tests\)' ;; esac
  command -v g++ >/dev/null || echo g++
  command -v cmake >/dev/null || echo cmake
  command -v ninja >/dev/null || echo ninja-build
  "$python" -c 'import venv, ensurepip' 2>/dev/null || echo python3-venv
  "$python" -c 'import os, sys, sysconfig
sys.exit(not os.path.exists(os.path.join(sysconfig.get_paths()["include"], "Python.h")))' || echo python3-dev
  # The libraries: the DEBIAN lines of third_party/dependencies.cmake that say INSTALL yes, or tests for them.
  sed -n "/^ *DEBIAN /{s/^ *DEBIAN \"\(.*\)\".*/\1/;h;};/^ *INSTALL $wanted/{x;p;}" third_party/dependencies.cmake |
    while read -r package; do [ "$package" = g++ ] || has_package "$package" || echo "$package"; done
}

# How this user may install: nothing for root, "sudo -n" where that asks for no password.
privilege() {
  if [ "$(id -u)" = 0 ]; then echo env
  elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then echo "sudo -n env"
  else return 1; fi
}

# $1: demo, test, lint or bench.
step_system() {
  local missing right
  if [ -n "${TISSU_NO_APT:-}" ] || ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    command -v g++ >/dev/null || fail "no C++ compiler; install g++ 11 or newer."
    from_pypi="cmeel-eigen>=3.4"
    command -v cmake >/dev/null || from_pypi="$from_pypi"$'\n'"cmake>=3.22"
    command -v ninja >/dev/null || from_pypi="$from_pypi"$'\n'"ninja"
    return
  fi
  missing=$(missing_packages "$1" | tr '\n' ' ')
  [ -n "$missing" ] || return 0
  right=$(privilege) || fail "these packages are missing and this user may not install them; run
  sudo apt-get update && sudo apt-get install -y ${missing% }
then the same command again (or, with a C++ compiler and the network at hand, set TISSU_NO_APT=1)."
  install_packages "$right" "${missing% }" || fail "apt could not install ${missing% }; the reason is above."
}

# $1: how this user may install, $2: Debian packages.
install_packages() {
  local right=$1 packages=$2
  say "installing with apt: $packages"
  {
    # shellcheck disable=SC2086
    $right DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=400 update
    # shellcheck disable=SC2086
    $right DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=400 install -y --no-install-recommends $packages
  } >>"$log" 2>&1 9>&-
}

# $1: demo, test, lint or bench. What tests use where it is there, and are skipped without; asked for once each.
step_optional() {
  [ "$1" = test ] || return 0
  optional_package valgrind "the tests that count instructions"
  optional_package chromium "the tests of the view in a browser"
}

# $1: a command and the Debian package of it, $2: the tests that are skipped without.
optional_package() {
  local right
  command -v "$1" >/dev/null && return
  is_done "optional-$1" "$1" && return
  mark_done "optional-$1" "$1"
  if [ -n "${TISSU_NO_APT:-}" ] || ! command -v apt-get >/dev/null || ! right=$(privilege); then
    say "no $1: $2 are skipped"
    return
  fi
  install_packages "$right" "$1" || say "apt could not install $1 ($log): $2 are skipped"
}

step_venv() {
  if ! "$venv/bin/python" -c 'import pip' 2>/dev/null; then
    say "making $venv"
    rm -rf "$venv"
    "$python" -m venv "$venv" >>"$log" 2>&1 || fail "could not make $venv with $python; the reason is above."
  fi
  PATH="$PWD/$venv/bin:$PATH"
  python="$PWD/$venv/bin/python"
}

# $1: demo, test, lint or bench.
step_packages() {
  local extras wanted key
  case $1 in
    demo) extras=view ;;   # a first look is in the browser
    bench) extras= ;;
    test) extras="test docs" ;;
    docs) extras=docs ;;
    *) extras="test lint docs" ;;
  esac
  # shellcheck disable=SC2086
  wanted=$("$python" .ci/requirements.py build $extras) || fail "could not read the requirements in pyproject.toml."
  wanted="pip>=23.1"$'\n'"$wanted"   # Ubuntu 22.04's cannot pass settings to a build
  [ -z "$from_pypi" ] || wanted="$wanted"$'\n'"$from_pypi"
  key=$(printf '%s' "$wanted" | checksum)
  is_done "packages-$1" "$key" && return
  say "installing Python packages into $venv"
  printf '%s\n' "$wanted" >build/requirements.txt
  "$python" -m pip install --quiet --disable-pip-version-check -r build/requirements.txt >>"$log" 2>&1 ||
    fail "pip could not install the Python packages; the reason is above."
  mark_done "packages-$1" "$key"
}

# The instruction sets that the hot kernels are compiled for. A first look takes those of this machine, which saves a
# tenth of the build; all others, and what already has them all, take all. $1: as above.
instruction_sets() {
  if [ "$1" = demo ] && ! grep -q "^TISSU_ISAS:STRING=all" "$build/CMakeCache.txt" 2>/dev/null; then
    echo native
  else
    echo all
  fi
}

# Everything that the installed package is made of. $1: the instruction sets.
sources() {
  printf '%s\n' "werror=${TISSU_WERROR:-OFF}" "isas=$1" "$PWD"
  find CMakeLists.txt pyproject.toml cpp python third_party -type f -not -path '*/__pycache__/*' -print0 |
    LC_ALL=C sort -z | xargs -0 sha256sum
}

# $1: demo, test, lint or bench.
step_build() {
  local key isas
  isas=$(instruction_sets "$1")
  key=$(sources "$isas" | checksum)
  if is_done build "$key" && [ -f "$build/CMakeCache.txt" ] && [ -x "$venv/bin/tissu" ]; then return; fi
  say "compiling and installing tissu (minutes the first time)"
  "$python" -m pip install --quiet --disable-pip-version-check --no-build-isolation --no-deps --force-reinstall \
    --config-settings=build-dir="$build" \
    --config-settings=cmake.define.TISSU_ISAS="$isas" \
    --config-settings=cmake.define.TISSU_WERROR="${TISSU_WERROR:-OFF}" . >>"$log" 2>&1 9>&- ||
    fail "the build failed; the compiler's message is above."
  mark_done build "$key"
}

# $1: demo, test, lint or bench. The same build folder holds the tests and the benchmarks once they are wanted.
step_configure() {
  local option
  for option in $(case $1 in test) echo TESTS ;; bench) echo BENCH ;; lint) echo TESTS BENCH ;; esac); do
    grep -q "^TISSU_BUILD_$option:BOOL=ON" "$build/CMakeCache.txt" && continue
    cmake "-DTISSU_BUILD_$option=ON" "$build" >>"$log" 2>&1 || fail "CMake could not set up the $1; the reason is above."
  done
}
