"""Conversion of colours."""
