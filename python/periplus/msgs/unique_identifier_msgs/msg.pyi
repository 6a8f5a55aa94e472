import numpy as np
import numpy.typing as npt

from periplus.msgs import Message

__all__ = [
    "UUID",
]

class UUID(Message):
    @property
    def uuid(self) -> npt.NDArray[np.uint8]: ...
    @uuid.setter
    def uuid(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, uuid: npt.ArrayLike = ...) -> None: ...
