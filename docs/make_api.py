"""Writes the pages of the Python API from the list of public names: docs/reference/api/*.md.

mkdocstrings puts the docstrings in when the site is built. A room that no page below names gets a
page of its own, so that each public name has a page.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from tissu.codegen.names import HEADINGS, MODULES, NAMES, part_names

FOLDER = Path(__file__).parent / "reference" / "api"
FIRST = "Simulation"
"""The name that stands first on its page."""


@dataclass(frozen=True)
class Page:
    """One page: its title, what it says first, rooms of public names, and objects they return."""

    title: str
    words: str
    rooms: tuple[str, ...] = ()
    returned: tuple[str, ...] = ()
    modules: tuple[str, ...] = ()


PAGES = {
    "simulation": Page(
        "Simulation",
        "`scene.compile()` makes a simulation. Its methods step it, look into it and touch it.",
        ("simulation",),
        (
            "simulation.grab.Grab",
            "simulation.grab_point.GrabPoint",
            "simulation.lead.Lead",
            "simulation.live_load.LiveLoad",
            "simulation.obstacle_lead.ObstacleLead",
            "simulation.rigid.Rigid",
            "simulation.contact_at_nodes.ContactAtNodes",
            "simulation.touched.BodySurface",
            "simulation.obstacle_surface.ObstacleSurface",
            "simulation.parameters.Parameters",
            "simulation.parameters.Parameter",
            "simulation.profile.ProfileRow",
            "simulation.profile.Solves",
            "simulation.profile.WorstStep",
            "checkpoint.Resumed",
            "compile.Check",
            "scene.effect.Effect",
            "scene.problem.Problem",
            "scene.problem.Source",
        ),
    ),
    "mesh": Page("Meshes", "Reading, making, checking and writing meshes.", ("mesh",)),
    "cutting": Page("Cutting", "Blades, and what a cut leaves behind.", ("cutting",)),
    "own-laws": Page(
        "Laws of your own",
        "A law from its formula, compiled at run time.",
        ("user_law",),
        ("user_law.made.MadeLaw", "user_law.made.Build", "codegen.definition.Law"),
        ("formula",),
    ),
    "fields": Page("Names of fields", "What `Simulation.field` computes.", ("field_names",)),
    "studies": Page(
        "Comparison and advice",
        "One scene with several models, and the cheapest setting that is good enough.",
        ("comparison", "advice"),
        ("comparison.table.Row", "advice.goal.Goal", "advice.rows.Row"),
    ),
    "pictures": Page(
        "Pictures, files and the live view",
        "Images, files for ParaView, and the page in the browser.",
        ("picture", "output", "live_view"),
    ),
    "sampling": Page(
        "Examples and sampling",
        "The examples that come with the package, and points inside a surface.",
        (),
        ("sampling.nearest.TriangleTree",),
        ("examples", "sampling"),
    ),
    "trocar": Page(
        "The controller of a trocar",
        "These are loaded from their modules: `from tissu.trocar.controller import Controller`.",
        (),
        (
            "trocar.controller.Controller",
            "trocar.model.LocalModel",
            "trocar.model.Blade",
            "trocar.touch.Touch",
            "trocar.touch.Felt",
            "trocar.report.Report",
            "trocar.report.Timing",
            "trocar.report.Spread",
            "trocar.report.Grant",
            "trocar.states.State",
            "trocar.states.Reason",
            "trocar.recording.Recording",
            "trocar.recording.Published",
            "scene.trocar.passive.Bound",
        ),
    ),
    "errors": Page(
        "Errors",
        "Every error is a `TissuError`. [Errors](../errors.md) says what to do about them.",
        ("errors",),
    ),
}
"""Name of the file -> the page, beside those of the parts of a scene."""
COMMON = {
    "Laws and viscosity": "scene.law.Law",
    "Models": "scene.model.Model",
    "Loads": "scene.load.Load",
}
"""Heading of parts of a scene -> the class that they have in common."""


def slug(heading: str) -> str:
    """The file of a heading of the scene's parts."""
    return "scene-" + heading.split(":")[0].lower().replace(" ", "-")


