"""States, user data and containers."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from typing import Any, ClassVar

from smach._log import logerr, logwarn


class InvalidStateError(Exception):
    """A state that does not fit."""


class InvalidTransitionError(Exception):
    """An outcome without a transition, or a transition to nowhere."""


class InvalidConstructionError(Exception):
    """A container that cannot be built like this."""


class InvalidUserCodeError(Exception):
    """Code of a state has raised an exception."""


def has_smach_interface(obj: Any) -> bool:
    """True for an object that has the methods of a state."""
    names = ("execute", "request_preempt", "get_registered_outcomes", "get_registered_input_keys")
    return all(hasattr(obj, name) for name in names)


class UserData:
    """Values that states share, as attributes or by `[]`."""

    def __init__(self) -> None:
        object.__setattr__(self, "_data", {})
        object.__setattr__(self, "_lock", threading.RLock())

    def update(self, ud: UserData) -> None:
        self._data.update(ud._data)

    def extract(self, keys: Iterable[str], remapping: dict[str, str]) -> UserData:
        """Values of some keys, under the names of the caller."""
        made = UserData()
        for key in keys:
            made[remapping.get(key, key)] = self[key]
        return made

    def merge(self, ud: UserData, keys: Iterable[str], remapping: dict[str, str]) -> None:
        """Takes values of some keys from others."""
        for key in keys:
            self[key] = ud[remapping.get(key, key)]

    def keys(self) -> list[str]:
        return list(self._data)

    def __contains__(self, key: str) -> bool:
        return key in self._data

    def __getitem__(self, key: str) -> Any:
        return self.__getattr__(key)

    def __setitem__(self, key: str, item: Any) -> None:
        self.__setattr__(key, item)

    def __getattr__(self, name: str) -> Any:
        try:
            return object.__getattribute__(self, "_data")[name]
        except KeyError:
            raise KeyError(f"User data has no key {name!r}. Available keys are: {sorted(self._data)}") from None

    def __setattr__(self, name: str, value: Any) -> None:
        self._data[name] = value


class Remapper:
    """The user data as one state sees it: its own keys, under its own names."""

    def __init__(
        self,
        ud: Any,
        input_keys: Iterable[str] = (),
        output_keys: Iterable[str] = (),
        remapping: dict[str, str] | None = None,
    ) -> None:
        object.__setattr__(self, "_ud", ud)
        object.__setattr__(self, "_input_keys", set(input_keys))
        object.__setattr__(self, "_output_keys", set(output_keys))
        object.__setattr__(self, "_map", dict(remapping or {}))

    def _real(self, key: str) -> str:
        return str(self._map.get(key, key))

    def __getitem__(self, key: str) -> Any:
        if key not in self._input_keys:
            raise InvalidUserCodeError(
                f"Reading from SMACH userdata key {key!r} but the only keys that were declared as input to this state "
                f"were: {sorted(self._input_keys)}. This key needs to be declaread as input to this state. "
            )
        return self._ud[self._real(key)]

    def __setitem__(self, key: str, value: Any) -> None:
        if key not in self._output_keys:
            raise InvalidUserCodeError(
                f"Writing to SMACH userdata key {key!r} but the only keys that were declared as output from this state "
                f"were: {sorted(self._output_keys)}."
            )
        self._ud[self._real(key)] = value

    def __getattr__(self, name: str) -> Any:
        return self[name]

    def __setattr__(self, name: str, value: Any) -> None:
        self[name] = value

    def __contains__(self, key: str) -> bool:
        return key in self._input_keys and self._real(key) in self._ud

    def keys(self) -> list[str]:
        return [key for key in sorted(self._input_keys) if self._real(key) in self._ud]

    def update(self, ud: Any) -> None:
        for key in ud.keys():
            self[key] = ud[key]


class State:
    """A state: `execute(userdata)` returns one of its outcomes.

    Args:
        outcomes: Names of the outcomes.
        input_keys: Keys of the user data that the state reads.
        output_keys: Keys that it writes.
        io_keys: Keys that it reads and writes.
    """

    def __init__(
        self,
        outcomes: Iterable[str] = (),
        input_keys: Iterable[str] = (),
        output_keys: Iterable[str] = (),
        io_keys: Iterable[str] = (),
    ) -> None:
        self._outcomes = set(outcomes)
        self._input_keys = set(input_keys) | set(io_keys)
        self._output_keys = set(output_keys) | set(io_keys)
        self._preempt_requested = False
        self.userdata: Any = None

    def execute(self, ud: Any) -> Any:
        """Does the work of the state."""
        raise NotImplementedError

    def register_outcomes(self, new_outcomes: Iterable[str]) -> None:
        self._outcomes |= set(new_outcomes)

    def get_registered_outcomes(self) -> tuple[str, ...]:
        return tuple(self._outcomes)

    def register_io_keys(self, keys: Iterable[str]) -> None:
        self._input_keys |= set(keys)
        self._output_keys |= set(keys)

    def register_input_keys(self, keys: Iterable[str]) -> None:
        self._input_keys |= set(keys)

    def get_registered_input_keys(self) -> tuple[str, ...]:
        return tuple(self._input_keys)

    def register_output_keys(self, keys: Iterable[str]) -> None:
        self._output_keys |= set(keys)

    def get_registered_output_keys(self) -> tuple[str, ...]:
        return tuple(self._output_keys)

    def request_preempt(self) -> None:
        """Asks the state to end."""
        self._preempt_requested = True

    def service_preempt(self) -> None:
        """Takes note of the request."""
        self._preempt_requested = False

    def recall_preempt(self) -> None:
        """Takes the request back."""
        self._preempt_requested = False

    def preempt_requested(self) -> bool:
        """True if the state is to end."""
        return self._preempt_requested


class CBState(State):
    """State whose work is a function of the user data."""

    def __init__(
        self,
        cb: Callable[..., Any],
        cb_args: Iterable[Any] = (),
        cb_kwargs: dict[str, Any] | None = None,
        outcomes: Iterable[str] = (),
        input_keys: Iterable[str] = (),
        output_keys: Iterable[str] = (),
        io_keys: Iterable[str] = (),
    ) -> None:
        super().__init__(outcomes, input_keys, output_keys, io_keys)
        self._cb = cb
        self._cb_args = list(cb_args)
        self._cb_kwargs = dict(cb_kwargs or {})
        if getattr(cb, "_has_smach_interface", False):
            self.register_outcomes(cb.get_registered_outcomes())  # type: ignore[attr-defined]
            self.register_input_keys(cb.get_registered_input_keys())  # type: ignore[attr-defined]
            self.register_output_keys(cb.get_registered_output_keys())  # type: ignore[attr-defined]

    def execute(self, ud: Any) -> Any:
        return self._cb(ud, *self._cb_args, **self._cb_kwargs)


def cb_interface(
    outcomes: Iterable[str] = (), input_keys: Iterable[str] = (), output_keys: Iterable[str] = ()
) -> Callable[[Any], Any]:
    """Decorator: the outcomes and keys of a function."""

    def decorate(function: Any) -> Any:
        function._has_smach_interface = True
        function.get_registered_outcomes = lambda: tuple(outcomes)
        function.get_registered_input_keys = lambda: tuple(input_keys)
        function.get_registered_output_keys = lambda: tuple(output_keys)
        return function

    return decorate


class Container(State):
    """Base of states with states inside. `with container:` opens it for `add`."""

    _open: ClassVar[list[Any]] = []

    def __init__(
        self,
        outcomes: Iterable[str] = (),
        input_keys: Iterable[str] = (),
        output_keys: Iterable[str] = (),
    ) -> None:
        super().__init__(outcomes, input_keys, output_keys)
        self.userdata = UserData()
        self._start_cbs: list[Any] = []
        self._transition_cbs: list[Any] = []
        self._termination_cbs: list[Any] = []

    def __enter__(self) -> Any:
        self.open()
        return self

    def __exit__(self, kind: Any, value: Any, trace: Any) -> None:
        self.close()
        if kind is None:
            self.check_consistency()

    def open(self) -> None:
        Container._open.append(self)

    def close(self) -> None:
        if not Container._open or Container._open[-1] is not self:
            raise InvalidStateError("close() was called on a container that is not the open one")
        Container._open.pop()

    @classmethod
    def opened(cls) -> Any:
        """The container that is open."""
        if not Container._open:
            raise InvalidStateError(f"{cls.__name__}.add() needs an open container: use it inside `with container:`")
        return Container._open[-1]

    def check_consistency(self) -> None:
        """Raises an exception if the container cannot work."""

    def get_children(self) -> dict[str, Any]:
        raise NotImplementedError

    def __getitem__(self, key: str) -> Any:
        return self.get_children()[key]

    def register_start_cb(self, callback: Any, cb_args: Iterable[Any] = ()) -> None:
        """Registers a function of the user data and the first states."""
        self._start_cbs.append((callback, list(cb_args)))

    def register_transition_cb(self, callback: Any, cb_args: Iterable[Any] = ()) -> None:
        """Registers a function of the user data and the active states."""
        self._transition_cbs.append((callback, list(cb_args)))

    def register_termination_cb(self, callback: Any, cb_args: Iterable[Any] = ()) -> None:
        """Registers a function of the user data, the last states and the outcome."""
        self._termination_cbs.append((callback, list(cb_args)))

    def _call(self, callbacks: list[Any], *args: Any) -> None:
        for callback, extra in callbacks:
            try:
                callback(self.userdata, *args, *extra)
            except Exception as error:
                logerr(f"Could not execute callback {callback}: {error}")

    def _take(self, parent_ud: Any) -> None:
        """Takes the input keys from the user data of the parent."""
        for key in self._input_keys:
            try:
                self.userdata[key] = parent_ud[key]
            except KeyError:
                logwarn(f"Attempting to copy key '{key}', but this key does not exist.")

    def _give(self, parent_ud: Any) -> None:
        """Gives the output keys to the user data of the parent."""
        for key in self._output_keys:
            if key in self.userdata:
                parent_ud[key] = self.userdata[key]
            else:
                logwarn(f"Attempting to copy key '{key}', but this key does not exist.")

    def request_preempt(self) -> None:
        super().request_preempt()
        for label in self.get_active_states():
            child = self.get_children().get(label)
            if child is not None:
                child.request_preempt()

    def get_active_states(self) -> list[str]:
        return []

    def get_initial_states(self) -> list[str]:
        return []

    def is_running(self) -> bool:
        return bool(self.get_active_states())


def run_state(label: str, state: Any, ud: Any, remapping: dict[str, str]) -> Any:
    """Executes a state; an exception of its code becomes `InvalidUserCodeError`."""
    from periplus.ros import _faults

    view = Remapper(ud, state.get_registered_input_keys(), state.get_registered_output_keys(), remapping)
    try:
        return state.execute(view)
    except InvalidUserCodeError as error:
        logerr(f"State '{label}' failed to execute.")
        raise error
    except Exception as error:
        raise InvalidUserCodeError(
            f"Could not execute state '{label}' of type '{state}': {_faults.format_exception(error)}"
        ) from error
