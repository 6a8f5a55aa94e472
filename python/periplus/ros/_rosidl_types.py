"""Types of message fields, with the class names of ``rosidl_parser.definition``."""

from __future__ import annotations

BASIC_TYPES = (
    "short", "unsigned short", "long", "unsigned long", "long long", "unsigned long long",
    "float", "double", "long double", "char", "wchar", "boolean", "octet",
    "int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64",
)  # fmt: skip


class AbstractType:
    """Base of all types. Types are equal if their classes and attributes are."""

    __slots__: tuple[str, ...] = ()

    def _values(self) -> tuple[object, ...]:
        return tuple(
            getattr(self, name) for cls in reversed(type(self).__mro__) for name in getattr(cls, "__slots__", ())
        )

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and self._values() == other._values()

    def __hash__(self) -> int:
        return hash((type(self), self._values()))


class AbstractNestableType(AbstractType):
    """Type that can be the element of an array."""

    __slots__ = ()


class BasicType(AbstractNestableType):
    """Number, ``boolean`` or ``octet``."""

    __slots__ = ("typename",)

    def __init__(self, typename: str) -> None:
        self.typename = typename


class NamedType(AbstractNestableType):
    """Type given by a name."""

    __slots__ = ("name",)

    def __init__(self, name: str) -> None:
        self.name = name


class NamespacedType(AbstractNestableType):
    """Message type, such as ``std_msgs/msg/Header``."""

    __slots__ = ("namespaces", "name")

    def __init__(self, namespaces: list[str], name: str) -> None:
        self.namespaces = list(namespaces)
        self.name = name

    def namespaced_name(self) -> tuple[str, ...]:
        """Namespaces and name."""
        return (*self.namespaces, self.name)

    def _values(self) -> tuple[object, ...]:
        return self.namespaced_name()


class AbstractGenericString(AbstractNestableType):
    """Base of all string types."""

    __slots__ = ()

    def has_maximum_size(self) -> bool:
        """True for a bounded string."""
        return False


class AbstractString(AbstractGenericString):
    """Base of the strings of 8-bit characters."""

    __slots__ = ()


class AbstractWString(AbstractGenericString):
    """Base of the strings of wide characters."""

    __slots__ = ()


class BoundedString(AbstractString):
    """String with a maximum length."""

    __slots__ = ("maximum_size",)

    def __init__(self, maximum_size: int) -> None:
        self.maximum_size = maximum_size

    def has_maximum_size(self) -> bool:
        return True


class UnboundedString(AbstractString):
    """String of any length."""

    __slots__ = ()


class BoundedWString(AbstractWString):
    """Wide string with a maximum length."""

    __slots__ = ("maximum_size",)

    def __init__(self, maximum_size: int) -> None:
        self.maximum_size = maximum_size

    def has_maximum_size(self) -> bool:
        return True


class UnboundedWString(AbstractWString):
    """Wide string of any length."""

    __slots__ = ()


class AbstractNestedType(AbstractType):
    """Base of arrays and sequences."""

    __slots__ = ("value_type",)

    def __init__(self, value_type: AbstractNestableType) -> None:
        self.value_type = value_type

    def has_maximum_size(self) -> bool:
        """True for an array and a bounded sequence."""
        return False


class Array(AbstractNestedType):
    """Array of a fixed length."""

    __slots__ = ("size",)

    def __init__(self, value_type: AbstractNestableType, size: int) -> None:
        super().__init__(value_type)
        self.size = size

    def has_maximum_size(self) -> bool:
        return True


class AbstractSequence(AbstractNestedType):
    """Base of the arrays of variable length."""

    __slots__ = ()


class BoundedSequence(AbstractSequence):
    """Array with a maximum length."""

    __slots__ = ("maximum_size",)

    def __init__(self, value_type: AbstractNestableType, maximum_size: int) -> None:
        super().__init__(value_type)
        self.maximum_size = maximum_size

    def has_maximum_size(self) -> bool:
        return True


class UnboundedSequence(AbstractSequence):
    """Array of any length."""

    __slots__ = ()


class FieldType:
    """Type of a field, read from its text, such as ``sequence<float>`` or ``string<22>[3]``."""

    __slots__ = ("element", "bound", "shape", "size", "text")

    element: str
    """``float``, ``string``, ``octet``, or the full name of a message type."""
    bound: int | None
    """Maximum length of a string."""
    shape: str
    """``one``, ``fixed``, ``bounded`` or ``unbounded``."""
    size: int
    """Length or maximum length of an array; 0 if it has none."""

    def __init__(self, text: str) -> None:
        self.shape, self.size, self.bound = "one", 0, None
        element = text
        if element.startswith("sequence<"):
            element = element[len("sequence<") : -1]
            head, comma, tail = element.rpartition(", ")
            if comma:
                element, self.shape, self.size = head, "bounded", int(tail)
            else:
                self.shape = "unbounded"
        elif element.endswith("]"):
            element, _, length = element[:-1].rpartition("[")
            self.shape, self.size = "fixed", int(length)
        if element.endswith(">"):
            element, _, bound = element[:-1].partition("<")
            self.bound = int(bound)
        if element.count("/") == 1:
            element = element.replace("/", "/msg/")
        self.element = element
        short = text.replace("/srv/", "/").replace("/action/", "/")
        self.text = short

    @property
    def is_message(self) -> bool:
        """True if the elements are messages."""
        return "/" in self.element

    def definition(self) -> AbstractType:
        """Type with the classes of ``rosidl_parser.definition``."""
        element: AbstractNestableType
        if "/" in self.element:
            *namespaces, name = self.element.split("/")
            element = NamespacedType(namespaces, name)
        elif self.element == "string":
            element = UnboundedString() if self.bound is None else BoundedString(self.bound)
        elif self.element == "wstring":
            element = UnboundedWString() if self.bound is None else BoundedWString(self.bound)
        else:
            element = BasicType(self.element)
        if self.shape == "fixed":
            return Array(element, self.size)
        if self.shape == "bounded":
            return BoundedSequence(element, self.size)
        return UnboundedSequence(element) if self.shape == "unbounded" else element
