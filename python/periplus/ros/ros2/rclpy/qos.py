"""Quality of service: profiles, policies, compatibility."""

from __future__ import annotations

from enum import Enum, IntEnum
from typing import Any

from rclpy._rclpy_pybind11 import QoSCompatibility
from rclpy._warnings import warn
from rclpy.duration import DeadlineBestAvailable, Duration, LivelinessLeaseDurationeBestAvailable


class QoSPolicyKind(IntEnum):
    """Kind of a policy."""

    INVALID = 1
    DURABILITY = 2
    DEADLINE = 4
    LIVELINESS = 8
    RELIABILITY = 16
    HISTORY = 32
    LIFESPAN = 64
    DEPTH = 128
    LIVELINESS_LEASE_DURATION = 256
    AVOID_ROS_NAMESPACE_CONVENTIONS = 512


def qos_policy_name_from_kind(policy_kind: QoSPolicyKind | int) -> str:
    """Name of a kind of policy."""
    return QoSPolicyKind(policy_kind).name


class InvalidQoSProfileException(Exception):
    """Profile without a history or a depth."""

    def __init__(self, *args: object) -> None:
        super().__init__("Invalid QoSProfile", *args)


class _DeprecatedAlias:
    """Old name of a value, which warns when it is read."""

    def __init__(self, name: str, old_name: str) -> None:
        self._name = name
        self._old_name = old_name

    def __get__(self, instance: object, owner: Any) -> Any:
        warn(f"{owner.__name__}.{self._old_name} is deprecated. Use {owner.__name__}.{self._name} instead.")
        return owner[self._name]


class QoSPolicyEnum(IntEnum):
    """Base of the values of policies."""

    @classmethod
    def short_keys(cls) -> list[str]:
        """Names of the values in lower case."""
        return [name.lower() for name in cls.__members__ if not name.startswith("RMW")]

    @classmethod
    def get_from_short_key(cls, name: str) -> Any:
        """Number of the value with a name in lower case."""
        return cls[name.upper()].value

    @property
    def short_key(self) -> str:
        """The name in lower case."""
        return self.name.lower()


class HistoryPolicy(QoSPolicyEnum):
    """Rule for the messages that are kept."""

    SYSTEM_DEFAULT = 0
    KEEP_LAST = 1
    KEEP_ALL = 2
    UNKNOWN = 3


class ReliabilityPolicy(QoSPolicyEnum):
    """Delivery: lost messages are resent (RELIABLE) or not (BEST_EFFORT)."""

    SYSTEM_DEFAULT = 0
    RELIABLE = 1
    BEST_EFFORT = 2
    UNKNOWN = 3
    BEST_AVAILABLE = 4


class DurabilityPolicy(QoSPolicyEnum):
    """Storage of messages for subscriptions that come later."""

    SYSTEM_DEFAULT = 0
    TRANSIENT_LOCAL = 1
    VOLATILE = 2
    UNKNOWN = 3
    BEST_AVAILABLE = 4


class LivelinessPolicy(QoSPolicyEnum):
    """Signs of life of a publisher."""

    SYSTEM_DEFAULT = 0
    AUTOMATIC = 1
    MANUAL_BY_TOPIC = 3
    UNKNOWN = 4
    BEST_AVAILABLE = 5


QoSHistoryPolicy = HistoryPolicy
QoSReliabilityPolicy = ReliabilityPolicy
QoSDurabilityPolicy = DurabilityPolicy
QoSLivelinessPolicy = LivelinessPolicy

for _enum, _prefix in (
    (HistoryPolicy, "RMW_QOS_POLICY_HISTORY_"),
    (ReliabilityPolicy, "RMW_QOS_POLICY_RELIABILITY_"),
    (DurabilityPolicy, "RMW_QOS_POLICY_DURABILITY_"),
    (LivelinessPolicy, "RMW_QOS_POLICY_LIVELINESS_"),
):
    for _name in _enum.__members__:
        if _name != "BEST_AVAILABLE":
            type.__setattr__(_enum, _prefix + _name, _DeprecatedAlias(_name, _prefix + _name))


def _expected(policy: str, kind: type, value: object) -> str:
    """Text for a value of the wrong type."""
    names = ""
    if issubclass(kind, IntEnum):
        names = ": " + ", ".join(f"{kind.__name__}.{name}" for name, one in kind.__members__.items() if name == one.name)
    return f"{policy} must be a {kind.__name__}, not {value!r}{names}"


