"""Setters, default values and checks of the fields of rosidl-style messages."""

from __future__ import annotations

from array import array
from collections.abc import Callable
from typing import Any

from periplus.ros._rosidl_types import FieldType

TYPECODES = {
    "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I",
    "int64": "q", "uint64": "Q", "float": "f", "double": "d",
}  # fmt: skip

DTYPES = {
    "int8": "int8", "uint8": "uint8", "int16": "int16", "uint16": "uint16", "int32": "int32", "uint32": "uint32",
    "int64": "int64", "uint64": "uint64", "float": "float32", "double": "float64",
}  # fmt: skip

ZEROS: dict[str, Any] = {
    "float": 0.0, "double": 0.0, "boolean": False, "octet": b"\x00", "string": "", "wstring": "",
}  # fmt: skip

Setter = Callable[[Any, Any], None]

_FLOAT_MAX = 3.402823466e38


def to_array(typecode: str, value: Any) -> array[Any]:
    """Copy of the values as an ``array.array``; fast for numpy arrays and buffers of the same type."""
    kind = type(value)
    if kind is list or kind is tuple or kind is array or kind is bytes:
        return array(typecode, value)
    dtype = getattr(value, "dtype", None)
    if dtype is not None and getattr(value, "ndim", 0) == 1:
        is_float = typecode in "fd"
        if dtype.char == typecode or (dtype.kind == typecode.replace("d", "f") and is_float) or _same(dtype, typecode):
            made = array(typecode)
            if len(value):
                import numpy as np

                made.frombytes(np.ascontiguousarray(value, typecode).data.cast("B"))
            return made
    elif kind is memoryview and value.format == typecode and value.contiguous and value.nbytes:
        made = array(typecode)
        made.frombytes(value.cast("B"))
        return made
    return array(typecode, value)


def _same(dtype: Any, typecode: str) -> bool:
    """True for two integer types of the same size and sign, such as ``l`` and ``q``."""
    kind = "i" if typecode.islower() else "u"
    return bool(dtype.kind == kind and dtype.itemsize == array(typecode).itemsize and typecode not in "fd")


def converts(field: FieldType) -> bool:
    """True if the setter of a field converts values: arrays of numbers."""
    return field.shape != "one" and field.element in TYPECODES


def converter(field: FieldType, name: str) -> Callable[[Any], Any]:
    """Conversion of the values given to an array of numbers; `name` is the field in errors."""
    convert: Callable[[Any], Any]
    if field.shape == "fixed":
        import numpy as np

        dtype = np.dtype(DTYPES[field.element])
        make = np.array
        convert = lambda value: make(value, dtype=dtype)  # noqa: E731
    else:
        typecode = TYPECODES[field.element]
        convert = lambda value: to_array(typecode, value)  # noqa: E731

    def converted(value: Any) -> Any:
        try:
            return convert(value)
        except (TypeError, OverflowError, ValueError) as error:
            kind = next(one for one in (TypeError, OverflowError, ValueError) if isinstance(error, one))
            raise kind(f"{name} of type {field.text}: {error}{_wrong_values(convert, value)}") from None

    return converted


def _wrong_values(convert: Callable[[Any], Any], value: Any) -> str:
    """The values that cannot be converted, for an error: an array by its type and shape, a list by its first wrong item."""
    dtype, shape = getattr(value, "dtype", None), getattr(value, "shape", None)
    if dtype is not None and shape is not None:
        remedy = "; ravel() makes it flat, astype() changes its type"
        return f" (the value is a numpy array of {dtype} with shape {shape}{remedy})"
    if isinstance(value, (list, tuple)):
        for index, item in enumerate(value):
            try:
                convert([item])
            except (TypeError, OverflowError, ValueError):
                return f" (item {index} is {item!r:.60})"
    return ""


def unchecked_setter(slot: Setter, field: FieldType, name: str) -> Setter:
    """Setter of an array of numbers; `name` is the field in errors."""
    convert = converter(field, name)
    return lambda message, value: slot(message, convert(value))


def zero(field: FieldType, nested: Callable[[str], type]) -> tuple[str, dict[str, Any]]:
    """Expression of the default value without a default in the definition, and the names that it uses."""
    if field.shape == "one":
        if field.is_message:
            return "{name}()", {"{name}": nested(field.element)}
        return repr(ZEROS.get(field.element, 0)), {}
    if field.element in TYPECODES:
        if field.shape == "fixed":
            import numpy as np

            template = np.zeros(field.size, DTYPES[field.element])
            return "{name}()", {"{name}": template.copy}
        return f"_array({TYPECODES[field.element]!r})", {}
    if field.shape != "fixed":
        return "[]", {}
    if field.is_message:
        return f"[{{name}}() for _ in range({field.size})]", {"{name}": nested(field.element)}
    return f"[{ZEROS.get(field.element, 0)!r}] * {field.size}", {}


def given_default(field: FieldType, value: Any) -> tuple[str, dict[str, Any]]:
    """Expression of a default value of the definition, and the names that it uses."""
    if field.shape == "one":
        return repr(value), {}
    if field.element in TYPECODES:
        if field.shape == "fixed":
            import numpy as np

            return "{name}()", {"{name}": np.array(value, DTYPES[field.element]).copy}
        return f"_array({TYPECODES[field.element]!r}, {list(value)!r})", {}
    if field.element == "octet":
        value = [bytes([one]) if isinstance(one, int) else one for one in value]
    return repr(list(value)), {}


