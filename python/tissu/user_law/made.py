"""A law that is made: its formula, its C++, and the core's law for each instruction set."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from tissu.errors import LawError, ParameterError, TissuError
from tissu.user_law.cache import library_for
from tissu.user_law.compiler import find_compiler, flags_for
from tissu.user_law.library_image import library_image

if TYPE_CHECKING:
    from tissu._core import LoadedLaw
    from tissu.codegen.definition import Law


@dataclass(frozen=True, slots=True)
class Build:
    """The core's law with what it was compiled by.

    Attributes:
        loaded: the law as the core holds it.
        compiler: its name and version.
        flags: those of the compiler.
    """

    loaded: LoadedLaw
    compiler: str
    flags: str


@dataclass(frozen=True, slots=True, eq=False)
class MadeLaw:
    """What the scene's class of a law of one's own stands for.

    Attributes:
        law: its formula, parameters and constants.
        source: its C++.
        file: the file it was read from, if it was.
    """

    law: Law
    source: str
    file: Path | None = None
    _builds: dict[str, Build] = field(default_factory=dict, repr=False)

    def __eq__(self, other: object) -> bool:
        """Whether the other law computes the same."""
        return isinstance(other, MadeLaw) and self.source == other.source

    def __hash__(self) -> int:
        return hash(self.source)

    @property
    def name(self) -> str:
        """The law's `type` in a scene."""
        return self.law.name

    @property
    def parameters(self) -> list[str]:
        """Names of the parameters, in order."""
        return [p.name for p in self.law.parameters]

    @property
    def digest(self) -> str:
        """SHA-256 of the C++: laws of one digest compute the same."""
        return hashlib.sha256(self.source.encode()).hexdigest()

    def build(self) -> Build:
        """The law for the instruction set that runs now, compiled when it has not been.

        Raises:
            LawError: no compiler, or one that refuses the text.
        """
        from tissu._core import build_info

        instruction_set = str(build_info()["instruction_set"])
        if instruction_set not in self._builds:
            self._builds[instruction_set] = self._made_for(instruction_set)
        return self._builds[instruction_set]

    def _made_for(self, instruction_set: str) -> Build:
        from tissu._core import LoadedLaw

        compiler, flags = find_compiler(), flags_for(instruction_set)
        data = library_for(self.name, self.source, compiler, flags)
        try:
            loaded = LoadedLaw(path=library_image(self.name, data))
        except TissuError:  # made on another machine, whose user has the same folder
            data = library_for(self.name, self.source, compiler, flags, again=True)
            try:
                loaded = LoadedLaw(path=library_image(self.name, data))
            except (TissuError, OSError) as error:
                raise LawError(f"{self.name}: {error}") from None
        except OSError as error:
            raise LawError(f"{self.name}: the library cannot be loaded: {error}") from None
        return Build(loaded, compiler.version, " ".join(flags))

    def check(self, parameters: Mapping[str, float]) -> None:
        """Refuses parameters that give no material.

        Raises:
            ParameterError: a range, a condition on several, or no stiffness at rest.
        """
        values = np.array([parameters[name] for name in self.parameters])
        loaded = self.build().loaded
        loaded.compute(parameters=values)
        limit = loaded.small_strain(parameters=values)
        if limit is None:
            return
        lam, mu = limit
        bulk = lam + 2.0 / 3.0 * mu
        for words, modulus in (("shear", mu), ("bulk", bulk)):
            if not modulus > 0.0:
                raise ParameterError(
                    f"found a {words} modulus at rest of {modulus:.6g} Pa; parameters that give "
                    "one above 0 are accepted"
                )

    def record(self) -> dict[str, Any]:
        """What a summary needs to make the law again: `law_from_record` takes it."""
        build, law = self.build(), self.law
        return {
            "name": law.name,
            "formula": str(law.energy),
            "parameters": [asdict(p) for p in law.parameters],
            "constants": {name: str(e) for name, e in law.constants.items()},
            "requirements": [
                {"expression": str(r.expression), "field": r.field, "accepted": r.accepted}
                for r in law.requirements
            ],
            "frame_invariant": law.frame_invariant,
            "file": None if self.file is None else str(self.file),
            "digest": f"sha256:{self.digest}",
            "compiler": build.compiler,
            "flags": build.flags,
        }
