"""Conversion between structured and plain numpy arrays."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.lib.recfunctions import structured_to_unstructured as structured_to_unstructured
from numpy.lib.recfunctions import unstructured_to_structured as _unstructured_to_structured


def unstructured_to_structured(
    arr: Any,
    dtype: Any = None,
    names: Any = None,
    align: bool = False,
    copy: bool = False,
    casting: Any = "unsafe",
) -> Any:
    """Structured array of a plain one: the last axis becomes the fields."""
    if isinstance(dtype, np.dtype) and dtype.names is not None:
        values = np.asarray(arr)
        if values.shape[-1] != len(dtype.names):
            raise ValueError("The length of the last dimension of arr must be equal to the number of fields in dtype")
        made = np.zeros(values.shape[:-1], dtype)
        for index, name in enumerate(dtype.names):
            made[name] = values[..., index].astype(dtype[name], casting=casting)
        return made
    return _unstructured_to_structured(arr, dtype, names, align, copy, casting)