def block(name: str, *options: str) -> str:
    """What mkdocstrings replaces by a docstring."""
    lines = "".join(f"\n      {option}" for option in options)
    return f"::: tissu.{name}" + (f"\n    options:{lines}" if lines else "")


def part_page(heading: str, modules: tuple[str, ...]) -> str:
    """The page of one kind of part; the scene itself is the first."""
    names = ["Scene"] * (modules == ("scene",))
    names += [name for module in modules for name in part_names(module)]
    anchor = heading.lower().replace(":", "").replace(" ", "-")
    where = f"[Scene files](../scene.md#{anchor})"
    head = (
        f"# {heading}\n\n{where} has the fields of these classes with their defaults. Each part\n"
        "has `replace(**changes)`: the part with some fields changed, and checked again.\n"
    )
    blocks = [block(name) for name in names]
    if heading in COMMON:
        blocks += ["## What they have in common", block(COMMON[heading])]
    return "\n".join([head, *(f"{text}\n" for text in blocks)])


def room_page(page: Page) -> str:
    """The page of rooms and modules."""
    inherited = "inherited_members: true"
    names = sorted((name for room in page.rooms for name in NAMES[room]), key=FIRST.__ne__)
    blocks = [block(name, inherited) for name in names]
    blocks += [block(name) for name in page.modules]
    if page.returned:
        blocks += ["## What methods return"] * bool(names or page.modules)
        blocks += [block(name, inherited) for name in page.returned]
    return "\n".join([f"# {page.title}\n\n{page.words}\n", *(f"{text}\n" for text in blocks)])


def names_of(page: Page) -> list[str]:
    """Public names of a page of rooms and modules."""
    return [*(name for room in page.rooms for name in NAMES[room]), *page.modules]


def index() -> str:
    """The page that lists every public name."""
    lines = [
        "# Python API",
        "",
        "`import tissu as ts` loads each name when it is first asked for. Numbers are SI, arrays",
        "are `(n, 3)`, and nodes of cells stand in VTK's order. A text with a unit is converted.",
        "",
        "| page | names, and classes that methods return |",
        "|---|---|",
    ]
    for heading, modules in HEADINGS.items():
        names = ["Scene"] * (modules == ("scene",))
        names += [name for module in modules for name in part_names(module)]
        listed = " ".join(f"`{name}`" for name in names)
        lines.append(f"| [{heading}]({slug(heading)}.md) | {listed} |")
    for name, page in all_pages().items():
        returned = [path.rpartition(".")[2] for path in page.returned]
        listed = " ".join(f"`{public}`" for public in dict.fromkeys([*names_of(page), *returned]))
        lines.append(f"| [{page.title}]({name}.md) | {listed} |")
    return "\n".join([*lines, "", "This page is printed by `make codegen`.", ""])


def all_pages() -> dict[str, Page]:
    """The pages above, and one for each room or public module that none of them has."""
    rooms = {room for page in PAGES.values() for room in page.rooms} | {"front"}
    modules = {module for page in PAGES.values() for module in page.modules}
    found = dict(PAGES)
    for name in [*(room for room in NAMES if room not in rooms), *MODULES]:
        if name not in modules:
            title = name.replace("_", " ").capitalize()
            own = ((name,), (), ()) if name in NAMES else ((), (), (name,))
            found[name.replace("_", "-")] = Page(
                title, f"The public names of `tissu.{name}`.", *own
            )
    return found


def pages() -> dict[Path, str]:
    """Every page with its text."""
    found = {"index": index()}
    found |= {slug(heading): part_page(heading, some) for heading, some in HEADINGS.items()}
    found |= {name: room_page(page) for name, page in all_pages().items()}
    return {FOLDER / f"{name}.md": text for name, text in found.items()}


if __name__ == "__main__":
    FOLDER.mkdir(exist_ok=True)
    for path, text in pages().items():
        path.write_text(text, encoding="utf-8")
