"""The command ``periplus``: ``python -m periplus demo``."""

import signal
import sys

from periplus._native import run_command


def main() -> int:
    """Run the command line of this process and return its exit code."""
    # The command itself decides what Ctrl-C does.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return run_command(["periplus", *sys.argv[1:]], sys.executable)


if __name__ == "__main__":
    sys.exit(main())
