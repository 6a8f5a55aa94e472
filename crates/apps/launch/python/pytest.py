"""The marks of `pytest`, where it is not installed: descriptions of tests are read, tests are not run."""


class _Marks:
    """Every mark, which changes nothing."""

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return _mark


def _mark(*args, **_options):
    if len(args) == 1 and callable(args[0]):
        return args[0]
    return lambda subject: subject


mark = _Marks()
fixture = _mark
