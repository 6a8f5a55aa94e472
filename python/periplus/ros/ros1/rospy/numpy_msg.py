"""Message classes whose arrays of numbers are numpy arrays."""

from __future__ import annotations

from typing import Any

_DTYPES = {"float32": "f4", "float64": "f8", "char": "u1", "byte": "i1", "bool": "?"} | {
    f"{sign}int{bits}": f"{'u' if sign else 'i'}{bits // 8}" for sign in ("", "u") for bits in (8, 16, 32, 64)
}
_made: dict[Any, Any] = {}


def numpy_msg(msg_type: Any) -> Any:
    """Class like `msg_type`, with numpy arrays for the arrays of numbers.

    >>> rospy.Subscriber("floats", numpy_msg(Floats), callback)  # doctest: +SKIP
    """
    found = _made.get(msg_type)
    if found is None:
        names = msg_type.__slots__
        found = type(f"Numpy_{msg_type._type.replace('/', '__')}", (msg_type,), {"__slots__": ()})
        for name, type_text in zip(names, msg_type._slot_types, strict=True):
            base, bracket, _ = type_text.partition("[")
            if bracket and base in _DTYPES:
                setattr(found, name, _numpy_property(getattr(msg_type, name), _DTYPES[base]))
        found.__slots__ = names
        _made[msg_type] = found
    return found


def _numpy_property(inner: Any, dtype: str) -> property:
    import numpy as np

    def get(message: Any) -> Any:
        value = inner.__get__(message)
        if not isinstance(value, np.ndarray):
            value = np.frombuffer(value, dtype) if isinstance(value, (bytes, bytearray)) else np.array(value, dtype)
            inner.__set__(message, value)
            # A fixed array keeps a list; the numpy array is then made for each look.
        return value

    return property(get, inner.__set__)
