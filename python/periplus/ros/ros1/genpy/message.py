"""Base class of the messages of ROS 1 and the helpers around it."""

from __future__ import annotations

import io
from typing import Any, ClassVar

from genpy._codec import decode, encode
from genpy.rostime import Duration, Time, TVal


class MessageException(Exception):
    """Fault of a message."""


class SerializationError(MessageException):
    """A field has a value that does not fit its type."""


class DeserializationError(MessageException):
    """The bytes are not such a message."""


class _Md5:
    """Checksum of a definition, computed at the first use."""

    def __get__(self, message: object, cls: Any) -> str:
        from periplus.ros._genpy_types import md5sum

        value = md5sum(cls.__definition__) if getattr(cls, "__definition__", None) is not None else "*"
        cls._md5sum = value
        return value


class _FullText:
    """Text of a definition, computed at the first use."""

    def __get__(self, message: object, cls: Any) -> str:
        from periplus.ros._genpy_types import full_text

        value = full_text(cls.__definition__) if getattr(cls, "__definition__", None) is not None else ""
        cls._full_text = value
        return value


class Message:
    """Base of all messages. Fields are given all by position, or some by keyword."""

    __slots__: Any = ("_connection_header",)

    _type: ClassVar[str] = ""
    _slot_types: ClassVar[list[str]] = []
    _has_header: ClassVar[bool] = False
    __definition__: ClassVar[Any] = None
    __first_values__: ClassVar[tuple[tuple[str, Any], ...]] = ()
    _md5sum: ClassVar[Any] = _Md5()
    _full_text: ClassVar[Any] = _FullText()
    __type_handle__: ClassVar[Any] = None

    def __init__(self, *args: Any, **kwds: Any) -> None:
        for slot, make in self.__first_values__:
            setattr(self, slot, make())
        if args:
            names = type(self).__slots__
            if kwds:
                raise TypeError("Message constructor may only use args OR keywords, not both")
            if len(args) != len(names):
                raise TypeError(f"Invalid number of arguments, args should be {list(names)} args are{args}")
            for name, value in zip(names, args, strict=True):
                if value is not None:
                    setattr(self, name, value)
        elif kwds:
            names = type(self).__slots__
            for name, value in kwds.items():
                if name not in names:
                    raise AttributeError(f"{name} is not an attribute of {type(self).__name__}")
                if value is not None:
                    setattr(self, name, value)

    def _get_types(self) -> list[str]:
        return self._slot_types

    def _check_types(self, exc: Exception | None = None) -> None:
        """Raises `SerializationError` for the first field whose value does not fit."""
        for name, type_text in zip(type(self).__slots__, self._slot_types, strict=True):
            check_type(name, type_text, getattr(self, name))
        if exc is not None:
            raise SerializationError(str(exc))

    def serialize(self, buff: io.BytesIO) -> None:
        """Appends the message in the format of ROS 1."""
        buff.write(encode(self))

    def deserialize(self, data: bytes) -> Message:
        """Sets the fields from bytes in the format of ROS 1."""
        decode(self, data)
        return self

    def serialize_numpy(self, buff: io.BytesIO, numpy: Any) -> None:
        self.serialize(buff)

    def deserialize_numpy(self, data: bytes, numpy: Any) -> Message:
        return self.deserialize(data)

    def __getstate__(self) -> list[Any]:
        return [getattr(self, name) for name in type(self).__slots__]

    def __setstate__(self, state: list[Any]) -> None:
        for slot, make in self.__first_values__:
            setattr(self, slot, make())
        for name, value in zip(type(self).__slots__, state, strict=True):
            setattr(self, name, value)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, type(self)):
            return False
        return all(_equal(getattr(self, name), getattr(other, name)) for name in type(self).__slots__)

    __hash__ = None  # type: ignore[assignment]

    def __str__(self) -> str:
        return strify_message(self)

    __repr__ = __str__


