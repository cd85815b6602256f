"""An installed wheel works by itself: no Eigen, no SuiteSparse, no compiler."""

import subprocess
import sys
from importlib import metadata
from pathlib import Path

import numpy as np

import tissu


def test_it_comes_from_the_installed_package():
    listed = {str(path) for path in metadata.files("tissu") or ()}
    assert any(name.startswith("tissu/_core") for name in listed)
    assert Path(tissu.__file__).parent.parent.name == "site-packages"


def test_it_takes_steps_with_every_kind_of_solver():
    scene = tissu.examples.organ()
    sags = []
    for solver in (tissu.Auto(), tissu.Cholesky(), tissu.ConjugateGradient(tolerance=1e-10)):
        simulation = scene.replace(step=tissu.ImplicitEuler("10 ms", solver=solver)).compile()
        for report in simulation.run("0.1 s"):
            assert report.converged
        sags.append(simulation.displacements("organ")[:, 2].min())
    assert sags[0] < -1e-3
    assert np.ptp(sags) < 1e-4 * abs(sags[0])  # the tolerance of auto is 1e-5 a step


def test_the_licences_travel_with_it():
    names = {Path(str(path)).name for path in metadata.files("tissu") or ()}
    assert {"LICENSE", "NOTICE.md"} <= names


def test_what_is_bundled_is_licensed():
    """Each bundled library has its licence; with CHOLMOD the metadata name the GPL."""
    paths = [Path(str(path)) for path in metadata.files("tissu") or ()]
    libraries = {path.name.split("-")[0] for path in paths if path.parent.name == "tissu.libs"}
    of = [path.name for path in paths if path.parent.name == "bundled"]
    for library in libraries:
        start = "libopenblas" if library.startswith("libopenblas") else library
        assert any(name.startswith(f"{start}-") for name in of), library
    licence = metadata.metadata("tissu")["License-Expression"]
    assert licence.startswith("GPL-2.0-or-later AND ") == ("libcholmod" in libraries)


def test_the_command_runs():
    done = subprocess.run(
        [sys.executable, "-m", "tissu", "info"], capture_output=True, text=True, check=True
    )
    assert done.stdout.startswith("tissu")
