"""Tables of pandas and polars, made of columns of numpy."""

from __future__ import annotations

from typing import Any

import numpy as np


def require_pandas() -> None:
    """Fail early if pandas is not installed."""
    try:
        import pandas  # type: ignore[import-untyped, unused-ignore]  # noqa: F401
    except ImportError as error:
        raise ImportError("to_pandas needs the package pandas: pip install pandas") from error


def require_polars() -> None:
    """Fail early if polars is not installed."""
    try:
        import polars  # noqa: F401
    except ImportError as error:
        raise ImportError("to_polars needs the package polars: pip install polars") from error


def to_pandas(columns: dict[str, Any]) -> Any:
    """DataFrame of pandas. An array for each message becomes one object."""
    import pandas  # type: ignore[import-untyped, unused-ignore]

    return pandas.DataFrame(
        {name: list(column) if column.ndim > 1 else column for name, column in columns.items()}
    )


def to_polars(columns: dict[str, Any]) -> Any:
    """DataFrame of polars. An array for each message becomes one value of the type Array or List."""
    import polars

    def series(name: str, column: Any) -> Any:
        if column.dtype != np.object_:
            return polars.Series(name, column)
        values = [one.tolist() if isinstance(one, np.ndarray) else one for one in column]
        return polars.Series(name, values)

    return polars.DataFrame([series(name, column) for name, column in columns.items()])
