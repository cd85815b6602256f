#!/usr/bin/env bash
# .ci/setup.sh demo|test|lint|docs|bench: makes the machine, .venv and build/ ready. Quiet when nothing is to do; the log is
# build/setup.log. Does again only what its input changed since: a stamp per step holds the checksum of that input.
#   TISSU_NO_APT=1    touch no Debian package: CMake, Ninja, Eigen come from PyPI, the rest from pinned sources
#   TISSU_WERROR=ON   warnings of the C++ compiler are errors
#   PYTHON=python3.x  the interpreter of .venv (only when it is made)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=.ci/setup_steps.sh
. .ci/setup_steps.sh

purpose=${1:-test}
mkdir -p build
exec 9>build/setup.lock
if command -v flock >/dev/null; then flock 9; fi   # two at once would spoil each other's build
: >build/setup.log

step_python
[ "$purpose" = docs ] || step_system "$purpose"
step_venv
step_optional "$purpose"
step_packages "$purpose"
[ "$purpose" = docs ] && exit   # the site is made from the sources: nothing is compiled
step_build "$purpose"
step_configure "$purpose"
