"""python -m lacuna.codegen.flatten MODEL: print the flat model."""

import sys

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flat.text import dump_flat
from lacuna.codegen.flatten import flatten
from lacuna.codegen.library.classes import Library

if __name__ == "__main__":
    try:
        print(dump_flat(flatten(Library(), sys.argv[1])))
    except Diagnostic as error:
        sys.exit(str(error))