def _equal(mine: Any, theirs: Any) -> bool:
    result = mine == theirs
    if hasattr(result, "all"):
        return bool(result.all())
    if not result and isinstance(mine, (list, tuple)) and isinstance(theirs, (list, tuple)):
        return list(mine) == list(theirs)
    return bool(result)


_INTEGERS = {
    "byte": (-128, 127),
    "char": (0, 255),
    **{f"int{bits}": (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) for bits in (8, 16, 32, 64)},
    **{f"uint{bits}": (0, 2**bits - 1) for bits in (8, 16, 32, 64)},
}


def check_type(field_name: str, field_type: str, field_val: Any) -> None:
    """Raises `SerializationError` if a value does not fit the type of a field, such as ``float64[36]``."""
    if field_type.endswith("]"):
        base, _, length = field_type[:-1].rpartition("[")
        if base in ("uint8", "char") and isinstance(field_val, (bytes, bytearray, memoryview)):
            count = len(field_val)
        elif isinstance(field_val, (str, TVal, Message)) or not hasattr(field_val, "__len__"):
            raise SerializationError(f"field {field_name} must be a list or tuple type")
        else:
            count = len(field_val)
            if count and not hasattr(field_val, "dtype"):
                for index, one in enumerate(field_val):
                    check_type(f"{field_name}[{index}]", base, one)
        if length and count != int(length):
            raise SerializationError(f"field {field_name} has {count} values, but {field_type} needs {length}")
    elif field_type in _INTEGERS:
        if not hasattr(field_val, "__index__"):
            raise SerializationError(f"field {field_name} must be an integer type ({field_type}), not {_kind(field_val)}")
        low, high = _INTEGERS[field_type]
        if not low <= int(field_val) <= high:
            raise SerializationError(f"field {field_name} exceeds specified width [{field_type}]")
    elif field_type in ("float32", "float64"):
        if isinstance(field_val, (str, bytes)) or not (hasattr(field_val, "__float__") or hasattr(field_val, "__index__")):
            raise SerializationError(f"field {field_name} must be float type, not {_kind(field_val)}")
    elif field_type == "string":
        if not isinstance(field_val, (str, bytes)):
            raise SerializationError(f"field {field_name} must be of type str, not {_kind(field_val)}")
    elif field_type == "bool":
        if field_val not in (True, False, 0, 1):
            raise SerializationError(f"field {field_name} is not a bool")
    elif field_type == "time":
        if not isinstance(field_val, Time):
            raise SerializationError(f"field {field_name} must be of type Time, not {_kind(field_val)}")
    elif field_type == "duration":
        if not isinstance(field_val, Duration):
            raise SerializationError(f"field {field_name} must be of type Duration, not {_kind(field_val)}")
    elif not isinstance(field_val, Message):
        raise SerializationError(f"field {field_name} must be a [{field_type}], not {_kind(field_val)}")
    else:
        for name, type_text in zip(type(field_val).__slots__, field_val._slot_types, strict=True):
            check_type(f"{field_name}.{name}", type_text, getattr(field_val, name))


def _kind(value: object) -> str:
    return type(value).__name__


def strify_message(
    val: Any,
    indent: str = "",
    time_offset: Any = None,
    current_time: Any = None,
    field_filter: Any = None,
    fixed_numeric_width: int | None = None,
    digits: int | None = None,
) -> str:
    """Text of a value in the YAML form in which ROS 1 prints messages."""
    if isinstance(val, TVal):
        return f"\n{indent}secs: {val.secs}\n{indent}nsecs: {val.nsecs:9d}"
    if isinstance(val, bool):
        return str(val)
    if isinstance(val, (int, float)):
        return str(round(val, digits)) if digits is not None and isinstance(val, float) else str(val)
    if isinstance(val, str):
        if not val:
            return "''"
        return f'"{val}"' if indent or "\n" in val else f'"{val}"'
    if isinstance(val, (bytes, bytearray)):
        return str(list(val))
    if isinstance(val, Message):
        names = type(val).__slots__
        if field_filter is not None:
            names = list(field_filter(val))
        deeper = indent + "  "
        lines = []
        for name in names:
            value = getattr(val, name)
            text = strify_message(value, deeper, digits=digits)
            lines.append(f"{indent}{name}: {text}")
        return ("\n" if indent else "") + "\n".join(lines)
    if hasattr(val, "tolist"):
        val = val.tolist()
    if isinstance(val, (list, tuple)):
        if not val:
            return "[]"
        if isinstance(val[0], (Message, TVal)):
            deeper = indent + "  "
            return "".join(f"\n{indent}- {strify_message(one, deeper, digits=digits)}" for one in val)
        return "[" + ", ".join(strify_message(one, digits=digits) for one in val) + "]"
    return str(val)


