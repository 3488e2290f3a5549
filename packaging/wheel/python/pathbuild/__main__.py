"""`python -m pathbuild`: the program itself, with the same arguments and exit status."""

import os
import subprocess
import sys

from pathbuild import program


def main() -> int:
    command = [program(), *sys.argv[1:]]
    if os.name == "nt":
        return subprocess.run(command).returncode
    os.execv(command[0], command)


if __name__ == "__main__":
    sys.exit(main())
