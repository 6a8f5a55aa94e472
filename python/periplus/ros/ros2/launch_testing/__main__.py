"""Runs the tests of a file: `python -m launch_testing FILE [NAME:=VALUE ...]`."""

import sys

from launch_testing._runner import main

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