class QoSProfile:
    """Policies of a publisher, a subscription, a client or a service.

    Keywords: `history`, `depth`, `reliability`, `durability`, `lifespan`, `deadline`, `liveliness`,
    `liveliness_lease_duration`, `avoid_ros_namespace_conventions`. `depth` or `history` is needed.
    """

    __slots__ = [
        "_history",
        "_depth",
        "_reliability",
        "_durability",
        "_lifespan",
        "_deadline",
        "_liveliness",
        "_liveliness_lease_duration",
        "_avoid_ros_namespace_conventions",
    ]
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, **kwargs: Any) -> None:
        unknown = ", ".join(name for name in kwargs if "_" + name not in self.__slots__)
        assert not unknown, f"Invalid arguments passed to constructor: {unknown}"
        if "history" not in kwargs:
            if "depth" not in kwargs:
                raise InvalidQoSProfileException("History and/or depth settings are required.")
            kwargs["history"] = HistoryPolicy.KEEP_LAST
        self.history = kwargs["history"]
        if self._history == HistoryPolicy.KEEP_LAST:
            if "depth" not in kwargs:
                raise InvalidQoSProfileException("History set to KEEP_LAST without a depth setting.")
            if kwargs["depth"] == 0:
                warn(
                    "A zero depth with KEEP_LAST doesn't make sense; no data could be stored. "
                    "This will be interpreted as SYSTEM_DEFAULT"
                )
        self.depth = kwargs.get("depth", 10)
        self.reliability = kwargs.get("reliability", ReliabilityPolicy.RELIABLE)
        self.durability = kwargs.get("durability", DurabilityPolicy.VOLATILE)
        self.lifespan = kwargs.get("lifespan", Duration())
        self.deadline = kwargs.get("deadline", Duration())
        self.liveliness = kwargs.get("liveliness", LivelinessPolicy.SYSTEM_DEFAULT)
        self.liveliness_lease_duration = kwargs.get("liveliness_lease_duration", Duration())
        self.avoid_ros_namespace_conventions = kwargs.get("avoid_ros_namespace_conventions", False)

    @property
    def history(self) -> HistoryPolicy:
        """Rule for the messages that are kept."""
        return self._history

    @history.setter
    def history(self, value: int) -> None:
        assert isinstance(value, int), _expected("history", HistoryPolicy, value)
        self._history = HistoryPolicy(value)

    @property
    def reliability(self) -> ReliabilityPolicy:
        """Delivery: lost messages are resent (RELIABLE) or not (BEST_EFFORT)."""
        return self._reliability

    @reliability.setter
    def reliability(self, value: int) -> None:
        assert isinstance(value, int), _expected("reliability", ReliabilityPolicy, value)
        self._reliability = ReliabilityPolicy(value)

    @property
    def durability(self) -> DurabilityPolicy:
        """Storage of messages for subscriptions that come later."""
        return self._durability

    @durability.setter
    def durability(self, value: int) -> None:
        assert isinstance(value, int), _expected("durability", DurabilityPolicy, value)
        self._durability = DurabilityPolicy(value)

    @property
    def depth(self) -> int:
        """Number of messages that are kept."""
        return self._depth

    @depth.setter
    def depth(self, value: int) -> None:
        assert isinstance(value, int), _expected("depth", int, value)
        self._depth = value

    @property
    def lifespan(self) -> Duration:
        """Age after which messages are dropped."""
        return self._lifespan

    @lifespan.setter
    def lifespan(self, value: Duration) -> None:
        assert isinstance(value, Duration), _expected("lifespan", Duration, value)
        self._lifespan = value

    @property
    def deadline(self) -> Duration:
        """Longest time between two messages."""
        return self._deadline

    @deadline.setter
    def deadline(self, value: Duration) -> None:
        assert isinstance(value, Duration), _expected("deadline", Duration, value)
        self._deadline = value

    @property
    def liveliness(self) -> LivelinessPolicy:
        """Signs of life of a publisher."""
        return self._liveliness

    @liveliness.setter
    def liveliness(self, value: int) -> None:
        assert isinstance(value, int), _expected("liveliness", LivelinessPolicy, value)
        self._liveliness = LivelinessPolicy(value)

    @property
    def liveliness_lease_duration(self) -> Duration:
        """Time after which a silent publisher counts as dead."""
        return self._liveliness_lease_duration

    @liveliness_lease_duration.setter
    def liveliness_lease_duration(self, value: Duration) -> None:
        assert isinstance(value, Duration), _expected("liveliness_lease_duration", Duration, value)
        self._liveliness_lease_duration = value

    @property
    def avoid_ros_namespace_conventions(self) -> bool:
        """True for the plain topic names of DDS."""
        return self._avoid_ros_namespace_conventions

    @avoid_ros_namespace_conventions.setter
    def avoid_ros_namespace_conventions(self, value: bool) -> None:
        assert isinstance(value, bool)
        self._avoid_ros_namespace_conventions = value

    def get_c_qos_profile(self) -> QoSProfile:
        """The profile itself: there is no other representation."""
        return self

    def to_dict(self) -> dict[str, Any]:
        """The policies by name, as numbers and durations."""
        values = ((name[1:], getattr(self, name)) for name in self.__slots__)
        return {name: int(value) if isinstance(value, IntEnum) else value for name, value in values}

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, QoSProfile):
            return False
        return all(getattr(self, name) == getattr(other, name) for name in self.__slots__)

    def __str__(self) -> str:
        values = ", ".join(
            f"{name[1:]}={int(value) if isinstance(value, IntEnum) else value}"
            for name, value in ((name, getattr(self, name)) for name in self.__slots__)
        )
        return f"{type(self).__name__}({values})"

    # ---- native form

    def _to_native(self) -> tuple[Any, ...]:
        """The tuple that the native core takes."""
        depth = max(int(self._depth), 0)
        history = "keep_last" if self._history == HistoryPolicy.UNKNOWN else self._history.short_key
        if history == "keep_last" and depth == 0:
            history = "system_default"
        return (
            history,
            depth,
            _native_name(self._reliability),
            _native_name(self._durability),
            _native_ns(self._deadline),
            _native_ns(self._lifespan),
            _native_name(self._liveliness),
            _native_ns(self._liveliness_lease_duration),
        )

    @classmethod
    def _from_native(cls, qos: tuple[Any, ...]) -> QoSProfile:
        """Profile of a native tuple."""
        history, depth, reliability, durability, deadline, lifespan, liveliness, lease = qos
        infinite = Duration(nanoseconds=2**63 - 1)

        def duration(value: int | None) -> Duration:
            return infinite if value is None else Duration(nanoseconds=min(value, 2**63 - 1))

        made = cls(
            history=HistoryPolicy.__members__.get(history.upper(), HistoryPolicy.UNKNOWN),
            depth=depth or 1,
            reliability=ReliabilityPolicy[reliability.upper()],
            durability=DurabilityPolicy[durability.upper()],
            deadline=duration(deadline),
            lifespan=duration(lifespan),
            liveliness=LivelinessPolicy[liveliness.upper()],
            liveliness_lease_duration=duration(lease),
        )
        made._depth = depth or 0
        return made


