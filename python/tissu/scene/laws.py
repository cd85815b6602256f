"""How a scene names a law: the library's, one's own, or a map from regions to laws."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Annotated, Any

from pydantic import PlainValidator, TypeAdapter, ValidationInfo

from tissu.errors import ParameterError
from tissu.reading import Read
from tissu.scene.generated.laws import LAWS
from tissu.scene.law import Law, UserLaw
from tissu.scene.part import chosen, keeps_problems, type_name
from tissu.scene.problem import Problem
from tissu.scene.unknown import Unread


def built_in_names() -> list[str]:
    """The types of the library's own laws, and of what is added to them."""
    return [*(type_name(cls) for cls in LAWS), "fibre"]


def _one_law(value: Any, info: ValidationInfo) -> Any:
    """A law: in Python by class; in YAML by its `type`, one's own too where the scene has them."""
    if isinstance(value, UserLaw):
        return value
    context = info.context if isinstance(info.context, dict) else {}
    try:
        return chosen(value, (*LAWS, *context.get("laws", ())), info)
    except ParameterError as error:
        if not keeps_problems(info):
            raise
        if context.get("laws_refused") and isinstance(value, Mapping) and "type" in value:
            return Unread()  # it may be of a file whose fault is reported already
        return Unread((Problem((), str(error)),))


OneLaw = Annotated[Law, PlainValidator(_one_law)]


@lru_cache(maxsize=1)
def _region_laws() -> TypeAdapter[dict[str, Law]]:
    return TypeAdapter(dict[str, OneLaw])


def _law_or_map(value: Any, info: ValidationInfo) -> Any:
    """A law, or a map from the mesh's regions to laws."""
    if not isinstance(value, Mapping) or "type" in value:
        return _one_law(value, info)
    if not value or not all(isinstance(p, (Mapping, *LAWS, UserLaw)) for p in value.values()):
        return _one_law(value, info)  # says that `type` is missing
    laws = {str(name): law for name, law in value.items()}  # YAML reads a region 7 as a number
    return _region_laws().validate_python(laws, context=info.context)


_Laws = Read[Law | dict[str, Law], Law | Mapping[str, Law]]
LawOrMap = Annotated[_Laws, PlainValidator(_law_or_map)]
