"""Programs apart from the actions that start them."""


class Executable:
    """A program with its arguments and its environment."""

    def __init__(self, *, cmd, prefix=None, name=None, cwd=None, env=None, additional_env=None,
                 arguments=None):
        self.cmd = list(cmd) + list(arguments or [])
        self.prefix, self.name, self.cwd = prefix, name, cwd
        self.env, self.additional_env = env, additional_env