def get_printable_message_args(msg: Message, buff: Any = None, prefix: str = "") -> str:
    """Names of the fields of a message, separated by spaces."""
    return " ".join(f"{prefix}{name}" for name in type(msg).__slots__)


def get_message_class(message_type: str, reload_on_error: bool = False) -> type[Message] | None:
    """Class of a type such as ``std_msgs/String``, or None."""
    return _class_of(message_type, "msg")


def get_service_class(service_type: str, reload_on_error: bool = False) -> Any:
    """Class of a service such as ``std_srvs/Empty``, or None."""
    return _class_of(service_type, "srv")


def _class_of(type_name: str, kind: str) -> Any:
    import importlib

    package, _, name = type_name.partition("/")
    try:
        return getattr(importlib.import_module(f"{package}.{kind}"), name.rpartition("/")[2], None)
    except ModuleNotFoundError:
        return None


def fill_message_args(msg: Message, msg_args: Any, keys: dict[str, Any] | None = None) -> None:
    """Sets fields from a dict, or from a list with one value for each field, as `rostopic pub` takes them."""
    if isinstance(msg_args, (list, tuple)) and len(msg_args) == 1 and isinstance(msg_args[0], dict):
        msg_args = msg_args[0]
    _fill(msg, msg_args, "", keys or {})


def _fill(msg: Any, values: Any, where: str, keys: dict[str, Any]) -> None:
    names = list(type(msg).__slots__)
    if isinstance(values, dict):
        for name, value in values.items():
            if name not in names:
                raise MessageException(f"No field name [{where}{name}]")
            _fill_field(msg, name, value, where, keys)
        return
    if not isinstance(values, (list, tuple)):
        values = [values]
    if len(values) != len(names):
        few = "Not enough" if len(values) < len(names) else "Too many"
        at = f" (field {where[:-1]})" if where else ""
        raise MessageException(f"{few} arguments{at}:\n * Given: {list(values)}\n * Expected: {names}")
    for name, value in zip(names, values, strict=True):
        _fill_field(msg, name, value, where, keys)


def _fill_field(msg: Any, name: str, value: Any, where: str, keys: dict[str, Any]) -> None:
    from periplus.ros._genpy_types import element_class

    type_text = msg._slot_types[list(type(msg).__slots__).index(name)]
    current = getattr(msg, name)
    if isinstance(value, str) and value in keys:
        value = keys[value]
    if isinstance(current, TVal) and not isinstance(value, TVal):
        if isinstance(value, dict):
            current.set(value.get("secs", 0), value.get("nsecs", 0))
        elif isinstance(value, (list, tuple)):
            current.set(*value)
        else:
            setattr(msg, name, type(current)(value))
    elif isinstance(current, Message) and not isinstance(value, Message):
        _fill(current, value, f"{where}{name}.", keys)
    elif type_text.endswith("]") and (cls := element_class(type_text)) is not None:
        made = []
        for index, one in enumerate(value):
            if not isinstance(one, (Message, TVal)):
                element = cls()
                if isinstance(element, TVal):
                    one = cls(**one) if isinstance(one, dict) else cls(one)
                else:
                    _fill(element, one, f"{where}{name}[{index}].", keys)
                    one = element
            made.append(one)
        setattr(msg, name, made)
    else:
        setattr(msg, name, value)
