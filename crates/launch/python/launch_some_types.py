"""Names for type hints."""
from typing import Any

SomeSubstitutionsType = Any
SomeEntitiesType = Any
SomeActionsType = Any
SomeSubstitutionsType_types_tuple = (str, list)

__all__ = ["SomeSubstitutionsType", "SomeEntitiesType", "SomeActionsType"]
