"""The scene as users have it: its fields, and the verbs that read, check, write and compile it."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from typing_extensions import Self

from tissu.errors import SceneError
from tissu.scene.part import problems_in
from tissu.scene.scene import SceneData

if TYPE_CHECKING:
    from tissu.compile import Check
    from tissu.simulation import Simulation

__all__ = ["Scene"]


class Scene(SceneData):
    """Bodies, supports, loads, contacts and a method in time; frozen and validated.

    An effect that is absent (no viscosity, no gravity, no loads) is absent from the simulation too.
    """

    def _refusal(self) -> list[str]:
        from tissu.compile import problems_of

        return problems_of(self)

    @classmethod
    def from_yaml(cls, path: str | os.PathLike[str], *, trust_laws: bool = False) -> Self:
        """Read a scene; paths of meshes are relative to the file.

        Args:
            path: the file.
            trust_laws: run the files of `laws`, which are programs: only of scenes that you trust.

        Raises:
            SceneError: the file cannot be read or has wrong fields; with them everything that
                compile() would refuse, each problem with its line.
        """
        from tissu.yaml_io import read_scene

        return accepted(read_scene(Path(path), cls, trust_laws=trust_laws))

    @classmethod
    def from_yaml_text(
        cls, text: str, *, base: str | os.PathLike[str] | None = None, trust_laws: bool = False
    ) -> Self:
        """Read a scene from a text; paths of meshes are relative to the folder `base`.

        Args:
            text: the scene in YAML.
            base: the folder; absent: the present one.
            trust_laws: run the files of `laws`, which are programs: only of scenes that you trust.

        Raises:
            SceneError: the text has wrong fields; with them everything that compile() would
                refuse, each problem with its line.
        """
        from tissu.yaml_io import parse_scene

        folder = None if base is None else Path(base)
        return accepted(parse_scene(text, cls, base=folder, trust_laws=trust_laws))

    def to_yaml(self) -> str:
        """The scene as YAML text that reads back as an equal scene.

        Raises:
            SceneError: a mesh was made in memory; `save` writes it to a file.
        """
        from tissu.yaml_io import scene_text

        return scene_text(self)

    def to_dict(self) -> dict[str, Any]:
        """The content of to_yaml() as mappings, lists and numbers in SI.

        Raises:
            SceneError: a mesh was made in memory; `save` writes it to a file.
        """
        from tissu.yaml_io import scene_data

        return scene_data(self)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the scene to a YAML file, and beside it meshes made in memory as .vtu files.

        Files of laws from outside the file's folder are copied into it, because a scene reads no
        files from outside.

        Raises:
            SceneError: a file cannot be written.
        """
        from tissu.yaml_io import write_scene

        write_scene(self, Path(path))

    def compile(self, *, checkpoint: str | os.PathLike[str] | None = None) -> Simulation:
        """Turn the scene into a simulation.

        Args:
            checkpoint: a file of `Simulation.save_checkpoint`, from which the simulation continues
                with the same bits; absent: it begins at rest. Name, duration, threads and output
                may differ from those of the scene that was saved.

        Raises:
            SceneError: the scene or its meshes have problems; the error lists all of them.
            CheckpointError: the file is absent, damaged, or of another scene or version.
        """
        from tissu.compile import compile_scene

        simulation = compile_scene(self, None if checkpoint is None else Path(checkpoint))
        simulation._prepare_first_step()
        return simulation

    def check(self) -> Check:
        """The reasons for which compile() would refuse, and the effects that are switched on."""
        from tissu.compile import check_scene

        return check_scene(self)


S = TypeVar("S", bound=Scene)


def accepted(scene: S) -> S:
    """The scene, when its fields have no problem.

    Raises:
        SceneError: they have; with them everything that compile() would refuse.
    """
    if next(problems_in(scene), None) is not None:
        raise SceneError(scene._refusal())
    return scene
