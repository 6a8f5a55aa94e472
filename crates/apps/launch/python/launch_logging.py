"""Loggers: what a launch file says while it is evaluated goes to the standard error."""
import logging as _logging


def get_logger(name=None):
    return _logging.getLogger(name)


class _Configuration:
    log_dir = ""
    level = _logging.INFO


launch_config = _Configuration()
