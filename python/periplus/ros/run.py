"""Runs a Python node: `python -m periplus.ros.run FILE.py [ARGUMENTS]` or `... PACKAGE PROGRAM [ARGUMENTS]`."""

import sys

from periplus.ros._run import main

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
