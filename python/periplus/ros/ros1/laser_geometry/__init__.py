"""Point clouds of laser scans."""

from laser_geometry.laser_geometry import LaserProjection

__all__ = ["LaserProjection"]