# ---- checks, with ROS_PYTHON_CHECK_FIELDS=1


def _integer_range(element: str) -> tuple[int, int]:
    bits = int(element.lstrip("uint"))
    return (0, 2**bits - 1) if element[0] == "u" else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)


def _fits_float(value: float, element: str) -> bool:
    if element == "double" or value != value or value in (float("inf"), float("-inf")):
        return True
    return -_FLOAT_MAX <= value <= _FLOAT_MAX


def _check_one(name: str, field: FieldType, value: Any, nested: Callable[[str], type]) -> None:
    element = field.element
    if field.is_message:
        label = element.rpartition("/")[2]
        assert isinstance(value, nested(element)), f"The '{name}' field must be a sub message of type '{label}'"
    elif element in ("string", "wstring"):
        if field.bound is None:
            assert isinstance(value, str), f"The '{name}' field must be of type 'str'"
        else:
            text = f"The '{name}' field must be string value not longer than {field.bound}"
            assert isinstance(value, str) and len(value) <= field.bound, text
    elif element == "octet":
        text = f"The '{name}' field must be of type 'bytes' or 'ByteString' with length 1"
        assert isinstance(value, (bytes, bytearray)) and len(value) == 1, text
    elif element == "boolean":
        assert isinstance(value, bool), f"The '{name}' field must be of type 'bool'"
    elif element in ("float", "double"):
        assert isinstance(value, float), f"The '{name}' field must be of type 'float'"
        low_high = f"[-{_FLOAT_MAX!r}, {_FLOAT_MAX!r}]"
        assert _fits_float(value, element), f"The '{name}' field must be a {element} in {low_high}"
    else:
        assert isinstance(value, int), f"The '{name}' field must be of type 'int'"
        low, high = _integer_range(element)
        article = "an unsigned" if element[0] == "u" else "an"
        assert low <= value <= high, f"The '{name}' field must be {article} integer in [{low}, {high}]"


def _array_text(name: str, field: FieldType, label: str) -> str:
    length = {"fixed": f" with length {field.size}", "bounded": f" with length <= {field.size}"}.get(field.shape, "")
    text = f"The '{name}' field must be a set or sequence{length} and each value of type '{label}'"
    element = field.element
    if element in ("float", "double"):
        high = 3.402823466e38 if element == "float" else 1.7976931348623157e308
        text += f" and each {element} in [-{high:f}, {high:f}]"
    elif element in TYPECODES:
        low, last = _integer_range(element)
        text += f" and each {'unsigned ' if element[0] == 'u' else ''}integer in [{low}, {last}]"
    return text


_PYTHON_TYPES: dict[str, type] = {
    "float": float, "double": float, "boolean": bool, "octet": bytes, "string": str, "wstring": str,
}  # fmt: skip


def _check_array(name: str, field: FieldType, value: Any, nested: Callable[[str], type]) -> None:
    from collections import UserString
    from collections.abc import Sequence, Set

    element = field.element
    kind = nested(element) if field.is_message else _PYTHON_TYPES.get(element, int)
    fits = (
        isinstance(value, (Sequence, Set, array))
        and not isinstance(value, (str, UserString))
        and (field.shape != "fixed" or len(value) == field.size)
        and (field.shape != "bounded" or len(value) <= field.size)
        and all(isinstance(one, kind) for one in value)
    )
    if fits and element in TYPECODES:
        if kind is float:
            fits = all(_fits_float(one, element) for one in value)
        else:
            low, high = _integer_range(element)
            fits = all(low <= one <= high for one in value)
    assert fits, _array_text(name, field, kind.__name__)


def checked_setter(name: str, slot: Setter, field: FieldType, nested: Callable[[str], type]) -> Setter:
    """Setter that checks values, with the texts of rosidl."""

    def set_one(message: Any, value: Any) -> None:
        _check_one(name, field, value, nested)
        slot(message, value)

    def set_list(message: Any, value: Any) -> None:
        _check_array(name, field, value, nested)
        slot(message, value)

    def set_sequence(message: Any, value: Any) -> None:
        if isinstance(value, array):
            assert value.typecode == typecode, f"The '{name}' array.array() must have the type code of '{typecode}'"
            if field.shape == "bounded":
                assert len(value) <= field.size, f"The '{name}' array.array() must have a size <= {field.size}"
            slot(message, value)
            return
        _check_array(name, field, value, nested)
        slot(message, array(typecode, value))

    def set_fixed(message: Any, value: Any) -> None:
        import numpy as np

        dtype = DTYPES[field.element]
        if isinstance(value, np.ndarray):
            assert value.dtype == dtype, f"The '{name}' numpy.ndarray() must have the dtype of 'numpy.{dtype}'"
            assert value.size == field.size, f"The '{name}' numpy.ndarray() must have a size of {field.size}"
            slot(message, value)
            return
        _check_array(name, field, value, nested)
        slot(message, np.array(value, dtype=dtype))

    if field.shape == "one":
        return set_one
    if field.element not in TYPECODES:
        return set_list
    typecode = TYPECODES[field.element]
    return set_fixed if field.shape == "fixed" else set_sequence