def _native_name(value: QoSPolicyEnum) -> str:
    return "system_default" if value.name == "UNKNOWN" else value.short_key


def _native_ns(value: Duration) -> int | None:
    nanoseconds = value.nanoseconds
    return None if nanoseconds <= 0 or nanoseconds >= 2**63 - 2 else nanoseconds


# ---- presets

qos_profile_unknown = QoSProfile(
    history=HistoryPolicy.UNKNOWN,
    depth=0,
    reliability=ReliabilityPolicy.UNKNOWN,
    durability=DurabilityPolicy.UNKNOWN,
    liveliness=LivelinessPolicy.UNKNOWN,
)
qos_profile_default = QoSProfile(depth=10)
qos_profile_system_default = QoSProfile(
    history=HistoryPolicy.SYSTEM_DEFAULT,
    depth=0,
    reliability=ReliabilityPolicy.SYSTEM_DEFAULT,
    durability=DurabilityPolicy.SYSTEM_DEFAULT,
)
qos_profile_sensor_data = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
qos_profile_services_default = QoSProfile(depth=10)
qos_profile_parameters = QoSProfile(depth=1000)
qos_profile_parameter_events = QoSProfile(depth=1000)
qos_profile_action_status_default = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
qos_profile_best_available = QoSProfile(
    depth=10,
    reliability=ReliabilityPolicy.BEST_AVAILABLE,
    durability=DurabilityPolicy.BEST_AVAILABLE,
    deadline=DeadlineBestAvailable,
    liveliness=LivelinessPolicy.BEST_AVAILABLE,
    liveliness_lease_duration=LivelinessLeaseDurationeBestAvailable,
)


class QoSPresetProfiles(Enum):
    """Profiles by name."""

    UNKNOWN = qos_profile_unknown
    DEFAULT = qos_profile_default
    SYSTEM_DEFAULT = qos_profile_system_default
    SENSOR_DATA = qos_profile_sensor_data
    SERVICES_DEFAULT = qos_profile_services_default
    PARAMETERS = qos_profile_parameters
    PARAMETER_EVENTS = qos_profile_parameter_events
    ACTION_STATUS_DEFAULT = qos_profile_action_status_default
    BEST_AVAILABLE = qos_profile_best_available

    @classmethod
    def short_keys(cls) -> list[str]:
        """Names of the profiles in lower case."""
        return [name.lower() for name in cls.__members__]

    @classmethod
    def get_from_short_key(cls, name: str) -> Any:
        """Profile with a name in lower case."""
        return cls[name.upper()].value


def qos_check_compatible(
    publisher_qos: QoSProfile, subscription_qos: QoSProfile
) -> tuple[QoSCompatibility, str]:
    """Outcome and reasons of a connection between a publisher and a subscription with these profiles.

    The outcome is a warning where it depends on values that are left to the system.
    """
    from rclpy._qos_compatibility import check

    return check(publisher_qos, subscription_qos)
