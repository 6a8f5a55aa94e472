"""Points on a line."""

from __future__ import annotations

import math


class LineIterator:
    """Points from one end of a line to the other, `step_size` apart in x (in y for an upright line)."""

    def __init__(self, x0: float, y0: float, x1: float, y1: float, step_size: float = 1.0) -> None:
        for name, value in (("x0", x0), ("y0", y0), ("x1", x1), ("y1", y1), ("step_size", step_size)):
            if not isinstance(value, (int, float)):
                raise TypeError(f"{name} must be a number, not {type(value).__name__}")
        if step_size <= 0:
            raise ValueError(f"step_size must be greater than 0, not {step_size}")
        if x0 == x1 and y0 == y1:
            raise ValueError(f"the line has no length: both ends are at ({x0}, {y0})")
        self.x0_, self.y0_, self.x1_, self.y1_ = x0, y0, x1, y1
        self.x_, self.y_ = x0, y0
        self.step_size_ = step_size
        self.valid_ = True
        self.is_upright_ = x0 == x1
        self.slope_ = math.nan if self.is_upright_ else (y1 - y0) / (x1 - x0)

    def isValid(self) -> bool:  # noqa: N802
        """False once the line has ended."""
        return self.valid_

    def advance(self) -> None:
        """Goes to the next point."""
        if self.is_upright_:
            self.y_, self.valid_ = self._next(self.y_, self.y0_, self.y1_)
            return
        self.x_, self.valid_ = self._next(self.x_, self.x0_, self.x1_)
        if self.valid_:
            self.y_ = round(self.slope_ * (self.x_ - self.x0_) + self.y0_, 5)

    def _next(self, now: float, first: float, last: float) -> tuple[float, bool]:
        if now == last:
            return now, False
        step = self.step_size_ if last > first else -self.step_size_
        return round(self.clamp(now + step, min(first, last), max(first, last)), 5), True

    def getX(self) -> float:  # noqa: N802
        """Point's x."""
        return self.x_

    def getY(self) -> float:  # noqa: N802
        """Point's y."""
        return self.y_

    def getX0(self) -> float:  # noqa: N802
        """First point's x."""
        return self.x0_

    def getY0(self) -> float:  # noqa: N802
        """First point's y."""
        return self.y0_

    def getX1(self) -> float:  # noqa: N802
        """Last point's x."""
        return self.x1_

    def getY1(self) -> float:  # noqa: N802
        """Last point's y."""
        return self.y1_

    def get_line_length(self) -> float:
        """Length of the line."""
        return math.hypot(self.x1_ - self.x0_, self.y1_ - self.y0_)

    def clamp(self, n: float, min_n: float, max_n: float) -> float:
        """Number within limits."""
        return min_n if n < min_n else max_n if n > max_n else n
