"""The effects that a scene may have, and by which functions each is known when it runs."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from instruction_counts import Counts, Function, count


@dataclass(frozen=True)
class Row:
    """An effect.

    Attributes:
        effect: what it is called.
        scene: of tissu-effects, which has it.
        without: the scene that has everything but it.
        own: matches the functions that run for it alone; None where it has none in a step.
    """

    effect: str
    scene: str
    own: str | None
    without: str = "bare"


CONTACT = (
    r"\b(Contact|ContactRun|Candidates|Meetings|SurfaceSet|HoldBack|PushAhead|Hierarchy|BoxTree)\b"
    r"|\b(Box|find_contact|free_way|is_kept_apart|closest_edge_edge|closest_point_triangle)\b"
)
ROWS = (
    Row("gravity", "gravity", r"\bGravity\b"),
    Row("nodal load", "nodal-load", r"\b(NodalLoad|LoadChange|History)\b"),
    Row("traction", "traction", r"\b(NodalLoad|LoadChange|History)\b"),
    Row("pressure", "pressure", r"\bPressure\b"),
    Row("fixed nodes", "fixed", r"\bMotion\b"),
    Row("prescribed motion", "prescribed", r"\b(Motion|interpolate|locate)\b"),
    Row("live lead", "live-lead", r"\bLive(Lead|Place)\b", "fixed"),
    Row("Rayleigh damping", "rayleigh", r"\bRayleigh\b"),
    Row("Kelvin–Voigt viscosity", "kelvin-voigt", r"\b(KelvinVoigt|ViscousCells|StrainRate)\b"),
    Row("centroid viscosity", "centroid", r"\bCentroidDamping\b"),
    Row("Prony series", "prony", r"Prony|Overstress"),
    Row("sheets", "sheets", r"ShapeKernels<3, 2\b"),
    Row("lines", "lines", r"ShapeKernels<2, 1\b"),
    Row("fibres", "fibres", r"\bFibre\b"),
    Row("cells of a second type", "hexahedra", r"\bHexahedron8\b"),
    Row("corotational cells", "corotational", r"\bCorotational"),
    Row("mass-spring, with dampers", "mass-spring", r"\b(MassSpring|SpringDampers)\b"),
    Row("mass-link", "mass-link", r"\bMassLink\b"),
    Row("mass-tensor", "mass-tensor", r"\bMassTensor\b"),
    Row("mean dilatation", "mean-dilatation", r"\bMeanDilatation\b"),
    Row("condensed region", "condensed", r"\bCondensed"),
    Row("rigid frame", "frame", r"\bspatial_inertia\b"),
    Row("run-time spring", "link", r"\b(Links|Couplings)\b"),
    Row("grab", "grab", r"\b(Grabs|Couplings)\b"),
    Row("contact with an obstacle", "touch-plane", CONTACT),
    Row("friction", "rub-plane", r"\bImplicitContact::rub\b", "touch-plane"),
    Row("contact by penalty", "spring-plane", r"\bImplicitPenalty\b", "touch-plane"),
    Row("contact by impulses", "strike-plane", r"\bImpulseContact\b", "explicit"),
    Row("contact by correction", "correct-plane", r"\bGeometricContact\b", "strike-plane"),
    Row("contact by a barrier", "barrier-plane", r"\bBarrierContact\b", "touch-plane"),
    Row("contact of two bodies", "touch-bar", CONTACT, "two-bars"),
    Row("self-contact", "touch-itself", CONTACT),
    Row("instruments", "instruments", r"\bInstruments\b"),
    Row("editing allowed, nothing removed", "editable", None),
    Row("a cell removed in each step", "editing", r"\b(remove_cells|edited_model|replace_world)\b"),
    Row("Newton's iteration", "newton", r"\bStageSolver::(iterate|advance|potential)\b"),
    Row("indefinite matrices projected", "indefinite", r"stiffness<true>|definite"),
    Row("snapshots", "snapshots", r"\bSimulation::snapshot\b"),
    Row("reactions", "reactions", r"\bSimulation::reactions\b"),
    Row("energies", "energies", r"\bSimulation::energy\b|\bkinetic_energy\b"),
    Row("gravity, explicit step", "explicit-gravity", r"\bGravity\b", "explicit"),
    Row("fixed nodes, explicit step", "explicit-fixed", r"\bMotion\b", "explicit"),
    Row(
        "implicit step",
        "bare",
        r"\b(BlockMatrix|ConjugateGradient|StageSolver|PartBalance)\b",
        "explicit",
    ),
    Row("inertia", "hanging", r"\bMass\b", "static"),
)

# What looks, in each step of the bare scene, whether there is such an effect: a loop over nothing,
# or one question. It takes the same on every mesh.
ASKED = {
    "loads": r"\bSystem::external_force\b",
    "fixed or led nodes": r"\bFixedDofs::|\bBlockMatrix::constrain\b|\bStageSolver::lead\b",
    "rigid frames": r"\bkeep_angular_momentum\b",
    "what remembers": r"\btissu::remember\(",
    "whether to stop": r"\bstop_if_asked\(",
    "what begins a step": r"\btissu::begin_step\(",
}

# What the bare scene does ask for.
PRESENT = {
    "elasticity": r"\b(Elastic|CellModel|BodyModel|ForceModel|StVK)\b.*::",
    "inertia": r"\bMass::",
    "linear solver": r"\b(ConjugateGradient|Forecast|attainable)|"
    r"\b(Iteration|Preconditioner|BlockJacobi)<"
    # Inverses of blocks, dot products and their sums, copies of vectors: inlined or not, as the
    # compiler likes.
    r"|\bcompute_inverse<Eigen::Matrix<double, 3, 3|\bThreads::sum<tissu::dot<|^std::vector<double,"
    r".*>::(resize|operator=)\(",
    "matrix": r"\b(BlockMatrix::|multiply_(rows\b|three\b|three_of\b))",
    "method": r"\b(ImplicitEuler|StageSolver|PartBalance|System|State|World)::|\bmove\("
    # Rigid motions, in systems of at most six unknowns.
    r"|\b(RigidMotions|RigidCorrection|TurnAhead|Turning)::|\b(carried|turn_by)\("
    r"|Eigen::Matrix<double, -1, -?1, 0, 6, [16]>"
    r"|\btriangular_solve_vector<double",
    "loop and roll back": r"\bSimulation::|^tissu_effects_steps$",
    "profile": r"\bProfile::",
    "words of a report": r"^operator (new|delete)|^std::.*basic_string<char,.*::_M_replace\(",
}
# Of the libraries beside the program: the clock, copies of vectors, words of a report.
LIBRARIES = {"C library": r"^lib[cm][.-]", "C++ library": r"^libstdc\+\+"}


def matching(own: Mapping[Function, int], pattern: str) -> dict[Function, int]:
    """The functions whose name the pattern finds, with their instructions."""
    wanted = re.compile(pattern)
    return {function: n for function, n in own.items() if wanted.search(function.name)}


def instructions_of(counts: Counts, pattern: str) -> int:
    """Instructions, in all steps, of the functions whose name the pattern finds."""
    return sum(matching(counts.own, pattern).values())


def shares(counts: Counts) -> dict[str, int]:
    """Where the instructions of the bare scene go: by part, questions last, `unknown` if any."""
    parts: dict[str, int] = {}
    for function, instructions in counts.own.items():
        part = part_of(function)
        parts[part] = parts.get(part, 0) + instructions
    return parts


def part_of(function: Function) -> str:
    """The part of the bare scene that a function belongs to."""
    for part, pattern in LIBRARIES.items():
        if re.search(pattern, function.object_file):
            return part
    for part, pattern in (*ASKED.items(), *PRESENT.items()):
        if re.search(pattern, function.name):
            return part
    return "unknown"


@dataclass(frozen=True)
class Measured:
    """A row's counts: without the effect, with it, and without it again in the same process."""

    row: Row
    without: Counts
    present: Counts
    again: Counts


def measure(*, size: int, steps: int) -> list[Measured]:
    """Counts every row's scene, each between two runs of the scene without the effect."""
    scenes: list[str] = []
    places: list[int] = []
    for row in ROWS:
        scenes += [row.without] if not scenes or scenes[-1] != row.without else []
        places.append(len(scenes))
        scenes += [row.scene, row.without]
    counts = count(scenes, size=size, steps=steps)
    return [
        Measured(row, *counts[place - 1 : place + 2])
        for row, place in zip(ROWS, places, strict=True)
    ]
