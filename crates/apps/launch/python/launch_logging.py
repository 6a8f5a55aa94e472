"""Loggers: messages during the evaluation go to stderr."""
import logging as _logging


def get_logger(name=None):
    return _logging.getLogger(name)


class _Configuration:
    log_dir = ""
    level = _logging.INFO


launch_config = _Configuration()
