"""Markers that a user moves in a viewer."""
