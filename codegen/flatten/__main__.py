"""python -m codegen.flatten MODEL: print the flat model."""

import sys

from ..errors import Diagnostic
from ..flat_text import dump_flat
from ..library import Library
from . import flatten

if __name__ == "__main__":
    try:
        print(dump_flat(flatten(Library(), sys.argv[1])))
    except Diagnostic as error:
        sys.exit(str(error))
